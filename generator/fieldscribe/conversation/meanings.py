"""Turns a raw number of a point into words: its value with the unit, a name, flags, a text, digits.

A number outside its range has other readings: the words swapped, the other sign, and the points one address up and
down. Those that lie in range are listed; nothing is ranked or inferred.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache, partial
from typing import NamedTuple

from fieldscribe import wording
from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError, Settings
from fieldscribe.arithmetic.exact import float_of
from fieldscribe.arithmetic.exact import pattern_of as float_pattern
from fieldscribe.arithmetic.texts import date_of, text_of
from fieldscribe.arithmetic.words import mask_of, number_of, pattern_of, reader_of, words_of
from fieldscribe.conversation.refusals import amount, failure, in_range, is_short, range_fault, range_of
from fieldscribe.families.frame_results import Bits, bits_label
from fieldscribe.model import Device, Entry, Flag, Point, Text
from fieldscribe.report import visible
from fieldscribe.text import line
from fieldscribe.wording import label
from fieldscribe.wording.exact import exact, number_text, rounded

_MOST_NUMBERS = 64
"""The number of cached texts of a flag."""


class Meaning(NamedTuple):
    """The meaning of a raw number: its text, the exact value of a quantity, and what is missing or unusual.

    `flags` explains the bits of a word; the text is then empty.
    """

    text: str
    value: str | None = None
    missing: tuple[str, ...] = ()
    hint: str = ""
    flags: FlagTexts | None = None


class Meanings:
    """The meanings of one point's raw numbers. It never fails: if a meaning is unknown, the text says so."""

    def __init__(self, device: Device, point: Point) -> None:
        self._device, self._point = device, point
        self._of_names = _naming(point)
        self._specials, self._unit = point.specials, point.unit.symbol
        self._arguments, self._display = point.scale_arguments, point.display
        number = not point.info.floating and not point.epoch
        self._exact = number and point.most_raw is None and (point.generated or point.scale is not None)
        # typed: a special code equals the plain number, and is no quantity
        self._rule = lru_cache(_MOST_NUMBERS, typed=True)(self._rule_of)
        self._fixed = self._rule_of() if self._exact and not self._arguments else (1, 0, 1)

    def of(self, raw: int, settings: Settings) -> Meaning:
        """Return the meaning of a raw number under these settings of other points."""
        special = self._point.special(raw) if self._specials else None
        if special is not None:
            remark = ", no value" if special.no_value else ""
            return Meaning(line(f"{special.name} ({wording.title_text(special.title)}){remark}"))
        if self._of_names is not None:
            return self._of_names(raw)
        return (self._exact_quantity(raw, settings) if self._exact else None) or self._quantity(raw, settings)

    def text(self, raw: int, settings: Settings) -> str:
        """Return the meaning of a raw number as text, with the flags of a word in one sentence."""
        meaning = self.of(raw, settings)
        return meaning.text if meaning.flags is None else meaning.flags.sentence(raw)

    def lacks(self, settings: Settings) -> bool:
        """Return True if the scale needs points without a setting here."""
        try:
            codec.rule_in_force(self._point, settings)
        except CodecError as error:
            return bool(error.missing)
        return False

    def _rule_of(self, *values: int | Fraction | None) -> tuple[int, int, int]:
        """Return (multiply, add, divide): a value is raw * multiply + add, divided by a positive number."""
        pairs = zip(self._arguments, values, strict=True)
        settings = {name: value for name, value in pairs if value is not None}
        ratio, offset = codec.rule_in_force(self._point, settings)
        sign = 1 if ratio > 0 else -1
        multiply, divide = offset.denominator * ratio.denominator, offset.denominator * ratio.numerator
        return sign * multiply, -sign * offset.numerator * ratio.denominator, sign * divide

    def _exact_quantity(self, raw: int, settings: Settings) -> Meaning | None:
        """Return the result of `_quantity` if that is a short decimal; else None."""
        try:
            names = self._arguments
            multiply, add, divide = self._rule(*[settings.get(name) for name in names]) if names else self._fixed
        except CodecError:
            return None
        number = raw * multiply + add
        value = exact(number, divide)
        if "/" in value:
            return None
        if self._display is not None:
            text = rounded(number, divide, self._display)
        elif is_short(value):
            text = value
        else:
            return None
        return Meaning(f"{text} {self._unit}" if self._unit else text, value)

    def _quantity(self, raw: int, settings: Settings) -> Meaning:
        point = self._point
        if not point.generated and point.scale is None:
            return Meaning(line(point.reason or "its meaning is not settled"))
        try:
            value = codec.decode(point, raw, settings)
        except CodecError as error:
            if error.status == "not_a_number":
                return Meaning(str(codec.float_of(point, raw)))
            message, hint = failure(self._device, point, error)
            return Meaning(f"not known: {message}", None, error.missing, hint)
        if point.display is not None:
            text = rounded(value.numerator, value.denominator, point.display)
        else:
            text = _float_text(point, raw) if point.info.floating else amount(value)
        if point.epoch and (time := date_of(point.epoch, value)):
            return Meaning(time, number_text(value))
        return Meaning(wording.with_unit(text, point), number_text(value))


