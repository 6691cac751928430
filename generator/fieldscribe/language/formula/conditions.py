"""Parses conditions, and moves, the rules of a behaviour.

A condition is comparisons of a name with constants and `exists(name)`, joined by and, or, not; no arithmetic. A move is
`set 1 when x == 1 after 2 s`, or `ramp to y at 10 Hz/s while x == 1`: between its words stand expressions, a condition
and a time.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import lru_cache
from typing import TypeAlias, TypeVar

from fieldscribe.conditions import OPPOSITES, TooManyClausesError, all_of, any_of
from fieldscribe.language.formula.parser import LONGEST, VARIABLES, Parser, Token, number, parse_expression
from fieldscribe.language.formula.syntax import Expression, FormulaError, Name

_COMPARISONS = ("==", "!=", "<", "<=", ">", ">=")
_NO_ARITHMETIC = "a condition compares a name with constants: P1 == 2, P1 in (1, 2), P1 >= 3 and not P2 == 0"
_WORDS = ("and", "or", "not", "in")
EXISTS, NOT_EXISTS = "exists", "not exists"
"""The tests of a comparison without constants: whether a point exists."""

_OPPOSITES = {**OPPOSITES, EXISTS: NOT_EXISTS}
_NAME = re.compile(r"[A-Za-z0-9_]+")


@dataclass(frozen=True, slots=True)
class Constant:
    """A number, or a word that names one (an entry of an enum); `text` is as written (`550`, `400V`)."""

    value: Fraction | str
    column: int = field(compare=False)
    text: str = field(compare=False, default="")


@dataclass(frozen=True, slots=True)
class Comparison:
    """A name against constants; `op` is one of == != < <= > >= (one constant) or `in` (one or more).

    Without constants it is `exists` or `not exists`. `key` is the property of a variant that is compared.
    """

    name: Name
    op: str
    constants: tuple[Constant, ...]
    column: int = field(compare=False)
    key: str = ""


Clauses: TypeAlias = tuple[tuple[Comparison, ...], ...]
"""A condition as an `or` of clauses, each an `and` of comparisons."""


@lru_cache(maxsize=4096)
def parse_condition(text: str) -> Clauses:
    """Return the clauses of a condition; `not` binds tightest, then `and`, then `or`. Raises FormulaError."""
    parser = Parser(text)
    clauses = _alternatives(parser, opposite=False)
    parser.finish(_NO_ARITHMETIC)
    return clauses


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


def _alternatives(parser: Parser, *, opposite: bool) -> Clauses:
    """Parse conditions joined by `or`; return their clauses, or those of the opposite."""
    parts = _joined(parser, "or", _conjunction, opposite=opposite)
    return _all_of(parts) if opposite else any_of(parts)


def _conjunction(parser: Parser, *, opposite: bool) -> Clauses:
    """Parse conditions joined by `and`; return their clauses, or those of the opposite."""
    parts = _joined(parser, "and", _operand, opposite=opposite)
    return any_of(parts) if opposite else _all_of(parts)


def _joined(parser: Parser, word: str, read: Callable[..., Clauses], *, opposite: bool) -> list[Clauses]:
    parts = [read(parser, opposite=opposite)]
    while parser.sees_word(word):
        parser.take()
        parts.append(read(parser, opposite=opposite))
    return parts


def _operand(parser: Parser, *, opposite: bool) -> Clauses:
    if parser.sees_word("not"):
        parser.nest()
        parser.take()
        return _operand(parser, opposite=not opposite)
    if parser.sees("("):
        parser.nest()
        parser.take()
        inside = _alternatives(parser, opposite=opposite)
        if not parser.accept(")"):
            parser.refuse("`)`", _NO_ARITHMETIC)
        return inside
    comparison = _existence(parser) or _comparison(parser)
    return _opposite(comparison) if opposite else ((comparison,),)


def _existence(parser: Parser) -> Comparison | None:
    """Parse `exists(NAME)`; None if something else stands there."""
    if not parser.sees_call(EXISTS):
        return None
    column = parser.take().column
    parser.take()
    if parser.token.kind != "name":
        parser.refuse("the name of a point", "write exists(NAME)")
    name = parser.name()
    if not parser.accept(")"):
        parser.refuse("`)`", "write exists(NAME)")
    return Comparison(name, EXISTS, (), column)


def _comparison(parser: Parser) -> Comparison:
    token = parser.token
    if token.kind != "name" or token.text in _WORDS:
        parser.refuse("a name", "the name stands on the left" if token.kind == "number" else _NO_ARITHMETIC)
    key = "" if token.part in ("raw", "value") else token.part
    if key:
        parser.take()
    name = Name(token.text, "value", token.column) if key else parser.name()
    if name.name in VARIABLES:
        raise FormulaError(f"`{name.name}` is not known in a condition", name.column, "name a point")
    op = parser.token
    if parser.sees_word("in"):
        parser.take()
        return Comparison(name, "in", _set(parser), op.column, key)
    if not parser.sees(*_COMPARISONS):
        parser.refuse("a comparison", "equality is written ==" if parser.sees("=") else _NO_ARITHMETIC)
    parser.take()
    constant = _constant(parser)
    if isinstance(constant.value, str) and op.text not in ("==", "!="):
        hint = "compare a word with == or !=; two points are not compared"
        raise FormulaError(f"`{constant.value}` is no number and has no order", constant.column, hint)
    return Comparison(name, op.text, (constant,), op.column, key)


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
    """Return the error for a word that starts with a digit where no name can start so."""
    try:
        number(Token("number", text, "", column))
    except FormulaError as error:
        return error
    return FormulaError(f"`{text}` is a number", column)


def _all_of(parts: list[Clauses]) -> Clauses:
    """Return the clauses that are true if all parts are. Raises FormulaError for too many."""
    try:
        return all_of(parts)
    except TooManyClausesError as error:
        raise FormulaError(str(error), parts[-1][0][0].column, "simplify it") from None


def _opposite(comparison: Comparison) -> Clauses:
    """Return the opposite of a comparison; the opposite of `in` is that no constant is equal."""
    if comparison.op == "in":
        return (tuple(replace(comparison, op="!=", constants=(each,)) for each in comparison.constants),)
    return ((replace(comparison, op=_OPPOSITES[comparison.op]),),)


_WORD = re.compile(r"(?:^|(?<=\s))(set|ramp to|down at|at|while|when|after)(?=\s|$)")
_ORDER = re.compile(r"(set|ramp to at( down at)?)( while| when)?( after)?")
_DOWN = re.compile(r",\s*(down)\b(?!\s+at\b)")
_HOW = "write `set …` or `ramp to … at …`; after it `, down at …`, `while …` or `when …`, `after …` as needed"
_WITH_UNIT = re.compile(r"(.*[\w)])\s+([^\W\d][^\s/]*(?:/[a-z]+)?|[%°‰][^\s/]*(?:/[a-z]+)?)")

Parsed = TypeVar("Parsed")


@dataclass(frozen=True, slots=True)
class Amount:
    """An expression with the unit after it (an empty text if there is none); it starts at this column of the move."""

    expression: Expression
    unit: str
    column: int


@dataclass(frozen=True, slots=True)
class Move:
    """What a point does while a condition holds, or `once` when it becomes true, after the time of the `delay`.

    It is set to the target, or moves there at a rate: upwards at the first of `rates`, downwards at the last.
    """

    target: Amount
    rates: tuple[Amount, ...]
    condition: Clauses
    condition_column: int
    once: bool
    delay: Amount | None


@lru_cache(maxsize=4096)
def parse_move(text: str) -> Move:
    """Return the move of a text. Raises FormulaError."""
    parts = _parts(text)
    condition_column, condition = parts.get("when") or parts.get("while") or (0, "")
    return Move(
        _amount(parts.get("set") or parts["ramp to"]),
        tuple([_amount(parts[word], has_unit=True) for word in ("at", "down at") if word in parts]),
        _at_column(parse_condition, condition, condition_column) if condition else (),
        condition_column,
        "when" in parts,
        _amount(parts["after"], has_unit=True) if "after" in parts else None,
    )


def _parts(text: str) -> dict[str, tuple[int, str]]:
    """Return the text after each word, with its column, in the order of the words."""
    if len(text) > LONGEST:
        raise FormulaError(f"a move has at most {LONGEST} characters", LONGEST, "split it")
    words = list(_WORD.finditer(text))
    if fault := _fault(text, [(word[1], word.start()) for word in words]):
        raise fault
    if not _ORDER.fullmatch(" ".join(word[1] for word in words)) or text[: words[0].start()].strip():
        raise FormulaError("this is no move", 0, _HOW)
    parts = {}
    for word, following in zip(words, [*words[1:], None], strict=True):
        part = text[word.end() : following.start() if following else None].rstrip()
        if following is not None and following[1] == "down at":
            part = part.removesuffix(",").rstrip()
        if not part.strip():
            raise FormulaError(f"nothing follows `{word[1]}`", word.start(), _HOW)
        parts[word[1]] = word.end() + len(part) - len(part.lstrip()), part.strip()
    return parts


def _fault(text: str, words: list[tuple[str, int]]) -> FormulaError | None:
    """Return the error for a common mistake in the words of a move; None if there is none of them."""
    columns = dict(words)
    if (down := _DOWN.search(text)) is not None:
        return FormulaError("`down` needs a rate", down.start(1), "write `, down at …`, as in `, down at 20 Hz/s`")
    if "ramp to" in columns and "at" not in columns:
        return FormulaError("the rate is missing", columns["ramp to"], "write `ramp to … at …`, as in `at 10 Hz/s`")
    if len(found := [column for word, column in words if word in ("while", "when")]) > 1:
        return FormulaError("a move has one condition", found[1], "join both by `and`, after `while` or `when`")
    return None


def _amount(part: tuple[int, str], *, has_unit: bool = False) -> Amount:
    column, text = part
    match = _WITH_UNIT.fullmatch(text) if has_unit else None
    text, unit = (text, "") if match is None else match.groups()
    return Amount(_at_column(parse_expression, text, column), unit, column)


def _at_column(parse: Callable[[str], Parsed], text: str, column: int) -> Parsed:
    """Parse a part of a move that starts at this column; an error has its column in the whole move."""
    try:
        return parse(text)
    except FormulaError as error:
        raise FormulaError(error.message, error.column + column, error.hint) from None
