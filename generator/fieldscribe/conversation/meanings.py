"""What a raw number of a point means, in words a commissioning engineer understands."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError, Settings
from fieldscribe.arithmetic.floats import float_of, pattern_of
from fieldscribe.arithmetic.lines import Line
from fieldscribe.arithmetic.words import words_of
from fieldscribe.conversation.refusals import amount_with_unit, failure
from fieldscribe.conversation.texts import shown, text_of
from fieldscribe.families.answers import Bits
from fieldscribe.records import dataclass
from fieldscribe.text import line
from fieldscribe.wording.exact import hex_text, number_text, rounded

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from fieldscribe.model import Device, Entry, Flag, Point


_NAMELESS = "{}, a number without a name in the manual"
_MOST_RULES = 256
"""How many scales of a point, and names of a flag's numbers, are remembered."""


@dataclass(frozen=True, slots=True)
class Meaning:
    """The meaning of a raw number: text, the exact value of a quantity, and what is missing or unusual."""

    text: str
    value: str | None = None
    missing: tuple[str, ...] = ()
    hint: str = ""
    flags: tuple[Bits, ...] = ()


class Meanings:
    """What the raw numbers of one point mean; what does not depend on the number is worked out once.

    It never fails: if a meaning is unknown, the text says so.
    """

    def __init__(self, device: Device, point: Point) -> None:
        self._device = device
        self._point = point
        self._entries = {entry.raw: entry for entry in reversed(point.enum.entries if point.enum else ())}
        self._flags = [_Flag(flag) for flag in point.flags]
        self._named_bits = sum(flag.mask << flag.low for flag in self._flags)
        self._needs = point.scale_arguments
        self._rules: dict[tuple[object, ...], Line | Meaning] = {}

    def of(self, raw: int, settings: Settings) -> Meaning:
        """The meaning of a raw number, where other points hold these settings."""
        point = self._point
        if point.text is not None:
            return Meaning(shown(text_of(raw, point.words)), text_of(raw, point.words))
        named = self._named(raw)
        if named is None:
            return self._quantity(raw, settings)
        is_special = bool(point.shape.specials) and point.special(raw) is not None
        return Meaning(named, flags=() if is_special else tuple(self._bits(raw)))

    def lacks(self, settings: Settings) -> bool:
        """Whether the scale needs other points than those with these settings."""
        rule = self._rule(settings)
        return isinstance(rule, Meaning) and bool(rule.missing)

    def _named(self, raw: int) -> str | None:
        """The text of a raw number that is no quantity; None if it is one."""
        point, shape = self._point, self._point.shape
        special = point.special(raw) if shape.specials else None
        if special is not None:
            remark = ", no value" if special.no_value else ""
            return line(f"{special.name} ({wording.title_text(special.title)}){remark}")
        if shape.enum is not None:
            entry = self._entries.get(raw)
            return line("" if entry is None else wording.entry_meaning(entry)) or _NAMELESS.format(raw)
        if self._flags:
            return self._flags_text(raw)
        if shape.digits is not None:
            return _digits_text(point, raw)
        return ("on" if raw else "off") if shape.type == "bit" else None

    def _flags_text(self, raw: int) -> str:
        true: list[str] = []
        false: list[str] = []
        for flag in self._flags:
            (false if flag.is_false(raw) else true).append(flag.text(raw))
        parts = [", ".join(true) if true else "none set"]
        if false:
            parts.append(f"not set: {', '.join(false)}")
        rest = raw & ~self._named_bits
        if rest:
            bits = [str(bit) for bit in range(self._point.width) if rest >> bit & 1]
            parts.append(f"also bit{'s' if len(bits) > 1 else ''} {', '.join(bits)}, which the manual does not name")
        return line("; ".join(parts))

    def _bits(self, raw: int) -> Iterator[Bits]:
        """What each flag says, and each set bit that the manual does not name; nothing for other points."""
        lowest = self._point.bits[1] if self._point.bits else 0
        for flag in self._flags:
            yield flag.bits(raw, lowest)
        rest = raw & ~self._named_bits if self._flags else 0
        for bit in range(self._point.width):
            if rest >> bit & 1:
                yield Bits(lowest + bit, lowest + bit, None, 1, None, "")

    def _quantity(self, raw: int, settings: Settings) -> Meaning:
        point, shape = self._point, self._point.shape
        if shape.info.floating or (shape.most_raw is not None and abs(raw) > shape.most_raw):
            return self._computed(raw, settings)
        rule = self._rule(settings)
        if isinstance(rule, Meaning):
            return rule
        value = Fraction(raw * rule.factor + rule.add, rule.divisor)
        if shape.display is None:
            return Meaning(amount_with_unit(point, value), number_text(value))
        shown_value = rounded(value.numerator, value.denominator, shape.display)
        return Meaning(wording.with_unit(shown_value, point), number_text(value))

    def _rule(self, settings: Settings) -> Line | Meaning:
        """The scale in force, or why there is none: neither depends on the raw number."""
        # a special code equals the plain number, and is no quantity
        held = [settings.get(name) for name in self._needs]
        key = (*held, *map(type, held)) if held else ()
        rule = self._rules.get(key)
        if rule is None:
            if len(self._rules) >= _MOST_RULES:
                self._rules.clear()
            rule = self._rules[key] = self._found_rule(settings)
        return rule

    def _found_rule(self, settings: Settings) -> Line | Meaning:
        point = self._point
        if not point.generated and point.scale is None:
            return Meaning(line(point.reason or "its meaning is not settled"))
        try:
            ratio, offset = codec.rule_in_force(point, settings)
        except CodecError as error:
            return self._unknown(error)
        factor, add = offset.denominator * ratio.denominator, -offset.numerator * ratio.denominator
        return Line.reduced(factor, add, offset.denominator * ratio.numerator)

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
        message, hint = failure(self._device, self._point, error)
        return Meaning(f"not known: {message}", None, error.missing, hint)


class _Flag:
    """A flag, and what each of its numbers is called."""

    def __init__(self, flag: Flag) -> None:
        self.low, self.mask = flag.low, (1 << flag.width) - 1
        self._flag = flag
        self._texts: dict[int, str] = {}

    def is_false(self, raw: int) -> bool:
        """Whether it is a single bit whose name is not true."""
        return self.mask == 1 and raw >> self.low & 1 != self._flag.active

    def bits(self, raw: int, lowest: int) -> Bits:
        """The flag as a fact; `lowest` is the bit of the word where the point begins."""
        flag, low = self._flag, lowest + self.low
        number = raw >> self.low & self.mask
        entry = next((entry for entry in flag.values if entry.raw == number), None)
        told = "" if entry is None else line(_told(entry))
        return Bits(
            low + flag.width - 1, low, flag.name, number, None if flag.width > 1 else number == flag.active, told
        )

    def text(self, raw: int) -> str:
        """The flag with its number."""
        number = raw >> self.low & self.mask
        text = self._texts.get(number)
        if text is None:
            text = _flag_text(self._flag, number)
            if self.mask <= _MOST_RULES:
                self._texts[number] = text
        return text


def meaning_of(device: Device, point: Point, raw: int, settings: Settings) -> Meaning:
    """The meaning of a raw number; never fails: if it is unknown, the text says so."""
    return Meanings(device, point).of(raw, settings)


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
    return lambda raw: f"raw {raw} = {hex_text(raw & mask, digits)}"


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
