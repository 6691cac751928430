"""Formulas turned into linear rules, held against plain evaluation at several points."""

from __future__ import annotations

from fractions import Fraction
from math import gcd
from time import perf_counter

import pytest
from fieldscribe.language.formula.normal import Affine, invert, limit_rule, linear, scale_rule
from fieldscribe.language.formula.parser import parse_expression, parse_scale
from fieldscribe.language.formula.syntax import FormulaError
from fieldscribe.model import Factor, Linear
from hypothesis import assume, given
from hypothesis import strategies as st
from independent.arithmetic import evaluate

POINTS = {
    "k": Affine("factor", Fraction(1), Fraction(0)),
    "tenth": Affine("tenth", Fraction(1, 10), Fraction(0)),
    "celsius": Affine("celsius", Fraction(-1, 10), Fraction(40)),
    "e": Affine("exponent", Fraction(1), Fraction(0)),
    "down": Affine("down", Fraction(-2), Fraction(3)),
    "fixed": Affine("fixed", Fraction(0), Fraction(5)),
}


def resolve(name: str, part: str) -> Affine:
    """The meaning of the names of these tests."""
    if name not in POINTS:
        raise FormulaError(f"`{name}` is unknown", 0, "known: k")
    known = POINTS[name]
    return known if part == "value" else Affine(known.point, Fraction(1), Fraction(0))


def rule(ratio: Fraction | int, offset: Fraction | int = 0, *factors: Factor) -> Linear:
    """A rule, shorter to write."""
    return Linear(Fraction(ratio), Fraction(offset), factors)


def of(point: str, power: int = 1, slope: int = 1, intercept: int = 0) -> Factor:
    """A factor that is a point."""
    return Factor(point, slope, intercept, power, False)


def ten_to(point: str, power: int = 1, slope: int = 1, intercept: int = 0) -> Factor:
    """A factor that is a power of ten."""
    return Factor(point, slope, intercept, power, True)


SCALES = {
    "value = raw * 0.1": rule(10),
    "value = raw": rule(1),
    "raw = value * 256": rule(256),
    "raw = value * 0.5": rule(Fraction(1, 2)),
    "raw = -value": rule(-1),
    "value = (raw - 32) * 5 / 9": rule(Fraction(9, 5), 32),
    "raw = value * 2 + 1 - value": rule(1, 1),
    "raw = 100 - value": rule(-1, 100),
    "raw = value * fixed": rule(5),
    "raw = value * k / 400": rule(Fraction(1, 400), 0, of("factor")),
    "value = raw / k": rule(1, 0, of("factor")),
    "value = raw * 10 ** e": rule(1, 0, ten_to("exponent", -1)),
    "value = raw * 10 ** -e": rule(1, 0, ten_to("exponent")),
    "raw = value * 10 ** down": rule(1, 0, ten_to("down", -1, 2, -3)),
    "value = k / 2800 * 10 ** e * raw": rule(2800, 0, of("factor", -1), ten_to("exponent", -1)),
    "raw = value * 4000h / tenth": rule(163840, 0, of("tenth", -1)),
    "raw = value * 4000h / tenth.raw": rule(16384, 0, of("tenth", -1)),
    "raw = value * celsius": rule(Fraction(-1, 10), 0, of("celsius", 1, 1, -400)),
    "raw = value * (2 * k + 4) + 7": rule(2, 7, of("factor", 1, 1, 2)),
    "raw = value * (k + k)": rule(2, 0, of("factor")),
    "raw = value * (tenth + tenth.raw)": rule(Fraction(11, 10), 0, of("tenth")),
    "raw = value * k * k": rule(1, 0, of("factor"), of("factor")),
    "raw = value / (k * tenth)": rule(10, 0, of("factor", -1), of("tenth", -1)),
    "raw = value * 10 ** e / 10 ** e": rule(1),
    "raw = value * (k - k + 3)": rule(3),
}


@pytest.mark.parametrize("text", SCALES)
def test_a_scale_becomes_the_rule_from_value_to_raw(text: str) -> None:
    assert scale_rule(parse_scale(text), resolve) == SCALES[text]


