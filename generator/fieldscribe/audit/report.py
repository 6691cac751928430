"""Renders the audit: as lines of text for a terminal, and as a self-contained page."""

from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import NamedTuple

from fieldscribe.audit.comparison import ChangedLine, CitedFact, Comparison
from fieldscribe.audit.plain_audit import Audit, Missing, Unused
from fieldscribe.diagnostics import Line, visible

_MOST_NUMBERS = 8
"""The most numbers of one place in a finding."""
_FEWEST_TOGETHER = 4
"""From this many facts of a subject on that are missing at one place, they are one finding."""
_MOST_WORDS = 200
_TEXTS = {
    True: "the text that was transcribed",
    False: "not the text that was transcribed",
    None: "a text without a known checksum",
}


def audit_lines(outcome: Audit, *, everything: bool) -> Iterator[Line]:
    """Yield the findings and the figures; `everything` adds the sections and rows that nothing cites."""
    for _, facts in groupby(outcome.missing, key=lambda fact: (fact.subject, fact.line)):
        yield from _missing_together(list(facts))
    for erratum in outcome.unprinted:
        yield _finding(erratum.place, "erratum", f"{erratum.erratum}: {erratum.printed} is not at line {erratum.line}")
    for numbers in _unused_together(outcome.unused):
        yield _finding(numbers[0].place, "unused", _unused(numbers))
    for place in outcome.uncited:
        if place.among_cited or everything:
            rows = f"{place.last - place.line + 1} rows" if place.last > place.line else place.kind
            text = f": {_lines(place.line, place.last)}: {rows}: {place.text}"
            yield [("error" if place.among_cited else "hint", "uncited"), ("", visible(text))]
    if outcome.cites_nothing:
        yield [("error", "uncited"), ("", ": no fact cites a line of the manual, so nothing was compared")]
        yield [("hint", "  hint"), ("", ": `line: 123` at a point is the line of the text that prints it")]
    elif outcome.same_text is False and not outcome.is_clean:
        yield [("hint", "hint"), ("", ": each fact is looked for at its line: give the text before with --old")]
    yield from _figures_of_audit(outcome, everything)


def _missing_together(facts: list[Missing]) -> Iterator[Line]:
    """Yield a finding for each fact, or one for a subject if nearly none of its facts are at their place."""
    if len(facts) < _FEWEST_TOGETHER:
        for fact in facts:
            yield _finding(fact.place, "missing", f"{fact.subject}: {_missing(fact)}")
        return
    first = facts[0]
    named = "; ".join(f"{fact.fact} {fact.wanted}" for fact in facts[:_FEWEST_TOGETHER])
    more = f" and {len(facts) - _FEWEST_TOGETHER} more" if len(facts) > _FEWEST_TOGETHER else ""
    where = f"{len(facts)} facts are not at {_lines(first.line, first.last)}"
    yield _finding(first.place, "missing", f"{first.subject}: {where}: {named}{more}; {_near(first.nearest)}")


def _missing(fact: Missing) -> str:
    where = _lines(fact.line, fact.last)
    if fact.printed is not None:
        return f"{fact.fact}: the description says {fact.wanted}, the manual prints {fact.printed} at {where}"
    if fact.nearest is not None and fact.line <= fact.nearest <= max(fact.line, fact.last):
        return f"{fact.fact} {fact.wanted} is not printed as it should be at {where}"
    return f"{fact.fact} {fact.wanted} is not at {where}; {_near(fact.nearest)}"


def _unused_together(unused: list[Unused]) -> Iterator[list[Unused]]:
    """Yield the unused numbers of one place, grouped by runs of adjacent lines."""
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
    reported = ", ".join(number.number[:_MOST_WORDS] for number in numbers[:_MOST_NUMBERS])
    more = f" and {len(numbers) - _MOST_NUMBERS} more" if len(numbers) > _MOST_NUMBERS else ""
    column = f", column {first.column}" if len(numbers) == 1 else ""
    return f"{subjects}: no fact uses {reported}{more} at {_lines(first.line, numbers[-1].line)}{column}"


def _finding(place: str, kind: str, text: str) -> Line:
    return [("", visible(f"{place}: ")), ("error", kind), ("", visible(f": {text}"))]


def _lines(first: int, last: int) -> str:
    return f"line {first}" if last in (0, first) else f"lines {first} to {last}"


def _near(line: int | None) -> str:
    return "it is printed nowhere near" if line is None else f"the nearest place is line {line}"


def _figures_of_audit(outcome: Audit, everything: bool) -> Iterator[Line]:
    counts = outcome.counts
    checked = counts["errata"] - counts["errata_uncheckable"]
    tail = "" if everything else " (--all lists them)"
    yield [("strong", f"{outcome.device} against {visible(outcome.manual)}"), ("", f" ({_TEXTS[outcome.same_text]})")]
    for label, text in (
        ("facts", f"{counts['facts']}, {counts['missing']} of them not where they are cited"),
        ("errata", f"{checked} with a printed text to look for, {counts['errata_not_printed']} not there"),
        ("unused", f"{counts['unused_numbers']} numbers in cited places that no fact uses"),
        ("uncited", f"{counts['uncited']} sections and rows{tail}"),
    ):
        yield [("", f"  {label:<8} {text}")]


