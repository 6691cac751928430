"""The tree of a formula. Columns are offsets in its text, from 0, and take no part in equality."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from typing import Literal, TypeAlias


class FormulaError(ValueError):
    """A formula cannot be parsed or used. `column` is the offset in its text, from 0; `hint` may be empty."""

    def __init__(self, message: str, column: int, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.column = column
        self.hint = hint


class UnknownNameError(FormulaError):
    """A formula has a name that is not known where it stands."""


class NoSumError(FormulaError):
    """A formula is no sum of multiples of names."""

    def __init__(self, column: int) -> None:
        super().__init__("this is no sum of multiples", column)


class ZeroDivisorError(FormulaError):
    """A formula divides by the constant 0."""

    def __init__(self, column: int) -> None:
        super().__init__("division by zero", column, "divide by another number")


Part = Literal["value", "raw"]
"""Which number of a point a name stands for."""


@dataclass(frozen=True, slots=True)
class Number:
    """A constant."""

    value: Fraction
    column: int = field(compare=False)


@dataclass(frozen=True, slots=True)
class Name:
    """A point by code or name, or a variable of the rule (`raw`, `wire`, `base`); `part` defaults to `value`."""

    name: str
    part: Part
    column: int = field(compare=False)


@dataclass(frozen=True, slots=True)
class Negate:
    """Minus an expression."""

    operand: Expression
    column: int = field(compare=False)


@dataclass(frozen=True, slots=True)
class Binary:
    """Two expressions and the operator between them, with its column."""

    op: Literal["+", "-", "*", "/"]
    left: Expression
    right: Expression
    column: int = field(compare=False)


@dataclass(frozen=True, slots=True)
class Power10:
    """Ten to the power of a whole number or of a point, either with a sign."""

    exponent: Number | Name
    negative: bool
    column: int = field(compare=False)


Expression: TypeAlias = Number | Name | Negate | Binary | Power10


@dataclass(frozen=True, slots=True)
class Scale:
    """`side` = expression of the other side; `uses` are the points it reads at run time, in the order of the text."""

    side: Part
    expression: Expression
    uses: tuple[Name, ...]

    @property
    def variable(self) -> Part:
        """The other side: the variable of the expression."""
        return "value" if self.side == "raw" else "raw"


@dataclass(frozen=True, slots=True)
class Range:
    """Intervals low..high in the order of the text; `listed` if the author wrote only single numbers."""

    alternatives: tuple[tuple[Expression, Expression], ...]
    listed: bool


def names(expression: Expression) -> tuple[Name, ...]:
    """Return all names of an expression in the order of the text, with repetitions."""
    match expression:
        case Name():
            return (expression,)
        case Power10(Name() as exponent):
            return (exponent,)
        case Negate(operand):
            return names(operand)
        case Binary(_, left, right):
            return names(left) + names(right)
    return ()
