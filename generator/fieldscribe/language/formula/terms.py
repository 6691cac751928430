"""Calculates with terms of one shape: coefficient * variable * product of run-time factors + offset, all exact."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from math import gcd, lcm
from typing import TYPE_CHECKING, NamedTuple, NoReturn

from fieldscribe.language.formula.syntax import FormulaError

if TYPE_CHECKING:
    from collections.abc import Mapping

SHAPE = "supported is number * product of points + number, where a factor may be (number * point + number)"
LINEAR_ONLY = "only a rule that is linear in the variable can be inverted"


class Symbol(NamedTuple):
    """A run-time number: raw * slope + intercept of a point, or ten to this power. Slope > 0, no common divisor."""

    point: str
    slope: int
    intercept: int
    ten_to: bool


@dataclass(frozen=True, slots=True)
class Term:
    """A term; `variable` is 0 or 1: coefficient * (the variable) ** variable * product + offset.

    A constant has coefficient 0. If the product is a single point, the term is open: slope and intercept of the point
    are part of coefficient and offset, so that terms with the same point can be added.
    """

    coefficient: Fraction
    offset: Fraction
    variable: int = 0
    product: Mapping[Symbol, int] = field(default_factory=dict)

    @property
    def constant(self) -> bool:
        """Whether the term is a known number."""
        return self.coefficient == 0

    @property
    def points(self) -> str:
        """The points of the product, as messages name them."""
        return " and ".join(f"`{point}`" for point in dict.fromkeys(symbol.point for symbol in self.product))


def number(value: Fraction) -> Term:
    """A constant."""
    return Term(Fraction(0), value)


def scaled(term: Term, by: Fraction) -> Term:
    """A term times a constant."""
    if by == 0:
        return number(by)
    return Term(term.coefficient * by, term.offset * by, term.variable, term.product)


def add(left: Term, right: Term, column: int) -> Term:
    """The sum of two terms with the same variable and product, or of a term and a constant. Raises FormulaError."""
    if not (left.constant or right.constant) and (left.variable, left.product) != (right.variable, right.product):
        _refuse_sum(left, right, column)
    coefficient, offset = left.coefficient + right.coefficient, left.offset + right.offset
    if coefficient == 0:
        return number(offset)
    shape = right if left.constant else left
    return Term(coefficient, offset, shape.variable, shape.product)


def multiply(left: Term, right: Term, column: int) -> Term:
    """The product of two terms. Raises FormulaError."""
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
    for symbol, power in right.product.items():
        _raise_power(product, symbol, power, column)
    return _opened(left.coefficient * right.coefficient, left.variable + right.variable, product)


def reciprocal(term: Term, column: int) -> Term:
    """One divided by a term. Raises FormulaError."""
    if term.constant:
        if term.offset == 0:
            raise FormulaError("division by zero", column)
        return number(1 / term.offset)
    if term.variable:
        raise FormulaError("not linear: the variable stands in a divisor", column, LINEAR_ONLY)
    closed = _closed(term, column)
    return _opened(1 / closed.coefficient, 0, {symbol: -power for symbol, power in closed.product.items()})


def _closed(term: Term, column: int) -> Term:
    """The same term without an offset: the offset becomes the intercept of its point."""
    if term.offset == 0:
        return term
    (symbol, power), *others = term.product.items()
    if others or symbol.ten_to or power != 1:
        raise FormulaError("a sum of points and numbers is a factor only if it has one point", column, SHAPE)
    common = lcm(term.coefficient.denominator, term.offset.denominator)
    slope, intercept = int(term.coefficient * common), int(term.offset * common)
    divisor = gcd(slope, intercept) * (1 if slope > 0 else -1)
    closed = Symbol(symbol.point, slope // divisor, intercept // divisor, False)
    return Term(Fraction(divisor, common), Fraction(0), 0, {closed: 1})


def _opened(coefficient: Fraction, variable: int, product: dict[Symbol, int]) -> Term:
    """The term with this product; if that is a single point, the term is open (see `Term`)."""
    if not variable and len(product) == 1:
        (symbol, power) = next(iter(product.items()))
        if power == 1 and not symbol.ten_to:
            opened = {Symbol(symbol.point, 1, 0, False): 1}
            return Term(coefficient * symbol.slope, coefficient * symbol.intercept, 0, opened)
    if not variable and not product:
        return number(coefficient)
    return Term(coefficient, Fraction(0), variable, product)


def _raise_power(product: dict[Symbol, int], symbol: Symbol, power: int, column: int) -> None:
    """Multiply a product by a factor. A power of ten may cancel; a point may not, for it could be zero."""
    before = product.get(symbol, 0)
    if before * power < 0 and not symbol.ten_to:
        raise FormulaError(f"`{symbol.point}` is multiplied and divided by", column, "leave out what cancels")
    if before + power:
        product[symbol] = before + power
    else:
        del product[symbol]


def _refuse_sum(left: Term, right: Term, column: int) -> NoReturn:
    if left.variable and right.variable:
        hint = "write the variable once, times a sum: value * (POINT + 1)"
        raise FormulaError("the variable stands in two products", column, hint)
    if left.variable or right.variable:
        point = right.points if left.variable else left.points
        raise FormulaError(f"the offset depends on {point}", column, SHAPE)
    raise FormulaError(f"a sum of different run-time terms: {left.points} and {right.points}", column, SHAPE)
