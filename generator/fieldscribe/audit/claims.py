"""What a description takes from its manual: each fact with the lines that it cites."""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import NumberError, parse_number

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from fieldscribe.checks.subject import Subject
    from fieldscribe.model import Point
    from fieldscribe.resolve.drafts import Draft

_LITERAL = re.compile(
    r"(?<![\w.'])(?:0[xX][0-9A-Fa-f]+|[Hh]'[0-9A-Fa-f]+|[0-9][0-9A-Fa-f]*[hH]\b|0b[01]+|[0-9]+(?:\.[0-9]+)?)(?!\w)"
)
_LINES = re.compile(r"\blines?\s+[0-9]+(?:(?:,|\s+and|\s+to|\.\.)\s*[0-9]+)*(?:\s+and\s+[0-9]+)?")
_QUOTED = re.compile('["\u201e\u201c]([^"\u201c\u201d]+)["\u201c\u201d]')
_ELEMENT = re.compile(r"\[.*|\(.*")
_HALVES = {(15, 8): ("Highbyte", "High-Byte", "High Byte"), (7, 0): ("Lowbyte", "Low-Byte", "Low Byte")}
"""How manuals name the halves of a word."""
_OWN_PRINTED = frozenset({"range", "range_in_units", "resolution", "choices"})


@dataclass(frozen=True, slots=True)
class Claim:
    """A fact that has to stand in the manual: one of `numbers`, or one of `words`.

    `cited` are the lines (first, last) that are named for it; last is 0 where the line opens a row or section.
    `between` are the ends of a run of numbers that the manual may print in its place ("bit 0 to bit 4").
    `anchor` facts (code, section, address) tell where their subject stands in a manual that changed.
    """

    subject: str
    fact: str
    shown: str
    numbers: frozenset[Fraction]
    words: tuple[str, ...]
    cited: tuple[tuple[int, int], ...]
    anchor: bool = False
    between: frozenset[Fraction] = frozenset()
    point: str = ""
    """As errata name the subject: a point without its variant, `frame:NAME`, `function:NUMBER`."""


@dataclass(frozen=True, slots=True)
class PrintedErratum:
    """What an erratum says that the manual prints, and where."""

    id: str
    shown: str
    numbers: tuple[Fraction, ...]
    texts: tuple[str, ...]
    lines: tuple[int, ...]
    subjects: tuple[str, ...]
    taken: frozenset[Fraction]
    """What the description has instead: facts that the manual does not print."""
    told: bool
    """Whether it is told in a sentence, which may speak of what stands around the line too."""


def claims_of(subject: Subject) -> Iterator[Claim]:
    """All facts of points, frames, codes of the bus, messages and telegrams that name a line."""
    for resolved in subject.resolved:
        yield from _of_point(resolved.point, resolved.draft, subject.scope.named_enums)
    for name, entries in subject.scope.named_enums.items():
        yield from _of_enum(name, entries)
    for file in subject.scope.files:
        for key in ("commands", "messages", "telegrams"):
            for one in file.get(key, ()):
                yield from _of_entry(key.removesuffix("s"), one)
        yield from _of_frames(file)
        bus = file.get("bus")
        if isinstance(bus, Map):
            for key in ("functions", "responses", "exceptions"):
                yield from _of_codes(key, bus.get(key))


def errata_of(subject: Subject) -> Iterator[PrintedErratum]:
    """All errata that name a line."""
    for one in subject.errata:
        erratum = one.erratum
        if erratum.source.line is None:
            continue
        printed = one.raw.get("printed")
        line = erratum.source.line
        taken = frozenset(abs(number) for number in _numbers(one.raw.get("taken")))
        about = (one.subjects, taken)
        if isinstance(printed, Map):
            numbers = [number for key, value in printed.items() for number in _printed_numbers(key, value)]
            yield PrintedErratum(erratum.id, erratum.printed, tuple(numbers), (), (line,), *about, told=False)
            continue
        said = str(printed)
        named = [int(number) for lines in _LINES.findall(said) for number in re.findall("[0-9]+", lines)]
        quoted = tuple(text for text in _QUOTED.findall(said) if len(text) > 1)
        numbers = _numbers(_LINES.sub("", said))
        yield PrintedErratum(erratum.id, erratum.printed, tuple(numbers), quoted, (line, *named), *about, told=True)


