"""Turns a typed value into a raw number, and a raw number into the frames that write it.

Users type a number with or without its unit, a name, on or off, flags, digits, or a text.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from difflib import get_close_matches
from fractions import Fraction
from typing import Any, NamedTuple

from fieldscribe import wording
from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError, Settings
from fieldscribe.arithmetic.texts import fits, length_of, pattern_of_text, seconds_of
from fieldscribe.arithmetic.words import mask_of, with_fixed
from fieldscribe.conversation.meanings import Meanings, raw_form
from fieldscribe.conversation.refusals import amount_with_unit, refusal
from fieldscribe.conversation.selection import absence, choose_point
from fieldscribe.diagnostics import RefusedError, UnclearError, did_you_mean
from fieldscribe.families import family
from fieldscribe.families.frame_results import BuiltFrames, Options
from fieldscribe.language.numbers import NumberError, parse_number
from fieldscribe.language.units import factor_between
from fieldscribe.model import Device, Flag, Point
from fieldscribe.text import line, shortened
from fieldscribe.wording import label

_MEASURE = re.compile(r"([+-]?[0-9.,]+(?:[eE][+-]?[0-9]+)?)\s*(?![eE][+-]?[0-9])([^\s0-9.,].{0,30})")
_HEX_DIGITS = re.compile(r"[0-9A-Fa-f]+")
_HOURS = re.compile(r"[0-9][0-9A-Fa-f]*h")
_SWITCH = {"on": 1, "off": 0, "true": 1, "false": 0, "yes": 1, "no": 0}
_MOST_NAMES = 30
_UNICODE = ((0x20, 0x7E), (0xA0, 0xD7FF), (0xE000, 0x10FFFF))
_CHARACTERS = {"ascii": ((0x20, 0x7E),), "latin-1": ((0x20, 0x7E), (0xA0, 0xFF)), "utf-8": _UNICODE, "utf-16": _UNICODE}
"""The ranges of characters that may be written, by encoding."""


class Typed(NamedTuple):
    """A typed value: a quantity to encode, or a raw number if `value` is None."""

    value: Fraction | None
    raw: int


def read_value(point: Point, text: str, *, as_raw: bool = False) -> Typed:
    """Return the value that a text gives the point. Raises UnclearError; RefusedError for a text that does not fit."""
    if point.text is not None:
        return Typed(None, _pattern_of_text(point, text))
    if as_raw:
        return Typed(None, _whole(text))
    text = text.strip()
    raw = _flags(point, text) if point.flags else _digits(point, text) if point.digits else None
    raw = _named(point, text) if raw is None else raw
    if raw is not None:
        return Typed(None, raw)
    seconds = seconds_of(point.epoch, text) if point.epoch and not text.isdigit() else None
    if seconds is not None:
        return Typed(seconds, 0)
    try:
        number = _number(point, text)
    except NumberError as error:
        names = [name for name, _ in _names(point)]
        message = f"{label(point)} has no name `{shortened(text)}`"
        if names and not text[:1].isdigit():
            known = dict.fromkeys([entry.name for entry in point.enum.entries] if point.enum else names)
            raise _unknown(message, text.casefold(), names, known) from error
        if text[:1].isalpha():
            allowed = "on or off" if point.width == 1 else wording.range_text(point)
            marked = f"; hexadecimal is 0x{text}" if _HEX_DIGITS.fullmatch(text) else ""
            message = message if names or point.width == 1 else f"{label(point)}: `{shortened(text)}` is no number"
            raise UnclearError(message, f"it takes {allowed or 'numbers only'}{marked}") from error
        raise UnclearError(error.message, error.hint) from error
    if point.form not in ("enum", "flags", "bit", "digits"):
        return Typed(number, 0)
    if number.denominator != 1:
        raise UnclearError(f"`{shortened(text)}` is not a whole number", f"{label(point)} takes names or raw numbers")
    return Typed(None, int(number))


def encode_typed(device: Device, point: Point, typed: Typed, settings: Settings) -> int:
    """Return the raw number to write. Raises RefusedError, which says why not in words."""
    if point.text is not None:
        return typed.raw
    coded = typed.value is None and point.special(typed.raw) is not None
    raw = typed.raw if coded else with_fixed(point, typed.raw)
    try:
        if typed.value is not None:
            return codec.encode_checked(point, typed.value, settings)
        codec.check(point, raw, settings)
    except CodecError as error:
        raise refusal(device, point, typed.value, raw, (error, settings)) from error
    return raw


def read_settings(device: Device, pairs: list[str]) -> dict[str, int | Fraction]:
    """Return the settings for rules, from `A004=50 Hz` or `A004.raw=50`. Raises UnclearError, RefusedError."""
    settings: dict[str, int | Fraction] = {}
    for pair in pairs:
        name, equals, text = pair.partition("=")
        if not equals or not text.strip():
            raise UnclearError(f"`{shortened(pair)}` gives no value", "write --with POINT=VALUE")
        name = name.strip()
        point = choose_point(device, name.removesuffix(".raw"), any_variant=True)
        raw = _raw_of(device, point, text, settings, as_raw=name.endswith(".raw"))
        settings[point.name] = codec.setting_of(point, raw)
    return settings


def _raw_of(device: Device, point: Point, text: str, settings: Settings, *, as_raw: bool) -> int:
    """Return the raw number of another point. Only its bits limit it: it may hold what must not be written."""
    if point.text is not None:
        raise UnclearError(f"{label(point)} is {point.text.kind}, and no rule takes one", "")
    typed = read_value(point, text, as_raw=as_raw)
    try:
        raw = typed.raw if typed.value is None else codec.quantity(point, codec.encode(point, typed.value, settings))
        if not point.least <= raw <= point.greatest:
            raise CodecError("out_of_range")
    except CodecError as error:
        raise refusal(device, point, typed.value, typed.raw, (error, settings)) from error
    return raw


def _whole(text: str) -> int:
    try:
        number = parse_number(text)
    except NumberError as error:
        raise UnclearError(error.message, error.hint) from error
    if number.denominator != 1:
        raise UnclearError(f"`{shortened(text)}` is not a whole number", "a raw number has no decimals")
    return int(number)


def _number(point: Point, text: str) -> Fraction:
    """Return a number with or without the point's unit. Raises NumberError, UnclearError."""
    if point.unit.symbol == "h" and _HOURS.fullmatch(text):
        raise UnclearError(f"`{text}` could be hours or hexadecimal", f"write `{text[:-1]} h`, or 0x{text[:-1]}")
    try:
        return parse_number(text)
    except NumberError:
        measure, symbol = _MEASURE.fullmatch(text), point.unit.symbol
        if measure is None or (not symbol and _HEX_DIGITS.fullmatch(text)):
            raise
    number, factor = parse_number(measure[1]), _factor(point, measure[2].strip())
    if factor is None:
        unit = f"is in {symbol}, not in" if symbol else "has no unit, here is"
        hint = "give the number in that unit, or alone" if symbol else "give the number alone"
        hint += f"; hexadecimal is 0x{text}" if _HEX_DIGITS.fullmatch(text) else ""
        raise UnclearError(f"{label(point)} {unit} `{shortened(measure[2])}`", hint)
    return number * factor


