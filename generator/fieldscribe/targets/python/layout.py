"""Lays out Python expressions as formatters do: on one line if they fit, else with a line for each item."""

import textwrap
from collections.abc import Sequence

from fieldscribe.targets.runtime_calls.scope import Branch, Call, Hex, Leaf, Name, Node
from fieldscribe.text import python_doc, python_string

WIDTH = 88
"""The narrowest common line length, so that formatters with longer lines change nothing either."""

DOC = WIDTH - 4 - 6
"""The width of a docstring inside a class, less the indentation and two triple quotes."""


_LITERAL = 64
"""The longest parameter of a type: longer ones would have to be broken."""


def comment(text: str) -> str:
    """Return text for a `#` comment, in which no second `#` can start a directive for some tool."""
    return python_doc(text).replace("#", "")


def laid_out(node: Node, indent: int, before: str = "") -> str:
    """Return the lines of the expression at that indentation, with room for a comma after it.

    `before` precedes the expression on its line, such as `allowed=`.
    """
    if node is None or isinstance(node, (str, int, float)):
        return before + leaf(node)
    line = before + flat(node)
    return line if indent + len(line) < WIDTH else _spread(node, indent, before)


def arguments(made: Call, indent: int) -> tuple[str, ...]:
    """Return the lines of each argument of a call that stands on its own line."""
    return tuple([laid_out(item, indent, before) for before, item in _items(made)])


def _spread(node: Branch, indent: int, before: str) -> str:
    """Return a line for each item.

    A tuple of a single item is spread only if the item is spread itself: formatters with longer lines would join it
    again, even with a comma after the item.
    """
    (opening, closing), items, inner = _brackets(node), _items(node), " " * (indent + 4)
    only = node[0] if isinstance(node, tuple) and len(node) == 1 else None
    if only is not None and not isinstance(only, (str, int, float)) and _items(only):
        lines = f"{inner}{_spread(only, indent + 4, '')},\n"
    else:
        lines = "".join([f"{inner}{laid_out(item, indent + 4, key)},\n" for key, item in items])
    return f"{before}{opening}\n{lines}{' ' * indent}{closing}"


def flat(node: Node) -> str:
    """Return the expression on one line."""
    if node is None or isinstance(node, (str, int, float)):
        return leaf(node)
    opening, closing = _brackets(node)
    comma = "," if isinstance(node, tuple) and len(node) == 1 else ""
    return f"{opening}{', '.join([key + flat(item) for key, item in _items(node)])}{comma}{closing}"


def _brackets(node: Branch) -> tuple[str, str]:
    if isinstance(node, Call):
        return f"{node.name}{_parameter(node.literals)}(", ")"
    return ("(", ")") if isinstance(node, tuple) else ("{", "}")


def _parameter(literals: tuple[str, ...]) -> str:
    """Return a `Literal` of these texts as the parameter of a type; empty if it does not fit on a line."""
    text = f"[Literal[{', '.join(map(python_string, literals))}]]" if literals else ""
    return text if len(text) <= _LITERAL else ""


def _items(node: Branch) -> list[tuple[str, Node]]:
    """Return the items, each with its keyword or its key."""
    if isinstance(node, tuple):
        return [("", item) for item in node]
    if isinstance(node, Call):
        keywords = [(f"{name}=", item) for name, item in node.keywords.items()]
        return [("", item) for item in node.positional] + keywords
    return [(f"{flat(key)}: ", item) for key, item in node.items()]


def leaf(node: Leaf) -> str:
    """Return a name, a string or a number as text."""
    if isinstance(node, str):
        return node if isinstance(node, Name) else python_string(node)
    if isinstance(node, Hex):
        return f"0x{node:0{node.digits}X}"
    return repr(node)


def wrapped(text: str) -> list[str]:
    """Return the lines of a docstring inside a class."""
    return [text] if len(text) <= DOC else textwrap.wrap(text, DOC, break_long_words=False, break_on_hyphens=False)


def docstring(lines: Sequence[str]) -> str:
    """Return a docstring inside a class."""
    first, *others = lines
    if not others:
        return f'    """{first}"""'
    return "\n".join([f'    """{first}', *(f"    {line}" if line else "" for line in others), '    """'])


def imported(module: str, names: Sequence[str]) -> tuple[str, ...]:
    """Return the lines of an import."""
    line = f"from {module} import {', '.join(names)}"
    return (line,) if len(line) <= WIDTH else (f"from {module} import (", *(f"    {name}," for name in names), ")")
