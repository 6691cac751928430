"""The view of one point."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from fieldscribe.model import Device, Erratum, Point
from fieldscribe.targets.rust.documentation import point_doc, sentence
from fieldscribe.targets.rust.literals import float_literal, integer, mask, raw_literal, raw_type, type_name, type_range
from fieldscribe.targets.rust.rules import (
    bounds,
    count_path,
    decode_float,
    encode_float,
    fixed,
    interval,
    limit_views,
    run_time_rules,
)
from fieldscribe.targets.rust.views import BitsView, CheckView, PointView, ReadView, SpecialView, WriteView
from fieldscribe.text import rust_string

_ALIAS = re.compile(r"[\w.:/+-]+(?: [\w.:/+-]+)*")
_SPACES = {"coil": "Coil", "discrete": "Discrete", "input": "Input", "holding": "Holding"}
_ARGUMENTS_WIDTH = 60
"""rustfmt breaks arguments of a call, and of a macro, that take more columns."""
_LETTERS = ("a", "b", "c", "d")


@dataclass(frozen=True, slots=True)
class Scope:
    """What the points of one device share: points by name, errata by id, raw types of the enums, functions of the device."""

    points: Mapping[str, Point]
    errata: Mapping[str, Erratum]
    enums: Mapping[str, str]
    functions: frozenset[int]


def scope_of(device: Device) -> Scope:
    """The scope of a device."""
    points: dict[str, Point] = {}
    enums: dict[str, str] = {}
    for point in device.points:
        points.setdefault(point.name, point)
        if point.generated and point.enum is not None:
            raw = raw_type(point)
            known = enums.setdefault(point.enum.name, raw)
            if known != raw:
                enums[point.enum.name] = "i128" if "u64" in (known, raw) else "i64"
    functions = frozenset(code.number for code in device.bus.functions)
    return Scope(points, {one.id: one for one in device.errata}, enums, functions)


def space(name: str) -> str:
    """A space as a variant of the runtime's enum."""
    known = _SPACES.get(name)
    return f"runtime::Space::{known}" if known else f"runtime::Space::Other({rust_string(name)})"


def point_view(point: Point, scope: Scope) -> PointView:
    """All that the templates need of a point."""
    raw = raw_type(point)
    name = type_name(point.item)
    rule = fixed(point)
    rules = run_time_rules(point, scope.points) if point.form == "scaled" and rule is None else ()
    factors = _struct(point, point.scale_arguments, "Factors" if point.scale_arguments != point.arguments else "")
    low, high = bounds(point)
    return PointView(
        doc=tuple(f" {line}" if line else "" for line in point_doc(point, scope.errata)),
        alias=rust_string(point.code) if point.code and point.code != name and _ALIAS.fullmatch(point.code) else "",
        name=name,
        item=point.item,
        raw=raw,
        value=_value_type(point, raw),
        constants=_constants(point, raw, low, high),
        order=_order(point, raw),
        bits=_bits(point),
        rules=rules,
        factors=factors,
        last_rule_holds=bool(rules) and not rules[-1].condition,
        read=_read(point, raw, factors, scope) if point.readable else None,
        write=_write(point, raw, low, high, scope) if point.writable else None,
        specials=_specials(point, raw),
        was=tuple(map(type_name, point.was)),
    )


def patterns(numbers: list[tuple[int, int]], rust_type: str, subject: str = "raw") -> tuple[str, ...]:
    """Conditions, each short enough for one line, of which one holds if `raw` is in one of the intervals."""
    if rust_type == "bool":
        return (f"matches!({subject}, {raw_literal(numbers[0][0], rust_type)})",)
    parts = [interval(low, high) for low, high in _merged(numbers)]
    lines: list[list[str]] = [[]]
    width = len(subject) + 2
    for part in parts:
        if lines[-1] and width + len(part) + 3 > _ARGUMENTS_WIDTH:
            lines.append([])
            width = len(subject) + 2
        lines[-1].append(part)
        width += len(part) + 3
    return tuple(f"matches!({subject}, {' | '.join(line)})" for line in lines)


def _merged(numbers: list[tuple[int, int]]) -> list[tuple[int, int]]:
    merged: list[tuple[int, int]] = []
    for low, high in sorted(numbers):
        if merged and low <= merged[-1][1] + 1:
            merged[-1] = (merged[-1][0], max(high, merged[-1][1]))
        else:
            merged.append((low, high))
    return merged


