"""A claim: one fact that a description takes from its manual, the lines that it cites, and what must be printed there.

`ClaimMaker` makes the claims of one subject: a point, a message, a code of the bus, a frame.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple, Self, TypeAlias

from fieldscribe.audit.manual import letters_of
from fieldscribe.diagnostics import Span
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import number_in, parse_integer
from fieldscribe.model import About

_LITERAL = re.compile(
    r"(?<![\w.'])(?:0[xX][0-9A-Fa-f]+|[Hh]'[0-9A-Fa-f]+|(?:[0-9][0-9A-Fa-f]*[hH]|[A-F][0-9A-F]*h)\b|0b[01]+|[0-9]+(?:\.[0-9]+)?)(?!\w)"
)


class Cited(NamedTuple):
    """Lines that a description cites at `key` of the YAML; `last` is 0 if `first` opens a row or section."""

    first: int
    last: int
    key: Span

    @property
    def lines(self) -> tuple[int, int]:
        """First and last line."""
        return self.first, self.last


class Number(NamedTuple):
    """One of these numbers, `times` times; or a word that contains it (`PZD2`); or a run between `ends`."""

    numbers: frozenset[Fraction]
    words: tuple[str, ...] = ()
    ends: frozenset[Fraction] = frozenset()
    times: int = 1
    names: tuple[str, ...] = ()
    """The word before the number, such as `Mux` in `Mux 3`, unless the number opens a line."""


class Run(NamedTuple):
    """Numbers in one of these orders; if `spread`, other numbers may come between them."""

    ways: tuple[tuple[frozenset[Fraction], ...], ...]
    spread: bool = False


class Label(NamedTuple):
    """One of these labels, beside one of some numbers: `adjacent` has the numbers for each way to print the list.

    A table prints flags beside their bits, or beside their masks; values beside themselves, or beside their flag's bit.
    """

    words: tuple[str, ...]
    adjacent: tuple[frozenset[Fraction], ...] = ()

    def numbers(self, way: int) -> frozenset[Fraction]:
        """Return the numbers beside the label in one way to print the list."""
        return self.adjacent[min(way, len(self.adjacent) - 1)] if self.adjacent else frozenset()


class Word(NamedTuple):
    """One of these words by itself. `rivals` are words for another fact, such as `R/W` for `R`.

    With rivals, a place that prints neither agrees. In `cells`, only whole cells count.
    """

    words: tuple[str, ...]
    rivals: tuple[str, ...] = ()
    cells: bool = False


class Bytes(NamedTuple):
    """The bytes of a frame, as hexadecimal digits."""

    digits: str


Evidence: TypeAlias = "Number | Run | Label | Word | Bytes"


@dataclass(frozen=True, slots=True, eq=False)
class Claim:
    """A fact of a subject, as `stated` in reports, and the evidence for it at every place that it cites.

    An `optional` fact need not be printed. Between two editions, one that the old edition prints must stay.
    """

    subject: str
    fact: str
    stated: str
    cited: tuple[Cited, ...]
    place: Span
    """The place of the fact in the description."""
    evidence: Evidence
    optional: bool = False
    about: About = ""
    """The subject as errata name it: a point without its variant, or another thing."""

    @property
    def where(self) -> str:
        """Its place in the description as findings show it: file:line:column."""
        return f"{self.place.file}:{self.place.line}:{self.place.column}"

    @property
    def identity(self) -> tuple[object, ...]:
        """The key of a claim: the same fact in several notations is one claim."""
        lines = tuple(cited.lines for cited in self.cited)
        return self.subject, self.fact, self.stated, lines, self.evidence, self.optional

    @property
    def numbers(self) -> frozenset[Fraction]:
        """The numbers that are evidence for it."""
        if isinstance(self.evidence, Number):
            return self.evidence.numbers
        if isinstance(self.evidence, Run):
            return frozenset().union(*(numbers for way in self.evidence.ways for numbers in way))
        return frozenset()

    @property
    def words(self) -> tuple[str, ...]:
        """The words that are evidence for it."""
        return self.evidence.words if isinstance(self.evidence, Number | Label | Word) else ()


class ClaimMaker:
    """Makes the claims of one subject, at its `line` or at the lines that its key `lines` names for a fact."""

    def __init__(self, subject: str, place: Span, line: tuple[int, Span] | None, lines: Any, about: About = "") -> None:
        self.subject, self.place, self.about = subject, place, about
        self.own_line = () if line is None else (Cited(line[0], 0, line[1]),)
        self.lines_of_fact = (
            {key: tuple(cited_lines(value, lines.span(key))) for key, value in lines.items()}
            if isinstance(lines, Map)
            else {}
        )

    @classmethod
    def of(cls, subject: str, place: Span, node: Map, about: About = "") -> Self:
        """Return the maker for a thing that has its `line` and `lines` itself."""
        line = (node["line"], node.span("line")) if node.get("line") is not None else None
        return cls(subject, place, line, node.get("lines"), about)

    def claim(  # noqa: PLR0913 - a row of the table of facts
        self,
        fact: str,
        stated: str,
        evidence: Evidence,
        place: Span | None = None,
        *,
        key: str = "",
        optional: bool = False,
    ) -> Iterator[Claim]:
        """Yield the claim, unless the description cites no line for it; `key` is its key in `lines` if not `fact`."""
        cited = self.lines_of_fact.get(key or fact, self.own_line)
        if cited:
            yield Claim(self.subject, fact, stated, cited, place or self.place, evidence, optional, self.about)

    def number(
        self, fact: str, number: Fraction, place: Span | None = None, *, key: str = "", optional: bool = False
    ) -> Iterator[Claim]:
        """Yield the claim that one number is printed."""
        yield from self.claim(fact, str(number), Number(absolute((number,))), place, key=key, optional=optional)

    def numbers(self, fact: str, value: Any, place: Span, *, key: str = "", optional: bool = False) -> Iterator[Claim]:
        """Yield a claim for each number of a value."""
        for number in numbers_in(value):
            yield from self.number(fact, number, place, key=key, optional=optional)

    def run(  # noqa: PLR0913 - a row of the table of facts
        self,
        fact: str,
        stated: str,
        ways: Sequence[Sequence[Fraction]],
        place: Span,
        *,
        key: str = "",
        spread: bool = False,
        optional: bool = False,
    ) -> Iterator[Claim]:
        """Yield the claim that numbers are printed in one of these orders."""
        runs = tuple(tuple(absolute((number,)) for number in way) for way in ways)
        if len(runs[0]) == 1:
            evidence: Evidence = Number(absolute(number for way in ways for number in way))
            yield from self.claim(fact, stated, evidence, place, key=key, optional=optional)
        elif runs[0]:
            yield from self.claim(fact, stated, Run(runs, spread), place, key=key, optional=optional)

    def label(
        self,
        fact: str,
        words: tuple[str, ...],
        place: Span,
        *,
        key: str = "",
        adjacent: Sequence[Sequence[Fraction]] = (),
    ) -> Iterator[Claim]:
        """Yield the claim that words of the manual are printed, as a title or beside numbers."""
        if any(map(letters_of, words)):
            stated = f"{abs(adjacent[0][0])} = {words[0]}" if adjacent else words[0]
            yield from self.claim(fact, stated, Label(words, tuple(map(absolute, adjacent))), place, key=key)

    def word(self, fact: str, words: tuple[str, ...], place: Span | None = None) -> Iterator[Claim]:
        """Yield the claim that one of these words is printed."""
        yield from self.claim(fact, words[0], Word(words), place)


def absolute(numbers: Iterable[Fraction]) -> frozenset[Fraction]:
    """Return numbers without their signs: a minus in a text is often a dash."""
    return frozenset(map(abs, numbers))


def cited_lines(value: Any, key: Span) -> Iterator[Cited]:
    """Read `780`, `[780, 790]` or `780..790`."""
    for item in value if isinstance(value, Seq) else (value,):
        first, dots, last = str(item).partition("..")
        yield Cited(parse_integer(first), parse_integer(last) if dots else 0, key)


def numbers_in(value: Any) -> list[Fraction]:
    """Return all numbers in a fact as the author wrote it; digits that belong to a name are not numbers."""
    if value is None or isinstance(value, bool):
        return []
    if isinstance(value, Map):
        return [number for item in value.values() for number in numbers_in(item)]
    if isinstance(value, Seq | list | tuple):
        return [number for item in value for number in numbers_in(item)]
    literals = _LITERAL.findall(str(value).replace("..", " "))
    return [number for literal in literals if (number := number_in(literal)) is not None]