LIMITS = {
    "600": rule(600),
    "k": rule(1, 0, of("factor")),
    "tenth * 10": rule(1, 0, of("tenth")),
    "celsius * 10": rule(-1, 400, of("celsius")),
    "k - 5": rule(1, -5, of("factor")),
    "-(k * tenth) + 1": rule(Fraction(-1, 10), 1, of("factor"), of("tenth")),
    "100 / (tenth + 1)": rule(1000, 0, of("tenth", -1, 1, 10)),
    "k - k + 2": rule(2),
    "0 * k": rule(0),
    "10 ** e": rule(1, 0, ten_to("exponent")),
}


@pytest.mark.parametrize("text", LIMITS)
def test_a_limit_becomes_a_rule_for_1(text: str) -> None:
    assert limit_rule(parse_expression(text), resolve) == LIMITS[text]


# scale: (column, part of the message)
REFUSED = {
    "raw = 1 / value": (8, "in a divisor"),
    "raw = value / value": (12, "in a divisor"),
    "raw = 10 ** value": (12, "is an exponent"),
    "raw = 5": (6, "does not depend on `value`"),
    "raw = k * 2": (6, "does not depend on `value`"),
    "raw = value * 0": (6, "does not depend on `value`"),
    "raw = value - value": (6, "does not depend on `value`"),
    "raw = value / 0": (12, "division by zero"),
    "raw = value / (2 - 2)": (12, "division by zero"),
    "raw = value / (k - k)": (12, "division by zero"),
    "raw = value * (k + tenth)": (17, "a sum of different run-time terms: `factor` and `tenth`"),
    "raw = value * (k * tenth + 1)": (12, "only if it has one point"),
    "raw = value * (10 ** e + 1)": (12, "only if it has one point"),
    "raw = value * k + value": (16, "two products"),
    "raw = value + k": (12, "the offset depends on `factor`"),
    "raw = k * 2 - value": (12, "the offset depends on `factor`"),
    "raw = (value + 1) * k": (18, "the offset depends on `factor`"),
    "raw = k * (value + 1)": (8, "the offset depends on `factor`"),
    "raw = value * k / k": (16, "multiplied and divided by"),
    "value = raw * k + 5": (14, "inverse has an offset that depends on `factor`"),
    "raw = value * 10 ** tenth": (20, "need not be a whole number"),
    "raw = value * unknown": (14, "`unknown` is unknown"),
    "raw = value * " + " * ".join(["1e400"] * 11): (6, "too large"),
}


@pytest.mark.parametrize("text", REFUSED)
def test_what_is_not_linear_is_refused_where_it_stands(text: str) -> None:
    column, message = REFUSED[text]
    with pytest.raises(FormulaError) as caught:
        scale_rule(parse_scale(text), resolve)
    assert message in caught.value.message
    assert caught.value.column == column


def test_a_limit_knows_no_raw() -> None:
    with pytest.raises(FormulaError, match="`raw` is not known here") as caught:
        limit_rule(parse_expression("1 + raw"), resolve)
    assert caught.value.column == 4


def test_a_rule_inverts_into_itself() -> None:
    for one in (rule(Fraction(3, 7), 5), rule(2, 0, of("factor", -1), ten_to("exponent"))):
        assert invert(invert(one)) == one
    assert invert(rule(2, 6)) == rule(Fraction(1, 2), -3)
    for refused in (rule(2, 6, of("factor")), rule(0, 1)):
        with pytest.raises(FormulaError):
            invert(refused)


CONSTANTS = st.sampled_from(["2", "0.1", "400", "4000h", "10 ** 2", "10 ** -3", "(1 + 2)", "1.5e-3", "7 / 3", "-4"])
POINT_TEXTS = ["k", "tenth", "tenth.raw", "celsius", "e.raw", "fixed", "10 ** e", "10 ** -down"]
SUM_TEXTS = ["k + 3", "2 - celsius", "tenth * 4 - 1 / 3", "k * 10 ** e", "5 / celsius", "k + k", "tenth / 10 ** e"]
FACTORS = st.sampled_from([*POINT_TEXTS, *SUM_TEXTS])
STEPS = st.one_of(
    st.tuples(st.just("const"), st.sampled_from(["*", "/"]), CONSTANTS),
    st.tuples(st.just("point"), st.sampled_from(["*", "/"]), FACTORS),
    st.tuples(st.just("shift"), st.sampled_from(["+", "-"]), CONSTANTS),
    st.tuples(st.just("front"), st.just("*"), FACTORS),
    st.tuples(st.just("minus"), st.just("-"), CONSTANTS),
)


