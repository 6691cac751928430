"""Explains why a value cannot be written, or a raw number cannot be read."""

from collections.abc import Iterable
from fractions import Fraction

from fieldscribe import wording
from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError, Settings
from fieldscribe.arithmetic.words import with_fixed
from fieldscribe.conversation.selection import points_by_name
from fieldscribe.diagnostics import RefusedError
from fieldscribe.model import Device, Enum, Point, Special
from fieldscribe.text import line, shortened
from fieldscribe.wording import label
from fieldscribe.wording.numbers import number_text

_MOST_DIGITS = 12
_MOST_NAMES = 30


def refusal(
    device: Device, point: Point, value: Fraction | None, raw: int, why: tuple[CodecError, Settings]
) -> RefusedError:
    """Return the error of the codec in words. `value` is the user's value, None for a raw number.

    `why` is the error, with the numbers of other points that led to it.
    """
    error, settings = why
    if error.status in ("out_of_range", "unknown_value"):
        return _out_of_range(device, point, (value, raw), settings)
    if error.special is not None:
        return _special_code(point, value, raw, error.special)
    message, hint = failure(device, point, error)
    return _refused(point, error.status, message, hint)


def written_remarks(device: Device, point: Point, raw: int, settings: Settings) -> tuple[str, str]:
    """Return why the device refuses a raw number in a frame, and why it could not be checked; both may be empty."""
    if not point.writable:
        return f"it is {wording.access_text(point.access)}", ""
    try:
        codec.check(point, raw, settings)
    except CodecError as error:
        if error.status != "missing":
            return refusal(device, point, _value(point, raw, settings), raw, (error, settings)).why, ""
        options = " ".join(f"--with {name}=VALUE" for name in error.missing)
        names = names_text(device, error.missing)
        return "", f"not compared with its limits, which depend on {names}: give {options}"
    return "", ""


def range_fault(device: Device, point: Point, raw: int, settings: Settings) -> str:
    """Return a text about a raw number that is out of the range of its point."""
    return _out_of_range(device, point, (_value(point, raw, settings), raw), settings, hinted=False).why


def range_of(device: Device, point: Point, settings: Settings, *, raw_alone: bool = False) -> str:
    """Return the range of a point in its unit, or as raw numbers, with limits from other points filled in."""
    if point.limit_arguments and (now := _range_now(point, settings)):
        return now
    raws = wording.raw_range_text(point)
    span = wording.range_text(point, points_by_name(device)) or raws
    if point.form in ("enum", "flags", "bit") or (raw_alone and raws) or not span:
        return f"raw {raws or f'{point.least}..{point.greatest}'}"
    return span


def in_range(point: Point, raw: int, settings: Settings) -> bool:
    """Return False if a raw number is out of the range of its point; True if limits are unknown."""
    try:
        codec.check(point, raw, settings)
    except CodecError as error:
        return error.status not in ("out_of_range", "unknown_value")
    return True


def _value(point: Point, raw: int, settings: Settings) -> Fraction | None:
    try:
        return codec.decode(point, raw, settings) if point.form in ("scaled", "integer", "float") else None
    except CodecError:
        return None


def failure(device: Device, point: Point, error: CodecError) -> tuple[str, str]:
    """Return the message and the hint (may be empty) for an error that is not about a range or a special code."""
    names = names_text(device, error.missing)
    if error.status == "missing":
        points = points_by_name(device)
        codes = {name: line(points[name].code or "") if name in points else "" for name in error.missing}
        hint = "give " + " ".join(f"--with {code or name}=VALUE" for name, code in codes.items())
        part = "its scale" if set(error.missing) <= set(point.scale_arguments) else "its range"
        return f"{part} depends on {names}", hint
    return {
        "zero_factor": f"{names} is zero or no quantity, and nothing can be computed with that",
        "no_case": f"the manual gives no scale for what {names} holds",
        "overflow": f"the exponent {names} is outside the range that it has",
        "special": "this raw number is a special code and no quantity",
        "not_a_number": "the bit pattern is no number",
    }.get(error.status, error.status), ""