def _value_type(point: Point, raw: str) -> str:
    if point.form in ("scaled", "float"):
        return "f64"
    if point.enum is not None and point.form == "enum":
        return f"enums::{type_name(point.enum.name)}"
    return f"flags::{type_name(point.item)}" if point.form == "flags" else raw


def _constants(point: Point, raw: str, low: int, high: int) -> tuple[str, ...]:
    lines = [f"const NAME: &'static str = {rust_string(point.item)};"]
    if point.code:
        lines.append(f"const CODE: Option<&'static str> = Some({rust_string(point.code)});")
    lines.append(f"const SPACE: runtime::Space = {space(point.places[0].space)};")
    lines.append(f"const ADDRESS: u16 = 0x{point.address:04X};")
    if point.words != 1:
        lines.append(f"const WORDS: u16 = {point.words};")
    if point.unit.symbol:
        lines.append(f"const UNIT: &'static str = {rust_string(point.unit.symbol)};")
    least, greatest = type_range(raw)
    if point.form != "float":
        if low != least:
            lines.append(f"const RAW_MIN: {raw} = {raw_literal(low, raw)};")
        if high != greatest:
            lines.append(f"const RAW_MAX: {raw} = {raw_literal(high, raw)};")
    return tuple(lines)


def _order(point: Point, raw: str) -> tuple[str, str, str, str] | None:
    """How many words, their names, and how address order and reading order map; None where the high part comes first."""
    addresses = point.addresses
    if list(addresses) == sorted(addresses):
        return None
    letters = _LETTERS[: len(addresses)]
    by_address = [letters[place] for place in sorted(range(len(addresses)), key=addresses.__getitem__)]
    return str(len(addresses)), raw, ", ".join(letters), ", ".join(by_address)


def _bits(point: Point) -> BitsView | None:
    if point.bits is None:
        return None
    high, low = point.bits
    bits = mask(((1 << (high - low + 1)) - 1) << low, "u16")
    signed = "_signed" if point.info.signed else ""
    return BitsView(low, bits, f"arithmetic::extract{signed}(word, {low}, {bits})")


def _struct(point: Point, names: tuple[str, ...], suffix: str) -> str:
    return f"with::{type_name(point.item)}{suffix}" if names else "()"


def _read(point: Point, raw: str, factors: str, scope: Scope) -> ReadView:
    unreal = [(one.low, one.high) for one in point.specials if one.no_value]
    no_value = patterns(unreal, raw) if unreal else ()
    rule = fixed(point)
    failing, narrows, count_type, scaled, count = False, False, _plain_count(raw), "", ""
    if point.form == "float":
        value, count_type = f"f{point.width}::from_bits(raw)", ""
        value = f"f64::from({value})" if point.width == 32 else value
    elif point.form == "scaled" and rule is not None:
        path = count_path(rule, point.decimals, raw, *bounds(point))
        value, count_type, (scaled, count) = decode_float(rule, raw), path.type, path.decode
        failing = narrows = path.overflows
    elif point.form == "scaled":
        value, count_type, failing = "", "i64", True
        count = f"decode_count::<{integer(10**point.decimals)}>"
    else:
        value, count = _plain_value(point, raw, scope), "raw" if count_type == raw else f"{count_type}::from(raw)"
    function = _function(point, point.places[0].function, {"coil": 1, "discrete": 2, "holding": 3, "input": 4})
    parameter = _parameter(factors, "Factors", used=point.form == "scaled" and rule is None)
    failing = failing or bool(no_value)
    return ReadView(factors, parameter, failing, narrows, no_value, value, count_type, scaled, count, function)


def _plain_count(raw: str) -> str:
    """The integer that holds any raw number of a point without a scale, and numbers beyond."""
    return {"i32": "i64", "u32": "i64", "i64": "i64", "u64": "i128"}.get(raw, "i32")


def _parameter(type_: str, name: str, *, used: bool) -> str:
    return "(): ()" if type_ == "()" else f"{'with' if used else '_'}: Self::{name}"


def _plain_value(point: Point, raw: str, scope: Scope) -> str:
    if point.enum is not None and point.form == "enum":
        carried = scope.enums[point.enum.name]
        return f"{_value_type(point, raw)}::from({'raw' if carried == raw else f'{carried}::from(raw)'})"
    return f"{_value_type(point, raw)}::from(raw)" if point.form == "flags" else "raw"


