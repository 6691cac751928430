"""Changes that are one for a reader: what is exchanged, what the same fact stood on, what is done at many places."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from fieldscribe.audit.editions.findings import Ends, Finding, Reason, Void

    Pairs = tuple[tuple[str, str], ...]

_NEAR = 6
"""Two lines that are exchanged stand within so many lines."""
_TELLING = re.compile(r"[^\W\d_]{4}")
"""A word that is changed in the same way at many places has so many letters."""


def joined(findings: Iterable[Finding]) -> list[Finding]:
    """The findings in their order, each change told once."""
    told = _merged(map(_with_swaps, findings), _are_exchanged, _as_exchanged)
    told = _merged(told, _share_a_fact, _in_one)
    return _equal_once(told)


def with_elsewhere(findings: list[Finding], elsewhere: Iterable[Reason]) -> tuple[list[Finding], list[Reason]]:
    """Facts that do not hold though their lines are as they were, told where the same place of the YAML is told of."""
    left: list[Reason] = []
    for reason in elsewhere:
        at = (number for number, finding in enumerate(findings) if _says(finding, reason))
        if (number := next(at, -1)) < 0:
            left.append(reason)
        else:
            finding = findings[number]
            findings[number] = replace(finding, reasons=said_once((*finding.reasons, reason)))
    return findings, list(said_once(left))


def _says(finding: Finding, reason: Reason) -> bool:
    """Whether a finding says the same of the same place, or of a point of the same file that repeats the fact."""
    return any(
        other.said == reason.said and other.place.split(":")[0] == reason.place.split(":")[0]
        for other in finding.reasons
    )


def with_void(findings: list[Finding], void: Iterable[Void]) -> tuple[list[Finding], list[Void]]:
    """Errata that became void, each with a change of what it cites: of its line, or one that asks for something."""
    left: list[Void] = []
    for erratum in void:
        name = f"erratum {erratum.erratum}"
        citing = [at for at, finding in enumerate(findings) if any(cite.subject == name for cite in finding.cited_by)]
        best = sorted(citing, key=lambda at: (_lacks(findings[at], erratum), findings[at].explained))
        if best:
            findings[best[0]] = replace(findings[best[0]], void=(*findings[best[0]].void, erratum))
        else:
            left.append(erratum)
    return findings, left


def _lacks(finding: Finding, erratum: Void) -> bool:
    """Whether a finding is not about the line of an erratum."""
    return finding.new is None or not finding.new[0] <= erratum.line <= finding.new[1]


def said_once(reasons: Iterable[Reason]) -> tuple[Reason, ...]:
    """Reasons that say the same of several subjects at one place as one; of what is gone, only that."""
    reasons = list(reasons)
    gone: dict[tuple[str, ...], str] = {}
    for reason in reasons:
        if reason.kind == "gone":
            gone.setdefault(reason.subjects, reason.place)
    together: dict[tuple[str, str, str], Reason] = {}
    for reason in reasons:
        if reason.kind == "missing" and reason.subjects in gone:
            continue
        place = gone[reason.subjects] if reason.kind == "gone" else reason.place
        key = (reason.kind, reason.said, place)
        before = together.get(key, replace(reason, place=place))
        together[key] = replace(before, subjects=tuple(dict.fromkeys((*before.subjects, *reason.subjects))))
    return tuple(together.values())


def _merged(
    findings: Iterable[Finding],
    belong: Callable[[Finding, Finding], bool],
    merge: Callable[[Finding, Finding], Finding],
) -> list[Finding]:
    """Each two neighbours that belong together as one."""
    told: list[Finding] = []
    for finding in findings:
        if told and belong(told[-1], finding):
            told[-1] = merge(told[-1], finding)
        else:
            told.append(finding)
    return told


def _with_swaps(finding: Finding) -> Finding:
    """The finding as a swap, where all its words changed places with each other."""
    words = finding.words
    exchanged = finding.kind == "changed" and len(words) > 1 and _turned(words) == Counter(words)
    if not exchanged or any(not old or not new for old, new in words):
        return finding
    return replace(finding, kind="swapped", words=_once_each(words))


def _once_each(words: Pairs) -> Pairs:
    kept: dict[tuple[str, str], None] = {}
    for old, new in words:
        if (new, old) not in kept:
            kept[old, new] = None
    return tuple(kept)


def _are_exchanged(above: Finding, below: Finding) -> bool:
    """Whether two lines have each other's words now."""
    if not (above.kind == below.kind == "changed" and above.old and below.old and _is_plain(above)):
        return False
    return 0 < below.old[0] - above.old[1] <= _NEAR and _turned(above.words) == Counter(below.words)


