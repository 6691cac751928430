"""C expressions for the check of raw numbers, and for scales and limits whose factors are read at run time."""

from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from math import prod
from operator import attrgetter

from fieldscribe.arithmetic.words import INT64, ends_without
from fieldscribe.lowered import Operand, Rule
from fieldscribe.model import Interval, Limit, Point
from fieldscribe.targets.c.scales import linear
from fieldscribe.targets.c.scope import HeaderScope, PointFields
from fieldscribe.targets.c.syntax import Function, bare, float_order, function, hexadecimal, raw_type, signed, unsigned

_TABLE = 3
"""From this many ranges on a table is used; fewer are tested one by one."""


def known(point: Point, status: str) -> str:
    """Return the status expression, changed so that a closed enum reports an unknown value for a refused number."""
    closed = point.enum is not None and point.enum.closed
    return f"fieldscribe_known({status})" if closed and status != "FIELDSCRIBE_OK" else status


def refused(point: Point) -> str:
    """Return the status for a number that may not be written."""
    return f"FIELDSCRIBE_{'UNKNOWN_VALUE' if point.enum is not None and point.enum.closed else 'OUT_OF_RANGE'}"


def check(point: Point, fields: PointFields, scope: HeaderScope) -> str:
    """Return the status of writing `raw`, which is no special code."""
    if point.info.floating:
        return _check_of_pattern(point)
    if point.digits is not None:
        return f"fieldscribe_check_digits(raw, {digits_arguments(point, scope)})"
    status = known(point, _status(point, fields, scope))
    if point.fixed is None or point.bits is not None:
        return status
    bits = f"uint{max(32, point.info.bits)}_t"
    mask, constant = (hexadecimal(number, point.info.bits >> 2) for number in (point.fixed.mask, point.fixed.bits))
    return f"((({bits})raw & {mask}) == {constant}) ? ({status}) : {refused(point)}"


def digits_arguments(point: Point, scope: HeaderScope) -> str:
    """Return the number of digits and their names as arguments for the runtime."""
    digits, enum = point.digits, point.named_numbers
    assert digits
    assert enum
    names = f"{scope.prefix}_{enum.name}_names"
    return f"{digits.count}U, {names}, FIELDSCRIBE_COUNT({names})"


def _check_of_pattern(point: Point) -> str:
    """Return the status of writing a bit pattern, whose number must lie in one of the point's intervals."""
    bits = point.info.bits
    infinity = 0x7F80_0000 if bits == 32 else 0x7FF0 << 48
    spans = [(float_order(float(low), bits), float_order(float(high), bits)) for low, high in point.allowed.units]
    spans = spans or [(1 - infinity, infinity - 1)]
    return either([f"fieldscribe_check_f{bits}(raw, {bare(low)}, {bare(high)})" for low, high in spans])


def _checked(point: Point, fields: PointFields, low: int, high: int) -> str:
    """Return the status of `raw` between two limits."""
    if point.type == "u64":
        return f"fieldscribe_check_u64(raw, {unsigned(low)}, {unsigned(high)})"
    wide = "_wide" if point.info.bits > 16 else ""
    return f"fieldscribe_check{wide}({'raw ? 1 : 0' if point.type == 'bit' else 'raw'}, {fields.low}, {fields.high})"


def _status(point: Point, fields: PointFields, scope: HeaderScope) -> str:
    intervals = point.allowed.intervals
    if point.allowed.moves:
        return either([_between(interval, point, scope) for interval in intervals])
    if len(intervals) == 1:
        low, high = point.allowed.fixed[0]
        least, greatest = ends_without(point.specials, *point.held)  # these are tested first
        return "FIELDSCRIBE_OK" if low <= least and high >= greatest else _checked(point, fields, low, high)
    table = ranges_table(point, scope)
    if table:
        return f"FIELDSCRIBE_CHECK_RANGES(raw, {table})"
    test = is_in(point, point.allowed.fixed)
    return f"{bracketed(test)} ? FIELDSCRIBE_OK : FIELDSCRIBE_OUT_OF_RANGE" if test else "FIELDSCRIBE_OK"