def _text(steps: list[tuple[str, str, str]], variable: str) -> str:
    text = variable
    for kind, sign, operand in steps:
        text = f"({operand}) {sign} ({text})" if kind in ("front", "minus") else f"({text}) {sign} ({operand})"
    return text


def _plain(text: str, raws: dict[str, int], **variables: Fraction) -> Fraction:
    """What the formula gives, by plain evaluation: an independent way."""

    def value(name: str, part: str) -> Fraction:
        if name in variables:
            return variables[name]
        point, slope, intercept = POINTS[name]
        return Fraction(raws[point]) if part == "raw" else raws[point] * slope + intercept

    return evaluate(text, value)


def _applied(one: Linear, argument: Fraction, raws: dict[str, int]) -> Fraction:
    """What the rule gives, as the model defines it."""
    product = Fraction(1)
    for factor in one.factors:
        number = Fraction(raws[factor.point] * factor.slope + factor.intercept)
        product *= (Fraction(10) ** int(number) if factor.ten_to else number) ** factor.power
    return argument * one.ratio * product + one.offset


RAWS = st.fixed_dictionaries({known.point: st.integers(-9, 9) for known in POINTS.values()})


@given(st.lists(STEPS, max_size=6), st.lists(st.tuples(RAWS, st.fractions()), min_size=3, max_size=5))
def test_the_normal_form_is_the_formula(
    steps: list[tuple[str, str, str]], at: list[tuple[dict[str, int], Fraction]]
) -> None:
    text = _text(steps, "value")
    try:
        found = linear(parse_expression(text), "value", resolve)
    except FormulaError as error:
        assert "depends on" in error.message or "multiplied and divided" in error.message
        assume(False)
    for factor in found.factors:
        assert factor.slope > 0
        assert factor.ten_to or gcd(factor.slope, factor.intercept) == 1
    for raws, argument in at:
        try:
            expected = _plain(text, raws, value=argument)
        except ZeroDivisionError:
            continue
        assert _applied(found, argument, raws) == expected
        alive = all(raws[f.point] * f.slope + f.intercept or f.ten_to for f in found.factors)
        if alive and not (found.factors and found.offset):
            assert _applied(invert(found), expected, raws) == argument


@given(st.lists(STEPS, min_size=1, max_size=5), FACTORS, RAWS)
def test_the_limit_is_the_formula(steps: list[tuple[str, str, str]], first: str, raws: dict[str, int]) -> None:
    text = _text(steps, first)
    try:
        expected, found = _plain(text, raws), limit_rule(parse_expression(text), resolve)
    except (FormulaError, ZeroDivisionError):
        assume(False)
    assert _applied(found, Fraction(1), raws) == expected


LEAVES = st.sampled_from(["raw", "k", "tenth", "10 ** e", "10 ** raw", "2", "0", "1e400", "unknown", "celsius.raw"])
TREES = st.recursive(
    LEAVES,
    lambda inner: st.tuples(inner, st.sampled_from("+-*/"), inner).map(lambda both: f"({' '.join(both)})"),
    max_leaves=24,
)


@given(TREES)
def test_any_formula_gives_a_rule_or_a_formula_error(text: str) -> None:
    begun = perf_counter()
    for side in ("raw", "limit"):
        try:
            if side == "raw":
                scale_rule(parse_scale(f"value = {text}"), resolve)
            else:
                limit_rule(parse_expression(text), resolve)
        except FormulaError as error:
            assert error.message
            assert 0 <= error.column <= len(text) + len("value = ")
    assert perf_counter() - begun < 0.2