def _naming(point: Point) -> Callable[[int], Meaning] | None:
    """Return the function that names the raw numbers of a point; None if they are quantities."""
    if (layout := point.text) is not None:
        return partial(_text_meaning, layout)
    if point.enum is not None:
        entries = {entry.raw: wording.entry_meaning(entry) for entry in reversed(point.enum.entries)}
        number = partial(_float_text, point) if point.shape.patterns else str
        return lambda raw: Meaning(
            line(entries.get(raw, "")) or f"{number(raw)}, a number without a name in the manual"
        )
    if point.flags:
        meaning = Meaning("", flags=FlagTexts(point))
        return lambda _raw: meaning
    if point.digits is not None:
        return lambda raw: Meaning(_digits_text(point, raw))
    return (lambda raw: Meaning("on" if raw else "off")) if point.type == "bit" else None


def _text_meaning(layout: Text, raw: int) -> Meaning:
    try:
        text = text_of(layout, raw)
    except ValueError:
        return Meaning(f"not known: the words are no {layout.encoding}")
    return Meaning(text if layout.is_bytes or layout.parts else quoted_text(text), text)


class FlagTexts:
    """Explains the flags of a point; its texts are cached."""

    def __init__(self, point: Point) -> None:
        self._flags, self._width = point.flags, point.width
        self._lowest = point.bits[1] if point.bits else 0
        self._named = sum(mask_of(flag.width) << flag.low for flag in point.flags)
        self._bits = [lru_cache(_MOST_NUMBERS)(partial(_flag_bits, flag, self._lowest)) for flag in point.flags]
        self._texts = [lru_cache(_MOST_NUMBERS)(partial(_flag_text, flag)) for flag in point.flags]
        self._apart = lru_cache(_MOST_NUMBERS)(self._split_flags)

    def sentence(self, raw: int) -> str:
        """Return all flags in one sentence: those that are true first."""
        true, false = self._apart(raw)
        parts = [", ".join(true) or "none set"]
        if false:
            parts.append(f"not set: {', '.join(false)}")
        if bits := self._nameless(raw):
            named = ", ".join(map(str, bits))
            parts.append(f"also bit{'s' if len(bits) > 1 else ''} {named}, which the manual does not name")
        return line("; ".join(parts))

    def true(self, raw: int) -> str:
        """Return only the flags that apply."""
        return line(", ".join(self._apart(raw)[0]) or "none set")

    def _split_flags(self, raw: int) -> tuple[list[str], list[str]]:
        """Return the flags that apply to a number, with those of several bits, and the flags that do not."""
        true: list[str] = []
        false: list[str] = []
        for flag, text in zip(self._flags, self._texts, strict=True):
            number = raw >> flag.low & mask_of(flag.width)
            (true if flag.width > 1 or number == flag.active else false).append(text(number))
        return true, false

    def bits(self, raw: int) -> list[Bits]:
        """Return each flag, and each set bit that the manual does not name."""
        pairs = zip(self._flags, self._bits, strict=True)
        named = [bits(raw >> flag.low & mask_of(flag.width)) for flag, bits in pairs]
        return named + [_nameless_bit(self._lowest + bit) for bit in self._nameless(raw)]

    def _nameless(self, raw: int) -> list[int]:
        rest = raw & ~self._named
        return [bit for bit in range(self._width) if rest >> bit & 1] if rest else []


