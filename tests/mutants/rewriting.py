"""Changes of the compiler's own Python, beside those of tokens: what is returned, asked, compared and handed on."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator

from mutants.tokens import line_starts, span

Rewriting = tuple[str, ast.expr, str]
"""The sort of change, what it changes, and what stands there then."""

_COMPARISONS: dict[type[ast.cmpop], str] = {ast.In: "not in", ast.NotIn: "in", ast.Is: "is not", ast.IsNot: "is"}
_OTHERS = {"min": "max", "max": "min", "any": "all", "all": "any"}
_IN_ANY_ORDER = ("gcd", "lcm", "min", "max")
"""Functions whose arguments may change places."""
_LAID_OUT = ("binding", "assignment", "arm", "signature", "comparison", "calls", "called", "fields_of")
"""Functions that break lines; the column that they get first is held against rustfmt, where a line is that long."""


def rewritten(text: str) -> Iterator[tuple[str, int, int, str]]:
    """The sort of change, from where to where, and what stands there then."""
    starts, lines = line_starts(text), text.encode("utf-8").splitlines(keepends=True)
    tree = ast.parse(text)
    formatted = {part for node in ast.walk(tree) if isinstance(node, ast.JoinedStr) for part in ast.walk(node)}
    for node in ast.walk(tree):
        for what, changed, after in _rewritings(node):
            first, last = span(changed, starts, lines)
            if changed not in formatted or _is_there(text[first:last], changed):
                yield what, first, last, after


def unjudged(text: str) -> list[tuple[int, int]]:
    """Where nothing is changed: what states that something cannot be, for readers and the type checker."""
    starts, lines = line_starts(text), text.encode("utf-8").splitlines(keepends=True)
    impossible = (_stated_impossible(node) for node in ast.walk(ast.parse(text)))
    return [span(node, starts, lines) for node in impossible if node is not None]


def _stated_impossible(node: ast.AST) -> ast.stmt | ast.expr | None:
    if isinstance(node, ast.Raise):
        raised = node.exc.func if isinstance(node.exc, ast.Call) else node.exc
        states = isinstance(raised, ast.Name) and raised.id in ("AssertionError", "NotImplementedError")
        return node if states else None
    if isinstance(node, ast.keyword) and node.arg in ("strict", "maxsize"):
        return node.value
    if isinstance(node, ast.Assign) and _is_type(node.value):
        return node.value
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.args:
        first_is_for_others = node.func.id == "cast" or (node.func.id in _LAID_OUT and _is_number(node.args[0]))
        return node.args[0] if first_is_for_others else None
    return node if isinstance(node, ast.Assert) else None


def _is_number(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and type(node.value) is int


_GENERIC = (
    *("tuple", "list", "dict", "set", "frozenset", "type", "Callable", "Mapping", "Sequence", "Iterable", "Iterator"),
)


def _is_type(value: ast.expr) -> bool:
    """Whether it is the name of a type, which only the type checker reads: `tuple[str, "Owner"]`."""
    return isinstance(value, ast.Subscript) and isinstance(value.value, ast.Name) and value.value.id in _GENERIC


def _is_there(found: str, node: ast.expr) -> bool:
    """Whether the parser told the right place: inside formatted strings it may not."""
    try:
        return ast.dump(ast.parse(f"({found})", mode="eval").body) == ast.dump(node)
    except SyntaxError:
        return False


def _rewritings(node: ast.AST) -> Iterator[Rewriting]:
    match node:
        case ast.Return(value=ast.expr() as value) if not (isinstance(value, ast.Constant) and value.value is None):
            yield "return", value, "'?'" if _is_empty_text(value) else "None"
            if isinstance(value, ast.Compare | ast.BoolOp):
                yield "return", value, f"not ({ast.unparse(value)})"
        case ast.Compare(left=left, ops=[operator], comparators=[right]) if type(operator) in _COMPARISONS:
            after = f"{ast.unparse(left)} {_COMPARISONS[type(operator)]} {ast.unparse(right)}"
            yield "comparison", node, after
        case ast.BoolOp(values=values):
            for value in values:
                yield "part of a condition", node, f"({ast.unparse(value)})"
        case ast.While(test=test) | ast.If(test=test) | ast.IfExp(test=test):
            yield "condition", test, f"not ({ast.unparse(test)})"
        case ast.comprehension(ifs=ifs):
            for condition in ifs:
                yield from (("condition", condition, after) for after in ("True", f"not ({ast.unparse(condition)})"))
        case ast.Call():
            yield from _calls(node)


def _is_empty_text(value: ast.expr) -> bool:
    """`""`: None in its place is no less false, and the type checker tells."""
    return isinstance(value, ast.Constant) and value.value == ""


def _calls(node: ast.Call) -> Iterator[Rewriting]:
    """Two neighbouring arguments change places, and a function gives way to its opposite."""
    if isinstance(node.func, ast.Name) and node.func.id in _OTHERS:
        yield "function", node.func, _OTHERS[node.func.id]
    if isinstance(node.func, ast.Name) and node.func.id in _IN_ANY_ORDER and not node.keywords:
        return
    for first, second in zip(node.args, node.args[1:], strict=False):
        if not any(isinstance(one, ast.Starred) for one in (first, second)) and not _alike(first, second):
            swapped = [ast.unparse(one) for one in _exchanged(node.args, first, second)]
            named = [ast.unparse(keyword) for keyword in node.keywords]
            yield "arguments", node, f"{ast.unparse(node.func)}({', '.join([*swapped, *named])})"


def _exchanged(arguments: Iterable[ast.expr], first: ast.expr, second: ast.expr) -> Iterator[ast.expr]:
    for argument in arguments:
        yield second if argument is first else first if argument is second else argument


def _alike(first: ast.expr, second: ast.expr) -> bool:
    return ast.dump(first) == ast.dump(second)
