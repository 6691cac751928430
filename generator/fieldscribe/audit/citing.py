"""The facts of one subject, each with the lines that it cites: at the subject's own line, or where `lines` says."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from fieldscribe.audit.passage import letters_of
from fieldscribe.language.keys import keys_of
from fieldscribe.language.keys.places import PRINTED
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import NumberError, parse_integer, parse_number

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from fractions import Fraction

    from fieldscribe.diagnostics import Span
    from fieldscribe.model import About

_LITERAL = re.compile(
    r"(?<![\w.'])(?:0[xX][0-9A-Fa-f]+|[Hh]'[0-9A-Fa-f]+|(?:[0-9][0-9A-Fa-f]*[hH]|[A-F][0-9A-F]*h)\b|0b[01]+|[0-9]+(?:\.[0-9]+)?)(?!\w)"
)
OWN_PRINTED = keys_of(PRINTED)
"""What `printed` may say of every point; its other keys are the numberings of the device."""


@dataclass(frozen=True, slots=True)
class Claim:
    """A fact that the manual has to print: at least one of `numbers` or one of `words` must stand at each cited place.

    `cited` are the lines (first, last) that the description names; last is 0 where the line opens a row or section.
    `between` are the ends of a run ("bit 0 to bit 4") that may be printed in place of the number itself.
    `anchor` facts (code, section, address) help to find their subject again in a new edition.
    """

    subject: str
    fact: str
    shown: str
    numbers: frozenset[Fraction]
    words: tuple[str, ...]
    cited: tuple[tuple[int, int], ...]
    place: Span = field(compare=False)
    """Where the description says it."""
    anchor: bool = False
    between: frozenset[Fraction] = frozenset()
    about: About = ""
    """As errata name the subject: a point without its variant, or another thing."""
    optional: bool = False
    """Whether the manual may lack it; where it is printed, its numbers count as used."""
    in_order: tuple[frozenset[Fraction], ...] = ()
    """Numbers that are printed one after the other, such as both ends of a range."""
    tight: bool = False
    """Whether nothing but signs may stand between them."""
    or_in_order: tuple[frozenset[Fraction], ...] = ()
    """The same numbers in the unit or the other way round, if they may be printed so."""
    apart: bool = False
    """Whether they may also stand each somewhere: the manual has words or codes between them."""
    beside: frozenset[Fraction] = frozenset()
    """The numbers of which one is printed beside `words`."""
    or_beside: frozenset[Fraction] = frozenset()
    """Other numbers that all labels of a list may stand beside in place of those, such as the bit of a flag's value."""
    bit: frozenset[Fraction] = frozenset()
    """Of the label of a flag: its bit among the numbers `beside`, of which others are its mask."""
    entry: tuple[int, int] | None = None
    """Of a label: which entry it belongs to, counted as the description lists them, and which label of it it is."""
    times: int = 1
    """In how many notations the description says that it is printed, so that one of them is not enough."""
    unit: str = ""
    """What is printed behind the number, if it is printed so anywhere in the place."""
    names: tuple[str, ...] = ()
    """What the number belongs to, such as `Mux`: where the place prints such a name, the number stands behind it."""
    first: bool = False
    """Whether the number names its row: it stands in the first cell."""
    row: frozenset[Fraction] = frozenset()
    """The number of the bit: where one row of a table opens with it, the fact stands in that row."""
    alike: str = ""
    """What a place prints alike for all facts of the subject, or for none: an optional fact is expected there."""
    opens: bool = False
    """Whether the number stands alone in the first cell of its row."""
    behind: tuple[frozenset[Fraction], ...] = ()
    """Numbers that are printed right before it, in their order, if they are printed so at all."""
    under: frozenset[Fraction] = frozenset()
    """The number of the byte: where a table counts the bytes in its head, the number stands below that one."""
    closing: bool = False
    """Whether each of the numbers in order closes a short line, as in `b.) Byte 1`."""
    rivals: tuple[str, ...] = ()
    """Words that would say another fact in place of this one, such as `R/W` for `R`."""

    @property
    def ways(self) -> tuple[tuple[frozenset[Fraction], ...], ...]:
        """In which orders its numbers may stand."""
        return (self.in_order, self.or_in_order) if self.or_in_order else (self.in_order,)

    @property
    def where(self) -> str:
        """Its place in the description, as findings show places: file:line:column."""
        return f"{self.place.file}:{self.place.line}:{self.place.column}"

    @property
    def kind_of_subject(self) -> str:
        """What it is a fact of, such as `message`; empty for a point."""
        return self.subject.rpartition(" ")[0]

    @property
    def is_address(self) -> bool:
        """Whether it is the address of the point's first word, in the protocol or in a numbering of the manual."""
        printed = self.fact.removeprefix("printed ")
        numbering = printed != self.fact and printed not in OWN_PRINTED and not printed.startswith(("low_", "high_"))
        return self.fact == "address" or numbering


