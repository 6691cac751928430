"""Numbers as manuals write them, formulas as exact fractions, and rounding to nearest with halves away from zero."""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable
from fractions import Fraction

_HEXADECIMAL = re.compile(r"[hH]'([0-9A-Fa-f]+)|0x([0-9A-Fa-f]+)|\b([0-9][0-9A-Fa-f]*|[A-F][0-9A-F]*)h\b")
_NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?(?:e[+-]?\d+)?(?![\w])")
_OPERATORS: dict[type[ast.operator], Callable[[Fraction, Fraction], Fraction]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}


def number(text: str) -> int:
    """A whole number in decimal, hexadecimal (`1028h`, `0x1028`, `H'33F`) or binary (`0b0101`)."""
    text = text.strip()
    if text.startswith("-"):
        return -number(text[1:])
    if found := _HEXADECIMAL.fullmatch(text):
        return int(found[1] or found[2] or found[3], 16)
    return int(text, 2) if text.startswith("0b") else int(text, 10)


def is_number(text: str) -> bool:
    """Whether it is a whole number."""
    try:
        number(text)
    except ValueError:
        return False
    return True


def evaluate(text: str, named: Callable[[str, str], Fraction]) -> Fraction:
    """The number that a formula is; `named` gives what a name and its part (`raw`, `value` or nothing) stand for."""
    text = _HEXADECIMAL.sub(lambda found: str(int(found[1] or found[2] or found[3], 16)), text)
    constants: list[Fraction] = []

    def keep(found: re.Match[str]) -> str:
        constants.append(Fraction(found[0]))
        return f"_constant_{len(constants) - 1}"

    names = {f"_constant_{place}": place for place in range(text.count(" ") * 4 + 16)}

    def of(node: ast.expr) -> Fraction:
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
            return of(node.left) ** int(of(node.right))
        if isinstance(node, ast.BinOp):
            return _OPERATORS[type(node.op)](of(node.left), of(node.right))
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            return -of(node.operand)
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            return named(node.value.id, node.attr)
        assert isinstance(node, ast.Name), ast.dump(node)
        return constants[names[node.id]] if node.id in names else named(node.id, "")

    return of(ast.parse(_NUMBER.sub(keep, text).strip(), mode="eval").body)


def line_of(text: str, argument: str, named: Callable[[str, str], Fraction]) -> tuple[Fraction, Fraction]:
    """The slope and the start of a formula that is a straight line in `argument`."""

    def at(position: int) -> Fraction:
        return evaluate(text, lambda name, part: Fraction(position) if name == argument else named(name, part))

    start, one, two = at(0), at(1), at(2)
    assert two - one == one - start, f"{text} is no straight line in {argument}"
    return one - start, start


def nearest(exact: Fraction) -> int:
    """The nearest whole number, halves away from zero."""
    size = (2 * abs(exact.numerator) + exact.denominator) // (2 * exact.denominator)
    return size if exact >= 0 else -size
