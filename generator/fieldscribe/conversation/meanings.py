"""What a raw number of a point means, in words a commissioning engineer understands."""

from __future__ import annotations

from dataclasses import dataclass, replace
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError, Settings
from fieldscribe.arithmetic.floats import float_of, pattern_of
from fieldscribe.arithmetic.lines import Line
from fieldscribe.arithmetic.words import mask_of, words_of
from fieldscribe.conversation.refusals import amount, failure, is_short
from fieldscribe.conversation.texts import shown, text_of
from fieldscribe.families.decoded_frame import BoundedMemo
from fieldscribe.families.frame_results import Bits, bits_label
from fieldscribe.report import visible
from fieldscribe.text import line
from fieldscribe.wording.exact import decimal_places, exact, number_text, rounded, shortest

if TYPE_CHECKING:
    from collections.abc import Callable

    from fieldscribe.model import Device, Entry, Flag, Point


_NAMELESS = "{}, a number without a name in the manual"
_MOST_RULES = 256
"""How many scales of a point are remembered."""
_MOST_FLAGS = 64
"""And how many numbers of a flag, with what they mean."""


@dataclass(frozen=True, slots=True)
class Meaning:
    """The meaning of a raw number: text, the exact value of a quantity, and what is missing or unusual.

    Where `flags` tell it, the text is empty.
    """

    text: str
    value: str | None = None
    missing: tuple[str, ...] = ()
    hint: str = ""
    flags: Flags | None = None


class Meanings:
    """What the raw numbers of one point mean; what does not depend on the number is worked out once.

    It never fails: if a meaning is unknown, the text says so.
    """

    def __init__(self, device: Device, point: Point) -> None:
        self._device = device
        self._point = point
        self._entries = {entry.raw: entry for entry in reversed(point.enum.entries if point.enum else ())}
        self._flags = Flags(point) if point.flags else None
        shape = point.shape
        self._specials, self._floating, self._most_raw = shape.specials, shape.info.floating, shape.most_raw
        self._named = self._naming()
        self._needs = point.scale_arguments
        self._rules: dict[tuple[object, ...], _Scale | Meaning] = {}
        self._failures: dict[tuple[object, ...], tuple[str, str]] = {}

    def of(self, raw: int, settings: Settings) -> Meaning:
        """The meaning of a raw number, where other points hold these settings."""
        special = self._point.special(raw) if self._specials else None
        if special is not None:
            remark = ", no value" if special.no_value else ""
            return Meaning(line(f"{special.name} ({wording.title_text(special.title)}){remark}"))
        return self._quantity(raw, settings) if self._named is None else self._named(raw)

    def lacks(self, settings: Settings) -> bool:
        """Whether the scale needs other points than those with these settings."""
        rule = self._rule(settings)
        return isinstance(rule, Meaning) and bool(rule.missing)

    def _naming(self) -> Callable[[int], Meaning] | None:
        """What tells the raw numbers of a point that are no quantities; None where they are."""
        point = self._point
        if point.text is not None:
            return lambda raw: Meaning(shown(text_of(raw, point.words)), text_of(raw, point.words))
        if point.enum is not None:
            return lambda raw: Meaning(self._entry(raw))
        if self._flags is not None:
            told = Meaning("", flags=self._flags)
            return lambda _raw: told
        if point.digits is not None:
            return lambda raw: Meaning(_digits_text(point, raw))
        return (lambda raw: Meaning("on" if raw else "off")) if point.type == "bit" else None

    def _entry(self, raw: int) -> str:
        """The name of a number of an enum."""
        entry = self._entries.get(raw)
        return line("" if entry is None else wording.entry_meaning(entry)) or _NAMELESS.format(raw)

    def _quantity(self, raw: int, settings: Settings) -> Meaning:
        if self._floating or (self._most_raw is not None and abs(raw) > self._most_raw):
            return self._computed(raw, settings)
        rule = self._rule(settings)
        return rule if isinstance(rule, Meaning) else rule.meaning(raw)

    def _rule(self, settings: Settings) -> _Scale | Meaning:
        """The scale in force, or why there is none: neither depends on the raw number."""
        key: tuple[object, ...] = ()
        if self._needs:  # a special code equals the plain number, and is no quantity: so the types
            held = [settings.get(name) for name in self._needs]
            key = (*held, *map(type, held))
        rule = self._rules.get(key)
        if rule is None:
            if len(self._rules) >= _MOST_RULES:
                self._rules.clear()
            rule = self._rules[key] = self._found_rule(settings)
        return rule

    def _found_rule(self, settings: Settings) -> _Scale | Meaning:
        point = self._point
        if not point.generated and point.scale is None:
            return Meaning(line(point.reason or "its meaning is not settled"))
        try:
            ratio, offset = codec.rule_in_force(point, settings)
        except CodecError as error:
            return self._unknown(error)
        factor, add = offset.denominator * ratio.denominator, -offset.numerator * ratio.denominator
        return _Scale(point, Line.reduced(factor, add, offset.denominator * ratio.numerator))

    def _computed(self, raw: int, settings: Settings) -> Meaning:
        """The meaning of a bit pattern, and of a number that the scale cannot compute with."""
        point = self._point
        if not point.generated and point.scale is None:
            return Meaning(line(point.reason or "its meaning is not settled"))
        try:
            value = codec.decode(point, raw, settings)
        except CodecError as error:
            if error.status == "not_a_number":
                return Meaning(str(codec.float_of(point, raw)))
            return self._unknown(error)
        decimals = point.display
        said = _shortest(point, raw) if decimals is None else rounded(value.numerator, value.denominator, decimals)
        return Meaning(wording.with_unit(said, point), number_text(value))

    def _unknown(self, error: CodecError) -> Meaning:
        why = error.status, error.missing
        if why not in self._failures:  # as many as there are ways to fail
            self._failures[why] = failure(self._device, self._point, error)
        message, hint = self._failures[why]
        return Meaning(f"not known: {message}", None, error.missing, hint)


