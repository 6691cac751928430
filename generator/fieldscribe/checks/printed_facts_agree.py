"""What the manual prints redundantly about a point agrees with its facts, or an erratum says why not."""

from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

from fieldscribe import wording
from fieldscribe.arithmetic.exact import half_away
from fieldscribe.arithmetic.words import number_of
from fieldscribe.diagnostics import Span
from fieldscribe.language.formula.syntax import FormulaError
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import integer_in
from fieldscribe.model import Allowed, Point
from fieldscribe.resolve.addresses import WIRE
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.bounds import as_text, constant_range
from fieldscribe.resolve.errata import PrintedFact, same
from fieldscribe.resolve.points import ResolvedPoint
from fieldscribe.resolve.special_codes import without_codes
from fieldscribe.resolve.values import WORD_BITS, integer, number
from fieldscribe.wording.numbers import fixed_rule, number_text

_LOW, _HIGH, _WRITE = "low_", "high_", "write_"
_FLAG_WORDS = {"mask": "mask", "bit": "bit", "active": "active value"}
_NEEDS = {
    "range": {"range", "type"},
    "range_in_units": {"range", "type", "scale"},
    "resolution": {"scale", "unit"},
    "choices": {"enum", "range"},
    "pairs": {"type", "scale", "unit"},
}
"""The keys of the facts with which each printed key is compared; any other is compared with the address."""


def check(analysis: Analysis) -> None:
    """Report printed numbers, ranges, resolutions and counts that disagree with the point."""
    for resolved in analysis.resolved:
        layer = resolved.facts.layer("printed")
        if layer is not None:
            printed: Map = layer["printed"]
            doubtful = _doubtful(printed, resolved.point)
            if doubtful:
                _printed(analysis, resolved, printed, doubtful)
        if resolved.point.shape.flags:
            _flags(analysis, resolved)


def _doubtful(printed: Map, point: Point) -> list[str]:
    """Return the printed keys that are not simply equal to the numbers of the point."""
    references, addresses = point.place.references, point.place.addresses
    wire = _first_word(point, addresses) if addresses else None
    return [
        key
        for key, value in printed.items()
        if key in _NEEDS or not _is_plainly(value, wire if key == WIRE else references.get(key))
    ]


def _is_plainly(value: object, number: int | str | None) -> bool:
    """Return True if everything printed is this number in a usual notation."""
    if not isinstance(number, int):
        return False
    hexadecimal = f"{number:04X}h"
    for printed in value if isinstance(value, Seq) else (value,):
        if printed not in (number, hexadecimal) and integer_in(printed) != number:
            return False
    return True


def _printed(analysis: Analysis, resolved: ResolvedPoint, printed: Map, keys: list[str]) -> None:
    numbers: Mapping[str, int] | None = None
    facts = resolved.facts
    unknown_scale = facts.layer("scale") is not None and facts.get("scale") is None
    for key in keys:
        value, span = printed[key], printed.span(key)
        if _NEEDS.get(key, {"at", "space", "type"}) & facts.failed:
            continue
        if key in ("range_in_units", "resolution", "pairs") and unknown_scale:
            continue  # the scale is not known
        if key in ("range", "range_in_units"):
            _range(analysis, resolved, key, value, span)
        elif key == "resolution":
            _resolution(analysis, resolved, value, span)
        elif key == "pairs":
            _pairs(analysis, resolved, value)
        elif key == "choices":
            _choices(analysis, resolved, value, span)
        else:
            numbers = _numbers(analysis, resolved) if numbers is None else numbers
            _number(analysis, resolved, key, printed, numbers)


def _numbers(analysis: Analysis, resolved: ResolvedPoint) -> Mapping[str, int]:
    """Return the point's number in every numbering of its group.

    The prefixes `low_` and `high_` mean the words with the low and the high part, `write_` the write address.
    """
    known: dict[str, int] = {}
    for place in resolved.point.places:
        addresses, way = place.addresses, "" if place is resolved.point.place else _WRITE
        words = {way: _first_word(resolved.point, addresses)}
        if len(addresses) > 1:
            words |= {way + _LOW: addresses[-1], way + _HIGH: addresses[0]}
        for prefix, address in words.items():
            numbers = {WIRE: address, **analysis.places.references(resolved.facts, address)}
            known |= {prefix + name: number for name, number in numbers.items()}
    return known


