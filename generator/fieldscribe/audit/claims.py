"""What a description takes from its manual: each fact with the lines that it cites."""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from fieldscribe.families import families
from fieldscribe.language.keys import keys_of
from fieldscribe.language.keys.places import PRINTED
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import NumberError, parse_number

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from fieldscribe.checks.subject import Subject
    from fieldscribe.model import Point
    from fieldscribe.resolve.drafts import Draft

_LITERAL = re.compile(
    r"(?<![\w.'])(?:0[xX][0-9A-Fa-f]+|[Hh]'[0-9A-Fa-f]+|(?:[0-9][0-9A-Fa-f]*[hH]|[A-F][0-9A-F]*h)\b|0b[01]+|[0-9]+(?:\.[0-9]+)?)(?!\w)"
)
_LINES = re.compile(r"\blines?\s+[0-9]+(?:(?:,|\s+and|\s+to|\.\.)\s*[0-9]+)*(?:\s+and\s+[0-9]+)?")
_QUOTED = re.compile('["\u201e\u201c]([^"\u201c\u201d]+)["\u201c\u201d]')
_ELEMENT = re.compile(r"\[.*|\(.*")
_CODE = re.compile("([A-Za-z]+)([0-9]+)")
_LINES_OF = {"range_in_units": "range", "pairs": "printed"}
"""The key of `lines` for what is printed, where it is another."""
_OWN_PRINTED = keys_of(PRINTED)


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
    optional: bool = False
    """What the manual need not say, such as a title in the author's own words: where it does stand, it is used."""

    @property
    def is_address(self) -> bool:
        """Whether it says where the point's first word is, in some numbering."""
        printed = self.fact.removeprefix("printed ")
        numbering = printed != self.fact and printed not in _OWN_PRINTED and not printed.startswith("low_")
        return self.fact == "address" or numbering


@dataclass(frozen=True, slots=True)
class PrintedErratum:
    """What an erratum says that the manual prints, and where."""

    id: str
    shown: str
    numbers: tuple[Fraction, ...]
    texts: tuple[str, ...]
    cited: tuple[tuple[int, int], ...]
    """Lines (first, last); last is 0 where the line opens a row or section."""
    subjects: tuple[str, ...]
    taken: frozenset[Fraction]
    """What the description has instead: facts that the manual does not print."""
    told: bool
    """Whether it is told in a sentence, which may speak of what stands around the line too."""
    taken_text: str = ""
    """`taken` as it is written: codes that the manual does not print stand there."""


def claims_of(subject: Subject) -> Iterator[Claim]:
    """All facts of points, frames, codes of the bus, messages and telegrams that name a line."""
    written = Written(subject.scope.header["documents"])
    for resolved in subject.resolved:
        yield from _of_point(resolved.point, resolved.draft, subject.scope.named_enums, written)
    for name, entries in subject.scope.named_enums.items():
        yield from _of_enum(name, entries)
    for file in subject.scope.files:
        for key in ("commands", "messages", "telegrams"):
            for one in file.get(key, ()):
                yield from _of_entry(key.removesuffix("s"), one)
        yield from _of_frames(file)
        bus = file.get("bus")
        if isinstance(bus, Map):
            yield from _of_line(bus)
            for key in ("functions", "responses", "exceptions"):
                yield from _of_codes(key, bus.get(key))


def errata_of(subject: Subject) -> Iterator[PrintedErratum]:
    """All errata that name a line."""
    for one in subject.errata:
        erratum = one.erratum
        if erratum.source.line is None:
            continue
        printed = one.raw.get("printed")
        lines = one.raw.get("lines")
        others = [place for value in lines.values() for place in _lines(value)] if isinstance(lines, Map) else []
        cited = (*_lines(one.raw["line"]), *others)
        taken = frozenset(abs(number) for number in _numbers(one.raw.get("taken")))
        about = (one.subjects, taken)
        if isinstance(printed, Map):
            numbers = [number for key, value in printed.items() for number in _printed_numbers(key, value)]
            yield PrintedErratum(
                erratum.id, erratum.printed, tuple(numbers), (), cited, *about, told=False, taken_text=erratum.taken
            )
            continue
        said = str(printed)
        named = [(int(number), 0) for places in _LINES.findall(said) for number in re.findall("[0-9]+", places)]
        quoted = tuple(text for text in _QUOTED.findall(said) if len(text) > 1)
        numbers = _numbers(_LINES.sub("", said))
        cited = (*cited, *named)
        yield PrintedErratum(
            erratum.id, erratum.printed, tuple(numbers), quoted, cited, *about, told=True, taken_text=erratum.taken
        )


