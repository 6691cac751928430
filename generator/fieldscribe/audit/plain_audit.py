"""The plain audit: cited facts that a text does not print, and numbers at cited places that no fact uses."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, field
from functools import cached_property
from itertools import groupby

from fieldscribe.audit.claims import Claim, Label, Word
from fieldscribe.audit.evidence import printed_notations
from fieldscribe.audit.held import Citations, Held
from fieldscribe.audit.manual import Extent, Passage
from fieldscribe.audit.numbers import readings_of

_SHORT = 100
"""The most characters of a line in a finding."""
_SHORT_LABEL = 60
_COMPOUND = re.compile(r"-[^\W\d]{2,}")
"""What makes a number part of a word: `16-bit`."""
_CAPTION = re.compile(
    r"[\s*_]*(?:Abbildung|Abb\.|Bild|Tabelle|Tab\.|Figure|Fig\.|Picture|Table)\s+[0-9]+(?:[-.][0-9]+)*\s*[:.\u2013-]",
    re.IGNORECASE,
)
"""The number of a picture or a table is not a fact."""
_END_OF_CELL = re.compile(r"[|\t\n]|<br>")


@dataclass(frozen=True, slots=True)
class Missing:
    """A fact that is not printed where it is cited.

    `place` is the place in the description (file:line:column), `printed` the text there instead, `nearest` the nearest
    line that prints the fact; both are None if unknown.
    """

    subject: str
    fact: str
    wanted: str
    line: int
    last: int
    place: str
    printed: str | None
    nearest: int | None


@dataclass(frozen=True, slots=True)
class Unused:
    """A number in a cited place that no fact uses. `place` is that of the first subject in the description."""

    line: int
    column: int
    number: str
    subjects: tuple[str, ...]
    place: str


@dataclass(frozen=True, slots=True)
class Uncited:
    """A section, or rows of a table up to `last`, that nothing cites; `among_cited` if others of the section are."""

    line: int
    last: int
    kind: str
    text: str
    among_cited: bool


@dataclass(frozen=True, slots=True)
class Unprinted:
    """An erratum whose printed text is not at its line."""

    erratum: str
    printed: str
    line: int
    place: str


@dataclass(slots=True)
class Audit:
    """All findings. `facts` counts the claims; `uncheckable` the errata without a number or a quotation."""

    device: str
    manual: str
    same_text: bool | None
    """True if the text is the one that was transcribed; None if the description does not record its checksum."""
    lines: int
    facts: int = 0
    errata: int = 0
    uncheckable: int = 0
    missing: list[Missing] = field(default_factory=list)
    unprinted: list[Unprinted] = field(default_factory=list)
    unused: list[Unused] = field(default_factory=list)
    uncited: list[Uncited] = field(default_factory=list)

    @property
    def is_clean(self) -> bool:
        """True if everything cited is printed, errata too, and the cited places have no other numbers."""
        return self.findings == 0 and not self.cites_nothing

    @property
    def cites_nothing(self) -> bool:
        """True if the description cites no line of the text, so that nothing was compared."""
        return self.facts + self.errata == 0

    @property
    def findings(self) -> int:
        """The number of findings."""
        return len(self.missing) + len(self.unprinted) + len(self.unused) + len(self.added)

    @property
    def added(self) -> list[Uncited]:
        """The rows that nothing cites among rows that are cited."""
        return [place for place in self.uncited if place.among_cited]

    @property
    def counts(self) -> dict[str, int]:
        """The number of findings of each kind."""
        return {
            "facts": self.facts,
            "missing": len(self.missing),
            "errata": self.errata,
            "errata_not_printed": len(self.unprinted),
            "errata_uncheckable": self.uncheckable,
            "unused_numbers": len(self.unused),
            "uncited": sum(place.last - place.line + 1 for place in self.uncited),
        }

    def as_data(self) -> dict[str, object]:
        """Return the same for JSON."""
        return {
            "device": self.device,
            "manual": self.manual,
            "same_text": self.same_text,
            "clean": self.is_clean,
            "counts": self.counts,
            "missing": [asdict(fact) for fact in self.missing],
            "errata_not_printed": [asdict(erratum) for erratum in self.unprinted],
            "unused_numbers": [asdict(number) for number in self.unused],
            "uncited": [asdict(place) for place in self.uncited],
        }


def audit(citations: Citations, name: str, text: str, *, same_text: bool | None) -> Audit:
    """Compare a description with the text `name`; `same_text` as in `Audit`."""
    return audit_of(Held(citations, citations.manual(text)), name, same_text=same_text)


def audit_of(held: Held, name: str, *, same_text: bool | None) -> Audit:
    """Return the findings of a description that is already compared with a text."""
    claims = held.citations.claims
    outcome = Audit(held.citations.device, name, same_text, len(held.manual))
    outcome.facts = sum(not claim.optional for claim in claims)
    outcome.errata = len(held.citations.errata)
    _errata(held, outcome)
    unused = list(_Unused(held).all())
    missing = [claim for claim in claims if not claim.optional and not held.stands(claim)]
    by_line = {line: list(numbers) for line, numbers in groupby(unused, key=lambda number: number.line)}
    outcome.missing = [_missing(claim, held, by_line) for claim in missing]
    instead = {(fact.line, fact.printed) for fact in outcome.missing if fact.printed is not None}
    outcome.unused = [number for number in unused if (number.line, number.number) not in instead]
    outcome.uncited = sorted(_uncited(held), key=lambda place: place.line)
    return outcome


def _errata(held: Held, outcome: Audit) -> None:
    """Search for the printed texts of errata."""
    for erratum in held.citations.errata:
        if not erratum.numbers and not erratum.texts:
            outcome.uncheckable += 1
        elif not held.erratum_stands(erratum):
            place = f"{erratum.place.file}:{erratum.place.line}:{erratum.place.column}"
            outcome.unprinted.append(Unprinted(erratum.id, erratum.stated, erratum.cited[0].first, place))


def _missing(claim: Claim, held: Held, unused: dict[int, list[Unused]]) -> Missing:
    extents = [place.extent for place in held.places[claim]]
    first, last = (extents[0].first, extents[0].last) if extents else claim.cited[0].lines
    there = [number for extent in extents for line in extent.lines for number in unused.get(line, ())]
    printed = _printed_instead(claim, [held.passage(extent) for extent in extents], there)
    nearest = None if printed else held.manual.nearest_with(claim.numbers, claim.words, first)
    return Missing(claim.subject, claim.fact, claim.stated, first, last, claim.where, printed, nearest)


def _printed_instead(claim: Claim, passages: list[Passage], unused: list[Unused]) -> str | None:
    """Return what is printed instead: words beside the number of a label, another access, or the only unused number."""
    evidence = claim.evidence
    if isinstance(evidence, Word) and evidence.rivals:
        return next((word for passage in passages for word in printed_notations(evidence, passage.pieces[0][2])), None)
    if isinstance(evidence, Label):
        labels = (_label_with_number(evidence, passage) for passage in passages if evidence.adjacent)
        return next((words for words in labels if words), None)
    others = {number.number for number in unused if not readings_of(number.number) & claim.numbers}
    return others.pop() if len(others) == 1 and (claim.numbers or claim.fact == "code") else None


def _label_with_number(label: Label, passage: Passage) -> str | None:
    for token, end in zip(passage.tokens, passage.ends, strict=True):
        if token.readings & label.numbers(0):
            words = _END_OF_CELL.split(passage.text[end:], maxsplit=1)[0].strip(" .:=)-")
            if any(map(str.isalpha, words)):
                return words[:_SHORT_LABEL]
    return None


class _Unused:
    """Finds the numbers in cited places that no fact uses, and codes there that the description does not know."""

    def __init__(self, held: Held) -> None:
        self.held, self.manual = held, held.manual

    def all(self) -> Iterator[Unused]:
        owners: dict[int, tuple[str, dict[str, None]]] = {}
        for extent, subjects in self.held.extents.items():
            for line in extent.lines:
                owners.setdefault(line, (next(iter(subjects.values())), {}))[1].update(dict.fromkeys(subjects))
        whole = {line for line, numbers in self.held.passed_over.items() if not numbers}
        for line in sorted(owners.keys() - whole - self.manual.page_lines):
            place, names = owners[line]
            for column, text in sorted(self._of_line(line)):
                yield Unused(line, column, text, tuple(names), place)

    def _of_line(self, line: int) -> Iterator[tuple[int, str]]:
        known = self.held.citations.codes | self.held.passed_over.get(line, frozenset())
        text = self.manual.line(line)
        caption = _CAPTION.match(text)
        for token in self.manual.tokens(line):
            is_word = token.text in known or _COMPOUND.match(text, token.column - 1 + len(token.text))
            in_caption = caption is not None and token.column <= caption.end()
            if (line, token.column) not in self.held.used and not is_word and not in_caption:
                yield token.column, token.text
        columns = {token.column for token in self.manual.tokens(line)}
        for match in self._forms_of_codes.finditer(text):
            if (
                match.start() + 1 not in columns
                and match[0] not in known
                and (line, match.start() + 1) not in self.held.used
            ):
                yield match.start() + 1, match[0]

    @cached_property
    def _forms_of_codes(self) -> re.Pattern[str]:
        """Return patterns of letters and at least three digits, like the codes of the description."""
        codes = [code for code in self.held.citations.codes if re.fullmatch("[A-Za-z]+[0-9]{3,}", code)]
        forms = {re.sub("[0-9]", "[0-9]", code) for code in codes}
        return re.compile(rf"(?<!\w)(?:{'|'.join(sorted(forms))})(?!\w)" if forms else "(?!)")


def _uncited(held: Held) -> Iterator[Uncited]:
    """Yield sections and rows of tables that nothing cites."""
    manual = held.manual
    extents: list[Extent] = list(held.extents)
    of_errata = (cited for erratum in held.citations.errata for cited in erratum.cited)
    extents += [extent for cited in of_errata if (extent := held.extent(cited)) is not None]
    covered = {line for extent in extents for line in extent.lines}
    covered |= {line for line, numbers in held.passed_over.items() if not numbers}
    for line in manual.headings:
        if covered.isdisjoint(manual.section_around(line).lines):
            yield Uncited(line, line, "section", manual.line(line).strip()[:_SHORT], among_cited=False)
    rows = (line for line in range(1, len(manual) + 1) if line not in covered and line not in manual.page_lines)
    for first, last in _runs(line for line in rows if manual.is_row(line) and manual.tokens(line)):
        among_cited = not covered.isdisjoint(manual.section_around(first).lines)
        yield Uncited(first, last, "row", manual.line(first).strip()[:_SHORT], among_cited=among_cited)


def _runs(lines: Iterable[int]) -> Iterator[tuple[int, int]]:
    """Yield the first and the last line of each run of consecutive lines."""
    for _, run in groupby(enumerate(lines), key=lambda entry: entry[1] - entry[0]):
        numbers = [line for _, line in run]
        yield numbers[0], numbers[-1]
