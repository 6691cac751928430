"""The bounds of points that are exponents of ten in other rules, alike in every language and on the command line."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.model import Interval, Limit

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Allowed, Bound, Factor, Linear, Point, Shape

Ends = tuple[int, int]


def with_exponents(points: tuple[Point, ...]) -> tuple[Point, ...]:
    """The points, with the raw numbers for which powers of ten are defined added to the rules that have some."""
    shapes = {id(point.shape): point.shape for point in points}
    limits = {id(point.allowed): point.allowed for point in points}
    rules = [*map(_rules_of_shape, shapes.values()), *map(_rules_of_limits, limits.values())]
    names = {factor.point for some in rules for rule in some for factor in rule.factors if factor.ten_to}
    if not names:
        return points
    ends: dict[str, Ends] = {}
    for point in points:
        for name in {point.name, point.item} & names:
            ends[name] = _joined(ends.get(name), point.outer)
    if not ends:
        return points
    bounded_shapes = {key: _shape(shape, ends) for key, shape in shapes.items()}
    bounded_limits = {key: _allowed(allowed, ends) for key, allowed in limits.items()}
    return tuple(
        [
            replace(point, shape=bounded_shapes[id(point.shape)], allowed=bounded_limits[id(point.allowed)])
            for point in points
        ]
    )


def _joined(known: Ends | None, other: Ends) -> Ends:
    """The ends that cover both: a point may have another range in each variant."""
    return other if known is None else (min(known[0], other[0]), max(known[1], other[1]))


def _rules_of_shape(shape: Shape) -> list[Linear]:
    return [case.rule for case in shape.scale or ()]


def _rules_of_limits(allowed: Allowed) -> list[Linear]:
    bounds = [bound for interval in allowed.intervals for bound in (interval.low, interval.high)]
    return [bound.rule for bound in bounds if isinstance(bound, Limit)]


def _shape(shape: Shape, ends: Mapping[str, Ends]) -> Shape:
    cases = shape.scale and tuple([replace(case, rule=_rule(case.rule, ends)) for case in shape.scale])
    return shape if cases == shape.scale else replace(shape, scale=cases)


def _allowed(allowed: Allowed, ends: Mapping[str, Ends]) -> Allowed:
    if not allowed.moves:
        return allowed
    intervals = [Interval(_limit(interval.low, ends), _limit(interval.high, ends)) for interval in allowed.intervals]
    return replace(allowed, intervals=tuple(intervals))


def _limit(bound: Bound, ends: Mapping[str, Ends]) -> Bound:
    return replace(bound, rule=_rule(bound.rule, ends)) if isinstance(bound, Limit) else bound


def _rule(rule: Linear, ends: Mapping[str, Ends]) -> Linear:
    return replace(rule, factors=tuple([_factor(factor, ends) for factor in rule.factors]))


def _factor(factor: Factor, ends: Mapping[str, Ends]) -> Factor:
    return replace(factor, exponents=ends.get(factor.point)) if factor.ten_to else factor
