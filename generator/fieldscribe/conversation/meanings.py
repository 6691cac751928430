"""What a raw number of a point means, in words a commissioning engineer understands."""

from __future__ import annotations

from decimal import Decimal
from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError, Settings
from fieldscribe.arithmetic.floats import float_of, pattern_of
from fieldscribe.arithmetic.words import words_of
from fieldscribe.conversation.refusals import amount_with_unit, failure, names_text, refusal
from fieldscribe.conversation.texts import shown, text_of
from fieldscribe.records import dataclass
from fieldscribe.text import line
from fieldscribe.wording.exact import hex_text, number_text, rounded

if TYPE_CHECKING:
    from collections.abc import Iterator
    from fractions import Fraction

    from fieldscribe.model import Device, Flag, Point


@dataclass(frozen=True, slots=True)
class Meaning:
    """The meaning of a raw number: text, the exact value of a quantity, and what is missing or unusual."""

    text: str
    value: str | None = None
    missing: tuple[str, ...] = ()
    hint: str = ""


def meaning_of(device: Device, point: Point, raw: int, settings: Settings) -> Meaning:
    """The meaning of a raw number; never fails: if it is unknown, the text says so."""
    if point.text is not None:
        return Meaning(shown(text_of(raw, point.words)), text_of(raw, point.words))
    named = _named(point, raw)
    return _quantity(device, point, raw, settings) if named is None else Meaning(named)


def _named(point: Point, raw: int) -> str | None:
    """The text of a raw number that is no quantity; None if it is one."""
    special = point.special(raw)
    if special is not None:
        remark = ", no value" if special.no_value else ""
        return line(f"{special.name} ({wording.title_text(special.title)}){remark}")
    if point.enum is not None:
        entry = next((entry for entry in point.enum.entries if entry.raw == raw), None)
        named = "" if entry is None else wording.entry_meaning(entry)
        return line(named) or f"{raw}, a number without a name in the manual"
    if point.flags:
        return _flags_text(point, raw)
    if point.digits is not None:
        return _digits_text(point, raw)
    return ("on" if raw else "off") if point.type == "bit" else None


def rounding_remarks(point: Point, asked: Fraction, raw: int, settings: Settings) -> Iterator[str]:
    """Remarks on how a value was rounded that the point cannot hold exactly."""
    if point.info.floating:
        return
    got = codec.decode(point, raw, settings)
    if got != asked:
        yield f"{amount_with_unit(point, asked)} is between two raw numbers; rounded to {amount_with_unit(point, got)}"
    coarse = next((step for start, step in reversed(point.steps) if raw >= start), 1)
    if raw % coarse:
        kept = point.special(raw - raw % coarse)
        back = (
            kept.name
            if kept is not None
            else amount_with_unit(point, codec.decode(point, raw - raw % coarse, settings))
        )
        yield f"here the device keeps only raw numbers divisible by {coarse}; expect {back} back"


def range_remark(device: Device, point: Point, raw: int, settings: Settings) -> str:
    """Why the device refuses a raw number that a frame writes; empty if it accepts it."""
    if not point.writable:
        return f"it is {wording.access_text(point.access)}"
    try:
        codec.check(point, raw, settings)
    except CodecError as error:
        if error.status == "missing":
            return ""
        return refusal(device, point, _value(point, raw, settings), raw, (error, settings)).why
    return ""


def unchecked_remark(device: Device, point: Point, raw: int, settings: Settings) -> str:
    """The remark that a written number was not checked, for its limits depend on unknown points; else empty."""
    if not point.writable:
        return ""
    try:
        codec.check(point, raw, settings)
    except CodecError as error:
        if error.status == "missing":
            switches = " ".join(f"--with {name}=VALUE" for name in error.missing)
            return f"not held against its limits, which depend on {names_text(device, error.missing)}: give {switches}"
    return ""


def raw_text(point: Point, raw: int) -> str:
    """A raw number in both notations: `raw 500 = 01F4h`."""
    if point.type == "bit":
        return f"raw {raw}"
    if point.text is not None:
        return f"words {' '.join(f'{word:04X}h' for word in words_of(point, raw))}"
    digits = max(1, point.width + 3 >> 2)
    return f"raw {raw} = {hex_text(raw & ((1 << point.width) - 1), digits)}"


def _value(point: Point, raw: int, settings: Settings) -> Fraction | None:
    try:
        return codec.decode(point, raw, settings) if point.form in ("scaled", "integer", "float") else None
    except CodecError:
        return None


def _quantity(device: Device, point: Point, raw: int, settings: Settings) -> Meaning:
    if not point.generated and point.scale is None:
        return Meaning(line(point.reason or "its meaning is not settled"))
    try:
        value = codec.decode(point, raw, settings)
    except CodecError as error:
        if error.status == "not_a_number":
            return Meaning(str(codec.float_of(point, raw)))
        message, hint = failure(device, point, error)
        return Meaning(f"not known: {message}", None, error.missing, hint)
    if point.display is not None:
        shown_value = rounded(value.numerator, value.denominator, point.display)
        return Meaning(wording.with_unit(shown_value, point), number_text(value))
    if point.info.floating:
        return Meaning(wording.with_unit(_shortest(point, raw), point), number_text(value))
    return Meaning(amount_with_unit(point, value), number_text(value))


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


def _flags_text(point: Point, raw: int) -> str:
    true = [_flag_text(flag, raw) for flag in point.flags if flag.width > 1 or _is_true(flag, raw)]
    false = [_flag_text(flag, raw) for flag in point.flags if flag.width == 1 and not _is_true(flag, raw)]
    parts = [", ".join(true) if true else "none set"]
    if false:
        parts.append(f"not set: {', '.join(false)}")
    rest = raw & ~sum(((1 << flag.width) - 1) << flag.low for flag in point.flags)
    if rest:
        bits = [str(bit) for bit in range(point.width) if rest >> bit & 1]
        parts.append(f"also bit{'s' if len(bits) > 1 else ''} {', '.join(bits)}, which the manual does not name")
    return line("; ".join(parts))


def _is_true(flag: Flag, raw: int) -> bool:
    return raw >> flag.low & 1 == flag.active


def _flag_text(flag: Flag, raw: int) -> str:
    number = raw >> flag.low & ((1 << flag.width) - 1)
    entry = next((entry for entry in flag.values if entry.raw == number), None)
    if flag.width > 1:
        return f"{flag.name} = {entry.name if entry else number}"
    if entry is not None and entry.title["en"].casefold().replace(" ", "_") != flag.name:
        return f"{flag.name} ({entry.title['en']})"
    return f"{flag.name} (its bit is {number})" if flag.active == 0 else flag.name
