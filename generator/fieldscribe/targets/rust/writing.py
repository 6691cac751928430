"""How a point is encoded, and what may be written."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.rust.literals import (
    FLOAT_GREATEST,
    float_literal,
    integer,
    mask,
    nearest_float,
    type_range,
)
from fieldscribe.targets.rust.reading import parameter, plain_count
from fieldscribe.targets.rust.rules import count_path, encode_float, limit_views, merged, patterns
from fieldscribe.targets.rust.views import CheckView, WriteView

if TYPE_CHECKING:
    from fieldscribe.model import Point
    from fieldscribe.targets.rust.subjects import Scope, Subject

_FUNCTIONS = {"coil": (5, 15), "holding": (6, 16)}


def write_view(subject: Subject, low: int, high: int, scope: Scope) -> WriteView:
    """Encoding of a point whose raw numbers are written within `low..=high`."""
    point, raw, form, rule = subject.point, subject.raw, subject.form, subject.rule
    kind, count_type, within, scaled, count, fixed = form, "", "", "", "", ""
    if form == "float":
        value = f"f{point.width}_bits"
    elif form == "scaled" and rule is not None:
        value = encode_float(rule)
        if point.decimals is not None:
            path = count_path(rule, point.decimals, raw, low, high)
            count_type, (scaled, count), within = path.type, path.encode, f"{path.low}, {path.high}"
    elif form == "scaled":
        kind = "run_time"
        if point.decimals is not None:
            count_type, count = "i64", f"encode_count::<{integer(10**point.decimals)}>"
        value = "with" if subject.factors == subject.arguments else "with.factors()"
    elif form == "text":
        value = "value.into_words()"
    elif form == "digits":
        value = f"runtime::digits::join::<Self>(&value.map({subject.carried}::from))?"
        value = value if raw == "u16" else f"arithmetic::held::<Self>({value}, runtime::Error::UnknownValue)?"
    else:
        kind, value, count_type = "plain", _plain_raw(subject), plain_count(raw)
        fixed = _fixed(subject)[0]
        count = "arithmetic::bit(count)?" if raw == "bool" else _held("count", closed=subject.closed)
    bounded = not subject.limits and not point.specials and len(merged(_numbers(point))) == 1
    function, address = _place(point, scope)
    with_type = subject.with_type
    return WriteView(
        arguments=with_type,
        parameter=parameter(with_type, "With", used=True),
        passed="with" if subject.arguments else "()",
        check=_check(subject, with_type, scope),
        kind=kind,
        encodes=point.encodes_values,
        bounded=bounded,
        value=value,
        count_type=f"runtime::Reading<{count_type}, {raw}>" if point.specials and count_type else count_type,
        count_parameter=parameter(with_type, "With", used=kind != "scaled" or not bounded),
        within=within,
        scaled=scaled,
        count=count,
        function=function,
        address=address,
        fixed=fixed,
    )


def _plain_raw(subject: Subject) -> str:
    """A value as the raw number; an enum that several raw types share may carry what this one cannot hold."""
    if subject.enum is not None and subject.carried != subject.raw:
        return _held(f"{subject.carried}::from(value)", closed=subject.closed)
    return f"{subject.raw}::from(value)" if subject.form in ("enum", "flags") else "value"


def _held(number: str, *, closed: bool) -> str:
    return f"arithmetic::held::<Self>({number}, runtime::Error::{'UnknownValue' if closed else 'OutOfRange'})?"


def _fixed(subject: Subject) -> tuple[str, str]:
    """`raw` with the bits of its word that are always a constant, and whether it has them; empty if there are none."""
    point, raw = subject.point, subject.raw
    if point.fixed is None or point.bits is not None or raw == "bool":
        return "", ""
    ones = (1 << point.info.bits) - 1
    all_bits, bits = (_pattern(number & ones, raw) for number in (point.fixed.mask, point.fixed.bits))
    cleared = f"raw & !{all_bits}"
    return f"({cleared}) | {bits}" if point.fixed.bits & ones else cleared, f"raw & {all_bits} == {bits}"


def _pattern(bits: int, raw: str) -> str:
    """Bits as a hexadecimal literal of the type, which may be signed."""
    least, greatest = type_range(raw)
    negative = bits > greatest
    return f"{'-' if negative else ''}{mask(-(bits + 2 * least) if negative else bits, raw)}"


def _float_ranges(point: Point) -> tuple[str, ...]:
    """Conditions of which one holds if a number of the type is within the limits, as the type has those."""
    greatest = FLOAT_GREATEST[point.width]
    ends = [[nearest_float(float(end), point.width) for end in pair] for pair in point.allowed.units]
    if not ends or ends == [[-greatest, greatest]]:
        return ("number.is_finite()",)
    literals = [map(float_literal, pair) for pair in ends]
    return tuple(f"({low}..={high}).contains(&number)" for low, high in literals)


def _check(subject: Subject, with_type: str, scope: Scope) -> CheckView:
    point, raw = subject.point, subject.raw
    report = "listed" if subject.closed else "allowed"
    if subject.limits:
        limits, conditions = limit_views(point, scope.points)
        number = "runtime::Raw::to_i64(raw)"
        with_limits = parameter(with_type, "With", used=True)
        return CheckView(report, "raw", with_limits, number, conditions, limits, _fixed(subject)[1])
    unused = parameter(with_type, "With", used=False)
    if subject.form == "float":
        return CheckView(report, "raw", unused, f"arithmetic::f{point.width}_number(raw)?", _float_ranges(point), ())
    if point.text is not None:
        encoding = "is_ascii" if point.text.encoding == "ascii" else "is_latin_1"
        return CheckView(report, "raw", unused, "", (f"runtime::text::{encoding}(&raw)",), ())
    if subject.form == "digits" and point.digits is not None:
        number = "raw" if raw == "u16" else "u16::from(raw)"
        call = f"runtime::digits::check::<Self, {point.digits.count}>({number})"
        return CheckView(report, "raw", unused, "", (), (), call=call)
    numbers, fixed = _numbers(point), _fixed(subject)[1]
    least, greatest = type_range(raw)
    if any(low <= least and greatest <= high for low, high in merged(numbers)):
        return CheckView(report, "raw" if fixed or point.specials else "_", unused, "", (), (), fixed)
    return CheckView(report, "raw", unused, "", patterns(numbers, raw), (), fixed)


def _numbers(point: Point) -> list[tuple[int, int]]:
    """The intervals that no other point sets; all that the bits hold where the manual says none."""
    ends = ((one.low, one.high) for one in point.allowed.intervals)
    numbers = [(low, high) for low, high in ends if isinstance(low, int) and isinstance(high, int)]
    return numbers or [(point.least, point.greatest)]


def _place(point: Point, scope: Scope) -> tuple[str, str]:
    """Function and address that write the point, each empty where it is the usual one."""
    first = point.places[0]
    place = first if first.purpose == "write" else next((one for one in point.places if one.purpose == "write"), first)
    one, many = _FUNCTIONS.get(place.space, (0, 0))
    usual = one if point.words == 1 else many
    function = place.function if place.purpose == "write" else None
    if function is None:
        function = many if usual not in scope.functions and many in scope.functions else usual
    elsewhere = place is not first and place.addresses
    return "" if function == usual else str(function), f"0x{min(place.addresses):04X}" if elsewhere else ""