def _flag_bits(flag: Flag, lowest: int, number: int) -> Bits:
    """Return a flag with its number, as a row: `1  ready`, `0  fault (true when 0): a fault`."""
    low = lowest + flag.low
    high = low + flag.width - 1
    entry = _entry(flag, number)
    text = "" if entry is None else line(_entry_text(entry))
    inverted = " (true when 0)" if flag.width == 1 and not flag.active else ""
    repeats_name = text.casefold().replace(" ", "_") in ("", flag.name)
    row = f"{number}  {flag.name}{inverted}" + ("" if repeats_name else f": {text}")
    true = number == flag.active if flag.width == 1 else None
    return Bits(high, low, flag.name, number, true, text, (bits_label(high, low), visible(row)))


def _nameless_bit(bit: int) -> Bits:
    return Bits(bit, bit, None, 1, None, "", (bits_label(bit, bit), "1  not named by the manual"))


def _entry(flag: Flag, number: int) -> Entry | None:
    return next((entry for entry in flag.values if entry.raw == number), None)


def _entry_text(entry: Entry) -> str:
    """Return the meaning of a number of a flag: its English title, after its name unless that is a default name."""
    return entry.title["en"] if entry.name in ("zero", "one") else f"{entry.name} ({entry.title['en']})"


def _flag_text(flag: Flag, number: int) -> str:
    """Return a flag for a sentence: `ready`, `fault (its bit is 0)`, `mode = stop`."""
    entry = _entry(flag, number)
    if flag.width > 1:
        return f"{flag.name} = {entry.name if entry else number}"
    if entry is not None and entry.title["en"].casefold().replace(" ", "_") != flag.name:
        return f"{flag.name} ({entry.title['en']})"
    return f"{flag.name} (its bit is {number})" if flag.active == 0 else flag.name


def raw_form(point: Point) -> Callable[[int], str]:
    """Return the function that writes the raw numbers of a point in both notations: `raw 500 = 01F4h`."""
    if point.type == "bit":
        return "raw {}".format
    if point.text is not None:
        return lambda raw: f"words {' '.join(f'{word:04X}h' for word in words_of(point, raw))}"
    digits, mask = max(1, point.width + 3 >> 2), (1 << point.width) - 1
    form = f"raw %d = %0{digits}Xh"
    return lambda raw: form % (raw, raw & mask)


def quoted_text(text: str) -> str:
    """Return a received text in quotes; unprintable characters and repeated spaces are escaped."""
    pairs = zip(f'"{text}', text, strict=False)
    plain = [char.isprintable() and char not in '"\\' and before + char != "  " for before, char in pairs]
    escaped = (char if fine else f"\\x{ord(char):02X}" for char, fine in zip(text, plain, strict=True))
    return f'"{"".join(escaped)}"'


def _float_text(point: Point, raw: int) -> str:
    """Return the shortest decimal that has this bit pattern, as an instrument would show it."""
    number = codec.float_of(point, raw)
    text = repr(number)
    if point.shape.wire_type == "f32":
        for digits in range(1, 10):
            shorter = f"{number:.{digits}g}"
            try:
                if float_of(float_pattern(float(shorter), 32), 32) == number:
                    text = shorter
                    break
            except OverflowError:
                continue
    plain = 1e-6 <= abs(number) < 1e15
    return f"{Decimal(text):f}" if plain else text


def _digits_text(point: Point, raw: int) -> str:
    """Return the digits with their names, the highest first: `1 ms_200 (200 ms), 0 ms_100 (100 ms)`."""
    entries = {} if point.digits is None else {entry.raw: entry for entry in point.digits.enum.entries}
    parts = []
    for digit in codec.digits(point, raw):
        entry = entries.get(digit)
        quantity = f" ({entry.quantity})" if entry is not None and entry.quantity else ""
        parts.append(f"{digit} {'without a name' if entry is None else entry.name}{quantity}")
    return line("digits " + ", ".join(parts))