class _Citing:
    """Makes the claims of one subject: at its line, or at the lines that `lines` names for a fact."""

    def __init__(self, subject: str, line: int | None, others: Any, point: str = "") -> None:
        self.subject = subject
        self.point = point
        self.usual = () if line is None else ((line, 0),)
        self.others = {key: tuple(_lines(value)) for key, value in others.items()} if isinstance(others, Map) else {}

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
    ) -> Iterator[Claim]:
        cited = self.others.get(kind or fact, self.usual)
        wanted = frozenset(abs(number) for number in numbers)
        if cited and wanted:
            yield Claim(
                self.subject, fact, shown, wanted, words, cited, anchor and cited == self.usual, between, self.point
            )

    def words(self, fact: str, *words: str) -> Iterator[Claim]:
        cited = self.others.get(fact, self.usual)
        if cited:
            yield Claim(self.subject, fact, words[0], frozenset(), words, cited, anchor=cited == self.usual)


def _of_point(point: Point, draft: Draft, enums: Mapping[str, Map]) -> Iterator[Claim]:
    citing = _Citing(point.item, point.source.line, draft.get("lines"), point.name)
    code = None if point.code is None else _ELEMENT.sub("", point.code).strip()
    if code:
        yield from citing.words("code", code)
    own_section = draft.own.get("section")
    if own_section is not None:
        yield from citing.words("section", str(own_section))
    yield from _address(citing, point, draft, code or "")
    yield from _numbers_of(citing, point, draft)
    yield from _enum_of(citing, point, draft, enums)
    yield from _flags(citing, point)
    yield from _printed(citing, draft)


def _numbers_of(citing: _Citing, point: Point, draft: Draft) -> Iterator[Claim]:
    """The limits, the scale, the bits of the word, the numbers of the enum."""
    for key in ("range", "range_in_units"):
        if _says(draft, key) and not point.flags:  # the flags of a word say which numbers it holds
            for number in _numbers(draft.get(key)):
                yield from citing.numbers(
                    "range", str(number), _either(point, number, in_units=key == "range_in_units")
                )
    if _says(draft, "scale"):
        for number in _scale_numbers(draft.get("scale")):
            yield from citing.numbers("scale", str(number), (number, 1 / number))
    if point.bits is not None:
        words = _HALVES.get(point.bits, ())
        for bit in dict.fromkeys(point.bits):
            yield from citing.numbers("bits", str(bit), (Fraction(bit), Fraction(1 << bit)), words=words)


def _enum_of(citing: _Citing, point: Point, draft: Draft, enums: Mapping[str, Map]) -> Iterator[Claim]:
    """The numbers of the point's enum; those of a shared one that name a line of their own are looked for there."""
    if not _says(draft, "enum") or point.enum is None:
        return
    said = draft.get("enum")
    entries = enums.get(said, {}) if isinstance(said, str) else said
    own = {number for key, one in entries.items() if isinstance(one, Map) and "line" in one for number in _numbers(key)}
    for entry in point.enum.entries:
        if entry.raw not in own or entries is said:
            yield from citing.numbers("enum", str(entry.raw), (Fraction(entry.raw),))


def _of_enum(name: str, entries: Map) -> Iterator[Claim]:
    for key, one in entries.items():
        if isinstance(one, Map) and "line" in one:
            citing = _Citing(f"enum {name}", one["line"], None)
            yield from citing.numbers("enum", str(key), _numbers(key), anchor=True)


def _says(draft: Draft, key: str) -> bool:
    """Whether the point (or its format, record, set) says a fact itself; what its group says has no line."""
    layer = draft.layer(key)
    return layer is not None and layer is not draft.group


def _address(citing: _Citing, point: Point, draft: Draft, code: str) -> Iterator[Claim]:
    if point.address is None:
        return
    references = [Fraction(number) for number in point.references.values() if isinstance(number, int)]
    at = draft.get("at")
    rule = [Fraction(int(str(at["number"]), 0))] if isinstance(at, Map) and str(at.get("number", "")).isdigit() else []
    if code and any(str(number) in code for number in (point.address, *map(int, rule))):
        return  # the code is the number
    if point.text is not None:
        for address in (point.addresses[0], point.addresses[-1]):
            yield from citing.numbers("address", str(address), (Fraction(address),), anchor=True)
        return
    yield from citing.numbers(
        "address", f"{point.address:04X}h", (Fraction(point.address), *references, *rule), anchor=True
    )


def _either(point: Point, number: Fraction, *, in_units: bool) -> list[Fraction]:
    """A limit in raw and in the unit, where one rule holds."""
    cases = point.scale or ()
    if len(cases) != 1 or cases[0].rule.factors:
        return [number]
    rule = cases[0].rule
    return [number, number * rule.ratio + rule.offset if in_units else (number - rule.offset) / rule.ratio]