class _Scale:
    """The values of a point under a rule that is settled, as text; what does not depend on the number is worked out."""

    def __init__(self, point: Point, rule: Line) -> None:
        self._rule, self._decimals = rule, point.display
        self._unit = wording.with_unit(" ", point)[1:]
        self._places = decimal_places(rule.divisor)
        self._parts = 0 if self._places is None else 10**self._places // rule.divisor

    def meaning(self, raw: int) -> Meaning:
        """The meaning of a raw number."""
        factor, add, divisor = self._rule
        number = raw * factor + add
        if self._decimals is None and divisor == 1:
            exactly = str(number)
            return Meaning(exactly + self._unit, exactly)
        exactly = exact(number, divisor) if self._places is None else shortest(number * self._parts, self._places)
        if self._decimals is not None:
            return Meaning(rounded(number, divisor, self._decimals) + self._unit, exactly)
        said = exactly if is_short(exactly) else amount(Fraction(number, divisor))
        return Meaning(said + self._unit, exactly)


class Flags:
    """The flags of a point; what each of their numbers says is worked out once."""

    def __init__(self, point: Point) -> None:
        self._lowest, self._width = point.bits[1] if point.bits else 0, point.width
        self._flags = [(flag.low, mask_of(flag.width), _flag_said(flag, self._lowest)) for flag in point.flags]
        self._nameless = BoundedMemo(_MOST_FLAGS, _nameless_bit)
        self._named_bits = sum(mask << low for low, mask, _ in self._flags)

    def sentence(self, raw: int) -> str:
        """All flags in one sentence: those that are true first."""
        true: list[str] = []
        false: list[str] = []
        for low, mask, said in self._flags:
            is_false, text, _ = said[raw >> low & mask]
            (false if is_false else true).append(text)
        parts = [", ".join(true) if true else "none set"]
        if false:
            parts.append(f"not set: {', '.join(false)}")
        if bits := self._others(raw):
            named = ", ".join(map(str, bits))
            parts.append(f"also bit{'s' if len(bits) > 1 else ''} {named}, which the manual does not name")
        return line("; ".join(parts))

    def bits(self, raw: int) -> list[Bits]:
        """What each flag says, and each set bit that the manual does not name."""
        named = [said[raw >> low & mask][2] for low, mask, said in self._flags]
        return named + [self._nameless[self._lowest + bit] for bit in self._others(raw)]

    def _others(self, raw: int) -> list[int]:
        rest = raw & ~self._named_bits
        return [bit for bit in range(self._width) if rest >> bit & 1] if rest else []


