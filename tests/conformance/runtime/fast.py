"""The fast path takes usual values and leaves others to the slow path; both give the same results."""

from __future__ import annotations

import copy
import math
import pickle
import struct
from collections.abc import Callable
from typing import Any

from conformance.package import Package
from conformance.runtime.bench import refusal, table

SLOW = "slow"
NOTHING: dict[str, int] = {}


def _slow(number: Any, raws: Any = NOTHING) -> Any:
    """Stands for the slow path."""
    return SLOW, number, raws


def _is_slow(way: Callable[..., Any], *numbers: Any) -> bool:
    """Whether a path passes these values to the slow path with all its arguments."""
    told = {"other": 1}
    return all(way(number, told) == (SLOW, number, told) and way(number) == (SLOW, number, {}) for number in numbers)


class _Asked:
    """A slow path that computes by a rule and records its calls."""

    def __init__(self, rule: Any, asked: list[float]) -> None:
        self.rule, self.asked = rule, asked

    def __call__(self, raw: Any, raws: Any) -> Any:
        self.asked.append(raw)
        return self.rule.decode(raw, raws)


def check_integers(package: Package) -> None:
    """Integers of a range, and no other numbers."""
    fast = package.runtime.fast
    way = fast.same(-2, 5, _slow)
    assert [way(number) for number in (-2, 0, 5)] == [-2, 0, 5]
    assert _is_slow(way, -3, 6, True, 1.0, "1")
    assert fast.itself(7, {}) == 7


def check_lists(package: Package) -> None:
    """What is listed, by raw number and by value."""
    fast = package.runtime.fast
    names = package.runtime.NamedNumber("Names", {"ONE": 1})
    listed = fast.listed({1: "one"}, _slow)
    assert (listed(1, {}), listed(2, {"a": 1})) == ("one", (SLOW, 2, {"a": 1}))
    checked = fast.checked(listed, (0, 3), (), _slow)
    assert checked(1) == "one"
    assert _is_slow(checked, 2, 4, -1, True, 1.0, "1", [1])
    way = fast.chosen(names, {names.ONE: 1}, _slow)
    assert (way(names.ONE), type(way(names.ONE))) == (1, int)
    assert _is_slow(way, 1, names(2), True)


def check_scales(package: Package) -> None:
    """Fixed scales, with and without an offset."""
    fast = package.runtime.fast
    for line, raw, value in (((1, 0, 10), 5, 0.5), ((3, 2, 10), 5, 1.3), ((1, 2, 10), 5, 0.3), ((3, 0, 10), 5, 1.5)):
        way = fast.scaled(line, 5, 9, _slow)
        assert (way(raw), fast.unchecked(line)(raw, {}), fast.unchecked(line)(-raw, {}) < 0) == (value, value, True)
        assert way(9) > value
        assert _is_slow(way, 4, 10, 5.0, True)
        divides = line[:2] == (1, 0)  # which takes a function of its own
        assert [made.__name__ == "decode" for made in (way, fast.unchecked(line))] == [divides, divides]


def check_steps(package: Package) -> None:
    """Values by steps, to nearest with halves away from zero, in range."""
    way = package.runtime.fast.rounded((10.0, 4.0, 0.5), -20, 20, _slow)
    exact = {2: 6, 0: 1, 1.8: 5, 1.79: 5, 7.799: 20, -1.2: -3, -8.2: -20, -8.3999: -20, -0.2: 0, -0.5: -1}
    assert {value: way(value) for value in exact} == exact
    assert [type(way(value)) for value in (2, 2.0)] == [int, int]
    assert _is_slow(way, 8.0, 8.2, -8.4, -9, True, "2", math.inf, 10**400)
    assert way(math.nan)[0] == SLOW
    halves = package.runtime.fast.rounded((1.0, 1.0, 0.0), -9, 9, _slow)
    numbers = (0.5, -0.5, 1.5, -1.5, 2.5, 0.49999999999999994, -0.49999999999999994, 8.4)
    assert [halves(number) for number in numbers] == [1, -1, 2, -2, 3, 0, 0, 8]


def check_scales_of_others(package: Package) -> None:
    """Scales that one or two other points decide: computed once, and remembered."""
    runtime = package.runtime

    def rule_of(*names: str) -> Any:
        return runtime.Rule(num=2, offset=(1, 1), factors=tuple([runtime.Factor(name) for name in names]))

    fast, both = runtime.fast, {"a": 5, "b": 3}

    def checked(rule: Any, low: int, high: int, slow: Any) -> Any:
        names = [factor.point for factor in rule.factors]
        return fast.checked(fast.scaled_by(rule, low, high, slow), (low, high), names, slow)

    for made, names, value in (
        *((checked, ("a",), 0.6), (checked, ("a", "b"), 0.2)),
        *((fast.scaled_by, ("a",), 0.6), (fast.scaled_by, ("a", "b"), 0.2)),
    ):
        asked: list[float] = []
        rule = rule_of(*names)
        way = made(rule, 0, 9, _Asked(rule, asked))
        for _ in range(2):
            assert (way(7, both), way(7, {"a": 1, "b": 1}), way(9, both) > value) == (value, 3.0, True)
        assert way(7, {**both, names[-1]: 1}) > value
        assert asked == [7] * (1 + len(names))
        asked.clear()
        assert (way(0, both) < value, way(9, both) > value, asked) == (True, True, [])
        if made is fast.scaled_by:
            assert (way(10, both) > value, way(-1, both) < 0, asked) == (True, True, [])
        else:
            assert (way(10, both) > value, way(-1, both) < 0, way(7.0, both), asked) == (
                True, True, value, [10, -1, 7.0],
            )  # fmt: skip
        slow = made(rule, 0, 9, _slow)
        for raws in ({}, {"a": [1], "b": [1]}, None, 5):
            assert slow(7, raws) == (SLOW, 7, raws)
        if made is checked:
            way(1, {"a": 1, "b": 1})
            for wrong in ({"a": True, "b": 1}, {"a": 1.0, "b": 1}):
                asked.clear()
                assert (refusal(way, 7, wrong).status, asked) == ("wrong_type", [7])
    huge = runtime.Rule(factors=(runtime.Factor("a", ten_to=(-400, 0)),))
    for made in (checked, fast.scaled_by):
        way = made(huge, 0, 9, _slow)
        assert [way(1, {"a": -400}) for _ in range(2)] == [(SLOW, 1, {"a": -400})] * 2


