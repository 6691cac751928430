"""What a point takes from its manual."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from fieldscribe.audit.citing import OWN_PRINTED, Citing, numbers_in
from fieldscribe.language.nodes import Map

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.audit.citing import Claim
    from fieldscribe.diagnostics import Span
    from fieldscribe.model import Flag, Point
    from fieldscribe.resolve.drafts import Draft

_INDEX_BEHIND_CODE = re.compile(r"\[.*|\(.*")
_LETTERS_AND_DIGITS = re.compile("([A-Za-z]+)([0-9]+)")
_KEY_IN_LINES = {"range_in_units": "range", "pairs": "printed"}
"""The keys of `printed` whose place `lines` names by another key."""


class Wordings:
    """The manual's own words for what the description writes otherwise, from the key `writes` of its documents."""

    def __init__(self, documents: Map) -> None:
        self._words: dict[str, list[str]] = {}
        for document in documents.values():
            for written, words in document.get("writes", {}).items():
                self._words.setdefault(str(written), []).extend(words)

    def code(self, letters: str) -> list[str]:
        """The words that the manual has for the letters of a code: `Parameter` for `P`."""
        return self._words.get(letters, [])

    def bits(self, high: int, low: int) -> list[str]:
        """The names that the manual has for a part of a word: `Highbyte` for 15..8."""
        return self._words.get(f"{high}..{low}", [])

    def number(self, number: Fraction) -> list[str]:
        """The words that the manual has for a number: `zero` for 0."""
        return self._words.get(str(number), [])


def claims_of_point(point: Point, draft: Draft, enums: Mapping[str, Map], wordings: Wordings) -> Iterator[Claim]:
    """Everything that a point says itself: code, section, address, title, numbers, enum, flags, printed facts."""
    citing = Citing(point.item, draft.span(), point.source.line, draft.get("lines"), point.name)
    code = None if point.code is None else _INDEX_BEHIND_CODE.sub("", point.code).strip()
    if code:
        yield from citing.words("code", *_codes_of(code, wordings), str(point.code), place=draft.span("code"))
    if _says_itself(draft, "section"):
        yield from citing.words("section", str(draft.get("section")), place=draft.span("section"))
    yield from _address(citing, point, draft, code or "")
    titles = {**point.title, "": "" if point.variant is None else point.variant.value}
    yield from citing.title(titles, place=draft.span("title"))
    yield from _numbers_of(citing, point, draft, wordings)
    yield from _enum_of(citing, point, draft, enums)
    yield from _flags(citing, point, draft, wordings)
    yield from _printed(citing, draft)


def _codes_of(code: str, wordings: Wordings) -> tuple[str, ...]:
    """How a manual may write a code: `P601`, `P 601`, `Parameter 601`."""
    match = _LETTERS_AND_DIGITS.fullmatch(code)
    if match is None:
        return (code,)
    letters, digits = match.groups()
    return (code, f"{letters} {digits}", *(f"{word} {digits}" for word in wordings.code(letters)))


def _address(citing: Citing, point: Point, draft: Draft, code: str) -> Iterator[Claim]:
    if point.address is None:
        return
    at = draft.get("at")
    by_rule = (draft.element is not None or "addressing" in draft.group) and str(at).isdigit()
    rule = [Fraction(int(at))] if by_rule else []
    for number in (*rule, *map(Fraction, filter(None, (point.set, point.index)))):
        yield from citing.numbers("number", str(number), (number,), "code", optional=True, place=draft.span("at"))
    if code and any(str(number) in code for number in (point.address, *map(int, rule))):
        return  # the code is the number
    if point.text is not None:
        ends = frozenset(map(Fraction, (point.addresses[0], point.addresses[-1])))
        for address in map(Fraction, point.addresses):
            inner = ends if address not in ends else frozenset()
            yield from citing.numbers(
                "address", str(address), (address,), anchor=not inner, between=inner, place=draft.span("at")
            )
        return
    for place in point.places:
        references = [Fraction(number) for number in place.references.values() if isinstance(number, int)]
        yield from citing.numbers(
            "address",
            f"{min(place.addresses):04X}h",
            (Fraction(min(place.addresses)), *references, *rule),
            anchor=place is point.place,
            words=tuple(word for name, number in place.references.items() for word in _joined(name, number)),
            place=draft.span("at"),
        )


def _joined(numbering: str, number: object) -> tuple[str, ...]:
    """How a manual writes a number that is part of a name: `PZD2`, `Bit13`."""
    return tuple(f"{name}{number}" for name in (numbering, numbering.capitalize(), numbering.upper()))


def _numbers_of(citing: Citing, point: Point, draft: Draft, wordings: Wordings) -> Iterator[Claim]:
    """The limits, the bits of the word, the characters of a text and the scale."""
    for key in ("range", "range_in_units"):
        if _says_itself(draft, key) and not point.flags:  # the flags of a word say which numbers it holds
            for number in numbers_in(draft.get(key)):
                yield from citing.numbers(
                    "range",
                    str(number),
                    _in_both_units(point, number, in_units=key == "range_in_units"),
                    place=draft.span(key),
                )
    yield from _bits_of(citing, point, draft, wordings)
    if point.text is not None and _says_itself(draft, "characters"):
        characters = point.text.characters
        yield from citing.numbers(
            "characters", str(characters), (Fraction(characters),), "range", place=draft.span("characters")
        )
    if _says_itself(draft, "scale"):
        for number in _scale_numbers(draft.get("scale")):
            yield from citing.numbers("scale", str(number), (number, 1 / number), place=draft.span("scale"))


