"""The rules of a behaviour as data: targets, conditions, rates and delays."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Literal

from fieldscribe.arithmetic.codec import MOST_EXPONENT
from fieldscribe.conditions import TESTS
from fieldscribe.language.formula.syntax import Binary, Expression, Name, Negate, Number, Power10
from fieldscribe.model import Flag

ZERO = Fraction(0)
TIME = "time"
"""The name of the time: seconds since the start of the simulation."""

Pair = tuple[Fraction, Fraction]
"""A number and its change per second."""


@dataclass(frozen=True, slots=True)
class Ref:
    """A resolved name: the value of a point in its unit, its raw number, a flag of it, a quantity, or the time.

    `unit` is its symbol; empty for plain numbers.
    """

    name: str
    kind: Literal["value", "raw", "flag", "plant", "time"]
    flag: Flag | None = field(default=None, compare=False)
    unit: str = field(default="", compare=False)
    flag_name: str = ""


@dataclass(frozen=True, slots=True)
class Test:
    """Compares a number with constants; the test `in` takes several."""

    ref: Ref
    op: str
    constants: tuple[Fraction, ...]

    def holds(self, number: Fraction) -> bool:
        """Return True if the comparison is true for a number."""
        return number in self.constants if self.op == "in" else TESTS[self.op](number, self.constants[0])


@dataclass(frozen=True, slots=True)
class Amount:
    """An expression, and the factor that turns it into the unit of the point, or into seconds."""

    expression: Expression
    refs: Mapping[Name, Ref]
    factor: Fraction = Fraction(1)

    def at(self, read: Callable[[Ref], Pair]) -> Pair:
        """Return the number and its slope. Raises ArithmeticError: for a zero divisor, or a large exponent."""
        number, slope = _evaluated(self.expression, lambda name: read(self.refs[name]))
        return number * self.factor, slope * self.factor


@dataclass(frozen=True, eq=False, slots=True)
class Step:
    """One move: to a target, at once or at a rate (up, down), while one of the clauses is true.

    With `once`, it happens when they become true. `delay` is how long they must be true before, in seconds.
    """

    target: Amount
    rates: tuple[Amount, ...]
    clauses: tuple[tuple[Test, ...], ...]
    once: bool
    delay: Amount | None

    @property
    def refs(self) -> list[Ref]:
        """Return all names that it reads."""
        amounts = [self.target, *self.rates, *([] if self.delay is None else [self.delay])]
        compared = [test.ref for clause in self.clauses for test in clause]
        return [*(ref for amount in amounts for ref in amount.refs.values()), *compared]


@dataclass(frozen=True, slots=True)
class Rule:
    """The moves of one number; the first that applies is used."""

    ref: Ref
    steps: tuple[Step, ...]

    @property
    def delays(self) -> bool:
        """Return True if a move has a delay."""
        return any(step.delay is not None for step in self.steps)


@dataclass(frozen=True, slots=True)
class Quantity:
    """A quantity of the behaviour, which is no point: its number at the start, its unit's symbol, and its title."""

    start: Fraction
    unit: str
    title: str


@dataclass(frozen=True, slots=True)
class Rules:
    """What a simulated device does. `start` has values in the unit, or raw numbers of names, by point."""

    plant: Mapping[str, Quantity]
    start: Mapping[str, Fraction]
    rules: tuple[Rule, ...]


def _evaluated(expression: Expression, read: Callable[[Name], Pair]) -> Pair:
    """Return the number of an expression and its slope."""
    match expression:
        case Number(value):
            return value, ZERO
        case Name():
            return read(expression)
        case Negate(operand):
            number, slope = _evaluated(operand, read)
            return -number, -slope
        case Power10(exponent, negative):
            number, _ = _evaluated(exponent, read)
            if abs(number) > MOST_EXPONENT:
                raise OverflowError
            return Fraction(10) ** (-int(number) if negative else int(number)), ZERO
        case Binary(op, left, right):
            return _joined(op, _evaluated(left, read), _evaluated(right, read))


def _joined(op: str, left: Pair, right: Pair) -> Pair:
    (first, first_slope), (second, second_slope) = left, right
    if op == "+":
        return first + second, first_slope + second_slope
    if op == "-":
        return first - second, first_slope - second_slope
    if op == "*":
        return first * second, first_slope * second + first * second_slope
    return first / second, (first_slope * second - first * second_slope) / (second * second)
