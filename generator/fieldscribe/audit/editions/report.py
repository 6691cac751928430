"""What two editions mean for a description, as lines of text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.report import visible

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.audit.editions.findings import Comparison, Draft, Finding
    from fieldscribe.report import Line

_MOST_CITES, _MOST_LINES = 6, 4
"""A finding shows at most so many facts that cite it, and lines of each edition."""


def as_lines(outcome: Comparison, *, everything: bool) -> Iterator[Line]:
    """All changed lines in the order of the new edition, then the figures; `everything` tells all of explained ones."""
    for finding in outcome.findings:
        yield from _of_finding(finding, whole=everything or not finding.explained)
    for reason in outcome.elsewhere:
        yield [*_placed(reason.place), ("error", "missing"), ("", visible(f": {reason.text}"))]
    for void in outcome.void:
        said = "the manual now prints what was taken: it can go" if void.is_corrected else "it is no longer printed so"
        yield [*_placed(void.place), ("error", "erratum"), ("", visible(f": {void.erratum}: line {void.line}: {said}"))]
    yield from stale_notes(outcome)
    yield from figures(outcome)


def stale_notes(outcome: Comparison) -> Iterator[Line]:
    """Sentences that say what a changed line does not say any more: whether they still hold is for a reader."""
    for note in outcome.notes:
        said = ", ".join(f"`{text}` ({where})" for text, where in note.said)
        told = f": {note.key} of {note.owner} says {said}: does it still hold?"
        yield [*_placed(note.place), ("hint", "note"), ("", visible(told))]


def _of_finding(finding: Finding, *, whole: bool) -> Iterator[Line]:
    places = [cite.place for cite in finding.cited_by if cite.place]
    severity = "hint" if finding.explained else "error"
    explained = " (explained)" if finding.explained else ""
    yield [*_placed(next(iter(places), "")), (severity, finding.kind), ("", visible(f": {_head(finding)}{explained}"))]
    if not whole:
        yield from _errata_of(finding)
        return
    if finding.kind != "moved":
        yield from _shown("-", finding.was)
        yield from _shown("+", finding.now)
    for reason in finding.reasons:
        yield [("", "  "), *_placed(reason.place), ("", visible(reason.text))]
    said = {reason.place for reason in finding.reasons} | set(places[:1] if not finding.reasons else ())
    cites = [cite for cite in finding.cited_by if cite.place and cite.place not in said]
    cites.sort(key=lambda cite: not cite.is_erratum)
    for cite in cites[:_MOST_CITES]:
        fact = f": {cite.fact} {cite.shown}" if cite.fact else ""
        yield [("", "  "), *_placed(cite.place), ("", visible(f"{cite.subject}{fact} cites it"))]
    if len(cites) > _MOST_CITES:
        yield [("", f"  and {len(cites) - _MOST_CITES} more cite it")]
    for draft in finding.drafts:
        yield from _of_draft(draft)


def _errata_of(finding: Finding) -> Iterator[Line]:
    """The errata about a line that is explained: whether they still hold is for a reader, as many are sentences."""
    errata = [cite for cite in finding.cited_by if cite.is_erratum]
    for cite in errata if finding.kind == "changed" else ():
        yield [("", "  "), *_placed(cite.place), ("", visible(f"{cite.subject} cites it: does it still hold?"))]


def _head(finding: Finding) -> str:
    words = ", ".join(f"`{old}` -> `{new}`" for old, new in finding.words) if finding.kind == "changed" else ""
    if finding.explained and finding.kind in ("added", "removed"):
        words = f"`{(finding.now or finding.was)[0]}`"
    subjects = ", ".join(dict.fromkeys(cite.subject for cite in finding.cited_by[:3]))
    return ": ".join(filter(None, (_where(finding), subjects, words)))


def _where(finding: Finding) -> str:
    old, new = _lines(finding.old), _lines(finding.new)
    if not old or not new:
        return f"{new} in the new edition" if new else f"{old} of the old edition"
    return old if finding.old == finding.new else f"{old}, now {new.removeprefix('line ').removeprefix('lines ')}"


def _lines(ends: tuple[int, int] | None) -> str:
    if ends is None:
        return ""
    return f"line {ends[0]}" if ends[0] == ends[1] else f"lines {ends[0]} to {ends[1]}"


def _shown(sign: str, lines: Iterable[str]) -> Iterator[Line]:
    lines = list(lines)
    for line in lines[:_MOST_LINES]:
        yield [("", visible(f"  {sign} {line}"))]
    if len(lines) > _MOST_LINES:
        yield [("", f"  {sign} ... ({len(lines)} lines)")]


def _of_draft(draft: Draft) -> Iterator[Line]:
    yield [("hint", visible(f"  line {draft.line} seems to be {draft.kind}, to stand {draft.place}:"))]
    for line in draft.yaml.splitlines():
        yield [("", visible(f"    {line}"))]


def _placed(place: str) -> Line:
    return [("", f"{visible(place)}: ")] if place else []


def figures(outcome: Comparison) -> Iterator[Line]:
    """How many lines and findings there are, and which edition the description counts."""
    counts = outcome.counts
    unexplained = sum(not finding.explained for finding in outcome.findings)
    unexplained += len(outcome.elsewhere) + len(outcome.void)
    yield [("strong", visible(f"{outcome.device}: {outcome.old} against {outcome.new}"))]
    kinds = ", ".join(f"{count} {kind}" for kind, count in counts.items())
    yield [("", f"  lines     {kinds}")]
    left = "all explained" if outcome.explained else f"{unexplained} not explained"
    yield [("", f"  findings  {len(outcome.findings)}, {left}")]
    if outcome.notes:
        yield [("", f"  notes     {len(outcome.notes)} to read again: they say what changed")]
    if outcome.renumbered:
        yield [("", "  numbers   the description counts the lines of the new edition")]
    elif outcome.shifted:
        cited = f"{outcome.shifted} cited line{'' if outcome.shifted == 1 else 's'}"
        yield [("", f"  numbers   {cited} moved: --renumber writes the new numbers")]
    if outcome.old_is_known is False and not outcome.renumbered:
        yield [("", visible(f"  note      {outcome.old} is not the text that was transcribed"))]