def _plain_raw(point: Point, raw: str, scope: Scope) -> str:
    """A value as the raw number; an enum that several raw types share may carry what this one cannot hold."""
    if point.enum is not None and point.form == "enum":
        carried = scope.enums[point.enum.name]
        return f"{raw}::from(value)" if carried == raw else _held(f"{carried}::from(value)", closed=point.enum.closed)
    return f"{raw}::from(value)" if point.form == "flags" else "value"


def _held(number: str, *, closed: bool) -> str:
    return f"arithmetic::held::<Self>({number}, runtime::Error::{'UnknownValue' if closed else 'OutOfRange'})?"


def _write(point: Point, raw: str, low: int, high: int, scope: Scope) -> WriteView:
    arguments = _struct(point, point.arguments, "")
    rule = fixed(point)
    kind, count_type, within, scaled, ranges = "plain", _plain_count(raw), "", "", ()
    if point.form == "float":
        kind, value, count_type, count, ranges = "float", f"f{point.width}_bits", "", "", _float_ranges(point)
    elif point.form == "scaled" and rule is not None:
        path = count_path(rule, point.decimals, raw, low, high)
        kind, value, count_type, (scaled, count) = "scaled", encode_float(rule), path.type, path.encode
        within = f"{path.low}, {path.high}"
    elif point.form == "scaled":
        kind, count_type, count = "run_time", "i64", f"encode_count::<{integer(10**point.decimals)}>"
        value = "with.factors()" if point.scale_arguments != point.arguments else "with"
    else:
        closed = point.enum is not None and point.form == "enum" and point.enum.closed
        value = _plain_raw(point, raw, scope)
        count = "arithmetic::bit(count)?" if raw == "bool" else _held("count", closed=closed)
    place = next((one for one in point.places if one.purpose == "write"), point.places[0])
    elsewhere = place is not point.places[0] and place.addresses
    return WriteView(
        arguments=arguments,
        parameter=_parameter(arguments, "With", used=True),
        passed="with" if arguments != "()" else "()",
        check=_check(point, raw, arguments, scope),
        kind=kind,
        value=value,
        ranges=ranges,
        count_type=count_type,
        within=within,
        scaled=scaled,
        count=count,
        function=_write_function(point, place.function if place.purpose == "write" else None, scope),
        address=f"0x{min(place.addresses):04X}" if elsewhere else "",
    )


def _float_ranges(point: Point) -> tuple[str, ...]:
    """Conditions of which one holds if a value is within the limits; none if there are none."""
    ends = [(float_literal(float(low)), float_literal(float(high))) for low, high in point.allowed.units]
    return tuple(f"({low}..={high}).contains(&value)" for low, high in ends)


def _check(point: Point, raw: str, arguments: str, scope: Scope) -> CheckView:
    closed = point.enum is not None and point.form == "enum" and point.enum.closed
    report = "listed" if closed else "allowed"
    if point.limit_arguments:
        limits, conditions = limit_views(point, scope.points)
        return CheckView(report, "raw", _parameter(arguments, "With", used=True), conditions, limits)
    parameter = _parameter(arguments, "With", used=False)
    numbers = [(one.low, one.high) for one in point.allowed.intervals if isinstance(one.low, int) and isinstance(one.high, int)]
    numbers = numbers or [(point.least, point.greatest)]
    least, greatest = type_range(raw)
    if point.form == "float" or any(low <= least and greatest <= high for low, high in _merged(numbers)):
        return CheckView(report, "_", parameter, (), ())
    return CheckView(report, "raw", parameter, patterns(numbers, raw), ())


def _specials(point: Point, raw: str) -> tuple[SpecialView, ...]:
    views = []
    for one in point.specials:
        single = one.low == one.high
        literal = raw_literal(one.low, raw) if single else f"{raw_literal(one.low, raw)}..={raw_literal(one.high, raw)}"
        type_ = raw if single else f"core::ops::RangeInclusive<{raw}>"
        views.append(SpecialView(sentence(one.title), one.name.upper(), one.name, type_, literal, single))
    return tuple(views)


def _function(point: Point, function: int | None, usual: Mapping[str, int]) -> str:
    return "" if function is None or function == usual.get(point.places[0].space) else str(function)


def _write_function(point: Point, function: int | None, scope: Scope) -> str:
    """The function that writes the point, where it is not the usual one: named by the manual, or the only one there is."""
    one, many = {"coil": (5, 15), "holding": (6, 16)}.get(point.places[0].space, (0, 0))
    usual = one if point.words == 1 else many
    if function is None:
        function = many if usual not in scope.functions and many in scope.functions else usual
    return "" if function == usual else str(function)