def is_in(point: Point, bands: Iterable[tuple[int, int]]) -> str:
    """Return a test that `raw` lies in one of these bands; empty if every number of the type does, or without bands."""
    literal = bare if point.info.signed else unsigned
    tests = [interval_test("raw", *band, point.held, literal) for band in bands]
    if len(tests) < 2:
        return tests[0] if tests else ""
    if not all(tests):
        return ""
    return " || ".join(f"({test})" if " && " in test else test for test in tests)


def either(statuses: list[str]) -> str:
    """Return the status of a number that may satisfy any of several tests."""
    first, *others = statuses
    return f"fieldscribe_either({first}, {either(others)})" if others else first


def has_ranges_table(point: Point) -> bool:
    """Return True if the point has enough ranges for a table."""
    many = len(point.allowed.intervals) >= _TABLE and not point.allowed.moves
    return many and point.writable and point.info.bits <= 16


def ranges_table(point: Point, scope: HeaderScope) -> str:
    """Return the name of the table of a point's ranges, shared by points with equal ranges; empty if it needs none."""
    return scope.named_after_first(point.item, "ranges", repr(point.allowed.fixed)) if has_ranges_table(point) else ""


def _between(interval: Interval, point: Point, scope: HeaderScope) -> str:
    """Return a test that the number lies in an interval, whose limits may depend on other points.

    Limits are signed; an unsigned number above their type is above every limit.
    """
    raw = "(raw > (uint64_t)INT64_MAX) ? INT64_MAX : (int64_t)raw" if point.type == "u64" else "raw"
    ends = [(end, end is interval.low) for end in (interval.low, interval.high)]
    low, high = (
        _sure_limit(end, scope, is_low=is_low) if isinstance(end, Limit) else bare(end) for end, is_low in ends
    )
    if low and high:
        return f"fieldscribe_check_wide({raw}, {low}, {high})"
    low, high = (
        limit(end, scope, is_low=is_low) if isinstance(end, Limit) else f"fieldscribe_whole_of({bare(end)})"
        for end, is_low in ends
    )
    return f"fieldscribe_between({raw}, {low}, {high})"


def interval_test(name: str, low: int, high: int, bounds: tuple[int, int], literal: Callable[[int], str]) -> str:
    """Return a test of one interval, without comparisons that are always true; empty if all of the type is inside."""
    if low == high:
        return f"({name} == {literal(low)})"
    parts = [f"({name} >= {literal(low)})"] if low > bounds[0] else []
    return " && ".join([*parts, f"({name} <= {literal(high)})"] if high < bounds[1] else parts)


def bracketed(test: str) -> str:
    """Return a test in brackets if it needs them in front of a question mark."""
    return test if test.startswith("(") and " && " not in test and " || " not in test else f"({test})"


def rule_function(point: Point, scope: HeaderScope) -> Function:
    """Return the function that gives the rule of a point; points whose rule needs one point of a type share it."""
    names = point.scale_arguments
    parameters = scope.parameters(point, names)
    if len(names) == 1:
        parameters, scope.spelling = [f"{raw_type(scope.points[names[0]])} other_raw"], "other_raw"
    body = f"return {_rule_of(point, scope)};"
    content = f"({', '.join(parameters)}) {body}"
    name = scope.named_after_first(point.item, "rule", content)
    return function("static inline fieldscribe_rule", name, parameters, body)


def name_shared(points: Sequence[Point], scope: HeaderScope) -> None:
    """Name tables of ranges and rules after the point with the lowest address, wherever it is described."""
    by_rank = attrgetter("rank")
    for point in sorted(filter(has_ranges_table, points), key=by_rank):
        ranges_table(point, scope)
    for point in sorted([point for point in points if point.form == "scaled" and point.scale_arguments], key=by_rank):
        rule_function(point, scope)