def _flag_said(flag: Flag, lowest: int) -> BoundedMemo[int, tuple[bool, str, Bits]]:
    """By the number of a flag: whether it is a bit whose name is not true, what it is called, and both as a fact."""
    is_bit, low = flag.width == 1, lowest + flag.low
    high = low + flag.width - 1
    place = bits_label(high, low)

    def said(number: int) -> tuple[bool, str, Bits]:
        entry = next((entry for entry in flag.values if entry.raw == number), None)
        told = "" if entry is None else line(_told(entry))
        true = number == flag.active if is_bit else None
        shown = place, visible(_flag_line(flag, number, told))
        return true is False, _flag_text(flag, number), Bits(high, low, flag.name, number, true, told, shown)

    return BoundedMemo(_MOST_FLAGS, said)


def _nameless_bit(bit: int) -> Bits:
    """A set bit that the manual does not name."""
    return Bits(bit, bit, None, 1, None, "", (bits_label(bit, bit), "1  not named by the manual"))


def _flag_line(flag: Flag, number: int, told: str) -> str:
    """`1  ready`, `0  fault (true when 0): a fault`; what only repeats the name is left out."""
    inverted = " (true when 0)" if flag.width == 1 and not flag.active else ""
    says_more = told.casefold().replace(" ", "_") not in ("", flag.name)
    return f"{number}  {flag.name}{inverted}" + (f": {told}" if says_more else "")


def meaning_of(device: Device, point: Point, raw: int, settings: Settings) -> Meaning:
    """The meaning of a raw number; never fails: if it is unknown, the text says so."""
    meaning = Meanings(device, point).of(raw, settings)
    return meaning if meaning.flags is None else replace(meaning, text=meaning.flags.sentence(raw))


def raw_text(point: Point, raw: int) -> str:
    """A raw number in both notations: `raw 500 = 01F4h`."""
    return raw_form(point)(raw)


def raw_form(point: Point) -> Callable[[int], str]:
    """What shows the raw numbers of a point in both notations."""
    if point.type == "bit":
        return "raw {}".format
    if point.text is not None:
        return lambda raw: f"words {' '.join(f'{word:04X}h' for word in words_of(point, raw))}"
    digits, mask = max(1, point.width + 3 >> 2), (1 << point.width) - 1
    form = f"raw %d = %0{digits}Xh"
    return lambda raw: form % (raw, raw & mask)


def _shortest(point: Point, raw: int) -> str:
    """The shortest decimal that means this bit pattern, as an instrument would show it."""
    number = codec.float_of(point, raw)
    text = repr(number)
    if point.type == "f32":
        for digits in range(1, 10):
            shorter = f"{number:.{digits}g}"
            try:
                if float_of(pattern_of(float(shorter), 32), 32) == number:
                    text = shorter
                    break
            except OverflowError:
                continue
    plain = 1e-6 <= abs(number) < 1e15
    return f"{Decimal(text):f}" if plain else text


def _digits_text(point: Point, raw: int) -> str:
    """The digits with their names, the highest first: `1 ms_200 (200 ms), 0 ms_100 (100 ms)`."""
    entries = {} if point.digits is None else {entry.raw: entry for entry in point.digits.enum.entries}
    parts = []
    for digit in codec.digits(point, raw):
        entry = entries.get(digit)
        named = "without a name" if entry is None else entry.name
        quantity = f" ({entry.quantity})" if entry is not None and entry.quantity else ""
        parts.append(f"{digit} {named}{quantity}")
    return line("digits " + ", ".join(parts))


def _told(entry: Entry) -> str:
    """What a number of a flag means: its English title, behind its name where it has one of its own."""
    return entry.title["en"] if entry.name in ("zero", "one") else f"{entry.name} ({entry.title['en']})"


def _flag_text(flag: Flag, number: int) -> str:
    entry = next((entry for entry in flag.values if entry.raw == number), None)
    if flag.width > 1:
        return f"{flag.name} = {entry.name if entry else number}"
    if entry is not None and entry.title["en"].casefold().replace(" ", "_") != flag.name:
        return f"{flag.name} ({entry.title['en']})"
    return f"{flag.name} (its bit is {number})" if flag.active == 0 else flag.name