def comparison_lines(outcome: Comparison, *, with_lines: bool = True) -> Iterator[Line]:
    """Yield every line that differs between two editions with facts that cite it, missing facts and the figures."""
    lines = outcome.lines if with_lines else []
    for line in lines:
        yield from _changed_line(line)
    reported = {fact for line in lines for fact in line.facts}
    others = [fact for fact in outcome.fallen if fact not in reported]
    for subject, facts in groupby(others, key=lambda fact: fact.subject):
        for place, named in _listed(list(facts)):
            yield _finding(place, "missing", f"{subject}: {named}: not printed where it is cited")
    for erratum in outcome.errata:
        yield [("error", "erratum"), ("", visible(f": {erratum}: its printed text is no longer there"))]
    yield from _figures_of_comparison(outcome)


def _changed_line(line: ChangedLine) -> Iterator[Line]:
    words = ", ".join(f"`{_short(was)}` -> `{_short(now)}`" for was, now in line.words)
    where = f"line {line.old_line}" if line.old_line is not None else f"line {line.new_line} of the new edition"
    if line.old_line is not None and line.new_line not in (None, line.old_line):
        where += f", now {line.new_line}"
    uncited = "" if line.facts else "no fact cites it"
    details = "".join(f": {visible(text)}" for text in (words, uncited) if text)
    yield [("strong", line.kind), ("", f": {where}{details}")]
    if line.old_line is not None:
        yield [("", f"  - {visible(line.old.strip())}")]
    if line.kind in ("changed", "added"):
        yield [("", f"  + {visible(line.new.strip())}")]
    fallen = [fact for fact in line.facts if not fact.stands]
    for subject, facts in groupby(fallen, key=lambda fact: fact.subject):
        for place, named in _listed(list(facts)):
            yield [("", "  "), *_finding(place, "missing", f"{subject}: {named}: no longer printed there")]
    standing = [fact for fact in line.facts if fact.stands]
    for subject, facts in groupby(standing, key=lambda fact: fact.subject):
        listed = list(facts)
        named = ", ".join(dict.fromkeys(f"{fact.fact} {_short(fact.says)}" for fact in listed))
        yield [("", visible(f"  {listed[0].place}: {subject}: stands: {named}"))]


def _listed(facts: list[CitedFact]) -> list[tuple[str, str]]:
    """Return place and name of each fact of a subject; many facts are joined, at the place of the first."""
    named = [f"{fact.fact} {_short(fact.says)}" for fact in facts]
    if len(facts) < _FEWEST_TOGETHER:
        return [(fact.place, name) for fact, name in zip(facts, named, strict=True)]
    return [(facts[0].place, ", ".join(dict.fromkeys(named)))]


def _short(text: str) -> str:
    return text if len(text) <= _MOST_WORDS else text[:_MOST_WORDS] + "..."


def _figures_of_comparison(outcome: Comparison) -> Iterator[Line]:
    """Yield the figures of two editions."""
    counts = outcome.counts
    kinds = ", ".join(f"{counts[kind]} {kind}" for kind in ("changed", "added", "removed", "moved"))
    fallen, errata = counts["facts_that_fell"], counts["errata_not_printed"]
    missing = "every cited fact stands" if not fallen else f"{fallen} that {'does' if fallen == 1 else 'do'} not stand"
    yield [("strong", f"{outcome.device}: {visible(outcome.old)} against {visible(outcome.new)}")]
    yield [("", f"  lines    {kinds}; {counts['without_facts']} that no fact cites")]
    yield [("", f"  facts    {missing}" + (f"; {errata} errata whose printed text is gone" if errata else ""))]
    if counts["to_renumber"]:
        yield [("", f"  numbers  {counts['to_renumber']} places cite lines of the old edition: add --renumber")]


class _Table(NamedTuple):
    """One table of the page."""

    title: str
    heads: tuple[str, ...]
    rows: Sequence[tuple[object, ...]]


def audit_page(outcome: Audit) -> str:
    """Return a self-contained page of tables."""
    from fieldscribe.resources import render

    tables = [
        _Table(
            "Facts that are not where they are cited",
            ("Place", "Analysis", "Fact", "The description says", "The manual prints", "Line", "Nearest"),
            [
                (fact.place, fact.subject, fact.fact, fact.wanted, fact.printed or "", fact.line, fact.nearest or "")
                for fact in outcome.missing
            ],
        ),
        _Table(
            "Errata whose printed text is not there",
            ("Place", "Erratum", "Printed", "Line"),
            [(erratum.place, erratum.erratum, erratum.printed, erratum.line) for erratum in outcome.unprinted],
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
    safe = [table._replace(rows=[tuple(visible(str(cell)) for cell in row) for row in table.rows]) for table in tables]
    verdict = "Some cited facts are not printed where they are cited."
    if outcome.cites_nothing:
        verdict = "No fact cites a line of the manual, so nothing was compared."
    elif outcome.is_clean:
        verdict = "Every cited fact is printed where it is cited."
    text = _TEXTS[outcome.same_text]
    view = {"found": outcome, "manual": visible(outcome.manual), "text": text, "verdict": verdict, "tables": safe}
    return render("audit.html.j2", view)