def looked_through_of(subject: Subject) -> set[int]:
    """The lines that the description says hold nothing for it."""
    spans = [
        span for file in subject.scope.files for one in file.get("looked_through", ()) for span in _lines(one["lines"])
    ]
    return {line for first, last in spans for line in range(first, max(first, last) + 1)}


class Written:
    """How the manuals of a device write what its description writes otherwise: what `writes` of its documents says."""

    def __init__(self, documents: Map) -> None:
        self._words: dict[str, list[str]] = {}
        for document in documents.values():
            for ours, theirs in document.get("writes", {}).items():
                self._words.setdefault(str(ours), []).extend(theirs)

    def code(self, letters: str) -> list[str]:
        """The words in place of the letters of a code: `Parameter` of `P`."""
        return self._words.get(letters, [])

    def bits(self, high: int, low: int) -> list[str]:
        """The names of a part of a word: `Highbyte` of 15..8."""
        return self._words.get(f"{high}..{low}", [])

    def number(self, number: Fraction) -> list[str]:
        """The words for a number: `zero` of 0."""
        return self._words.get(str(number), [])


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
        optional: bool = False,
    ) -> Iterator[Claim]:
        cited = self.others.get(kind or fact, self.usual)
        wanted = frozenset(abs(number) for number in numbers)
        first = anchor and cited == self.usual
        if cited and wanted:
            yield Claim(self.subject, fact, shown, wanted, words, cited, first, between, self.point, optional)

    def title(self, titles: Mapping[str, str], kind: str = "") -> Iterator[Claim]:
        """The titles, where they stand as they are given."""
        words = tuple(text for text in titles.values() if any(char.isdigit() for char in text))
        cited = self.others.get(kind, self.usual)
        if words and cited:
            yield Claim(self.subject, "title", words[0], frozenset(), words, cited, optional=True)

    def words(self, fact: str, *words: str) -> Iterator[Claim]:
        cited = self.others.get(fact, self.usual)
        if cited:
            anchor = cited == self.usual
            yield Claim(self.subject, fact, words[0], frozenset(), words, cited, anchor=anchor, point=self.point)


def _of_point(point: Point, draft: Draft, enums: Mapping[str, Map], written: Written) -> Iterator[Claim]:
    citing = _Citing(point.item, point.source.line, draft.get("lines"), point.name)
    code = None if point.code is None else _ELEMENT.sub("", point.code).strip()
    if code:
        yield from citing.words("code", *_codes_of(code, written), str(point.code))
    if _says(draft, "section"):
        yield from citing.words("section", str(draft.get("section")))
    yield from _address(citing, point, draft, code or "")
    yield from citing.title({**point.title, "": (point.variant or "").partition("=")[2]})
    yield from _numbers_of(citing, point, draft, written)
    yield from _enum_of(citing, point, draft, enums)
    yield from _flags(citing, point, written)
    yield from _printed(citing, draft)


def _codes_of(code: str, written: Written) -> tuple[str, ...]:
    """How a manual writes a code: `P601`, `P 601`, and with the words that it has for the letters."""
    found = _CODE.fullmatch(code)
    if found is None:
        return (code,)
    letters, digits = found.groups()
    return (code, f"{letters} {digits}", *(f"{word} {digits}" for word in written.code(letters)))


