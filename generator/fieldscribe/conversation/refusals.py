"""Why a value cannot be written, or a raw number cannot be read, in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError, Settings
from fieldscribe.arithmetic.words import with_fixed
from fieldscribe.conversation.selection import points_by_name
from fieldscribe.text import line
from fieldscribe.user_errors import RefusedError
from fieldscribe.wording import label
from fieldscribe.wording.exact import number_text

if TYPE_CHECKING:
    from collections.abc import Iterable
    from fractions import Fraction

    from fieldscribe.model import Device, Point, Special

_MOST_DIGITS = 12
_MOST_NAMES = 30


def _refused(point: Point, status: str, why: str, hint: str = "", *, joint: str = ": ") -> RefusedError:
    """The refusal with the label of the point in front of the reason."""
    return RefusedError(status, line(f"{label(point)}{joint}{why}"), hint, why=line(why))


Circumstances = tuple[CodecError, Settings]
"""The error, and the raw numbers of other points that led to it."""


def refusal(device: Device, point: Point, value: Fraction | None, raw: int, why: Circumstances) -> RefusedError:
    """The error of the codec in words; `value` is what was asked for, or None if `raw` was."""
    error, settings = why
    if error.status in ("out_of_range", "unknown_value"):
        return _out_of_range_refusal(device, point, value, raw, settings)
    if error.special is not None:
        return _special_code_refusal(point, value, raw, error.special)
    message, hint = failure(device, point, error)
    return _refused(point, error.status, message, hint)


def _special_code_refusal(point: Point, value: Fraction | None, raw: int, special: Special) -> RefusedError:
    """The refusal of a special code: it was given as a quantity, or it can only be read."""
    title = f"`{special.name}` ({wording.title_text(special.title)})"
    if value is not None:
        code = wording.special_numbers(special, point.width)
        why = f"{amount_with_unit(point, value)} would be {code}, the special code {title}"
    else:
        shown = wording.code_text(raw, point.width, hexadecimal=special.hexadecimal)
        why = f"{shown} is the special code {title}, which is only read"
    hint = "the code is no quantity, and is only read"
    if special.writable:
        hint = f"write `{special.name}` if that is meant"
        hint = hint if special.low == special.high else f"if that is meant, give {point.name}.raw a raw number"
    return _refused(point, "special", why, hint if value is not None else "give a quantity")


def failure(device: Device, point: Point, error: CodecError) -> tuple[str, str]:
    """The message for any other error, and a hint (or empty)."""
    blamed = names_text(device, error.missing)
    if error.status == "missing":
        hint = "give " + " ".join(f"--with {_short(device, name)}=VALUE" for name in error.missing)
        part = "its scale" if set(error.missing) <= set(point.scale_arguments) else "its range"
        return f"{part} depends on {blamed}", hint
    return {
        "zero_factor": (f"{blamed} is zero or no quantity, and nothing can be computed with that", ""),
        "no_case": (f"the manual gives no scale for what {blamed} holds", ""),
        "overflow": (f"the exponent {blamed} is outside the range that it has", ""),
        "special": ("this raw number is a special code and no quantity", ""),
        "not_a_number": ("the bit pattern is no number", ""),
    }.get(error.status, (error.status, ""))


def names_text(device: Device, names: Iterable[str]) -> str:
    """The names that people know points by: `A062 lower_frequency_limit and A004 maximum_frequency`."""
    points = points_by_name(device) if (names := tuple(names)) else {}
    return " and ".join(_name(points[name]) if name in points else line(name) for name in names)


def _name(point: Point) -> str:
    """The name that rules use for a point, common to all its variants."""
    return f"{line(point.code)} {point.name}" if point.code else point.name


def amount(number: Fraction) -> str:
    """A number for people: exact if that is short, else rounded and marked as rounded."""
    exactly = number_text(number)
    return exactly if is_short(exactly) or abs(number) >= 10**300 else f"about {float(number):.9g}"


def is_short(exactly: str) -> bool:
    """Whether the text of an exact number ends, and soon."""
    return "/" not in exactly and (len(exactly) <= _MOST_DIGITS + (exactly[0] == "-") or "." not in exactly)


def amount_with_unit(point: Point, number: Fraction) -> str:
    """A number for people, with the point's unit."""
    return wording.with_unit(amount(number), point)