class Citing:
    """Makes the claims of one subject: at its own line, or at the lines that its key `lines` names for a fact."""

    def __init__(self, subject: str, place: Span, line: int | None, lines: Any, about: About = "") -> None:
        self.subject = subject
        self.place = place
        self.about = about
        self.own_line = () if line is None else ((line, 0),)
        self.lines_of_fact = (
            {key: tuple(spans_of(value)) for key, value in lines.items()} if isinstance(lines, Map) else {}
        )

    def numbers(  # noqa: PLR0913 - one line of a table of facts
        self,
        fact: str,
        shown: str,
        numbers: Iterable[Fraction],
        kind: str = "",
        *,
        anchor: bool = False,
        between: frozenset[Fraction] = frozenset(),
        words: tuple[str, ...] = (),
        optional: bool = False,
        times: int = 1,
        unit: str = "",
        entry: tuple[int, int] | None = None,
        names: tuple[str, ...] = (),
        first: bool = False,
        row: frozenset[Fraction] = frozenset(),
        alike: str = "",
        opens: bool = False,
        behind: tuple[frozenset[Fraction], ...] = (),
        under: frozenset[Fraction] = frozenset(),
        place: Span | None = None,
    ) -> Iterator[Claim]:
        """A fact that one of these numbers states; `kind` is its key in `lines`, where that has another name."""
        cited = self.lines_of_fact.get(kind or fact, self.own_line)
        wanted = frozenset(abs(number) for number in numbers)
        at_own_line = anchor and cited == self.own_line
        if cited and wanted:
            yield Claim(
                self.subject,
                fact,
                shown,
                wanted,
                words,
                cited,
                place or self.place,
                at_own_line,
                between,
                self.about,
                optional,
                entry=entry,
                times=times,
                names=names,
                first=first,
                row=row,
                unit=unit,
                alike=alike,
                opens=opens,
                behind=behind,
                under=under,
            )

    def in_order(  # noqa: PLR0913 - one line of a table of facts
        self,
        fact: str,
        shown: str,
        ways: Sequence[Sequence[Fraction]],
        kind: str = "",
        *,
        apart: bool = False,
        tight: bool = False,
        optional: bool = False,
        alike: str = "",
        words: tuple[str, ...] = (),
        closing: bool = False,
        place: Span,
    ) -> Iterator[Claim]:
        """Numbers that are printed one after the other, in one of two ways, or also `apart`; `words` in their line."""
        cited = self.lines_of_fact.get(kind or fact, self.own_line)
        wanted = [tuple(frozenset((abs(number),)) for number in way) for way in ways]
        if cited and wanted[0]:
            numbers = frozenset(abs(number) for way in ways for number in way)
            in_order, *others = wanted if len(wanted[0]) > 1 else [()]
            yield Claim(
                self.subject,
                fact,
                shown,
                numbers,
                words,
                cited,
                place,
                about=self.about,
                in_order=in_order,
                or_in_order=others[0] if others else (),
                apart=apart,
                tight=tight,
                optional=optional,
                alike=alike,
                closing=closing,
            )

    def label(  # noqa: PLR0913 - one line of a table of facts
        self,
        fact: str,
        words: tuple[str, ...],
        kind: str = "",
        *,
        beside: Iterable[Fraction] = (),
        or_beside: Iterable[Fraction] = (),
        bit: Iterable[Fraction] = (),
        entry: tuple[int, int] | None = None,
        place: Span,
    ) -> Iterator[Claim]:
        """Words of the manual, as a title or beside a number."""
        cited = self.lines_of_fact.get(kind or fact, self.own_line)
        numbers = list(map(abs, beside))
        if cited and any(map(letters_of, words)):
            shown = f"{numbers[0]} = {words[0]}" if numbers else words[0]
            yield Claim(
                self.subject,
                fact,
                shown,
                frozenset(),
                words,
                cited,
                place,
                about=self.about,
                beside=frozenset(numbers),
                or_beside=frozenset(map(abs, or_beside)),
                bit=frozenset(bit),
                entry=entry,
            )

    def access(self, access: str, words: tuple[str, ...], rivals: tuple[str, ...], place: Span) -> Iterator[Claim]:
        """Who may write, in the manual's notation; where the manual says nothing of it, it is no finding."""
        cited = self.lines_of_fact.get("access", self.own_line)
        if cited:
            shown = words[0] if words else access
            yield Claim(
                self.subject, "access", shown, frozenset(), words, cited, place, about=self.about, rivals=rivals
            )

    def words(self, fact: str, *words: str, place: Span | None = None) -> Iterator[Claim]:
        """A fact that one of these words states."""
        cited = self.lines_of_fact.get(fact, self.own_line)
        if cited:
            anchor = cited == self.own_line
            place = place or self.place
            yield Claim(self.subject, fact, words[0], frozenset(), words, cited, place, anchor=anchor, about=self.about)


def spans_of(value: Any) -> Iterator[tuple[int, int]]:
    """`780`, `[780, 790]` or `780..790` as spans of lines."""
    for place in value if isinstance(value, Seq) else (value,):
        first, dots, last = str(place).partition("..")
        yield parse_integer(first), parse_integer(last) if dots else 0


def numbers_in(value: Any) -> list[Fraction]:
    """All numbers in a fact as the author wrote it; digits that belong to a name are not numbers."""
    if value is None or isinstance(value, bool):
        return []
    if isinstance(value, Map):
        return [number for item in value.values() for number in numbers_in(item)]
    if isinstance(value, Seq | list | tuple):
        return [number for item in value for number in numbers_in(item)]
    numbers = []
    for literal in _LITERAL.findall(str(value).replace("..", " ")):
        try:
            numbers.append(parse_number(literal))
        except NumberError:
            continue
    return numbers