def _numbers_of(citing: _Citing, point: Point, draft: Draft, written: Written) -> Iterator[Claim]:
    """The limits, the scale, the bits of the word, the numbers of the enum."""
    for key in ("range", "range_in_units"):
        if _says(draft, key) and not point.flags:  # the flags of a word say which numbers it holds
            for number in _numbers(draft.get(key)):
                yield from citing.numbers(
                    "range", str(number), _either(point, number, in_units=key == "range_in_units")
                )
    yield from _bits_of(citing, point, draft, written)
    if point.text is not None and _says(draft, "characters"):
        yield from citing.numbers("characters", str(point.text.characters), (Fraction(point.text.characters),), "range")
    if _says(draft, "scale"):
        for number in _scale_numbers(draft.get("scale")):
            yield from citing.numbers("scale", str(number), (number, 1 / number))


def _bits_of(citing: _Citing, point: Point, draft: Draft, written: Written) -> Iterator[Claim]:
    """The bits that the point takes, and those beside it that are always the same."""
    if point.bits is not None:
        words = tuple(written.bits(*point.bits))
        for place in range(point.bits[1], point.bits[0] + 1):
            inner = place not in point.bits
            yield from citing.numbers(
                "bits", str(place), (Fraction(place), Fraction(1 << place)), words=words, optional=inner
            )
    fixed = draft.get("fixed") if _says(draft, "fixed") else None
    for bits, constant in fixed.items() if isinstance(fixed, Map) else ():
        for bit in _numbers(bits):
            yield from citing.numbers("fixed bits", str(bit), (bit, Fraction(1 << int(bit))), "bits")
        for number in _numbers(constant):
            yield from citing.numbers(
                "fixed bits", f"= {number}", (number,), "bits", words=tuple(written.number(number))
            )


def _enum_of(citing: _Citing, point: Point, draft: Draft, enums: Mapping[str, Map]) -> Iterator[Claim]:
    """The numbers of the point's enum; those of a shared one that name a line of their own are looked for there."""
    key = "digits" if point.digits else "enum"
    enum = point.digits.enum if point.digits else point.enum
    if not _says(draft, key) or enum is None:
        return
    said = draft.get(key)
    said = said["enum"] if point.digits else said
    entries = enums.get(said, {}) if isinstance(said, str) else said
    own = {number for key, one in entries.items() if isinstance(one, Map) and "line" in one for number in _numbers(key)}
    for entry in enum.entries:
        if entry.raw not in own or entries is said:
            yield from citing.numbers("enum", str(entry.raw), (Fraction(entry.raw),))
            yield from citing.title(entry.title, "enum")
            for number in _numbers(entry.quantity):
                yield from citing.numbers("enum", str(entry.quantity), (number,))


def _of_enum(name: str, entries: Map) -> Iterator[Claim]:
    for key, one in entries.items():
        if isinstance(one, Map) and "line" in one:
            citing = _Citing(f"enum {name}", one["line"], None)
            yield from citing.numbers("enum", str(key), _numbers(key), anchor=True)
            yield from citing.title({name: str(text) for name, text in one.items() if len(name) == 2})


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
    for number in (*rule, *map(Fraction, filter(None, (point.set, point.index)))):
        yield from citing.numbers("number", str(number), (number,), "code", optional=True)
    if code and any(str(number) in code for number in (point.address, *map(int, rule))):
        return  # the code is the number
    if point.text is not None:
        ends = frozenset(map(Fraction, (point.addresses[0], point.addresses[-1])))
        for address in map(Fraction, point.addresses):
            inner = ends if address not in ends else frozenset()
            yield from citing.numbers("address", str(address), (address,), anchor=not inner, between=inner)
        return
    yield from citing.numbers(
        "address",
        f"{point.address:04X}h",
        (Fraction(point.address), *references, *rule),
        anchor=True,
        words=tuple(word for name, number in point.references.items() for word in _joined(name, number)),
    )


def _joined(numbering: str, number: object) -> tuple[str, ...]:
    """How a manual writes a number that is part of a name: `PZD2`, `Bit13`."""
    return tuple(f"{name}{number}" for name in (numbering, numbering.capitalize(), numbering.upper()))


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


