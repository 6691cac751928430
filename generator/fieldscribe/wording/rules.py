"""Texts of scales, ranges, conditions, and steps of commands."""

from collections.abc import Mapping
from fractions import Fraction

from fieldscribe.arithmetic.exact import Line, value_line
from fieldscribe.conditions import Clause, Comparison, Condition
from fieldscribe.model import Bound, Factor, Interval, Limit, Linear, Point, Step, SteppedCommand, Word
from fieldscribe.model.device import WHOLE_WORD
from fieldscribe.wording.numbers import exact, fixed_rule, hex_text, number_text, plus_text, times_text, value_multiple

Points = Mapping[str, Point]
"""Points by name, from which texts of rules take units and names."""


class RenamedPoints(dict[str, Point]):
    """Points by name, and other names for them in texts. Without points, texts use only raw numbers."""

    def __init__(self, points: Points, names: Mapping[str, str]) -> None:
        super().__init__(points)
        self.names = names


_TURNED = str.maketrans("<>", "><")


def converted(raw: int, line: Line) -> str:
    """Return the value of a raw number as text."""
    return exact(raw * line.factor + line.add, line.divisor)


def inverse_text(rule: Linear, points: Points | None = None) -> str:
    """Return the inverse of a rule, from `raw` to the value: `raw x 0.1 - 0.25`."""
    multiply, add, divide = value_line(rule)
    ratio = Fraction(multiply, divide)
    if not rule.factors:
        common = Fraction(add, divide)
        text = times_text("raw", ratio.numerator, ratio.denominator)
        return plus_text(text, common.numerator, common.denominator)
    moved = plus_text("raw", -rule.offset.numerator, rule.offset.denominator)
    start = times_text(f"({moved})" if rule.offset else moved, ratio.numerator, ratio.denominator)
    return _with_factors(start, [(_factor_text(factor, points), -factor.power) for factor in rule.factors])


def ranges_text(point: Point, line: Line, points: Points | None, unit: str) -> str:
    """Return all intervals in one text, the unit after the last number and the exceptions of limits at the end."""
    intervals, listed = point.allowed.intervals, point.allowed.listed
    falling = line.factor < 0
    simple = intervals[0].fixed if len(intervals) == 1 and not listed else None
    if simple is not None:  # the same as below, quicker for most points
        ends = [converted(raw, line) for raw in (simple[::-1] if falling else simple)]
        text = "..".join(ends) if simple[0] != simple[1] else ends[0]
        return f"{text} {unit}" if unit else text
    parts, remarks = [], []
    for interval in intervals:
        ends = [
            _bound_text(interval.low, True, point, line, points),
            _bound_text(interval.high, False, point, line, points),
        ]
        parts.append(_span_text(interval, ends, falling, listed))
        if point.allowed.moves:
            remarks += [
                _lifted_text(end, side, line, points) for side, end in (("low", interval.low), ("high", interval.high))
            ]
    if unit and parts:
        parts[-1] = f"{parts[-1]} {unit}"
    return (", " if listed else " or ").join(parts) + "".join(remarks)


def condition_text(condition: Condition | None, points: Points | None = None) -> str:
    """Return the condition of a point: `model == large and speed.raw > 600`; empty if it always exists."""
    return " or ".join(clause_text(clause, points) for clause in condition.clauses) if condition is not None else ""


def clause_text(clause: Clause, points: Points | None = None) -> str:
    """Return comparisons joined by `and`; with values instead of raw numbers if `points` are given."""
    return " and ".join(_comparison_text(comparison, points) for comparison in clause)


def _comparison_text(comparison: Comparison, points: Points | None) -> str:
    name = name_of(comparison.of, points)
    numbers = [raw for raw in comparison.than if isinstance(raw, int)]
    if not numbers:
        return _test_text(name, comparison.test, [str(text) for text in comparison.than])
    point = None if points is None else points.get(comparison.of)
    line = None if point is None else fixed_rule(point)
    if point is None or line is None:
        return _test_text(f"{name}.raw", comparison.test, [str(raw) for raw in numbers])
    names = {} if point.enum is None else {entry.raw: entry.name for entry in point.enum.entries}
    test = comparison.test.translate(_TURNED) if line.factor < 0 else comparison.test
    return _test_text(name, test, [names.get(raw) or converted(raw, line) for raw in numbers])


def name_of(name: str, points: Points | None) -> str:
    """Return the name of a point in texts."""
    return points.names.get(name, name) if isinstance(points, RenamedPoints) else name


def _test_text(name: str, test: str, than: list[str]) -> str:
    return f"{name} in ({', '.join(than)})" if test == "in" else f"{name} {test} {than[0]}"


def _span_text(interval: Interval, ends: list[str], falling: bool, listed: bool) -> str:
    low, high = interval.low, interval.high
    if low == high:
        return ends[0]
    if falling:
        ends.reverse()
    adjacent = listed and isinstance(low, int) and isinstance(high, int) and high - low == 1
    return ", ".join(ends) if adjacent else "..".join(ends)


