"""The values of the facts of a point: as they are exported (scales and limits last), and as `diff` compares them."""

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

from fieldscribe.conditions import Comparison, Condition
from fieldscribe.facts.table import API, COMPATIBLE, DOCS, WIRE, Context, Exported
from fieldscribe.families import family
from fieldscribe.model import (
    Allowed,
    Bound,
    Entry,
    Enum,
    Factor,
    Flag,
    Limit,
    Linear,
    Place,
    Point,
    Source,
    Variant,
    item_of,
    type_info,
)
from fieldscribe.wording.numbers import fixed_rule, number_text, value_multiple

_MOST_REPEATS = 8
_MOST_DIGITS = 1000
_MOST_VALUES = 4096
"""Longer lists of single numbers are exported as ranges only."""


# The exported values.


def source_value(thing: Any, _: Context) -> dict[str, object] | None:
    """Return the place in the manual of a thing."""
    source: Source = thing.source
    return {"document": source.document, "section": source.section, "page": source.page, "line": source.line}


def coding_of(point: Point) -> str:
    """Return how the bits hold the raw number, or the parts of a date; empty if as usual."""
    return "bcd" if point.text is not None and point.text.bcd else point.coding


def default_raw(point: Point, _: Context) -> int | str | None:
    """Return the default as a raw number (f32, f64: as a value); null if its raw number depends on other points."""
    if point.info.floating:
        return None if point.default is None else number_text(point.default)
    return point.default_raw


def default_value(point: Point, _: Context) -> str | None:
    """Return the default in the unit if its raw number depends on other points."""
    known = point.default is None or point.default_raw is not None or point.info.floating
    return None if known or point.default is None else number_text(point.default)


def condition(condition: Condition) -> dict[str, object]:
    """Return a condition as data: any of its clauses, each with all its comparisons."""
    return {"any": [{"all": [_comparison(comparison) for comparison in clause]} for clause in condition.clauses]}


def _comparison(comparison: Comparison) -> dict[str, object]:
    than = list(comparison.than) if comparison.test == "in" else comparison.than[0]
    return {"of": comparison.of, "is": comparison.test, "than": than}


def places(point: Point, context: Context) -> list[dict[str, object]]:
    """Return the places where it is read and written, with their functions; one place if they are the same."""
    tasks_of = getattr(family(context.device.family).part("bus_facts"), "tasks", None)
    tasks: Sequence[tuple[str, int]] = tasks_of(context.device.bus, point) if tasks_of else ()
    purposes = ("write",) if point.access == "w" else ("read", "write")
    usual = [(purpose, place, None) for purpose, place in zip(purposes, point.places, strict=False)]
    return [
        {"for": purpose, "space": point.space, "address": min(place.addresses), "function": function}
        for purpose, place, function in [(purpose, point.place, task) for purpose, task in tasks] or usual
    ]


def signal(point: Point, _: Context) -> dict[str, object] | None:
    """Return the place of a signal in its message; None for other points."""
    place = point.place
    return None if place.bit is None else {"bit": place.bit, "low_first": place.low_first}


def place(place: Place) -> dict[str, object]:
    """Return the addresses of a place and the numbers that the manual prints for it."""
    return {"addresses": list(place.addresses), "references": dict(place.references)}


def raw(point: Point, _: Context) -> dict[str, object]:
    """Return the raw numbers that may be written; for f32, f64 and points of unknown scale, the values."""
    allowed = point.allowed
    if point.info.floating or allowed.units:
        return {"ranges": [[number_text(low), number_text(high)] for low, high in allowed.units], "values": None}
    ranges = [
        [bound_of(interval.low, True, point), bound_of(interval.high, False, point)] for interval in allowed.intervals
    ]
    return {"ranges": ranges, "values": listed_values(allowed) if allowed.listed else None}


def listed_values(allowed: Allowed) -> list[int] | None:
    """Return the numbers that the author listed one by one."""
    spans = [(interval.low, interval.high) for interval in allowed.intervals]
    fixed = [(low, high) for low, high in spans if isinstance(low, int) and isinstance(high, int)]
    if len(fixed) < len(spans) or sum(high - low + 1 for low, high in fixed) > _MOST_VALUES:
        return None
    return [number for low, high in fixed for number in range(low, high + 1)]


def repeat(point: Point, _: Context) -> str | None:
    """Return the name of the row that this point was expanded from: its own name without set and index."""
    name = point.name
    for word, number in (("index", point.index), ("set", point.set)):
        name = name.removesuffix(f"_{word}_{number}")
    return None if name == point.name else name


def entries_of(enum: Enum) -> dict[str, Entry]:
    """Return the named numbers of an enum by number."""
    return {str(entry.raw): entry for entry in enum.entries}


def flag_values(flag: Flag, _: Context) -> Mapping[str, Entry | Flag]:
    """Return the named numbers of a flag; for a single bit without any, the number that makes it true."""
    if not flag.values and flag.width == 1:
        return {str(flag.active): flag}
    return {str(entry.raw): entry for entry in flag.values}


# What `diff` compares where that is not the exported value, and how grave a difference is.