def names_text(device: Device, names: Iterable[str]) -> str:
    """Return the codes and names of points: `A062 lower_frequency_limit and A004 maximum_frequency`."""
    names = tuple(names)
    points = points_by_name(device) if names else {}
    codes = {name: points[name].code if name in points else None for name in names}
    return " and ".join(f"{line(code)} {name}" if code else line(name) for name, code in codes.items())


def amount(number: Fraction) -> str:
    """Return a number as text: exact if that is short, else rounded and marked as rounded."""
    text = number_text(number)
    return text if is_short(text) or abs(number) >= 10**300 else f"about {float(number):.9g}"


def is_short(text: str) -> bool:
    """Return True if the text of an exact number is short enough to read."""
    return "/" not in text and ("." not in text or len(text.lstrip("-")) <= _MOST_DIGITS)


def amount_with_unit(point: Point, number: Fraction) -> str:
    """Return a number as text with the point's unit."""
    return wording.with_unit(amount(number), point)


def _refused(point: Point, status: str, why: str, hint: str = "", *, joint: str = ": ") -> RefusedError:
    """Return the refusal: the point's label, then the reason."""
    return RefusedError(status, line(f"{label(point)}{joint}{why}"), line(hint), why=line(why))


def _special_code(point: Point, value: Fraction | None, raw: int, special: Special) -> RefusedError:
    """Return the refusal of a special code, which was given as a quantity or can only be read."""
    title = f"`{special.name}` ({wording.title_text(special.title)})"
    if value is None:
        code = wording.code_text(raw, point.width, hexadecimal=special.hexadecimal)
        return _refused(point, "special", f"{code} is the special code {title}, which is only read", "give a quantity")
    code = wording.special_numbers(special, point.width)
    why = f"{amount_with_unit(point, value)} would be {code}, the special code {title}"
    if not special.writable:
        hint = "the code is no quantity, and is only read"
    elif special.low == special.high:
        hint = f"write `{special.name}` if that is meant"
    else:
        hint = f"if that is meant, give {point.name}.raw a raw number"
    return _refused(point, "special", why, hint)


def _out_of_range(
    device: Device, point: Point, number: tuple[Fraction | None, int], settings: Settings, *, hinted: bool = True
) -> RefusedError:
    value, raw = number
    if point.enum is not None and all(isinstance(interval.low, int) for interval in point.allowed.intervals):
        if not hinted:
            return _refused(point, "out_of_range", f"does not take {raw}")
        beyond = "" if point.enum.closed else f"; raw {wording.raw_range_text(point)} may be written"
        status = "unknown_value" if point.enum.closed else "out_of_range"
        return _refused(point, status, f"does not take {raw}", f"it has {_entries(point.enum)}{beyond}", joint=" ")
    if point.digits is not None and codec.strange_digits(point, raw):
        hint = f"each digit is one of {_entries(point.digits.enum)}"
        return _refused(point, "unknown_value", f"does not take {raw}", hint, joint=" ")
    if with_fixed(point, raw) != raw:
        always = wording.fixed_text(point)
        return _refused(point, "out_of_range", f"raw {raw} breaks what is always written: {always}")
    given = amount_with_unit(point, value) if value is not None else f"raw {raw}"
    span = range_of(device, point, settings, raw_alone=value is None)
    nearest = _nearest(point, value, raw, settings) if hinted else ""
    return _refused(point, "out_of_range", f"{shortened(given)} is outside {span}", nearest)


def _entries(enum: Enum) -> str:
    return ", ".join(f"{entry.raw} {entry.name}" for entry in enum.entries[:_MOST_NAMES])


def _range_now(point: Point, settings: Settings) -> str:
    """Return the range with limits from other points filled in; empty if one of them is unknown."""
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
    """Return the hint that names the nearest allowed value; empty if there is none."""
    if point.info.floating:
        if value is None or not point.allowed.units:
            return ""
        ends = [min(max(value, low), high) for low, high in point.allowed.units]
        text = amount_with_unit(point, min(ends, key=lambda end: abs(end - value)))
    else:
        try:
            wanted = raw if value is None else codec.encode(point, value, settings)
            nearest = codec.nearest_allowed(point, wanted, settings)
            if nearest is None:
                return ""
            text = _span(point, nearest, nearest, settings) if value is not None else f"raw {nearest}"
        except CodecError:
            return ""
    return f"the nearest allowed value is {text}"