def _scale_numbers(raw: Any) -> list[Fraction]:
    texts = [raw] if isinstance(raw, str) else [one["rule"] for one in raw or ()]
    return [number for text in texts for number in _numbers(text) if number not in (0, 1)]


def _flags(citing: _Citing, point: Point) -> Iterator[Claim]:
    above = point.bits[1] if point.bits else 0
    always = point.fixed.bits if point.fixed is not None else 0
    for flag in point.flags:
        for bit in dict.fromkeys((flag.low + flag.width - 1, flag.low)):
            numbers = (
                Fraction(bit + above),
                Fraction(1 << bit),
                Fraction(1 << bit + above),
                Fraction(1 << bit | always),
            )
            run = _run(point, bit)
            between = frozenset(Fraction(end + above) for end in run) if bit not in run else frozenset()
            yield from citing.numbers("flags", f"bit {bit + above}", numbers, between=between)
        for entry in flag.values if flag.width > 1 else ():
            yield from citing.numbers("flag values", f"{flag.name} {entry.raw}", (Fraction(entry.raw),), "flags")


def _run(point: Point, bit: int) -> tuple[int, int]:
    """The ends of the run of named bits around a bit."""
    named = {one for flag in point.flags for one in range(flag.low, flag.low + flag.width)}
    low = high = bit
    while low - 1 in named:
        low -= 1
    while high + 1 in named:
        high += 1
    return low, high


def _printed(citing: _Citing, draft: Draft) -> Iterator[Claim]:
    printed = draft.get("printed")
    for key, value in printed.items() if isinstance(printed, Map) else ():
        for number in _numbers(value):
            if key == "resolution" and number == 1:
                continue  # a unit alone says it
            kind = "range" if key in ("range", "range_in_units") else "address" if key not in _OWN_PRINTED else key
            yield from citing.numbers(f"printed {key}", str(number), (number,), kind)


def _of_entry(kind: str, one: Map) -> Iterator[Claim]:
    citing = _Citing(f"{kind} {one['name']}", one.get("line"), one.get("lines"))
    for key in ("at", "can_id", "words", "wears"):
        for number in _numbers(one.get(key)):
            yield from citing.numbers(key, str(number), (number,))


def _of_codes(kind: str, codes: Any) -> Iterator[Claim]:
    for key, one in codes.items() if isinstance(codes, Map) else ():
        if isinstance(one, Map):
            citing = _Citing(f"{kind.removesuffix('s')} {key}", one.get("line"), one.get("lines"))
            for number in _numbers(key):
                yield from citing.numbers("number", str(key), (number,), anchor=True)
            for fact in ("max", "answers", "refusals"):
                for number in _numbers(one.get(fact)):
                    yield from citing.numbers(fact, str(number), (number,))


def _of_frames(file: Map) -> Iterator[Claim]:
    for one in file.get("frames", ()):
        citing = _Citing(f"frame {one['name']}", one.get("line"), one.get("lines"), f"frame:{one['name']}")
        digits = "".join(str(one["bytes"]).split()).upper()
        if citing.usual:
            yield Claim(citing.subject, "bytes", digits, frozenset(), (), citing.others.get("bytes", citing.usual))


def _printed_numbers(key: str, value: Any) -> list[Fraction]:
    """The numbers of a printed fact; a checksum is bytes."""
    if key != "crc":
        return _numbers(value)
    return [Fraction(byte) for byte in bytes.fromhex("".join(str(value).split()))]


def _lines(value: Any) -> Iterator[tuple[int, int]]:
    """`780`, `[780, 790]` or `780..790` as spans of lines."""
    for one in value if isinstance(value, Seq) else (value,):
        first, dots, last = str(one).partition("..")
        yield int(first), int(last) if dots else 0


def _numbers(value: Any) -> list[Fraction]:
    """All numbers that stand in a fact as the author wrote it; names with digits in them are none."""
    if value is None or isinstance(value, bool):
        return []
    if isinstance(value, Map):
        return [number for one in value.values() for number in _numbers(one)]
    if isinstance(value, Seq | list | tuple):
        return [number for one in value for number in _numbers(one)]
    found = []
    for literal in _LITERAL.findall(str(value).replace("..", " ")):
        try:
            found.append(parse_number(literal))
        except NumberError:
            continue
    return found