def _factor(point: Point, typed: str) -> Fraction | None:
    """Return the factor from the typed unit to the point's unit; None if they have nothing in common."""
    if not point.unit.symbol:
        return None
    known = factor_between(typed, point.unit)
    return Fraction(1) if known is None and _is_unit(point, typed) else known


def _is_unit(point: Point, typed: str) -> bool:
    """Return True for another spelling of the point's unit. Case may differ except in a prefix: mW is not MW."""
    if typed.casefold() in (point.unit.name.casefold(), f"{point.unit.name}s".casefold()):
        return True
    typed, symbol = (
        text.replace("\u00b5", "u").replace("\u03bc", "u").replace("\u00b0", "") for text in (typed, point.unit.symbol)
    )
    if typed == symbol:
        return True
    return typed.casefold() == symbol.casefold() and (typed[:1] == symbol[:1] or symbol[:1] not in "mMpP")


def _names(point: Point) -> Iterator[tuple[str, int]]:
    """Return all names for raw numbers of the point, the plain names first."""
    entries = point.enum.entries if point.enum else ()
    yield from ((special.name, special.low) for special in point.specials if special.low == special.high)
    yield from ((entry.name, entry.raw) for entry in entries)
    for entry in entries:
        yield from ((title, entry.raw) for title in entry.title.values())
    yield from ((entry.quantity, entry.raw) for entry in entries if entry.quantity)


