"""What two editions mean for a description, as lines of text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.audit.editions.remarks import is_spelling
from fieldscribe.report import visible

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.audit.editions.findings import Cite, Comparison, Draft, Finding, Place, Remark, Void
    from fieldscribe.report import Line

_MOST_CITES, _MOST_LINES, _MOST_PLACES, _MOST_NAMED = 6, 4, 6, 20
"""A finding shows at most so many facts that cite it, lines of each edition, and places."""
_BEFORE, _LONGEST = 60, 160
"""Of a long line so many characters are shown before what was changed, and so many in all."""
_KINDS = {
    "heads_and_feet": "heads or feet of pages",
    "front_matter": "text before all that was there",
    "contents": "the table of contents",
    "list_of_editions": "the list of editions",
    "headings": "headings over the same text",
    "references": "where something is described",
    "repeated_heads": "heads of tables on other pages",
    "wording": "the wording of lines that hold no changed fact",
    "moved": "lines that moved",
}


def as_lines(outcome: Comparison, *, everything: bool) -> Iterator[Line]:
    """All findings in the order of the new edition, remarks, then the figures; `everything` tells all of each."""
    for finding in outcome.findings:
        yield from _of_finding(finding, whole=everything or not finding.explained)
    for reason in outcome.elsewhere:
        yield [*_placed(reason.place), ("error", "missing"), ("", visible(f": {reason.text}"))]
    for void in outcome.void:
        yield [*_placed(void.place), ("error", "erratum"), ("", visible(f": {void.erratum}: {_of_void(void)}"))]
    for remark in outcome.remarks:
        yield from _of_remark(remark, whole=everything)
    yield from _doubts(outcome)
    yield from stale_notes(outcome)
    yield from figures(outcome)


def _doubts(outcome: Comparison) -> Iterator[Line]:
    """Errata in words about lines that changed."""
    for doubt in outcome.doubts:
        lines = ", ".join(str(first) if first == last else f"{first} to {last}" for first, last in doubt.lines)
        said = f": {doubt.erratum}: lines that it cites changed ({lines}): does it still hold?"
        yield [*_placed(doubt.place), ("error", "erratum"), ("", visible(said))]


def stale_notes(outcome: Comparison) -> Iterator[Line]:
    """Sentences that say what a changed line does not say any more: whether they still hold is for a reader."""
    for note in outcome.notes:
        said = ", ".join(f"`{text}` ({where})" for text, where in note.said)
        told = f": {note.key} of {note.owner} says {said}: does it still hold?"
        yield [*_placed(note.place), ("hint", "note"), ("", visible(told))]


def _of_remark(remark: Remark, *, whole: bool) -> Iterator[Line]:
    """A kind of changes with its places; of wording the words, too, if they are others and not spelt otherwise."""
    yield [("hint", "remark"), ("", f": {_KINDS[remark.kind]}: {_places(remark.places)}")]
    for finding in remark.findings:
        if whole:
            yield from ([("", "  "), *line] for line in _of_finding(finding, whole=True))
        elif remark.kind == "wording" and not is_spelling(finding):
            place = next((cite.place for cite in finding.cited_by if cite.place), finding.beside)
            yield [("", "  "), *_placed(place), ("", visible(f"{_where(finding.places[0])}: {_words(finding)}"))]


def _of_void(void: Void) -> str:
    said = "the manual now prints what was taken: it can go" if void.is_corrected else "it is no longer printed so"
    return f"line {void.line}: {said}"


def _of_finding(finding: Finding, *, whole: bool) -> Iterator[Line]:
    places = [cite.place for cite in finding.cited_by if cite.place] or [finding.beside]
    severity = "hint" if finding.explained else "error"
    explained = " (explained)" if finding.explained else ""
    yield [*_placed(places[0]), (severity, finding.kind), ("", visible(f": {_head(finding)}{explained}"))]
    if not whole:
        return
    if finding.kind != "moved":
        yield from _shown("-", finding.was, finding.was_at)
        yield from _shown("+", finding.now, finding.now_at)
    for reason in finding.reasons:
        yield [("", "  "), *_placed(reason.place), ("", visible(reason.text))]
    for void in finding.void:
        yield [("", "  "), *_placed(void.place), ("", visible(f"erratum {void.erratum}: {_of_void(void)}"))]
    yield from _cites_of(finding, places)
    for draft in finding.drafts:
        yield from _of_draft(draft)


def _cites_of(finding: Finding, places: list[str]) -> Iterator[Line]:
    """What cites the lines and is not named yet, errata first."""
    said = {reason.place for reason in finding.reasons} | {void.place for void in finding.void}
    said |= set(places[:1] if not finding.reasons else ())
    gone = {subject for reason in finding.reasons if reason.kind == "gone" for subject in reason.subjects}
    by_place: dict[str, list[Cite]] = {}
    for cite in sorted(finding.cited_by, key=lambda cite: not cite.is_erratum):
        if cite.place and cite.place not in said and cite.subject not in gone:
            by_place.setdefault(cite.place, []).append(cite)
    for place, cites in list(by_place.items())[:_MOST_CITES]:
        more = f" and {len(cites) - 1} more" if len(cites) > 1 else ""
        fact = f": {cites[0].fact} {cites[0].shown}" if cites[0].fact else ""
        yield [("", "  "), *_placed(place), ("", visible(f"{cites[0].subject}{fact}{more} cites it"))]
    if len(by_place) > _MOST_CITES:
        yield [("", f"  and {len(by_place) - _MOST_CITES} more places cite it")]


def _head(finding: Finding) -> str:
    words = _words(finding) if finding.kind in ("changed", "swapped") else ""
    if finding.explained and finding.kind in ("added", "removed"):
        words = f"`{_around((finding.now or finding.was)[0], 0)}`"
    subjects = ", ".join(dict.fromkeys(cite.subject for cite in finding.cited_by[:3]))
    if not finding.cited_by and finding.beside:
        subjects = "nothing cites it; this cites what stands above it"
    return ": ".join(filter(None, (_places(finding.places), subjects, words)))


def _words(finding: Finding) -> str:
    sign = "<->" if finding.kind == "swapped" else "->"
    return ", ".join(f"`{old}` {sign} `{new}`" for old, new in finding.words)


def _places(places: tuple[Place, ...]) -> str:
    """The places, or how many there are and the first of them."""
    if len(places) == 1:
        return _where(places[0])
    shown = "; ".join(_where(place) for place in places[:_MOST_PLACES])
    if not any(place.old for place in places) or not any(place.new for place in places):
        shown = _in_one_edition(
            [place.new or place.old or (0, 0) for place in places], "new" if places[0].new else "old"
        )
    more = f" and {len(places) - _MOST_PLACES} more" if len(places) > _MOST_PLACES else ""
    return f"{len(places)} places: {shown}{more}"


def _in_one_edition(places: list[tuple[int, int]], edition: str) -> str:
    shown = [f"{first}" if first == last else f"{first} to {last}" for first, last in places[:_MOST_PLACES]]
    return f"lines {', '.join(shown)} {'in the new' if edition == 'new' else 'of the old'} edition"


def _where(place: Place) -> str:
    old, new = _lines(place.old), _lines(place.new)
    if not old or not new:
        return f"{new} in the new edition" if new else f"{old} of the old edition"
    return old if place.old == place.new else f"{old}, now {new.removeprefix('line ').removeprefix('lines ')}"


def _lines(ends: tuple[int, int] | None) -> str:
    if ends is None:
        return ""
    return f"line {ends[0]}" if ends[0] == ends[1] else f"lines {ends[0]} to {ends[1]}"


def _shown(sign: str, lines: tuple[str, ...], starts: tuple[int, ...]) -> Iterator[Line]:
    for line, start in list(zip(lines, starts, strict=True))[:_MOST_LINES]:
        yield [("", visible(f"  {sign} {_around(line, start)}"))]
    if len(lines) > _MOST_LINES:
        yield [("", f"  {sign} ... ({len(lines)} lines)")]


def _around(line: str, start: int) -> str:
    """A line as far as it fits, around what was changed in it."""
    if len(line) <= _LONGEST:
        return line
    first = max(0, min(start - _BEFORE, len(line) - _LONGEST))
    last = first + _LONGEST
    return f"{'... ' if first else ''}{line[first:last]}{' ...' if last < len(line) else ''}"


def _of_draft(draft: Draft) -> Iterator[Line]:
    yield [("hint", visible(f"  line {draft.line} seems to be {draft.kind}, to stand {draft.place}:"))]
    for line in draft.yaml.splitlines():
        yield [("", visible(f"    {line}"))]


def _placed(place: str) -> Line:
    return [("", f"{visible(place)}: ")] if place else []


def figures(outcome: Comparison) -> Iterator[Line]:
    """How many lines and findings there are, and which edition the description counts."""
    counts = outcome.counts
    yield [("strong", visible(f"{outcome.device}: {outcome.old} against {outcome.new}"))]
    kinds = ", ".join(f"{count} {kind}" for kind, count in counts.items())
    yield [("", f"  lines     {kinds}")]
    left = "all explained" if outcome.explained else f"{outcome.unexplained} not explained"
    yield [("", f"  findings  {len(outcome.findings)}, {left}")]
    if outcome.doubts:
        ids = [doubt.erratum for doubt in outcome.doubts]
        names = ",".join(ids) if len(ids) <= _MOST_NAMED else f"and the ids named above, as in {ids[0]},{ids[1]}"
        said = f"  errata    {len(ids)} to look at: mend or remove them; if they hold, say --holds {names}"
        yield [("", visible(said))]
    if outcome.notes:
        yield [("", f"  notes     {len(outcome.notes)} to read again: they say what changed")]
    if outcome.remarks:
        yield [("", f"  remarks   {len(outcome.remarks)}, of what holds no fact: --all lists all of them")]
    if outcome.renumbered:
        yield [("", "  numbers   the description counts the lines of the new edition")]
    elif outcome.shifted:
        cited = f"{outcome.shifted} cited line{'' if outcome.shifted == 1 else 's'}"
        yield [("", f"  numbers   {cited} moved: --renumber writes the new numbers")]
    if outcome.old_is_known is False and outcome.new_is_known:
        said = f"{outcome.new} is the text that the description records: accepted before, or are the two swapped?"
        yield [("", visible(f"  note      {said}"))]
    elif outcome.old_is_known is False and not outcome.renumbered:
        yield [("", visible(f"  note      {outcome.old} is not the text that was transcribed"))]
