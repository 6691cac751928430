"""Parses conditions: comparisons of a name with constants, joined by and, or, not; without arithmetic."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import TYPE_CHECKING, TypeAlias

from fieldscribe.language.formula.parser import VARIABLES, Parser
from fieldscribe.language.formula.syntax import FormulaError, Name
from fieldscribe.language.formula.tokens import Token, number

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from fractions import Fraction

_COMPARISONS = ("==", "!=", "<", "<=", ">", ">=")
_NO_ARITHMETIC = "a condition compares a name with constants: P1 == 2, P1 in (1, 2), P1 >= 3 and not P2 == 0"
_WORDS = ("and", "or", "not", "in")
_OPPOSITES = {"==": "!=", "!=": "==", "<": ">=", ">=": "<", ">": "<=", "<=": ">"}
_NAME = re.compile(r"[A-Za-z0-9_]+")
_MOST_CLAUSES = 64


@dataclass(frozen=True, slots=True)
class Constant:
    """A number, or a word that names one (an entry of an enum); `text` is as written (`550`, `400V`)."""

    value: Fraction | str
    column: int = field(compare=False)
    text: str = field(compare=False, default="")


@dataclass(frozen=True, slots=True)
class Comparison:
    """A name against constants; `op` is one of == != < <= > >= (one constant) or `in` (one or more)."""

    name: Name
    op: str
    constants: tuple[Constant, ...]
    column: int = field(compare=False)


@dataclass(frozen=True, slots=True)
class Not:
    """True if the operand is false."""

    operand: Condition


@dataclass(frozen=True, slots=True)
class AllOf:
    """True if all parts are true."""

    parts: tuple[Condition, ...]


@dataclass(frozen=True, slots=True)
class AnyOf:
    """True if one of the parts is true."""

    parts: tuple[Condition, ...]


Condition: TypeAlias = Comparison | Not | AllOf | AnyOf


@lru_cache(maxsize=4096)
def parse_condition(text: str) -> Condition:
    """Return the condition of a text; `not` binds tightest, then `and`, then `or`. Raises FormulaError."""
    parser = Parser(text)
    condition = _any(parser)
    parser.finish(_NO_ARITHMETIC)
    return condition


@lru_cache(maxsize=4096)
def parse_case(text: str) -> tuple[Name, int]:
    """Parse the case of a scale, `NAME == constant`; return the name and the raw number. Raises FormulaError."""
    how = "a case is written NAME == constant, on the raw number"
    parser = Parser(text)
    if parser.token.part == "value":
        raise FormulaError("a case compares the raw number", parser.token.column, how)
    case = _comparison(parser)
    parser.finish(how)
    constant = case.constants[0]
    if case.op != "==":
        raise FormulaError(f"a case knows ==, not {case.op}", case.column, how)
    if isinstance(constant.value, str) or constant.value.denominator != 1:
        raise FormulaError("a case compares with a whole number", constant.column, how)
    return Name(case.name.name, "raw", case.name.column), constant.value.numerator


def condition_names(condition: Condition) -> tuple[Name, ...]:
    """Return all names that a condition compares, in the order of the text, with repetitions."""
    return tuple(comparison.name for comparison in _comparisons(condition))


def _comparisons(condition: Condition) -> Iterator[Comparison]:
    match condition:
        case Comparison():
            yield condition
        case Not(operand):
            yield from _comparisons(operand)
        case AllOf(parts) | AnyOf(parts):
            for part in parts:
                yield from _comparisons(part)


def _any(parser: Parser) -> Condition:
    parts = _joined(parser, "or", _all)
    return parts[0] if len(parts) == 1 else AnyOf(parts)


def _all(parser: Parser) -> Condition:
    parts = _joined(parser, "and", _one)
    return parts[0] if len(parts) == 1 else AllOf(parts)


def _joined(parser: Parser, word: str, read: Callable[[Parser], Condition]) -> tuple[Condition, ...]:
    parts = [read(parser)]
    while parser.sees_word(word):
        parser.take()
        parts.append(read(parser))
    return tuple(parts)


def _one(parser: Parser) -> Condition:
    if parser.sees_word("not"):
        parser.nest()
        parser.take()
        return Not(_one(parser))
    if parser.sees("("):
        parser.nest()
        parser.take()
        inside = _any(parser)
        if not parser.accept(")"):
            parser.refuse("`)`", _NO_ARITHMETIC)
        return inside
    return _comparison(parser)


def _comparison(parser: Parser) -> Comparison:
    token = parser.token
    if token.kind != "name" or token.text in _WORDS:
        parser.refuse("a name", "the name stands on the left" if token.kind == "number" else _NO_ARITHMETIC)
    name = parser.name()
    if name.name in VARIABLES:
        raise FormulaError(f"`{name.name}` is not known in a condition", name.column, "name a point")
    op = parser.token
    if parser.sees_word("in"):
        parser.take()
        return Comparison(name, "in", _set(parser), op.column)
    if not parser.sees(*_COMPARISONS):
        parser.refuse("a comparison", "equality is written ==" if parser.sees("=") else _NO_ARITHMETIC)
    parser.take()
    constant = _constant(parser)
    if isinstance(constant.value, str) and op.text not in ("==", "!="):
        raise FormulaError("a word has no order", constant.column, "compare it with == or !=")
    return Comparison(name, op.text, (constant,), op.column)


def _set(parser: Parser) -> tuple[Constant, ...]:
    if not parser.accept("("):
        parser.refuse("`(`", "write NAME in (1, 2, 3)")
    constants = [_constant(parser)]
    while parser.accept(","):
        constants.append(_constant(parser))
    if not parser.accept(")"):
        parser.refuse("`,` or `)`", "write NAME in (1, 2, 3)")
    return tuple(constants)


def _constant(parser: Parser) -> Constant:
    column = parser.token.column
    negative = parser.sees("-")
    if negative or parser.sees("+"):
        parser.take()
    elif parser.token.kind == "name" and parser.token.text not in _WORDS:
        if parser.token.part:
            parser.refuse("a constant", "a condition compares with constants, not with other points")
        word = parser.take().text
        return Constant(word, column, word)
    if parser.token.kind != "number":
        parser.refuse("a constant", _NO_ARITHMETIC)
    token = parser.take()
    try:
        value = number(token)
    except FormulaError:
        if negative or not _NAME.fullmatch(token.text):
            raise
        return Constant(token.text, column, token.text)  # `400V` may name the value of a variant
    return Constant(-value if negative else value, column, f"-{token.text}" if negative else token.text)


def wrong_number(text: str, column: int) -> FormulaError:
    """Return the error for a word that starts with a digit, where it can be no name."""
    try:
        number(Token("number", text, "", column))
    except FormulaError as error:
        return error
    return FormulaError(f"`{text}` is a number", column)


def clauses_of(condition: Condition) -> tuple[tuple[Comparison, ...], ...]:
    """Return the condition as an `or` of clauses, each an `and` of comparisons. Raises FormulaError for too many."""
    return _clauses(condition, turned=False)


def _clauses(condition: Condition, *, turned: bool) -> tuple[tuple[Comparison, ...], ...]:
    """Return the clauses of a condition, or of its opposite if `turned`."""
    match condition:
        case Comparison():
            return _turned(condition) if turned else ((condition,),)
        case Not(operand):
            return _clauses(operand, turned=not turned)
        case AllOf(parts) | AnyOf(parts):
            parts_clauses = [_clauses(part, turned=turned) for part in parts]
            if isinstance(condition, AnyOf) != turned:
                return tuple(clause for clauses in parts_clauses for clause in clauses)
            return _all_of(parts_clauses)


def _all_of(parts: list[tuple[tuple[Comparison, ...], ...]]) -> tuple[tuple[Comparison, ...], ...]:
    clauses: tuple[tuple[Comparison, ...], ...] = ((),)
    for part in parts:
        if len(clauses) * len(part) > _MOST_CLAUSES:
            column = part[0][0].column
            raise FormulaError(f"written out, this is more than {_MOST_CLAUSES} cases", column, "simplify it")
        clauses = tuple(first + second for first in clauses for second in part)
    return clauses


def _turned(comparison: Comparison) -> tuple[tuple[Comparison, ...], ...]:
    """Return the opposite of a comparison; the opposite of `in` is that no constant is equal."""
    if comparison.op == "in":
        return (tuple(replace(comparison, op="!=", constants=(each,)) for each in comparison.constants),)
    return ((replace(comparison, op=_OPPOSITES[comparison.op]),),)
