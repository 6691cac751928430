"""Turns formulas into the form of the model: result = argument * ratio * product(factors) + offset. Always exact."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple, NoReturn

from fieldscribe.language.formula.evaluation import bounded, start
from fieldscribe.language.formula.parser import VARIABLES
from fieldscribe.language.formula.syntax import (
    Binary,
    Expression,
    FormulaError,
    Name,
    Negate,
    Number,
    Part,
    Power10,
    Scale,
)
from fieldscribe.language.formula.terms import LINEAR_ONLY, Symbol, Term, add, multiply, number, reciprocal, scaled
from fieldscribe.language.numbers import MOST_EXPONENT
from fieldscribe.model import Factor, Linear


class Affine(NamedTuple):
    """What a name means at run time: raw * slope + intercept, of the point with this name in the model."""

    point: str
    slope: Fraction
    intercept: Fraction


Resolve = Callable[[str, Part], Affine]
"""Gives the meaning of a name and its part. A FormulaError that it raises gets the column of the name."""


def linear(expression: Expression, variable: str, resolve: Resolve) -> Linear:
    """The normal form of an expression that is linear in `variable`; other names are factors. Raises FormulaError."""
    term = _term(expression, variable, resolve)
    if not term.variable:
        raise FormulaError(f"the result does not depend on `{variable}`", start(expression), f"use `{variable}`")
    return _linear(term, expression)


def limit_rule(expression: Expression, resolve: Resolve) -> Linear:
    """The normal form of a limit, whose argument is always 1; a constant becomes the ratio. Raises FormulaError."""
    term = _term(expression, "", resolve)
    return _linear(Term(term.offset, Fraction(0)) if term.constant else term, expression)


def scale_rule(scale: Scale, resolve: Resolve) -> Linear:
    """The rule from value to raw; the scale may be written for either side. Raises FormulaError."""
    if not scale.uses:
        return _static_rule(scale)
    return _rule(scale, resolve)


def invert(rule: Linear) -> Linear:
    """The inverse rule. Raises FormulaError (column 0) if its offset would depend on a point."""
    if rule.ratio == 0:
        raise FormulaError("a rule without slope cannot be inverted", 0)
    if rule.factors and rule.offset:
        points = " and ".join(f"`{point}`" for point in dict.fromkeys(factor.point for factor in rule.factors))
        message = f"the inverse has an offset that depends on {points}"
        raise FormulaError(message, 0, "a rule with run-time factors has an offset only where it is written raw = ...")
    factors = tuple(replace(factor, power=-factor.power) for factor in rule.factors)
    return Linear(1 / rule.ratio, -rule.offset / rule.ratio, factors)


def _rule(scale: Scale, resolve: Resolve) -> Linear:
    rule = linear(scale.expression, scale.variable, resolve)
    if scale.side == "raw":
        return rule
    try:
        return invert(rule)
    except FormulaError as error:
        raise FormulaError(error.message, scale.uses[0].column if scale.uses else 0, error.hint) from None


@lru_cache(maxsize=16384)
def _static_rule(scale: Scale) -> Linear:
    return _rule(scale, _no_points)


def _no_points(name: str, _: Part) -> NoReturn:
    raise FormulaError(f"`{name}` is not known", 0)


def _linear(term: Term, expression: Expression) -> Linear:
    """The model's rule of a term, factors in the order of the text."""
    column = start(expression)
    factors = tuple(
        Factor(symbol.point, symbol.slope, symbol.intercept, 1 if power > 0 else -1, symbol.ten_to)
        for symbol, power in term.product.items()
        for _ in range(abs(power))
    )
    return Linear(bounded(term.coefficient, column), bounded(term.offset, column), factors)


def _term(expression: Expression, variable: str, resolve: Resolve) -> Term:
    match expression:
        case Number(value):
            return number(value)
        case Name():
            return _point(expression, variable, resolve)
        case Negate(operand):
            return scaled(_term(operand, variable, resolve), Fraction(-1))
        case Power10():
            return _power(expression, variable, resolve)
        case Binary(op, left_side, right_side, column):
            left, right = _term(left_side, variable, resolve), _term(right_side, variable, resolve)
            return _combined(op, left, right, column)


def _combined(op: str, left: Term, right: Term, column: int) -> Term:
    if op == "+":
        return add(left, right, column)
    if op == "-":
        return add(left, scaled(right, Fraction(-1)), column)
    return multiply(left, right if op == "*" else reciprocal(right, column), column)


def _point(name: Name, variable: str, resolve: Resolve) -> Term:
    if name.name == variable:
        return Term(Fraction(1), Fraction(0), 1)
    point, slope, intercept = _resolved(name, resolve)
    if slope == 0:
        return number(intercept)
    return Term(slope, intercept, 0, {Symbol(point, 1, 0, False): 1})


def _power(power: Power10, variable: str, resolve: Resolve) -> Term:
    sign = -1 if power.negative else 1
    exponent = power.exponent
    if isinstance(exponent, Number):
        return number(Fraction(10) ** (sign * exponent.value.numerator))
    if exponent.name == variable:
        raise FormulaError("not linear: the variable is an exponent", exponent.column, LINEAR_ONLY)
    point, slope, intercept = _resolved(exponent, resolve)
    if slope.denominator != 1 or intercept.denominator != 1:
        message = f"`{exponent.name}` is an exponent and need not be a whole number"
        raise FormulaError(message, exponent.column, f"write {exponent.name}.raw if its raw number is meant")
    if slope < 0:
        slope, intercept, sign = -slope, -intercept, -sign
    symbol = Symbol(point, slope.numerator, intercept.numerator, True)
    if slope == 0:
        if abs(intercept) > MOST_EXPONENT:
            raise FormulaError(f"the exponent `{exponent.name}` is too large", exponent.column)
        return number(Fraction(10) ** (sign * symbol.intercept))
    return Term(Fraction(1), Fraction(0), 0, {symbol: sign})


def _resolved(name: Name, resolve: Resolve) -> Affine:
    if name.name in VARIABLES:
        raise FormulaError(f"`{name.name}` is not known here", name.column, "name a point")
    try:
        return resolve(name.name, name.part)
    except FormulaError as error:
        raise FormulaError(error.message, name.column, error.hint) from None