def _flags(citing: _Citing, point: Point, written: Written) -> Iterator[Claim]:
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
            words = (*written.bits(flag.low + flag.width - 1, flag.low), *_joined("bit", bit + above))
            yield from citing.numbers("flags", f"bit {bit + above}", numbers, between=between, words=words)
        yield from citing.title(flag.title, "flags")
        for entry in flag.values:
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
        told = [*value.keys(), *value.values()] if key == "pairs" else value
        for number in _numbers(told):
            if key == "resolution" and number == 1:
                continue  # a unit alone says it
            kind = _LINES_OF.get(key, key if key in _OWN_PRINTED else "address")
            words = _joined(key, number) if kind == "address" else ()
            yield from citing.numbers(f"printed {key}", str(number), (number,), kind, words=words)


def _of_entry(kind: str, one: Map) -> Iterator[Claim]:
    citing = _Citing(f"{kind} {one['name']}", one.get("line"), one.get("lines"))
    identifiers = tuple(key for family in families() if family.lays_out_messages for key in family.frame_keys)
    for key in ("at", *identifiers, "value", "words", "wears"):
        for number in _numbers(one.get(key)):
            yield from citing.numbers(key, str(number), (number,))
    layout = one.get("layout")
    for place, carried in layout.items() if isinstance(layout, Map) else ():
        for number in (*_numbers(place), *_numbers(carried)):
            yield from citing.numbers("layout", str(number), (number,), "bytes")
        first, *last = map(int, _numbers(place))
        for byte in range(first + 1, max(last, default=first)):
            yield from citing.numbers("layout", str(byte), (Fraction(byte),), "bytes", optional=True)
    title = one.get("title")
    yield from citing.title({"en": title} if isinstance(title, str) else title or {})


def _of_line(bus: Map) -> Iterator[Claim]:
    """How fast the line is, which manuals give in kBaud, and how long its identifiers are."""
    citing = _Citing("bus", bus.get("line"), None)
    for key, unit in (("bitrate", 1000), ("identifier_bits", 1)):
        for number in _numbers(bus.get(key)):
            yield from citing.numbers(key, str(number), (number, number / unit))


def _of_codes(kind: str, codes: Any) -> Iterator[Claim]:
    rows: dict[int, list[Fraction]] = {}
    for key, one in codes.items() if isinstance(codes, Map) else ():
        if isinstance(one, Map) and "line" in one:
            rows.setdefault(one["line"], []).extend(_numbers(key))
    for key, one in codes.items() if isinstance(codes, Map) else ():
        if isinstance(one, Map):
            name = kind.removesuffix("s")
            citing = _Citing(f"{name} {key}", one.get("line"), one.get("lines"), f"{name}:{key}")
            row = rows.get(one.get("line", 0), [])
            ends = frozenset((min(row), max(row))) if len(row) > 2 else frozenset()  # "9 - 12" is one row
            for number in _numbers(key):
                yield from citing.numbers("number", str(key), (number,), anchor=True, between=ends)
            for fact in ("max", "answers", "refusals"):
                for number in _numbers(one.get(fact)):
                    yield from citing.numbers(fact, str(number), (number,))
            for number in _numbers(one.get("printed", {}).get("bytes")):
                yield from citing.numbers("printed bytes", str(number), (number,))


def _of_frames(file: Map) -> Iterator[Claim]:
    for one in file.get("frames", ()):
        citing = _Citing(f"frame {one['name']}", one.get("line"), one.get("lines"), f"frame:{one['name']}")
        digits = "".join(str(one["bytes"]).split()).upper()
        if citing.usual:
            yield Claim(citing.subject, "bytes", digits, frozenset(), (), citing.others.get("bytes", citing.usual))
        for number in _numbers(one.get("says")):  # beside the bytes, or not at all
            told = "printed" in citing.others
            yield from citing.numbers("says", str(number), (number,), "printed", optional=not told)


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
