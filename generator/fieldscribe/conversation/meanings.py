"""Turns a raw number of a point into words: its value with the unit, a name, flags, a text, digits."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache, partial
from typing import NamedTuple

from fieldscribe import wording
from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError, Settings
from fieldscribe.arithmetic.exact import Line, float_of
from fieldscribe.arithmetic.exact import pattern_of as float_pattern
from fieldscribe.arithmetic.texts import date_of, text_of
from fieldscribe.arithmetic.words import mask_of, words_of
from fieldscribe.conversation.refusals import amount, failure, is_short
from fieldscribe.diagnostics import visible
from fieldscribe.families.frame_results import Bits, bits_label
from fieldscribe.model import Device, Entry, Flag, Point, Text
from fieldscribe.text import line
from fieldscribe.wording.numbers import decimal_places, exact, number_text, rounded, shortest

_MOST_SETTINGS = 256
"""How many numbers of the points that a scale needs are remembered, with what they make of it."""
_GROUP = 8
"""The most bits of neighbouring flags whose texts are cached together."""


class Meaning(NamedTuple):
    """The meaning of a raw number: its text, the exact value of a quantity, and what is missing or unusual.

    The text is a line as `line` makes it, except for what a device sent as text.
    `flags` explains the bits of a word; the text is then empty.
    """

    text: str
    value: str | None = None
    missing: tuple[str, ...] = ()
    hint: str = ""
    flags: FlagTexts | None = None


MeaningOf = Callable[[int], Meaning]
"""Returns the meaning of a raw number of a point, under some settings of other points."""


class Meanings:
    """The meanings of one point's raw numbers. It never fails: if a meaning is unknown, the text says so."""

    def __init__(self, device: Device, point: Point) -> None:
        self._device, self._point, self._names = device, point, point.scale_arguments
        self._named = _naming(point)
        number = not point.info.floating and not point.epoch
        self._is_exact = number and point.most_raw is None
        # typed: a special code equals the plain number, and is no quantity
        self._under = lru_cache(_MOST_SETTINGS, typed=True)(self._made_under)

    def of(self, raw: int, settings: Settings) -> Meaning:
        """Return the meaning of a raw number under these settings of other points."""
        return self.under(settings)(raw)

    def under(self, settings: Settings) -> MeaningOf:
        """Return the function that gives the meanings under these settings."""
        return self._under(*map(settings.get, self._names))

    def text(self, raw: int, settings: Settings) -> str:
        """Return the meaning of a raw number as text, with the flags of a word in one sentence."""
        meaning = self.of(raw, settings)
        return meaning.text if meaning.flags is None else meaning.flags.sentence(raw)

    def _made_under(self, *values: int | Fraction | None) -> MeaningOf:
        settings = {name: value for name, value in zip(self._names, values, strict=True) if value is not None}
        meaning_of = self._named or partial(self._quantity, settings)
        if self._is_exact and self._named is None:
            try:
                meaning_of = self._exact_quantity(*codec.rule_in_force(self._point, settings))
            except CodecError as error:
                meaning_of = _always(self._unknown(error))
        return partial(self._special_or, meaning_of) if self._point.specials else meaning_of

    def _special_or(self, meaning_of: MeaningOf, raw: int) -> Meaning:
        special = self._point.special(raw)
        if special is None:
            return meaning_of(raw)
        remark = ", no value" if special.no_value else ""
        return Meaning(line(f"{special.name} ({wording.title_text(special.title)}){remark}"))

    def _exact_quantity(self, ratio: Fraction, offset: Fraction) -> MeaningOf:
        """Return a function that does what `_quantity` does, with the rule worked out in integers."""
        display, unit = self._point.display, f" {symbol}" if (symbol := line(self._point.unit.symbol)) else ""
        rule = (offset.denominator * ratio.denominator, -offset.numerator * ratio.denominator)
        multiply, add, divide = Line.reduced(*rule, offset.denominator * ratio.numerator)
        places = decimal_places(divide)
        if places is not None:
            multiply, add, divide = multiply * 10**places // divide, add * 10**places // divide, 10**places

        def meaning_of(raw: int) -> Meaning:
            number = raw * multiply + add
            value = exact(number, divide) if places is None else shortest(number, places)
            if display is not None:
                text = rounded(number, divide, display)
            else:
                text = value if is_short(value) else amount(Fraction(number, divide))
            return Meaning(text + unit, value)

        return meaning_of

    def _unknown(self, error: CodecError) -> Meaning:
        message, hint = failure(self._device, self._point, error)
        return Meaning(f"not known: {message}", None, error.missing, hint)

    def _quantity(self, settings: Settings, raw: int) -> Meaning:
        point = self._point
        try:
            value = codec.decode(point, raw, settings)
        except CodecError as error:
            return Meaning(str(codec.float_of(point, raw))) if error.status == "not_a_number" else self._unknown(error)
        if point.display is not None:
            text = rounded(value.numerator, value.denominator, point.display)
        else:
            text = _float_text(point, raw) if point.info.floating else amount(value)
        if point.epoch and (time := date_of(point.epoch, value)):
            return Meaning(time, number_text(value))
        return Meaning(line(wording.with_unit(text, point)), number_text(value))