def _named(point: Point, text: str) -> int | None:
    wanted = " ".join(text.casefold().split())
    for name, raw in _names(point):
        if " ".join(name.casefold().split()) == wanted:
            return raw
    band = next((special for special in point.specials if special.name == wanted), None)
    if band is not None:
        numbers = wording.special_numbers(band, point.width)
        raise UnclearError(f"`{band.name}` is all of {numbers}", f"say which one: {point.name}.raw, and the raw number")
    return _SWITCH.get(wanted) if point.width == 1 else None


def _digits(point: Point, text: str) -> int | None:
    """Return the number of named or plain digits with commas between, the highest first; None for a plain number."""
    parts = [part.strip() for part in text.split(",")]
    if point.digits is None or (len(parts) == 1 and point.digits.count > 1):
        return None
    if len(parts) != point.digits.count:
        raise UnclearError(f"{label(point)} has {point.digits.count} digits, here are {len(parts)}", "")
    raw = 0
    for part in parts:
        named = (entry.raw for entry in point.digits.enum.entries if part.casefold() in (entry.name, entry.quantity))
        digit = next(named, None)
        digit = _whole(part) if digit is None else digit
        if not 0 <= digit <= 9:
            raise UnclearError(f"`{shortened(part)}` is no digit", "each is one of 0 to 9, or a name from the list")
        raw = 10 * raw + digit
    return raw


def _flags(point: Point, text: str) -> int | None:
    """Return the number in which the flags joined by `|` are true and no others; None for a number or special code."""
    wanted = [part.strip().casefold() for part in text.split("|")]
    if len(wanted) == 1 and (wanted[0][:1].isdigit() or any(code.name == wanted[0] for code in point.specials)):
        return None
    raw = sum(1 << flag.low for flag in point.flags if flag.width == 1 and flag.active == 0)
    for part in wanted:
        if part not in ("none", ""):
            flag, number = _flag(point, part)
            raw = raw & ~(mask_of(flag.width) << flag.low) | number << flag.low
    return raw


def _flag(point: Point, part: str) -> tuple[Flag, int]:
    """Return the flag and its number, of `name` or `name=number`."""
    name, equals, value = (side.strip() for side in part.partition("="))
    flag = next((flag for flag in point.flags if flag.name == name), None)
    if flag is None:
        names = [flag.name for flag in point.flags]
        raise _unknown(f"{label(point)} has no flag `{shortened(name)}`", name, names, names)
    if not equals:
        if flag.width > 1:
            raise UnclearError(f"`{flag.name}` has {flag.width} bits", f"write {flag.name}=NUMBER or {flag.name}=NAME")
        return flag, flag.active
    number = next((entry.raw for entry in flag.values if entry.name == value), None)
    number = _whole(value) if number is None else number
    if not 0 <= number < 1 << flag.width:
        raise UnclearError(f"`{flag.name}` has {flag.width} bits, {number} does not fit", "")
    return flag, number


def _unknown(message: str, typed: str, names: list[str], known: Iterable[str]) -> UnclearError:
    """Return the error for an unknown name, with similar names or else all known ones."""
    near = did_you_mean(get_close_matches(typed, names, 3))
    return UnclearError(message, near or f"it has {', '.join(list(known)[:_MOST_NAMES])}")


def _pattern_of_text(point: Point, typed: str) -> int:
    """Return the words of a typed text as one number, the first characters in the highest bits. Raises RefusedError."""
    layout = point.text
    assert layout is not None
    if layout.is_bytes or layout.parts:
        if not fits(layout, typed):
            what = (
                f"no {layout.encoding} of {label(point)}" if layout.parts else f"not {wording.characters_text(layout)}"
            )
            message = f"`{shortened(typed)}` is {what}"
            raise RefusedError("out_of_range", message)
        return pattern_of_text(layout, typed)
    spans = _CHARACTERS[layout.encoding]
    strange = next((char for char in typed if not any(low <= ord(char) <= high for low, high in spans)), None)
    if strange is not None:
        name = line(strange) or f"U+{ord(strange):04X}"
        message = f"{label(point)} cannot hold `{name}`: its characters are {layout.encoding}"
        raise RefusedError("out_of_range", message)
    if not fits(layout, typed):
        unit = {"utf-8": " bytes of utf-8", "utf-16": " words of utf-16"}.get(layout.encoding, " characters")
        message = f"{label(point)} has {layout.characters}{unit}, here are {length_of(layout, typed)}"
        raise RefusedError("out_of_range", message)
    return pattern_of_text(layout, typed)


