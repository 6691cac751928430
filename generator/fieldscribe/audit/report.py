"""An audit for people: lines of text for a terminal, and a page that stands alone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.report import visible

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.audit.outcome import Audit, Missing, Unused
    from fieldscribe.report import Line

_SHOWN = 8
"""A finding shows so many of the numbers of one place."""
_TEXTS = {
    True: "the text that was transcribed",
    False: "not the text that was transcribed",
    None: "a text without a known checksum",
}
_NO_LAYOUT = "no fingerprint of the text that was transcribed is kept: each line is looked for where it was"
_KEEP = "audit that text with --fingerprint, or give it as --old"


def as_lines(outcome: Audit, *, everything: bool) -> Iterator[Line]:
    """The findings, worst first, then the figures; `everything` adds unused numbers and uncited rows."""
    for fact in outcome.missing:
        yield [("", visible(fact.place) + ": "), ("error", "missing"), ("", visible(_missing(fact)))]
    for erratum in outcome.unprinted:
        message = f": {erratum.erratum}: {erratum.printed} is not at line {erratum.line}; {_near(erratum.nearest)}"
        yield [("error", "erratum"), ("", visible(message))]
    for first, last, by, count in outcome.shifts():
        lines = _lines(first, last)
        places = f"{count} cited place{'' if count == 1 else 's'}"
        side = "below" if by > 0 else "above"
        yield [("warning", "moved"), ("", f": {places} of {lines} stand {abs(by)} lines {side}")]
    for numbers in _together(outcome.unused):
        yield [("", visible(numbers[0].place) + ": "), ("error", "unused"), ("", visible(_unused(numbers)))]
    for place in outcome.uncited:
        kind = "error" if place.among_cited else "hint"
        if place.among_cited or everything:
            rows = f"{place.last - place.line + 1} rows" if place.last > place.line else place.kind
            yield [(kind, "uncited"), ("", visible(f": {_lines(place.line, place.last)}: {rows}: {place.text}"))]
    if outcome.same_text is False and not outcome.has_fingerprint:
        yield [("hint", "hint"), ("", f": {_NO_LAYOUT}; {_KEEP}")]
    yield from _figures(outcome, everything)


def _missing(fact: Missing) -> str:
    where = _lines(fact.line, fact.last)
    subject = f"{fact.subject} and {len(fact.also)} more" if fact.also else fact.subject
    told = f"{fact.fact} {fact.wanted}"
    if fact.lost > 1:
        return f": {subject}: {fact.lost} facts are not at {where}; {told}: {_near(fact.nearest)}"
    if fact.printed is not None:
        says = f"the description says {fact.wanted}, the manual prints {fact.printed}"
        return f": {subject}: {fact.fact}: {says} at {where}"
    if fact.nearest is not None and fact.line <= fact.nearest <= fact.last:
        lacks = "is not everywhere where places like it have it"
        return f": {subject}: {told} {lacks}, at {where}; line {fact.nearest} has it"
    return f": {subject}: {told} is not at {where}; {_near(fact.nearest)}"


def _together(unused: list[Unused]) -> Iterator[list[Unused]]:
    """The numbers of one place that stand in lines one below the other."""
    numbers: list[Unused] = []
    for number in unused:
        if numbers and (number.subjects != numbers[-1].subjects or number.line > numbers[-1].line + 1):
            yield numbers
            numbers = []
        numbers.append(number)
    if numbers:
        yield numbers


def _unused(numbers: list[Unused]) -> str:
    first = numbers[0]
    subjects = ", ".join(first.subjects[:3]) + (", ..." if len(first.subjects) > 3 else "")
    shown = ", ".join(number.number for number in numbers[:_SHOWN])
    more = f" and {len(numbers) - _SHOWN} more" if len(numbers) > _SHOWN else ""
    column = f", column {first.column}" if len(numbers) == 1 else ""
    return f": {subjects}: no fact uses {shown}{more} at {_lines(first.line, numbers[-1].line)}{column}"


def _lines(first: int, last: int) -> str:
    return f"line {first}" if last in (0, first) else f"lines {first} to {last}"


def _near(line: int | None) -> str:
    return "it stands nowhere in the manual" if line is None else f"the nearest place is line {line}"


def _figures(outcome: Audit, everything: bool) -> Iterator[Line]:
    counts = outcome.counts
    checked = counts["errata"] - counts["errata_uncheckable"]
    tail = "" if everything else " (--all lists them)"
    yield [("strong", f"{outcome.device} against {visible(outcome.manual)}"), ("", f" ({_TEXTS[outcome.same_text]})")]
    for label, text in (
        ("facts", f"{counts['facts']}, {counts['missing']} of them not where they are cited"),
        ("errata", f"{checked} with a printed text to look for, {counts['errata_not_printed']} not there"),
        ("moved", f"{counts['moved']} cited places"),
        ("unused", f"{counts['unused_numbers']} numbers in cited places that no fact uses"),
        ("uncited", f"{counts['uncited']} sections and rows{tail}"),
    ):
        yield [("", f"  {label:<8} {text}")]


@dataclass(frozen=True, slots=True)
class _Table:
    """One table of the page."""

    title: str
    heads: tuple[str, ...]
    rows: list[tuple[object, ...]]


def as_html(outcome: Audit) -> str:
    """A page of tables that needs nothing beside it."""
    from fieldscribe.render import render

    where = "none"
    tables = [
        _Table(
            "Facts that are not where they are cited",
            ("Place", "Subject", "Fact", "The description says", "The manual prints", "Line", "Nearest"),
            [
                (
                    *(fact.place, fact.subject, fact.fact, fact.wanted),
                    fact.printed or "",
                    fact.line,
                    fact.nearest or where,
                )
                for fact in outcome.missing
            ],
        ),
        _Table(
            "Errata whose printed text is not there",
            ("Erratum", "Printed", "Line", "Nearest"),
            [
                (erratum.erratum, erratum.printed, erratum.line, erratum.nearest or where)
                for erratum in outcome.unprinted
            ],
        ),
        _Table(
            "Cited places that moved",
            ("Subject", "Cited line", "Line now"),
            [(place.subject, place.line, place.now) for place in outcome.moved],
        ),
        _Table(
            "Numbers in cited places that no fact uses",
            ("Place", "Line", "Number", "Cited by"),
            [(number.place, number.line, number.number, ", ".join(number.subjects)) for number in outcome.unused],
        ),
        _Table(
            "Sections and rows that nothing cites",
            ("Line", "Last", "Kind", "Text"),
            [(place.line, place.last, place.kind, place.text) for place in outcome.uncited],
        ),
    ]
    seen = [_Table(table.title, table.heads, [tuple(map(_shown, row)) for row in table.rows]) for table in tables]
    view = {"found": outcome, "manual": visible(outcome.manual), "text": _TEXTS[outcome.same_text], "tables": seen}
    return render("audit.html.j2", view)


def _shown(cell: object) -> str:
    return visible(str(cell))