def _first_word(point: Point, addresses: tuple[int, ...]) -> int:
    """Return the address that manuals print: the first word of a text, else the lowest word."""
    return addresses[0] if point.shape.text is not None else min(addresses)


def _number(analysis: Analysis, resolved: ResolvedPoint, key: str, printed: Map, numbers: Mapping[str, int]) -> None:
    right = numbers.get(key)
    point = resolved.point
    if right is None:
        numbering = resolved.facts.group.get("numbering", ())
        if point.addresses and key not in (*numbering, *getattr(numbering, "broken", ())):
            message = f"`{key}` names no numbering of this point"
            hint = f"known here: {', '.join((*numbers, *_NEEDS))}; others follow from what the group says, as in "
            hint += "`numbering: {modicon: wire + 1}`"
            analysis.report.error("unknown-key", message, printed.key_span(key), hint)
        return
    for printed_number, span in _each(printed[key], printed.span(key)):
        if number(printed_number, span, analysis.report) not in (None, right):
            fact = f"{key.replace('_', ' ')} {printed_number}"
            message = f"{fact} is printed for `{point.name}`, the address says {right} ({right:04X}h)"
            analysis.report_printed(PrintedFact(point.name, key, printed_number, right, span, message))


def _each(value: Any, span: Span) -> Iterator[tuple[Any, Span]]:
    if isinstance(value, Seq):
        for index, item in enumerate(value):
            yield item, value.span(index)
    else:
        yield value, span


def _range(analysis: Analysis, resolved: ResolvedPoint, key: str, value: Any, span: Span) -> None:
    point, facts = resolved.point, resolved.facts
    in_units = key == "range_in_units" or point.info.floating

    def agrees(printed: Any) -> bool | None:
        if point.info.floating:
            return _same_units(point, printed)
        intervals = analysis.ranges.intervals(facts, printed, span, in_units, printed=True)
        return None if intervals is None else _same_range(point.allowed, without_codes(intervals, point.specials))

    if agrees(value) is not False:
        return
    taken = wording.range_text(point) if in_units else wording.raw_range_text(point)
    taken = taken or as_text(facts.get(key) or facts.get("range") or "another")
    what = "range" if point.info.floating else key.replace("_", " ")
    message = f"the {what} {as_text(value)} is printed for `{point.name}`, the fact is {taken}"
    key = "range_in_units" if in_units else key
    fact = PrintedFact(point.name, key, value, taken, span, message, lambda stated: bool(agrees(stated)))
    analysis.report_printed(fact)


def _same_units(point: Point, printed: Any) -> bool:
    """Return True if the printed limits of a floating-point number agree, or name other points."""
    try:
        return constant_range(as_text(printed)) in (None, point.allowed.units)
    except FormulaError:
        return False


def _same_range(taken: Allowed, printed: Allowed) -> bool:
    """Return True if the intervals are equal. Fixed ones need not be printed where other points set limits."""
    moving = taken.intervals[len(taken.fixed) :]  # these follow the fixed ones
    if moving != printed.intervals[len(printed.fixed) :]:
        return False
    return taken.fixed == printed.fixed or (bool(moving) and not printed.fixed)


def _resolution(analysis: Analysis, resolved: ResolvedPoint, value: Any, span: Span) -> None:
    point = resolved.point
    text, _, unit = str(value).strip().partition(" ")
    step, printed_step = _step(point), number(text, span, analysis.report)
    if step is None or printed_step is None:
        return
    right = f"{number_text(step)} {point.unit.symbol}".strip()
    if printed_step != step or (unit.strip() and not same(unit, point.unit.symbol)):
        message = f"the resolution {value} is printed for `{point.name}`, the scale says {right}"
        analysis.report_printed(PrintedFact(point.name, "resolution", value, right, span, message))