def _bound_text(bound: Bound, is_low: bool, point: Point, line: Line, points: Points | None) -> str:
    if isinstance(bound, int):
        return converted(bound, line)
    words = _limit_text(bound, line, points)
    fixed = bound.outermost(low=is_low)
    if fixed == (point.least if is_low else point.greatest):
        return words
    return f"{'max' if is_low == (line.factor > 0) else 'min'}({converted(fixed, line)}, {words})"


def _lifted_text(bound: Bound, side: str, line: Line, points: Points | None) -> str:
    """Return the exception of a limit: the numbers of other points that lift it, and the limit that then applies."""
    if isinstance(bound, int) or not bound.unless:
        return ""
    cases = [f"{name_of(name, points)}.raw is {' or '.join(map(band_text, codes))}" for name, codes in bound.unless]
    fixed = bound.outermost(low=side == "low")
    return f"; while {' or '.join(cases)}: {'from' if side == 'low' else 'to'} {converted(fixed, line)}"


def band_text(band: tuple[int, int]) -> str:
    """Return a range of raw numbers, or its only one: `1..4`."""
    return str(band[0]) if band[0] == band[1] else f"{band[0]}..{band[1]}"


def _limit_text(limit: Limit, line: Line, points: Points | None) -> str:
    multiply, add, divide = line
    ratio = limit.rule.ratio * multiply / divide
    offset = (limit.rule.offset * multiply + add) / divide
    factors = []
    for factor in limit.rule.factors:
        other = points.get(factor.point) if points and not factor.ten_to else None
        constant = value_multiple(factor, other) if other else None
        if constant is not None:
            ratio *= constant**factor.power
        factors.append(
            (name_of(factor.point, points) if constant is not None else _limit_factor(factor, points), factor.power)
        )
    factors.sort(key=lambda factor: -factor[1])
    if factors and factors[0][1] == 1:
        start = times_text(factors.pop(0)[0], ratio.numerator, ratio.denominator)
    else:
        start = number_text(ratio)
    return plus_text(_with_factors(start, factors), offset.numerator, offset.denominator)


def _with_factors(start: str, factors: list[tuple[str, int]]) -> str:
    return start + "".join(f" {'x' if power == 1 else '/'} {name}" for name, power in factors)


def _limit_factor(factor: Factor, points: Points | None) -> str:
    """Return a factor of a limit: always by its raw number."""
    return _factor_text(factor, RenamedPoints({}, points.names) if isinstance(points, RenamedPoints) else None)


def _factor_text(factor: Factor, points: Points | None = None) -> str:
    if points and factor.point in points and points[factor.point].info.floating:
        return name_of(factor.point, points)  # its value: the raw number is only a bit pattern
    text = f"{name_of(factor.point, points)}.raw"
    if factor.slope != 1 or factor.intercept:
        text = f"({plus_text(times_text(text, factor.slope, 1), factor.intercept, 1)})"
    return f"10^{text}" if factor.ten_to else text


def time_text(milliseconds: int) -> str:
    """Return a time as `500 ms` or `2 s`."""
    return f"{milliseconds} ms" if milliseconds % 1000 else f"{milliseconds // 1000} s"


def word_text(word: Word) -> str:
    """Return a word as a formula, with its bits if these are not all."""
    return str(word) if word.mask == WHOLE_WORD else f"{word} in the bits {hex_text(word.mask)}"


def step_text(step: Step) -> str:
    """Return what a step writes, where and how, or for what it waits."""
    words = ", ".join(map(word_text, step.words))
    says = "" if step.says == words else f"{step.says}: "
    where = f"{step.space} {step.address} ({hex_text(step.address)}){f' from {step.base}' if step.base else ''}"
    if step.write is None:
        how = f"with function {hex_text(step.read or 0, 2)} until it is {words}"
        return f"{says}read {where} {how}, for {time_text(step.within or 0)}"
    kept = "" if step.read is None else f", read with function {hex_text(step.read, 2)} before"
    return f"{says}write {words} to {where} with function {hex_text(step.write, 2)}{kept}"


def steps_texts(command: SteppedCommand, points: Points | None = None) -> list[str]:
    """Return the steps of a command in order, each with its condition."""
    whens = [f"; only when {condition_text(step.when, points)}" if step.when else "" for step in command.steps]
    return [f"{step_text(step)}{when}" for step, when in zip(command.steps, whens, strict=True)]


def run_text(command: SteppedCommand) -> str:
    """Return when a command is given, and with what arguments."""
    run = command.run if command.every is None else f"every {time_text(command.every)}, by caller"
    return ", ".join([run, *(f"{name} {low}..{high}" for name, (low, high) in command.arguments.items())])