def items(device: Exported) -> Iterator[Exported]:
    """Yield the points under their names in generated code, which differ between variants."""
    for point in device["points"]:
        yield point if point["variant"] is None else _with_names_of_variant(point)


def _with_names_of_variant(point: Exported) -> Exported:
    axis, _, value = point["variant"].partition("=")
    name, *old_names = (item_of(name, Variant(axis, value)) for name in (point["name"], *point["was"]))
    return {**point, "name": name, "was": old_names}


def grown(old: Any, new: Any) -> str:
    """Return the class of a changed list: more items are compatible."""
    return API if set(old) - set(new) else COMPATIBLE


def access_class(old: str, new: str) -> str:
    """Return the class of a changed access: more access is compatible."""
    kept = old == "none" or set(old) <= set(new)
    return COMPATIBLE if kept else API


def address_class(old: Any, _: Any) -> str:
    """Return the class of a changed address: nobody relied on one that was unknown."""
    return COMPATIBLE if old is None else WIRE


def type_class(old: str | None, _: str | None) -> str:
    """Return the class of a changed type: a point that gains one is no longer reached only raw."""
    return API if old is None else WIRE


def generated_class(old: bool, _: bool) -> str:
    """Return the class of a change of `generated`: code that disappears breaks others."""
    return API if old else COMPATIBLE


_KNOWN_WITHOUT_CODE = frozenset(
    {"group", "space", "telegram", "address", "order of words", "write address", "index", "variant", "type", "length"}
    | {"access", "generated", "reserved", "old names"}
)
"""Facts that code knows even of a point that is only documented."""


def class_in_code(old: Exported, new: Exported, label: str, weight: str) -> str:
    """Return the class of a changed fact of a point; one that was only documented breaks no code."""
    if old["generated"] or label in _KNOWN_WITHOUT_CODE or weight == DOCS:
        return weight
    return COMPATIBLE if new["generated"] else DOCS


def address_view(point: Exported) -> object:
    """Return the lowest address; all addresses if they are not consecutive."""
    if point["signal"] is not None:
        return point["signal"]["bit"]
    addresses = sorted(point["addresses"])
    if addresses and addresses[-1] - addresses[0] < len(addresses):
        return addresses[0]
    return addresses or None


def word_order_view(point: Exported) -> object:
    """Return the order of several words; None if it is the usual one."""
    addresses = point["addresses"]
    if addresses == sorted(addresses):
        return None
    return "low first" if addresses[::-1] == sorted(addresses) else [word - min(addresses) for word in addresses]


def byte_order_view(point: Exported) -> object:
    """Return the order of the bytes of a signal; None if it is the usual one."""
    return "low first" if point["signal"] is not None and point["signal"]["low_first"] else None


def base_view(place: Exported) -> object:
    """Return the distance of each printed number from the address, by numbering."""
    first = min(place["addresses"], default=0)
    return {
        numbering: number - first if isinstance(number, int) else number
        for numbering, number in place["references"].items()
    }


def written_view(point: Exported) -> object:
    """Return where else the point is written, with printed numbers as distances from the address."""
    return point["written"] and {**point["written"], "references": base_view(point["written"])}


def length_view(point: Exported) -> object:
    """Return how many words a text or a point without a type has; for others the type gives it."""
    return point["words"] if point["type"] in (None, "text", "bytes") else None


def range_view(point: Exported) -> object:
    """Return the intervals that may be written; None for all that the bits hold."""
    ranges, wire_type = point["raw"]["ranges"], point["type"]
    if wire_type is None:
        return None if ranges == [[0, (1 << 16 * point["words"]) - 1]] else ranges
    info, bits = type_info(wire_type), point["bits"]
    width = info.bits if bits is None else abs(bits[0] - bits[1]) + 1
    least, greatest = (-(1 << (width - 1)), (1 << (width - 1)) - 1) if info.signed else (0, (1 << width) - 1)
    return None if ranges == [[least, greatest]] else ranges


def entry_parts(point: Exported) -> Iterator[Exported]:
    """Yield the named numbers of a point, or of each of its digits."""
    named = point["enum"] if point["digits"] is None else point["digits"]["enum"]
    return ({**entry, "raw": int(raw)} for raw, entry in (named or {}).items())


def flag_value_parts(flag: Exported) -> Iterator[Exported]:
    """Yield the named numbers of a flag, except one that only repeats the name of the flag."""
    for raw, value in flag["values"].items():
        if len(flag["values"]) > 1 or value["name"] != flag["name"]:
            yield {**value, "raw": int(raw)}


def scale_of(point: Point, by_name: Mapping[str, Point]) -> list[dict[str, object]] | None:
    """Return the cases of a scale: `raw = value * num / den + offset`, `uses` beside `num`."""
    if point.scale is None:
        return None
    cases: list[dict[str, object]] = []
    for case in point.scale:
        ratio, uses = rule_of(case.rule, by_name)
        cases.append(
            {
                "when": None if case.point is None else {"point": case.point, "raw": case.raw},
                "num": str(ratio.numerator),
                "den": str(ratio.denominator),
                "offset": str(case.rule.offset),
                "uses": uses,
            }
        )
    return cases