def _rule_of(point: Point, scope: HeaderScope) -> str:
    """Return the expression for the rule of a point: its cases, by the raw numbers of other points."""
    rules, depth = "", 0
    for case in point.scale or ():
        lowered = scope.lowered.rule(case.rule)
        rule, codes = _steps(lowered, scope), _codes(lowered, scope)
        if codes:
            rule = f"{codes} ? fieldscribe_no_rule(FIELDSCRIBE_ZERO_FACTOR) : {rule}"
        if case.point is None:
            return f"{rules}{rule}{')' * depth}"
        rule = f"({rule})" if codes else rule
        rules += f"({scope.raw(case.point)} == {bare(case.raw or 0)}) ? {rule} : ("
        depth += 1
    return f"{rules}fieldscribe_no_rule(FIELDSCRIBE_NO_CASE){')' * depth}"


def limit(bound: Limit, scope: HeaderScope, *, is_low: bool) -> str:
    """Return a limit that depends on other points; the outer limit while a special code of one of them lifts it."""
    start, rule = bound.outermost(low=is_low), scope.lowered.rule(bound.rule)
    text = _bare_limit(rule, scope)
    if not _fits(rule) or not _stays_inside(rule, start, is_low=is_low):
        text = f"fieldscribe_no_{'less' if is_low else 'more'}({text}, {bare(start)})"
    tests = [_is_no_code(point, *band, scope) for point, codes in bound.unless for band in codes]
    if not tests:
        return text
    applies = tests[0] if len(tests) == 1 else f"({' && '.join(tests)})"
    return f"{applies} ? {text} : fieldscribe_whole_of({bare(start)})"


def _sure_limit(bound: Limit, scope: HeaderScope, *, is_low: bool) -> str:
    """Return a limit that other points always give, without a division, as a number; empty if it is another."""
    start, rule = bound.outermost(low=is_low), scope.lowered.rule(bound.rule)
    if not _fits(rule) or any(codes for _, codes in bound.unless):
        return ""
    number, divisor = _simple(rule, scope)
    if divisor != "1" or _stays_inside(rule, start, is_low=is_low):
        return number if divisor == "1" else ""
    return f"fieldscribe_{'larger' if is_low else 'smaller'}({number}, {bare(start)})"


def _bare_limit(rule: Rule, scope: HeaderScope) -> str:
    if not _fits(rule):
        floats = any(operand.floating for operand in rule.operands)
        return f"fieldscribe_limit{'_f32' if floats else ''}({_steps(rule, scope, of_limit=True)})"
    top, bottom = _simple(rule, scope)
    return f"fieldscribe_whole_of({top})" if bottom == "1" else f"fieldscribe_limit_ratio({top}, {bottom})"


def _stays_inside(rule: Rule, outermost: int, *, is_low: bool) -> bool:
    """Return True if a computed limit can never lie beyond the outermost limit, so that no test is needed.

    If nothing is negative, the limit is at least 0, and at most what the largest arguments give. Rounded, that does not
    exceed the outermost limit if it lies less than a half above it. Divisors may be so small that no upper bound holds.
    """
    if min(rule.ratio, rule.offset) < 0 or any(operand.ends[0] < 0 for operand in rule.operands):
        return False
    if is_low:
        return outermost <= 0
    if any(operand.over for operand in rule.operands):
        return False
    return 2 * (rule.ratio * prod(operand.ends[1] for operand in rule.operands) + rule.offset) < 2 * outermost + 1


def _is_no_code(point: str, low: int, high: int, scope: HeaderScope) -> str:
    (least, greatest), raw = scope.points[point].held, scope.raw(point)
    if low == high:
        return f"({raw} != {bare(low)})"
    tests = [f"({raw} < {bare(low)})"] if low > least else []
    tests += [f"({raw} > {bare(high)})"] if high < greatest else []
    return f"({' || '.join(tests)})" if len(tests) > 1 else tests[0]


def _steps(rule: Rule, scope: HeaderScope, *, of_limit: bool = False) -> str:
    """Return the expression that builds a rule. A scale refuses every factor of zero, a limit only divisors of zero."""
    ratio, offset = rule.ratio, rule.offset
    floating = any(operand.floating for operand in rule.operands)
    twos = _twos(ratio.numerator) - _twos(ratio.denominator) if floating else 0
    ratio /= Fraction(2) ** twos
    numbers = (ratio.numerator, ratio.denominator, offset.numerator, offset.denominator)
    text = f"fieldscribe_rule_of({', '.join(map(bare, numbers))})"
    for operand in rule.steps:
        if operand.floating:
            over = "true" if operand.over else "false"
            text = f"fieldscribe_rule_f32({text}, {scope.raw(operand.factor.point)}, {over}, {twos})"
            twos = 0
        else:
            text = _step(text, operand, scope, of_limit=of_limit)
    return text