def _is_plain(finding: Finding) -> bool:
    return all(old and new for old, new in finding.words)


def _turned(words: Pairs) -> Counter[tuple[str, str]]:
    return Counter((new, old) for old, new in words)


def _as_exchanged(above: Finding, below: Finding) -> Finding:
    return replace(_in_one(above, below), kind="swapped", words=above.words)


def _share_a_fact(above: Finding, below: Finding) -> bool:
    """Whether one fact stood on two lines, one below the other."""
    if not (above.kind == below.kind == "changed" and above.old and below.old and below.old[0] == above.old[1] + 1):
        return False
    missing = {(reason.said, reason.place) for reason in above.reasons if reason.kind == "missing"}
    return any((reason.said, reason.place) in missing for reason in below.reasons if reason.kind == "missing")


def _in_one(above: Finding, below: Finding) -> Finding:
    """Two findings about lines that belong together."""
    place = replace(above.places[0], old=_around(above.old, below.old), new=_around(above.new, below.new))
    return replace(
        above,
        places=(place,),
        was=(*above.was, *below.was),
        now=(*above.now, *below.now),
        was_at=(*above.was_at, *below.was_at),
        now_at=(*above.now_at, *below.now_at),
        words=(*above.words, *below.words),
        **_told_of_both(above, below),
    )


def _told_of_both(finding: Finding, other: Finding) -> dict[str, Any]:
    return {
        "cited_by": tuple(dict.fromkeys((*finding.cited_by, *other.cited_by))),
        "reasons": said_once((*finding.reasons, *other.reasons)),
        "drafts": (*finding.drafts, *other.drafts),
    }


def _around(lines: Ends | None, others: Ends | None) -> Ends | None:
    ends = [*(lines or ()), *(others or ())]
    return (min(ends), max(ends)) if ends else None


def _equal_once(findings: list[Finding]) -> list[Finding]:
    """What is done in the same way at many places as one finding: the one that asks for something, or the first."""
    groups: dict[object, list[Finding]] = {}
    for finding in findings:
        groups.setdefault(_likeness(finding), []).append(finding)
    told = {}
    for group in groups.values():
        for alike in _told_together(group):
            first = next((finding for finding in alike if not finding.explained), alike[0])
            told[id(first)] = _at_all_places(first, alike)
    return [told[id(finding)] for finding in findings if id(finding) in told]


def _told_together(group: list[Finding]) -> Iterator[list[Finding]]:
    """Lines that were equal are one finding; lines with equal words are, if at most one of them asks for something."""
    open_ones = [finding for finding in group if not finding.explained]
    if len(open_ones) < 2 or len(set(map(_of_lines, group))) == 1:
        yield group
    else:
        yield from ([finding] for finding in group)


def _likeness(finding: Finding) -> object:
    """What equal changes have in common."""
    if finding.kind == "changed" and any(_TELLING.search(old) and _TELLING.search(new) for old, new in finding.words):
        return finding.kind, finding.words
    return _of_lines(finding) if finding.kind != "moved" else finding.places


def _of_lines(finding: Finding) -> object:
    """Equal lines that were changed in the same way, wherever the new ones break."""
    if finding.kind != "changed":
        return finding.kind, finding.was, finding.now
    return finding.kind, finding.was, finding.was_at, finding.words


def _at_all_places(first: Finding, alike: list[Finding]) -> Finding:
    others = [finding for finding in alike if finding is not first]
    for other in others:
        first = replace(first, places=(*first.places, *other.places), **_told_of_both(first, other))
    return first