def check_patterns(package: Package) -> None:
    """The patterns of IEEE 754 numbers."""
    fast, forms = package.runtime.fast, (struct.Struct("<f"), struct.Struct("<I"))
    way = fast.from_pattern(*forms)
    assert (way(0x3FC00000, {}), way(0, {}), math.isnan(way(0xFFFFFFFF, {}))) == (1.5, 0.0, True)
    back = fast.to_pattern(*forms, -2.0, 1.5, _slow)
    assert [back(value) for value in (1.5, 1, -2, 0.0)] == [0x3FC00000, 0x3F800000, 0xC0000000, 0]
    assert _is_slow(back, 1.6, -2.1, 1e39, 10**400, math.inf, True, "1")
    assert back(math.nan)[0] == SLOW


def check_codes_on_the_way(package: Package) -> None:
    """Special codes before all else, and behind it."""
    fast, codes = package.runtime.fast, package.runtime.Codes({"off": 0, "band": (8, 9)})
    for find in (codes.finder, codes):
        plain = fast.coded(find, fast.same(0, 5, _slow))
        assert (plain(0, {}), plain(5, {}), plain(6, {})) == (codes.off, 5, (SLOW, 6, {}))
        assert _is_slow(fast.checked(plain, (0, 9), (), _slow), 6, 10, 0.0, False, "x", [])
        back = fast.uncoded(find, fast.same(0, 9, lambda *told: 7), _slow)
        assert [back(number) for number in (1, 5, 12)] == [1, 5, 7]
        assert _is_slow(back, 0, 8)
    assert (codes.finder(8), package.runtime.Codes({"off": 0}).finder(8)) == (codes(8), None)


def check_points_are_quick(package: Package) -> None:
    """Every form of point uses the fast path for usual values."""
    runtime = package.runtime
    names = runtime.NamedNumber("Names", {"ONE": 1, "TWO": 2})
    codes = runtime.Codes({"off": 0}, writable=("off",))
    scaled = runtime.Scaled(runtime.U16, runtime.Rule(num=10), decimals=1)
    forms: dict[str, tuple[Any, Any, Any]] = {
        "integer": (runtime.Integer(runtime.U16), 7, 7),
        "bit": (runtime.Bit(), 1, True),
        "named": (runtime.Named(runtime.U16, names), 2, names.TWO),
        "closed": (runtime.Named(runtime.U16, names, closed=True), 1, names.ONE),
        "scaled": (scaled, 15, 1.5),
        "coded": (runtime.WithWritableCodes(scaled, codes), 15, 1.5),
        "floating": (runtime.Floating(runtime.F32), 0x3FC00000, 1.5),
        "limited": (runtime.Floating(runtime.F64, units=((1.0, 2.0),)), 0x3FF8000000000000, 1.5),
    }
    made = table(
        package, **{name: runtime.ReadWrite(form, at=runtime.holding(1)) for name, (form, _, _) in forms.items()}
    )
    for name, (form, raw, value) in forms.items():
        point = made.POINTS[name]
        assert (form.quick_decode(*point.wire.limits(point.width), _slow)(raw), point.decode(raw)) == (value, value), (
            name
        )
        assert (form.quick_encode(point.allowed, _slow)(value), point.encode(value)) == (raw, raw), name
        assert (point.decode, point.encode) == (point.decoder, point.encoder), name
        twins = [copy.deepcopy(point)]
        if name not in ("named", "closed"):  # an enum that is made here has no module to be found in
            twins.append(pickle.loads(pickle.dumps(point)))
        for twin in twins:
            assert (twin.decode(raw), twin.encode(value), repr(twin)) == (value, raw, repr(point)), name
            assert twin.facts.at == point.facts.at
    flags = runtime.Flags(runtime.U16, package.runtime.NamedNumber("Bits", {"LOW": 1}))
    assert flags.quick_decode(0, 9, _slow)(5) == 5
    assert _is_slow(flags.quick_decode(0, 9, _slow), 10, -1)
    assert _is_slow(runtime.Integer(runtime.U16).quick_encode(((0, 1), (5, 9)), _slow), 5)
