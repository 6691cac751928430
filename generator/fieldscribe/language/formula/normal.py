"""Turns formulas into rules of the model, exactly: result = argument * ratio * product(factors) + offset."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import gcd, lcm
from typing import NamedTuple, NoReturn

from fieldscribe.language.formula.parser import VARIABLES
from fieldscribe.language.formula.syntax import (
    Binary,
    Expression,
    FormulaError,
    Name,
    Negate,
    NoSumError,
    Number,
    Part,
    Power10,
    Scale,
    UnknownNameError,
    ZeroDivisorError,
)
from fieldscribe.language.numbers import MOST_EXPONENT
from fieldscribe.model import Factor, Linear

MOST_BITS = 4096
"""The most bits of a numerator or denominator; larger results make no sense and cannot be printed."""
SHAPE = "supported is number * product of points + number, where a factor may be (number * point + number)"
LINEAR_ONLY = "only a rule that is linear in the variable can be inverted"


@dataclass(frozen=True, slots=True)
class Term:
    """A term; `variable` is 0 or 1: coefficient * (the variable) ** variable * product + offset.

    A constant has coefficient 0. The product has each factor, with slope > 0 and no common divisor, and how often it is
    multiplied with. If it is a single point, the term is open: slope and intercept of the point are part of coefficient
    and offset, so that terms with the same point can be added.
    """

    coefficient: Fraction
    offset: Fraction
    variable: int = 0
    product: Mapping[Factor, int] = field(default_factory=dict)

    @property
    def constant(self) -> bool:
        """True if the term is a known number."""
        return self.coefficient == 0

    @property
    def points(self) -> str:
        """The points of the product, for messages."""
        return " and ".join(f"`{point}`" for point in dict.fromkeys(factor.point for factor in self.product))


def number(value: Fraction) -> Term:
    """Return a constant as a term."""
    return Term(Fraction(0), value)


def scaled(term: Term, by: Fraction) -> Term:
    """Return a term times a constant."""
    if by == 0:
        return number(by)
    return Term(term.coefficient * by, term.offset * by, term.variable, term.product)


def add(left: Term, right: Term, column: int) -> Term:
    """Return the sum of two terms with the same variable and product, or with a constant. Raises FormulaError."""
    if not (left.constant or right.constant) and (left.variable, left.product) != (right.variable, right.product):
        _refuse_sum(left, right, column)
    coefficient, offset = left.coefficient + right.coefficient, left.offset + right.offset
    if coefficient == 0:
        return number(offset)
    shape = right if left.constant else left
    return Term(coefficient, offset, shape.variable, shape.product)


def multiply(left: Term, right: Term, column: int) -> Term:
    """Return the product of two terms. Raises FormulaError."""
    if left.constant:
        return scaled(right, left.offset)
    if right.constant:
        return scaled(left, right.offset)
    if left.variable and right.variable:
        raise FormulaError("not linear: the variable is multiplied by itself", column, LINEAR_ONLY)
    for term, other in ((left, right), (right, left)):
        if term.variable and term.offset:
            raise FormulaError(f"the offset depends on {other.points}", column, SHAPE)
    left, right = _closed(left, column), _closed(right, column)
    product = dict(left.product)
    for factor, power in right.product.items():
        _raise_power(product, factor, power, column)
    return _opened(left.coefficient * right.coefficient, left.variable + right.variable, product)


def reciprocal(term: Term, column: int) -> Term:
    """Return one divided by a term. Raises FormulaError."""
    if term.constant:
        if term.offset == 0:
            raise ZeroDivisorError(column)
        return number(1 / term.offset)
    if term.variable:
        raise FormulaError("not linear: the variable stands in a divisor", column, LINEAR_ONLY)
    closed = _closed(term, column)
    return _opened(1 / closed.coefficient, 0, {factor: -power for factor, power in closed.product.items()})


def _closed(term: Term, column: int) -> Term:
    """Return the same term without an offset: the offset becomes the intercept of its point."""
    if term.offset == 0:
        return term
    (factor, power), *others = term.product.items()
    if others or factor.ten_to or power != 1:
        raise FormulaError("a sum of points and numbers is a factor only if it has one point", column, SHAPE)
    common = lcm(term.coefficient.denominator, term.offset.denominator)
    slope, intercept = int(term.coefficient * common), int(term.offset * common)
    divisor = gcd(slope, intercept) * (1 if slope > 0 else -1)
    closed = Factor(factor.point, slope // divisor, intercept // divisor, 1, ten_to=False)
    return Term(Fraction(divisor, common), Fraction(0), 0, {closed: 1})


def _opened(coefficient: Fraction, variable: int, product: dict[Factor, int]) -> Term:
    """Return the term with this product; if that is a single point, the term is open (see `Term`)."""
    if not variable and len(product) == 1:
        (factor, power) = next(iter(product.items()))
        if power == 1 and not factor.ten_to:
            opened = {Factor(factor.point, 1, 0, 1, ten_to=False): 1}
            return Term(coefficient * factor.slope, coefficient * factor.intercept, 0, opened)
    if not variable and not product:
        return number(coefficient)
    return Term(coefficient, Fraction(0), variable, product)


def _raise_power(product: dict[Factor, int], factor: Factor, power: int, column: int) -> None:
    """Multiply a product by a factor. A power of ten may cancel; a point may not, for it could be zero."""
    before = product.get(factor, 0)
    if before * power < 0 and not factor.ten_to:
        raise FormulaError(f"`{factor.point}` is multiplied and divided by", column, "leave out what cancels")
    if before + power:
        product[factor] = before + power
    else:
        del product[factor]


def _refuse_sum(left: Term, right: Term, column: int) -> NoReturn:
    if left.variable and right.variable:
        hint = "write the variable once, times a sum: value * (POINT + 1)"
        raise FormulaError("the variable stands in two products", column, hint)
    if left.variable or right.variable:
        point = right.points if left.variable else left.points
        raise FormulaError(f"the offset depends on {point}", column, SHAPE)
    raise FormulaError(f"a sum of different run-time terms: {left.points} and {right.points}", column, SHAPE)


class Affine(NamedTuple):
    """What a name stands for at run time: raw * slope + intercept of the point with this name in the model."""

    point: str
    slope: Fraction
    intercept: Fraction


Resolve = Callable[[str, Part], Affine]
"""Returns what a name and its part stand for. A FormulaError that it raises gets the column of the name."""


def linear(expression: Expression, variable: str, resolve: Resolve) -> Linear:
    """Return the rule of an expression that is linear in `variable`; other names are factors. Raises FormulaError."""
    term = _term(expression, variable, resolve)
    if not term.variable:
        raise FormulaError(
            f"the result does not depend on `{variable}`", _start(expression), f"use `{variable}`, not times 0"
        )
    return _linear(term, expression)


def limit_rule(expression: Expression, resolve: Resolve) -> Linear:
    """Return the rule of a limit, whose argument is always 1; a constant becomes the ratio. Raises FormulaError."""
    term = _term(expression, "", resolve)
    return _linear(Term(term.offset, Fraction(0)) if term.constant else term, expression)


def evaluate(expression: Expression, values: Mapping[str, Fraction]) -> Fraction:
    """Return the result of an expression; `values` has numbers by name (`name.raw` for `.raw`). Raises FormulaError."""

    def resolve(name: str, part: Part) -> Affine:
        key = name if part == "value" else f"{name}.raw"
        if key in values:
            return Affine(name, Fraction(0), values[key])
        known = ", ".join(values)
        raise UnknownNameError(f"`{key}` is not known here", 0, f"known: {known}" if known else "write a number")

    return limit_rule(expression, resolve).ratio


def multiples(expression: Expression, known: Collection[str]) -> tuple[Fraction, dict[str, Fraction]]:
    """Return the constant and the factors of a sum of multiples of names. Raises FormulaError for anything else."""
    match expression:
        case Name(name, part, column):
            if part != "value" or name not in known:
                hint = f"known: {', '.join(known)}" if known else "write a number"
                key = name if part == "value" else f"{name}.raw"
                raise UnknownNameError(f"`{key}` is not known here", column, hint)
            return Fraction(0), {name: Fraction(1)}
        case Negate(operand):
            return _times(multiples(operand, known), Fraction(-1))
        case Binary("+" | "-" as op, left_side, right_side):
            constant, factors = multiples(left_side, known)
            further, others = _times(multiples(right_side, known), Fraction(1 if op == "+" else -1))
            sums = {name: factors.get(name, 0) + others.get(name, Fraction(0)) for name in factors | others}
            return constant + further, {name: factor for name, factor in sums.items() if factor}
        case Binary(op, left_side, right_side, column):
            left, right = multiples(left_side, known), multiples(right_side, known)
            if op == "*" and not left[1]:
                return _times(right, left[0])
            if right[1]:
                raise NoSumError(column)
            if op == "/" and right[0] == 0:
                raise ZeroDivisorError(column)
            return _times(left, right[0] if op == "*" else 1 / right[0])
        case Power10(Name() as exponent):
            raise NoSumError(exponent.column)
    return evaluate(expression, {}), {}


def _times(terms: tuple[Fraction, dict[str, Fraction]], by: Fraction) -> tuple[Fraction, dict[str, Fraction]]:
    constant, factors = terms
    return constant * by, {name: factor * by for name, factor in factors.items() if by}


def scale_rule(scale: Scale, resolve: Resolve) -> Linear:
    """Return the rule from value to raw; the scale may be written for either side. Raises FormulaError."""
    rule = linear(scale.expression, scale.variable, resolve)
    if scale.side == "raw":
        return rule
    try:
        return invert(rule)
    except FormulaError as error:
        raise FormulaError(error.message, scale.uses[0].column if scale.uses else 0, error.hint) from None


def invert(rule: Linear) -> Linear:
    """Return the inverse rule. Raises FormulaError (column 0) if its offset would depend on a point."""
    if rule.ratio == 0:
        raise FormulaError("a rule without slope cannot be inverted", 0)
    if rule.factors and rule.offset:
        points = " and ".join(f"`{point}`" for point in dict.fromkeys(factor.point for factor in rule.factors))
        message = f"the inverse has an offset that depends on {points}"
        raise FormulaError(message, 0, "a rule with run-time factors has an offset only where it is written raw = ...")
    factors = tuple(replace(factor, power=-factor.power) for factor in rule.factors)
    return Linear(1 / rule.ratio, -rule.offset / rule.ratio, factors)


def _linear(term: Term, expression: Expression) -> Linear:
    """Return the rule of a term, with its factors in the order of the text."""
    column = _start(expression)
    factors = tuple(
        replace(factor, power=1 if power > 0 else -1)
        for factor, power in term.product.items()
        for _ in range(abs(power))
    )
    sizes = map(int.bit_length, (*term.coefficient.as_integer_ratio(), *term.offset.as_integer_ratio()))
    if max(sizes) > MOST_BITS:
        raise FormulaError("the numbers of this formula are too large", column)
    return Linear(term.coefficient, term.offset, factors)


def _start(expression: Expression) -> int:
    """Return the column of the leftmost operand of an expression."""
    while isinstance(expression, Binary):
        expression = expression.left
    return expression.column


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
    return Term(slope, intercept, 0, {Factor(point, 1, 0, 1, ten_to=False): 1})


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
    factor = Factor(point, slope.numerator, intercept.numerator, 1, ten_to=True)
    if slope == 0:
        if abs(intercept) > MOST_EXPONENT:
            raise FormulaError(f"the exponent `{exponent.name}` is too large", exponent.column)
        return number(Fraction(10) ** (sign * factor.intercept))
    return Term(Fraction(1), Fraction(0), 0, {factor: sign})


def _resolved(name: Name, resolve: Resolve) -> Affine:
    if name.name in VARIABLES:
        raise UnknownNameError(f"`{name.name}` is not known here", name.column, "name a point")
    try:
        return resolve(name.name, name.part)
    except FormulaError as error:
        error.column = name.column
        raise