def rule_of(rule: Linear, by_name: Mapping[str, Point]) -> tuple[Fraction, list[dict[str, object]]]:
    """Return the constant of a rule times those of its factors, and its uses."""
    ratio, uses = rule.ratio, []
    for factor in rule.factors:
        constant, used = use_of(factor, by_name[factor.point])
        ratio *= constant
        uses += used
    return ratio, uses


def use_of(factor: Factor, point: Point) -> tuple[Fraction, list[dict[str, object]]]:
    """Return a run-time factor as a constant times `point`'s raw number or value.

    `raw * slope + intercept` becomes the raw number, a multiple of it or of the value, or stays as it is.
    """
    if factor.ten_to:
        return _power_of_ten(factor, point)
    if point.info.floating:
        return Fraction(1), [_use(factor, "value", "power", factor.power)]
    if factor.slope == 1 and factor.intercept == 0:
        return Fraction(1), [_use(factor, "raw", "power", factor.power)]
    multiple = value_multiple(factor, point)
    if multiple:
        return multiple**factor.power, [_use(factor, "value", "power", factor.power)]
    if factor.intercept == 0:
        return Fraction(factor.slope) ** factor.power, [_use(factor, "raw", "power", factor.power)]
    return Fraction(1), [_whole_use(factor, "power")]


def bound_of(bound: Bound, is_low: bool, point: Point) -> int | str:
    """Return the end of a range: a number, or an exact expression in the raw numbers of other points."""
    if isinstance(bound, int):
        return bound
    text = _limit(bound.rule)
    fixed = bound.outermost(low=is_low)
    if fixed != (point.least if is_low else point.greatest):
        text = f"{'max' if is_low else 'min'}({fixed}, {text})"
    return f"{fixed} if {_lifted(bound)} else {text}" if bound.unless else text


def _power_of_ten(factor: Factor, point: Point) -> tuple[Fraction, list[dict[str, object]]]:
    """Return ten to `raw * slope + intercept` as a constant and powers of the raw number or of the value."""
    rule = fixed_rule(point)
    if factor.slope not in (1, -1) and rule is not None and Fraction(rule.factor, rule.divisor) == factor.slope:
        rest = factor.intercept - Fraction(rule.add, rule.divisor)
        if rest.denominator == 1 and abs(rest) <= _MOST_DIGITS:
            return _ten_to(factor, int(rest)), [_use(factor, "value", "ten_to", factor.power)]
    if not 1 <= abs(factor.slope) <= _MOST_REPEATS or abs(factor.intercept) > _MOST_DIGITS:
        return Fraction(1), [_whole_use(factor, "ten_to")]
    sign = 1 if factor.slope > 0 else -1
    return _ten_to(factor, factor.intercept), [_use(factor, "raw", "ten_to", sign * factor.power)] * abs(factor.slope)


def _ten_to(factor: Factor, exponent: int) -> Fraction:
    return Fraction(10) ** (exponent * factor.power)


def _use(factor: Factor, part: str, kind: str, sign: int) -> dict[str, object]:
    return {"point": factor.point, "part": part, kind: sign}


def _whole_use(factor: Factor, kind: str) -> dict[str, object]:
    """Return a factor with slope and intercept, for one that is not a plain multiple."""
    return {"point": factor.point, "part": "raw", "times": factor.slope, "plus": factor.intercept, kind: factor.power}


def _limit(rule: Linear) -> str:
    """Return the rule applied to 1, as an arithmetic expression."""
    above = [_factor(factor) for factor in rule.factors if factor.power > 0]
    below = [_factor(factor) for factor in rule.factors if factor.power < 0]
    if rule.ratio.numerator != 1 or not above:
        above.append(str(rule.ratio.numerator))
    if rule.ratio.denominator != 1:
        below.append(str(rule.ratio.denominator))
    text = " * ".join(above) + "".join(f" / {factor}" for factor in below)
    if rule.offset:
        text += f" {'+' if rule.offset > 0 else '-'} {abs(rule.offset.numerator)}"
        text += f" / {rule.offset.denominator}" if rule.offset.denominator != 1 else ""
    return text


def _factor(factor: Factor) -> str:
    text = f"{factor.point}.raw"
    if factor.slope != 1:
        text = f"{text} * {factor.slope}"
    if factor.intercept:
        text = f"{text} {'+' if factor.intercept > 0 else '-'} {abs(factor.intercept)}"
    plain = factor.slope == 1 and not factor.intercept
    if factor.ten_to:
        return f"10 ** {text}" if plain else f"10 ** ({text})"
    return text if plain else f"({text})"


def _lifted(limit: Limit) -> str:
    """Return the condition under which the limit does not apply."""
    cases = (_is_code(f"{name}.raw", *band) for name, codes in limit.unless for band in codes)
    return " or ".join(cases)


def _is_code(raw: str, low: int, high: int) -> str:
    return f"{raw} == {low}" if low == high else f"{low} <= {raw} <= {high}"