Neighbours = Callable[[int], Iterable[Point]]
"""Returns the points that begin at an address of the same space."""


class Doubts:
    """Finds doubts about the numbers of a point; its limits and neighbours are looked up once."""

    def __init__(self, device: Device, point: Point, neighbours: Neighbours) -> None:
        self._device, self._point, self.fits = device, point, _range_test(point)
        """`fits` returns True if a number lies in range."""
        self._meanings, self._range = Meanings(device, point), ""
        self._is_plain = point.form in ("scaled", "integer") and not (point.limit_arguments or point.fixed)
        self._read, self._swaps = reader_of(point), point.words > 1
        self._is_limited, self._is_signed = _is_limited(point), not point.info.floating
        first = point.addresses[0] if point.addresses else 0
        if point.variant is not None and point.addresses:  # which variant this is, nobody may have said
            tests = [_range_test(other) for other in neighbours(first) if other.variant and other.words == point.words]
            self.fits = lambda raw, settings: any(test(raw, settings) for test in tests)
        others = [
            (f"one address {name}, {label(other)},", other)
            for name, address in ((("up", first + 1), ("down", first - 1)) if point.addresses else ())
            for other in neighbours(address)
            if other.words == point.words and other.generated and other.readable and _is_limited(other)
        ]
        self._others = [(text, reader_of(one), _range_test(one), Meanings(device, one)) for text, one in others]

    def of(self, raw: int, settings: Settings, meaning: str) -> tuple[str, ...]:
        """Return a text that a number is out of range, then the other readings.

        `meaning` is its meaning.
        """
        if self._is_plain and meaning:
            self._range = self._range or range_of(self._device, self._point, settings)
            fault = line(f"{meaning} is outside {self._range}")
        else:
            fault = range_fault(self._device, self._point, raw, settings)
        return (fault, *self._near_misses(raw, settings)) if fault else ()

    def _near_misses(self, raw: int, settings: Settings) -> Iterator[str]:
        """Yield the other readings that lie in range and have a meaning."""
        words = words_of(self._point, raw)
        for text, number, meanings in self._readings(raw, words, settings):
            meaning = meanings.of(number, settings)
            if meaning.text and not (meaning.missing or meaning.hint):
                yield line(f"{text} it is {meaning.text}")

    def _readings(self, raw: int, words: tuple[int, ...], settings: Settings) -> Iterator[tuple[str, int, Meanings]]:
        """Yield each other reading in range: in words, its raw number, and its meaning."""
        if self._is_limited and self._swaps and self.fits(number := self._read(words[::-1]), settings):
            yield "with its words swapped", number, self._meanings
        if self._is_limited and self._is_signed:
            signed = number_of(pattern_of(self._point, raw), self._point.width, signed=True)
            if signed < 0 and self.fits(-signed, settings):
                text, number = ("without its sign", -signed) if raw < 0 else ("as a signed number", signed)
                yield text, number, self._meanings
        for text, read, fits, meanings in self._others:
            if fits(number := read(words), settings):
                yield text, number, meanings


def _is_limited(point: Point) -> bool:
    """Return True if the manual limits the numbers of a point."""
    return bool(point.allowed.intervals or point.allowed.units or (point.enum is not None and point.enum.closed))


def _range_test(point: Point) -> Callable[[int, Settings], bool]:
    """Return a function that does for this point what `in_range` does."""
    spans = [(span.low, span.high) for span in point.allowed.intervals]
    ends = [(low, high) for low, high in spans if isinstance(low, int) and isinstance(high, int)]
    special = point.specials or point.fixed or point.digits or point.info.floating
    if special or len(ends) < len(spans) or not ends:
        return lambda raw, settings: in_range(point, raw, settings)
    least, greatest = point.least, point.greatest
    return lambda raw, _: least <= raw <= greatest and any(low <= raw <= high for low, high in ends)
