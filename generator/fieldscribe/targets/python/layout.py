"""Python expressions laid out as by a formatter: on one line if they fit, else with a line for each item."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from fieldscribe.text import python_doc

WIDTH = 88
"""The narrowest common line length, so that formatters with longer lines change nothing either."""

DOC = WIDTH - 4 - 6
"""The width of a docstring inside a class, less the indentation and two triple quotes."""


@dataclass(frozen=True, slots=True)
class Group:
    """A call, tuple or dict: its opening (`Rule(`, `allowed=(`), its items, its closing, and whether it is a call."""

    head: str
    items: tuple[Node, ...]
    close: str = ")"
    calls: bool = False

    @property
    def is_tuple(self) -> bool:
        """True for a tuple: a single item then needs a comma behind it."""
        return self.close == ")" and not self.calls


Node = str | Group


def comment(text: str) -> str:
    """Return text for a `#` comment, in which no second `#` can start a directive for some tool."""
    return python_doc(text).replace("#", "")


def call(head: str, items: Iterable[Node]) -> Group:
    """Return a call of `head`."""
    return Group(f"{head}(", tuple(items), calls=True)


def assigned(name: str, node: Group) -> Group:
    """Return the assignment of the expression to a name."""
    return replace(node, head=f"{name} = {node.head}")


def laid_out(node: Node, indent: int) -> str:
    """Return the lines of the expression at that indentation, with room for a comma behind it."""
    if isinstance(node, str):
        return node
    line = flat(node)
    return line if indent + len(line) < WIDTH else _spread(node, indent)


def _spread(node: Group, indent: int) -> str:
    """Return a line for each item.

    A tuple of a single item is spread only if the item is spread itself: formatters with longer lines would join it
    again, even with a comma behind the item.
    """
    inner, only = " " * (indent + 4), node.items[0] if len(node.items) == 1 else ""
    if isinstance(only, Group) and only.items and node.is_tuple:
        return f"{node.head}\n{inner}{_spread(only, indent + 4)},\n{' ' * indent}{node.close}"
    items = "".join(f"{inner}{laid_out(item, indent + 4)},\n" for item in node.items)
    return f"{node.head}\n{items}{' ' * indent}{node.close}"


def flat(node: Node) -> str:
    """Return the expression on one line."""
    if isinstance(node, str):
        return node
    comma = "," if len(node.items) == 1 and node.is_tuple else ""
    return f"{node.head}{', '.join([flat(item) for item in node.items])}{comma}{node.close}"


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