def _short(device: Device, name: str) -> str:
    point = points_by_name(device).get(name)
    return line(point.code) if point is not None and point.code else name


def _out_of_range_refusal(
    device: Device, point: Point, value: Fraction | None, raw: int, settings: Settings
) -> RefusedError:
    if point.enum is not None and all(isinstance(interval.low, int) for interval in point.allowed.intervals):
        known = ", ".join(f"{entry.raw} {entry.name}" for entry in point.enum.entries[:_MOST_NAMES])
        status = "unknown_value" if point.enum.closed else "out_of_range"
        beyond = "" if point.enum.closed else f"; raw {wording.raw_range_text(point)} may be written"
        return _refused(point, status, f"does not take {raw}", line(f"it has {known}{beyond}"), joint=" ")
    if point.digits is not None and codec.strange_digits(point, raw):
        known = ", ".join(f"{entry.raw} {entry.name}" for entry in point.digits.enum.entries[:_MOST_NAMES])
        hint = line(f"each digit is one of {known}")
        return _refused(point, "unknown_value", f"does not take {raw}", hint, joint=" ")
    if with_fixed(point, raw) != raw:
        always = wording.fixed_text(point)
        return _refused(point, "out_of_range", f"raw {raw} breaks what is always written: {always}")
    asked = amount_with_unit(point, value) if value is not None else f"raw {raw}"
    span = wording.range_text(point, points_by_name(device)) or wording.raw_range_text(point)
    if point.form in ("enum", "flags", "bit") or not span:
        span = f"raw {wording.raw_range_text(point) or f'{point.least}..{point.greatest}'}"
    span = (_range_now(point, settings) if point.limit_arguments else "") or span
    nearest = _nearest(point, value, raw, settings)
    return _refused(point, "out_of_range", f"{asked} is outside {line(span)}", nearest)


def _range_now(point: Point, settings: Settings) -> str:
    """The range with the limits from other points filled in, if all of them are known."""
    try:
        spans = [window for window in codec.windows(point, settings) if not window.missing]
        parts = [_span(point, window.low, window.high, settings) for window in spans if window.low <= window.high]
    except CodecError:
        return ""
    if len(spans) < len(point.allowed.intervals):
        return ""
    return f"what is allowed here, {' or '.join(parts)}" if parts else "what is allowed: here that is nothing"


def _span(point: Point, low: int, high: int, settings: Settings) -> str:
    ends = sorted(codec.decode(point, raw, settings) for raw in (low, high))
    if low == high:
        return amount_with_unit(point, ends[0])
    return wording.with_unit(f"{amount(ends[0])}..{amount(ends[1])}", point)


def _nearest(point: Point, value: Fraction | None, raw: int, settings: Settings) -> str:
    try:
        if point.info.floating:
            return _nearest_float(point, value)
        wanted = raw if value is None else codec.encode(point, value, settings)
        nearest = codec.nearest_allowed(point, wanted, settings)
        if nearest is None:
            return ""
        said = _span(point, nearest, nearest, settings) if value is not None else f"raw {nearest}"
    except CodecError:
        return ""
    return f"the nearest allowed value is {said}"


def _nearest_float(point: Point, value: Fraction | None) -> str:
    if value is None or not point.allowed.units:
        return ""
    ends = [min(max(value, low), high) for low, high in point.allowed.units]
    return f"the nearest allowed value is {amount_with_unit(point, min(ends, key=lambda end: abs(end - value)))}"
