"""Evaluates expressions whose names all have known numbers."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe.language.formula.syntax import Binary, Expression, FormulaError, Name, Negate, Number, Power10
from fieldscribe.language.numbers import MOST_EXPONENT

if TYPE_CHECKING:
    from collections.abc import Mapping

MOST_BITS = 4096
"""The most bits of a numerator or denominator; larger results make no sense and cannot be printed."""


def evaluate(expression: Expression, values: Mapping[str, Fraction]) -> Fraction:
    """Return the result of an expression; `values` has numbers by name (`name.raw` for `.raw`). Raises FormulaError."""
    return bounded(_evaluate(expression, values), start(expression))


def start(expression: Expression) -> int:
    """Return the column of the leftmost operand of an expression."""
    while isinstance(expression, Binary):
        expression = expression.left
    return expression.column


def bounded(result: Fraction, column: int) -> Fraction:
    """Return the result unchanged. Raises FormulaError if it is too large."""
    if result.numerator.bit_length() > MOST_BITS or result.denominator.bit_length() > MOST_BITS:
        raise FormulaError("the numbers of this formula are too large", column)
    return result


def _evaluate(expression: Expression, values: Mapping[str, Fraction]) -> Fraction:
    match expression:
        case Number(value):
            return value
        case Name():
            return _value(expression, values)
        case Negate(operand):
            return -_evaluate(operand, values)
        case Power10():
            return _power(expression, values)
        case Binary(op, left_side, right_side, column):
            return _combined(op, _evaluate(left_side, values), _evaluate(right_side, values), column)


def _combined(op: str, left: Fraction, right: Fraction, column: int) -> Fraction:
    if op == "+":
        return left + right
    if op == "-":
        return left - right
    if op == "*":
        return left * right
    if right == 0:
        raise FormulaError("division by zero", column)
    return left / right


def _value(name: Name, values: Mapping[str, Fraction]) -> Fraction:
    key = name.name if name.part == "value" else f"{name.name}.raw"
    if key not in values:
        known = ", ".join(values)
        raise FormulaError(f"`{key}` is not known here", name.column, f"known: {known}" if known else "write a number")
    return values[key]


def _power(power: Power10, values: Mapping[str, Fraction]) -> Fraction:
    exponent = power.exponent
    value = exponent.value if isinstance(exponent, Number) else _value(exponent, values)
    if value.denominator != 1 or abs(value) > MOST_EXPONENT:
        message = f"an exponent is a whole number of at most {MOST_EXPONENT}"
        raise FormulaError(message, exponent.column)
    return Fraction(10) ** (-value.numerator if power.negative else value.numerator)