def _in_both_units(point: Point, number: Fraction, *, in_units: bool) -> list[Fraction]:
    """A limit as raw number and in the unit; only as it is written where the scale has cases or factors."""
    cases = point.scale or ()
    if len(cases) != 1 or cases[0].rule.factors:
        return [number]
    rule = cases[0].rule
    return [number, number * rule.ratio + rule.offset if in_units else (number - rule.offset) / rule.ratio]


def _scale_numbers(raw: Any) -> list[Fraction]:
    texts = [raw] if isinstance(raw, str) else [case["rule"] for case in raw or ()]
    return [number for text in texts for number in numbers_in(text) if number not in (0, 1)]


def _bits_of(citing: Citing, point: Point, draft: Draft, wordings: Wordings) -> Iterator[Claim]:
    """The bits of the word that the point takes, and the bits that are always written alike."""
    if point.bits is not None:
        words = tuple(wordings.bits(*point.bits))
        for place in range(point.bits[1], point.bits[0] + 1):
            inner = place not in point.bits
            numbers = (Fraction(place), Fraction(1 << place))
            yield from citing.numbers(
                "bits", str(place), numbers, words=words, optional=inner, place=draft.span("bits")
            )
    fixed: Any = draft.get("fixed") if _says_itself(draft, "fixed") else None
    for bits, constant in fixed.items() if isinstance(fixed, Map) else ():
        place_of_bits = fixed.key_span(bits)
        for bit in numbers_in(bits):
            numbers = (bit, Fraction(1 << int(bit)))
            yield from citing.numbers("fixed bits", str(bit), numbers, "bits", place=place_of_bits)
        for number in numbers_in(constant):
            yield from citing.numbers(
                "fixed bits",
                f"= {number}",
                (number,),
                "bits",
                words=tuple(wordings.number(number)),
                place=place_of_bits,
            )


def _enum_of(citing: Citing, point: Point, draft: Draft, enums: Mapping[str, Map]) -> Iterator[Claim]:
    """The numbers of the point's enum, but for entries of a shared enum that cite a line themselves."""
    key = "digits" if point.digits else "enum"
    enum = point.digits.enum if point.digits else point.enum
    if not _says_itself(draft, key) or enum is None:
        return
    enum_as_written: Any = draft.get(key)
    enum_as_written = enum_as_written["enum"] if point.digits else enum_as_written
    entries = enums[enum_as_written] if isinstance(enum_as_written, str) else enum_as_written
    cited_themselves = {
        number
        for key, entry in entries.items()
        if isinstance(entry, Map) and "line" in entry
        for number in numbers_in(key)
    }
    places = {number: entries.key_span(entry) for entry in entries for number in numbers_in(entry)}
    for entry in enum.entries:
        if entry.raw not in cited_themselves or entries is enum_as_written:
            place = places.get(Fraction(entry.raw), draft.span(key))
            yield from citing.numbers("enum", str(entry.raw), (Fraction(entry.raw),), place=place)
            yield from citing.title(entry.title, "enum", place=place)
            for number in numbers_in(entry.quantity):
                yield from citing.numbers("enum", str(entry.quantity), (number,), place=place)


def _flags(citing: Citing, point: Point, draft: Draft, wordings: Wordings) -> Iterator[Claim]:
    above = point.bits[1] if point.bits else 0
    always = point.fixed.bits if point.fixed is not None else 0
    for flag in point.flags:
        place = _place_of_flag(draft, flag)
        for bit in dict.fromkeys((flag.low + flag.width - 1, flag.low)):
            numbers = (
                Fraction(bit + above),
                Fraction(1 << bit),
                Fraction(1 << bit + above),
                Fraction(1 << bit | always),
            )
            run = _ends_of_run(point, bit)
            between = frozenset(Fraction(end + above) for end in run) if bit not in run else frozenset()
            words = (*wordings.bits(flag.low + flag.width - 1, flag.low), *_joined("bit", bit + above))
            yield from citing.numbers("flags", f"bit {bit + above}", numbers, between=between, words=words, place=place)
        yield from citing.title(flag.title, "flags", place=place)
        for entry in flag.values:
            shown = f"{flag.name} {entry.raw}"
            yield from citing.numbers("flag values", shown, (Fraction(entry.raw),), "flags", place=place)


def _place_of_flag(draft: Draft, flag: Flag) -> Span:
    """Where the description names the bits of a flag."""
    flags = draft.get("flags")
    if isinstance(flags, Map):
        ends = {flag.low, flag.low + flag.width - 1}
        key = next((bits for bits in flags if ends == set(numbers_in(bits))), None)
        return flags.span() if key is None else flags.key_span(key)
    return draft.span("flags")


def _ends_of_run(point: Point, bit: int) -> tuple[int, int]:
    """The ends of the run of named bits around a bit."""
    named = {place for flag in point.flags for place in range(flag.low, flag.low + flag.width)}
    low = high = bit
    while low - 1 in named:
        low -= 1
    while high + 1 in named:
        high += 1
    return low, high


def _printed(citing: Citing, draft: Draft) -> Iterator[Claim]:
    printed = draft.get("printed")
    for key, value in printed.items() if isinstance(printed, Map) else ():
        printed_numbers = [*value.keys(), *value.values()] if key == "pairs" else value
        for number in numbers_in(printed_numbers):
            if key == "resolution" and number == 1:
                continue  # "resolution: A" means one ampere: no 1 is printed
            kind = _KEY_IN_LINES.get(key, key if key in OWN_PRINTED else "address")
            words = _joined(key, number) if kind == "address" else ()
            place = printed.span(key)
            yield from citing.numbers(f"printed {key}", str(number), (number,), kind, words=words, place=place)


def _says_itself(draft: Draft, key: str) -> bool:
    """Whether the point (or its format, record, set) says a fact itself: what its group says cites no line."""
    layer = draft.layer(key)
    return layer is not None and layer is not draft.group
