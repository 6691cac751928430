"""Parses the formulas of descriptions: expressions, scales and ranges. Pure functions, cached by their text."""

from __future__ import annotations

from functools import lru_cache

from fieldscribe.language.formula.errors import FormulaError
from fieldscribe.language.formula.parser import VARIABLES, Parser
from fieldscribe.language.formula.syntax import Binary, Expression, Number, Range, Scale, names

_CACHED = 16384


@lru_cache(maxsize=_CACHED)
def parse_expression(text: str, column0: int = 0) -> Expression:
    """Numbers and names with + - * /, 10 ** n and parentheses; columns count from `column0`. Raises FormulaError."""
    parser = Parser(text, column0)
    expression = parser.expression()
    parser.finish()
    return expression


@lru_cache(maxsize=_CACHED)
def parse_scale(text: str) -> Scale:
    """A scale `raw = <expression of value>` or `value = <expression of raw>`. Raises FormulaError."""
    parser = Parser(text)
    side = parser.token
    how = "write raw = <expression of value> or value = <expression of raw>"
    if side.kind != "name" or side.text not in VARIABLES or side.part:
        parser.refuse("`raw =` or `value =`", how)
    parser.take()
    if not parser.accept("="):
        parser.refuse("`=`", "a scale has one =" if parser.sees("==") else how)
    expression = parser.expression()
    parser.finish()
    uses = names(expression)
    for name in uses:
        if name.name == side.text:
            raise FormulaError(f"`{side.text}` stands on both sides", name.column, how)
    return Scale(
        "raw" if side.text == "raw" else "value", expression, tuple(name for name in uses if name.name not in VARIABLES)
    )


@lru_cache(maxsize=_CACHED)
def parse_range(text: str) -> Range:
    """Alternatives between `|` or `,`, each `low..high` or one expression. Raises FormulaError."""
    parser = Parser(text)
    alternatives = []
    listed = True
    while True:
        low = high = parser.fresh_expression()
        if parser.accept(".."):
            listed = False
            high = parser.fresh_expression()
        elif isinstance(low, Binary) and low.op == "-" and not names(low):
            raise FormulaError("a minus sign between two numbers", low.column, "an interval is written low..high")
        alternatives.append((low, high))
        if not (parser.accept(",") or parser.accept("|")):
            break
    parser.finish(_hint_for_range(parser))
    for low, high in alternatives:
        for name in (*names(low), *names(high)):
            if name.name in VARIABLES:
                raise FormulaError(f"`{name.name}` is not known in a range", name.column, "name a point or a number")
    return Range(tuple(alternatives), listed)


def _hint_for_range(parser: Parser) -> str:
    if parser.sees(".."):
        return "an interval has one low and one high end; write | between two intervals"
    if parser.token.kind == "name" and parser.token.text in ("to", "bis", "a", "or", "and", "und", "oder"):
        return "an interval is written low..high, alternatives with |"
    return ""


def constant(expression: Expression) -> bool:
    """Whether an expression depends on no point."""
    return isinstance(expression, Number) or not names(expression)