def _always(meaning: Meaning) -> MeaningOf:
    return lambda _raw: meaning


def _naming(point: Point) -> MeaningOf | None:
    """Return the function that names the raw numbers of a point; None if they are quantities."""
    if (layout := point.text) is not None:
        return partial(_text_meaning, layout)
    if point.enum is not None:
        entries = {entry.raw: Meaning(line(wording.entry_meaning(entry))) for entry in reversed(point.enum.entries)}
        number = partial(_float_text, point) if point.shape.patterns else str
        return lambda raw: entries.get(raw) or Meaning(f"{number(raw)}, a number without a name in the manual")
    if point.flags:
        return _always(Meaning("", flags=FlagTexts(point)))
    if point.digits is not None:
        return lambda raw: Meaning(_digits_text(point, raw))
    if point.type == "bit":
        return lambda raw: Meaning("on" if raw else "off")
    is_known = point.generated or point.scale is not None
    return None if is_known else _always(Meaning(line(point.reason or "its meaning is not settled")))


def _text_meaning(layout: Text, raw: int) -> Meaning:
    try:
        text = text_of(layout, raw)
    except ValueError:
        return Meaning(f"not known: the words are no {layout.encoding}")
    return Meaning(text if layout.is_bytes or layout.parts else quoted_text(text), text)


class FlagTexts:
    """Explains the flags of a point. Neighbouring flags share a cache, because a word has too many numbers for one."""

    def __init__(self, point: Point) -> None:
        lowest = point.bits[1] if point.bits else 0
        self._named: list[tuple[int, Callable[[int], _Texts]]] = []
        self._groups: list[tuple[int, Callable[[int], list[Bits]], Callable[..., str]]] = []
        """Bits that share a cache: their mask, and what returns the bits of a number, and their rows as text."""
        flags: list[Flag] = []
        for flag, following in zip(point.flags, (*point.flags[1:], None), strict=True):
            flags.append(flag)
            if following is None or sum(one.width for one in (*flags, following)) > _GROUP:
                mask = sum(mask_of(one.width, one.low) for one in flags)
                self._named.append((mask, lru_cache(1 << _GROUP)(partial(_texts_of, tuple(flags)))))
                self._add(mask, partial(_bits_of, tuple(flags), lowest))
                flags.clear()
        self._unnamed = [bit for bit in range(point.width) if not any(mask >> bit & 1 for mask, _ in self._named)]
        for first in range(0, len(self._unnamed), _GROUP):
            bits = self._unnamed[first : first + _GROUP]
            self._add(sum(1 << bit for bit in bits), partial(_nameless_bits, bits, lowest))

    def _add(self, mask: int, bits: Callable[[int], list[Bits]]) -> None:
        """Add a group of bits to those that `bits` and `lines` explain."""
        bits = lru_cache(1 << _GROUP)(bits)
        lines = lru_cache(1 << _GROUP)(lambda raw, row: "\n".join([row(*one.row) for one in bits(raw)]))
        self._groups.append((mask, bits, lines))

    def sentence(self, raw: int) -> str:
        """Return all flags in one sentence: those that are true first."""
        texts = [texts(raw & mask) for mask, texts in self._named]
        parts = [", ".join([true for true, _ in texts if true]) or "none set"]
        if false := ", ".join([false for _, false in texts if false]):
            parts.append(f"not set: {false}")
        if bits := [bit for bit in self._unnamed if raw >> bit & 1]:
            named = ", ".join(map(str, bits))
            parts.append(f"also bit{'s' if len(bits) > 1 else ''} {named}, which the manual does not name")
        return "; ".join(parts)

    def true(self, raw: int) -> str:
        """Return only the flags that apply."""
        return ", ".join([true for mask, texts in self._named if (true := texts(raw & mask)[0])]) or "none set"

    def bits(self, raw: int) -> list[Bits]:
        """Return each flag, and each set bit that the manual does not name."""
        return [one for mask, bits, _ in self._groups for one in bits(raw & mask)]

    def lines(self, raw: int, row: Callable[[str, str], str]) -> list[str]:
        """Return the same as texts of one or more rows; `row` makes one of a label and a text."""
        return [text for mask, _, lines in self._groups if (text := lines(raw & mask, row))]


_Texts = tuple[str, str]
"""The flags that apply to a number, with those of several bits, and the flags that do not."""


def _texts_of(flags: Sequence[Flag], raw: int) -> _Texts:
    true: list[str] = []
    false: list[str] = []
    for flag in flags:
        number = raw >> flag.low & mask_of(flag.width)
        (true if flag.width > 1 or number == flag.active else false).append(_flag_text(flag, number))
    return line(", ".join(true)), line(", ".join(false))


def _bits_of(flags: Sequence[Flag], lowest: int, raw: int) -> list[Bits]:
    return [_flag_bits(flag, lowest, raw >> flag.low & mask_of(flag.width)) for flag in flags]


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


def _nameless_bits(bits: Sequence[int], lowest: int, raw: int) -> list[Bits]:
    places = [lowest + bit for bit in bits if raw >> bit & 1]
    return [Bits(at, at, None, 1, None, "", (bits_label(at, at), "1  not named by the manual")) for at in places]


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