def _twos(number: int) -> int:
    """Return the power of two in an integer other than zero."""
    return (number & -number).bit_length() - 1


def _step(rule: str, operand: Operand, scope: HeaderScope, *, of_limit: bool) -> str:
    """Return the rule with another factor."""
    number, raw = _number(operand, scope), scope.raw(operand.factor.point)
    if not operand.factor.ten_to:
        how = "over" if operand.over else "scaled" if of_limit else "times"
        return _within(f"fieldscribe_rule_{how}({rule}, {number})", operand, raw)
    return f"fieldscribe_rule_ten_to({_within(rule, operand, raw)}, {'-' if operand.over else ''}{number})"


def _within(rule: str, operand: Operand, raw: str) -> str:
    """Return the rule, which overflows while the raw number of the operand's point is outside its limits."""
    (low, high), (least, greatest) = operand.within or operand.held, operand.held
    if low <= least and high >= greatest:
        return rule
    return f"fieldscribe_rule_within({rule}, (int64_t){raw}, {bare(low)}, {bare(high)})"


def _codes(rule: Rule, scope: HeaderScope) -> str:
    """Return a test that the point of some factor holds a special code; empty if none can."""
    tests = [interval_test(scope.raw(name), *band, scope.points[name].held, bare) for name, band in rule.coded]
    return f"({' || '.join(f'({test})' if ' && ' in test else test for test in tests)})" if tests else ""


def _fits(rule: Rule) -> bool:
    """Return True if a limit can be computed as a quotient of two integers that always fit 64 bits.

    The limit is (num * tops * part + lift * den * bottoms) / (den * bottoms * part), of the ratio num / den and the
    offset lift / part, where tops and bottoms are the products of the arguments that multiply and divide. The first sum
    below is no less than either side in size: each argument counts with its largest size, at least 1, so that no
    intermediate product is larger than the whole product; and bottom * (lift + 1) covers the lift and the divisor with
    the half that rounding adds. Rules with a divisor that may be negative, or with a power of ten, are not computed
    this way.
    """
    tops = [operand for operand in rule.operands if not operand.over]
    bottoms = [operand for operand in rule.operands if operand.over]
    if any(each.floating or each.factor.ten_to for each in rule.operands) or any(each.ends[0] < 0 for each in bottoms):
        return False
    part, lift = rule.offset.denominator, abs(rule.offset.numerator)
    top = abs(rule.ratio.numerator) * part * prod(each.largest for each in tops)
    bottom = rule.ratio.denominator * part * prod(each.largest for each in bottoms)
    return top + bottom * (lift + 1) <= INT64[1]


def _simple(rule: Rule, scope: HeaderScope) -> tuple[str, str]:
    """Return the expressions for the numerator and the divisor of a limit."""
    part = rule.offset.denominator
    tops = [_number(operand, scope) for operand in rule.operands if not operand.over]
    bottoms = [_number(operand, scope) for operand in rule.operands if operand.over]
    top = _product(rule.ratio.numerator * part, tops)
    bottom = _product(rule.ratio.denominator * part, bottoms)
    if rule.offset:
        lift = _product(rule.offset.numerator * rule.ratio.denominator, bottoms)
        top = f"({top}) + ({lift})"
    return top, bottom


def _product(constant: int, names: list[str]) -> str:
    """Return a product, without a constant of 1."""
    parts = list(names)
    if constant != 1 or not parts:
        parts.append(bare(constant) if not parts else signed(constant))
    return " * ".join(parts)


def _number(operand: Operand, scope: HeaderScope) -> str:
    """Return the expression raw * slope + intercept of a factor, in brackets unless it is just a name."""
    factor = operand.factor
    text = linear(scope.raw(factor.point), factor.slope, factor.intercept, "int64_t")
    return text if (factor.slope, factor.intercept) == (1, 0) else f"({text})"
