"""Turns conditions of templates into those of descriptions: `isDefined(a)==0||b!=2`, `not exists(a) or b != 2`."""

import ast
import re
from collections.abc import Sequence
from typing import Protocol, TypeAlias

from fieldscribe.conditions import TESTS

Condition: TypeAlias = str | bool
"""A condition as a description writes it; or True or False if it is constant."""

_LONGEST = 4000
_SIGNS = {ast.Eq: "==", ast.NotEq: "!=", ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}
_FLIPPED = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}


class Names(Protocol):
    """The meaning of parameter names of a template in the description."""

    def compared(self, name: str, sign: str, number: int) -> Condition:
        """Return the condition that compares a parameter with a number."""

    def defined(self, name: str) -> Condition:
        """Return the condition that a parameter exists."""


def condition_of(text: str, names: Names) -> Condition:
    """Return the condition of a template as a description writes it. Raises ValueError if it cannot be read."""
    if len(text) > _LONGEST:
        raise ValueError(f"it has more than {_LONGEST} characters")
    python = re.sub("!(?!=)", " not ", text.replace("&&", " and ").replace("||", " or "))
    try:
        return _condition(ast.parse(python.strip(), mode="eval").body, names)
    except (SyntaxError, RecursionError, MemoryError) as error:
        raise ValueError("it is not understood") from error


def any_of(parts: Sequence[Condition]) -> Condition:
    """Return the condition that one of these is true."""
    if True in parts:
        return True
    listed: dict[str, list[str]] = {}
    for text in (text for part in parts if isinstance(part, str) for text in _alternatives(part)):
        match = re.fullmatch(r"([\w.]+) (?:== (-?[\d.]+)|in \((.*)\))", text)
        listed.setdefault(match[1] if match else text, []).extend((match[2] or match[3]).split(", ") if match else [])
    return " or ".join(_one_of(name, list(dict.fromkeys(numbers))) for name, numbers in listed.items()) or False


def _alternatives(condition: str) -> list[str]:
    return [condition] if " and " in condition or "not (" in condition else condition.split(" or ")


def _one_of(name: str, numbers: Sequence[str]) -> str:
    if len(numbers) < 2:
        return " == ".join((name, *numbers))
    return f"{name} in ({', '.join(numbers)})"


def _all_of(parts: Sequence[Condition]) -> Condition:
    """Return the condition that all of these are true, without parts that others imply."""
    if False in parts:
        return False
    texts = list(dict.fromkeys(part for part in parts if isinstance(part, str)))
    known = {f"not ({text})" for text in texts}
    texts = [" or ".join(part for part in text.split(" or ") if part not in known) for text in texts]
    return " and ".join(f"({text})" if " or " in text and len(texts) > 1 else text for text in texts) or True


def _condition(node: ast.expr, names: Names) -> Condition:
    """Return the condition for a part of a template's condition. Raises ValueError."""
    match node:
        case ast.BoolOp(op=ast.And(), values=values):
            return _all_of([_condition(value, names) for value in values])
        case ast.BoolOp(values=values):
            return any_of([_condition(value, names) for value in values])
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return opposite(_condition(operand, names))
        case ast.Call(func=ast.Name(id="isDefined"), args=[ast.Name(id=name)], keywords=[]):
            return names.defined(name)
        case ast.Compare(left=left, ops=[sign], comparators=[right]) if type(sign) in _SIGNS:
            return _comparison(left, _SIGNS[type(sign)], right, names)
    raise ValueError(f"`{ast.unparse(node)[:40]}` is not understood")


def _comparison(left: ast.expr, sign: str, right: ast.expr, names: Names) -> Condition:
    match _number(left), _number(right):
        case int() as first, int() as second:
            return TESTS[sign](first, second)
        case int(), None:
            return _comparison(right, _FLIPPED.get(sign, sign), left, names)
        case None, int() as number if isinstance(left, ast.Name):
            return names.compared(left.id, sign, number)
        case None, int() as number:
            condition = _condition(left, names)
            one, zero = TESTS[sign](1, number), TESTS[sign](0, number)
            return one if one == zero else condition if one else opposite(condition)
    raise ValueError("a name is compared with no number")


def _number(node: ast.expr) -> int | None:
    if (
        isinstance(node, ast.UnaryOp)
        and isinstance(node.op, ast.USub)
        and (number := _number(node.operand)) is not None
    ):
        return -number
    return node.value if isinstance(node, ast.Constant) and type(node.value) is int else None


def opposite(condition: Condition) -> Condition:
    """Return the opposite of a condition."""
    if isinstance(condition, bool):
        return not condition
    return f"not {condition}" if re.fullmatch(r"exists\(\w+\)", condition) else f"not ({condition})"