def _pairs(analysis: Analysis, resolved: ResolvedPoint, pairs: Map) -> None:
    """Compare printed pairs of a raw number and a value: the scale must turn each into the other."""
    point = resolved.point
    rule = fixed_rule(point)
    if rule is None or point.info.floating:
        why = "it is a floating-point number" if point.info.floating else "its scale is not fixed"
        message = f"the pairs of `{point.name}` cannot be checked: {why}"
        analysis.report.error("bad-formula", message, pairs.span(), "leave them out, or put them into a `note`")
        return
    for key, value in pairs.items():
        raw = integer(key, pairs.key_span(key), analysis.report)
        printed_value = number(value, pairs.span(key), analysis.report)
        if raw is None or printed_value is None:
            continue
        if not -(1 << point.width >> 1) <= raw < 1 << point.width:
            message = f"{key} does not fit into the {point.width} bits of `{point.name}`"
            hint = "correct the raw number, or the type"
            analysis.report.error("range-outside-type", message, pairs.key_span(key), hint)
            continue
        if raw > point.greatest:
            raw = number_of(raw, point.width, signed=True)
        exact = rule.result(raw)
        if half_away(rule.argument(printed_value)) != raw and abs(exact - printed_value) > _half_digit(value):
            pair, right = f"{key} {value}", f"{key} {number_text(exact)}"
            message = f"the pair {pair} is printed for `{point.name}`, the scale says {number_text(exact)}"
            analysis.report_printed(PrintedFact(point.name, "pairs", pair, right, pairs.span(key), message))


def _half_digit(value: Any) -> Fraction:
    """Return half a unit of the last printed digit: the largest rounding error."""
    decimals = len(str(value).partition(".")[2])
    return Fraction(1, 2 * 10**decimals)


def _step(point: Point) -> Fraction | None:
    if point.info.floating:
        return None
    if point.scale is None:
        return Fraction(1)
    return None if point.fixed_scale is None else abs(1 / point.fixed_scale.ratio)


def _flags(analysis: Analysis, resolved: ResolvedPoint) -> None:
    """Compare the masks and bit numbers printed for flags, which count in the whole word."""
    point, raw = resolved.point, resolved.facts.get("flags")
    first = point.bits[1] if point.bits else 0
    numbers = resolved.facts.bit_numbers(WORD_BITS if point.bits else point.width)
    by_name = {flag.name: flag for flag in point.flags}
    for value in raw.values():
        printed = value.get("printed") if isinstance(value, Map) else None
        flag = by_name.get(value["name"]) if printed is not None else None
        if flag is None or printed is None:
            continue
        low = flag.low + first
        mask = ((1 << flag.width) - 1) << low
        with_fixed = mask | (point.fixed.bits if point.fixed is not None else 0)
        for key, right, other in (
            ("mask", mask, with_fixed),
            ("bit", numbers.number(low), numbers.number(low + flag.width - 1)),
            ("active", flag.active, flag.active),
        ):
            if key not in printed:
                continue
            span = printed.span(key)
            printed_number = integer(printed[key], span, analysis.report)
            if printed_number not in (None, right, other):
                as_printed, taken = (f"{raw:04X}h" if key == "mask" else str(raw) for raw in (printed_number, right))
                message = f"the {_FLAG_WORDS[key]} {as_printed} is printed for `{flag.name}`, the fact is {taken}"
                analysis.report_printed(PrintedFact(point.name, key, as_printed, taken, span, message, flag=flag.name))


def _choices(analysis: Analysis, resolved: ResolvedPoint, value: int, span: Span) -> None:
    point = resolved.point
    if point.enum is not None:
        right = len(point.enum.entries)
    else:
        ends = [(interval.low, interval.high) for interval in point.allowed.intervals if point.allowed.listed]
        right = sum(high - low + 1 for low, high in ends if isinstance(low, int) and isinstance(high, int))
    if value != right:
        message = f"{value} choices are printed for `{point.name}`, the facts have {right}"
        analysis.report_printed(PrintedFact(point.name, "choices", value, right, span, message))
