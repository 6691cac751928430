"""An audit for people: lines of text for a terminal, and a page that stands alone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.report import visible

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.audit.outcome import Audit
    from fieldscribe.report import Line

_TEXTS = {
    True: "the text that was transcribed",
    False: "not the text that was transcribed",
    None: "a text without a known checksum",
}


def as_lines(found: Audit, *, everything: bool) -> Iterator[Line]:
    """What has to be looked at, worst first, then the figures; with `everything` also what is only worth a look."""
    for one in found.missing:
        where = f"line {one.line}" if one.last in (0, one.line) else f"lines {one.line} to {one.last}"
        said = f": {one.subject}: {one.fact} {one.wanted} is not at {where}; {_near(one.nearest)}"
        yield [("error", "missing"), ("", visible(said))]
    for erratum in found.unprinted:
        said = f": {erratum.erratum}: {erratum.printed} is not at line {erratum.line}; {_near(erratum.nearest)}"
        yield [("error", "erratum"), ("", visible(said))]
    for first, last, by, count in found.shifts():
        lines = f"line {first}" if first == last else f"lines {first} to {last}"
        places = f"{count} cited place{'' if count == 1 else 's'}"
        side = "below" if by > 0 else "above"
        yield [("warning", "moved"), ("", f": {places} of {lines} stand {abs(by)} lines {side}")]
    for number in found.unused if everything else ():
        subjects = ", ".join(number.subjects[:3]) + (", ..." if len(number.subjects) > 3 else "")
        yield [("hint", "unused"), ("", visible(f": line {number.line}: {number.number} ({subjects})"))]
    for place in found.uncited if everything else ():
        yield [("hint", "uncited"), ("", visible(f": line {place.line}: {place.kind}: {place.text}"))]
    yield from _figures(found, everything)


def _near(line: int | None) -> str:
    return "it stands nowhere in the manual" if line is None else f"the nearest place is line {line}"


def _figures(found: Audit, everything: bool) -> Iterator[Line]:
    counts = found.counts
    checked = counts["errata"] - counts["errata_uncheckable"]
    tail = "" if everything else " (--all lists them)"
    yield [("strong", f"{found.device} against {visible(found.manual)}"), ("", f" ({_TEXTS[found.same_text]})")]
    for label, text in (
        ("facts", f"{counts['facts']}, {counts['missing']} of them not where they are cited"),
        ("errata", f"{checked} with a printed text to look for, {counts['errata_not_printed']} not there"),
        ("moved", f"{counts['moved']} cited places"),
        ("unused", f"{counts['unused_numbers']} numbers in cited places that no fact uses{tail}"),
        ("uncited", f"{counts['uncited']} sections and rows{tail}"),
    ):
        yield [("", f"  {label:<8} {text}")]


@dataclass(frozen=True, slots=True)
class _Table:
    """One table of the page."""

    title: str
    heads: tuple[str, ...]
    rows: list[tuple[object, ...]]


def as_html(found: Audit) -> str:
    """A page of tables that needs nothing beside it."""
    from fieldscribe.render import render

    where = "none"
    tables = [
        _Table(
            "Facts that are not where they are cited",
            ("Subject", "Fact", "Wanted", "Line", "Nearest"),
            [(one.subject, one.fact, one.wanted, one.line, one.nearest or where) for one in found.missing],
        ),
        _Table(
            "Errata whose printed text is not there",
            ("Erratum", "Printed", "Line", "Nearest"),
            [(one.erratum, one.printed, one.line, one.nearest or where) for one in found.unprinted],
        ),
        _Table(
            "Cited places that moved",
            ("Subject", "Cited line", "Line now"),
            [(one.subject, one.line, one.now) for one in found.moved],
        ),
        _Table(
            "Numbers in cited places that no fact uses",
            ("Line", "Number", "Cited by"),
            [(one.line, one.number, ", ".join(one.subjects)) for one in found.unused],
        ),
        _Table(
            "Sections and rows that nothing cites",
            ("Line", "Kind", "Text"),
            [(one.line, one.kind, one.text) for one in found.uncited],
        ),
    ]
    seen = [_Table(one.title, one.heads, [tuple(map(_shown, row)) for row in one.rows]) for one in tables]
    view = {"found": found, "manual": visible(found.manual), "text": _TEXTS[found.same_text], "tables": seen}
    return render("audit.html.j2", view)


def _shown(cell: object) -> str:
    return visible(str(cell))