class Encoded(NamedTuple):
    """A raw number to write, its meaning, and notes on how the value was rounded."""

    point: str
    code: str | None
    raw: int
    pattern: int
    text: str
    notes: tuple[str, ...]
    words: int = 1

    def as_data(self) -> dict[str, object]:
        """Return the same for JSON."""
        return {
            "point": self.point,
            "code": self.code,
            "raw": self.raw if self.words <= 4 else None,
            "hex": f"{self.pattern:0{4 * self.words if self.words > 4 else 1}X}",
            "text": self.text,
            "notes": list(self.notes),
        }


def encode_point(device: Device, point: Point, value: str, settings: Settings, *, as_raw: bool = False) -> Encoded:
    """Return the raw number of a typed value, or of a typed raw number. Raises RefusedError, UnclearError."""
    if missing := absence(device, point):
        raise RefusedError("absent", f"{label(point)}: {missing}")
    if not point.generated:
        reason = point.reason or "the manual leaves it open"
        raise RefusedError("not_generated", line(f"{label(point)} cannot be encoded: {reason}"))
    typed = read_value(point, value, as_raw=as_raw)
    raw = encode_typed(device, point, typed, settings)
    notes = () if typed.value is None else tuple(_rounding_notes(point, typed.value, raw, settings))
    text = line(f"{label(point)} = {Meanings(device, point).text(raw, settings)}: {raw_form(point)(raw)}")
    width = 16 * point.words if point.text is not None else point.width
    return Encoded(point.item, point.code, raw, raw & ((1 << width) - 1), text, notes, point.words)


def frames_for(device: Device, point: Point, raw: int, settings: Settings, options: Options) -> BuiltFrames:
    """Return the frames that write a raw number, after those that select the point.

    Raises RefusedError, UnclearError.
    """
    require_writable(point)
    build = family_part(device, "frame_builder").frames_for
    before = [
        frame
        for name, held in point.selects
        for other in device.points
        if other.name == name
        for frame in build(device, other, held, settings, options).frames
    ]
    frames: BuiltFrames = build(device, point, raw, settings, options)
    if point.write_with:
        frames = replace(
            frames, notes=(*frames.notes, f"the device wants it in one request with {', '.join(point.write_with)}")
        )
    return replace(frames, frames=(*before, *frames.frames)) if before else frames


def family_part(device: Device, name: str) -> Any:
    """Return a part of the device's family, such as `frame_builder`. Raises UnclearError if it has none."""
    part = family(device.family).part(name)
    if part is None:
        message = f"frames of the family {device.family} are not known here"
        raise UnclearError(message, "ask for raw numbers, without frames")
    return part


def require_writable(point: Point) -> None:
    """Raise RefusedError for a point that is only read."""
    if not point.writable:
        raise RefusedError("read_only", f"{label(point)} is {wording.access_text(point.access)}")


def _rounding_notes(point: Point, value: Fraction, raw: int, settings: Settings) -> Iterator[str]:
    """Return notes on the rounding of a value that the point cannot hold exactly."""
    if point.info.floating:
        return
    rounded = codec.decode(point, raw, settings)
    if rounded != value:
        texts = amount_with_unit(point, value), amount_with_unit(point, rounded)
        yield f"{texts[0]} is between two raw numbers; rounded to {texts[1]}"
    coarse = next((step for start, step in reversed(point.steps) if raw >= start), 1)
    if raw % coarse:
        kept = raw - raw % coarse
        special = point.special(kept)
        back = special.name if special else amount_with_unit(point, codec.decode(point, kept, settings))
        yield f"here the device keeps only raw numbers divisible by {coarse}; expect {back} back"
