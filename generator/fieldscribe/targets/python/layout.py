"""Python expressions laid out as a formatter would: on one line if they fit, else one item a line."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from fieldscribe.text import python_doc

if TYPE_CHECKING:
    from collections.abc import Iterable

WIDTH = 88
"""The narrowest common line length; what is laid out for it stays as it is under any wider one."""


@dataclass(frozen=True, slots=True)
class Group:
    """A call, tuple or dict: what opens it (`Rule(`, `allowed=(`), its items, what closes it, and whether it calls."""

    head: str
    items: tuple[Node, ...]
    close: str = ")"
    calls: bool = False

    @property
    def is_tuple(self) -> bool:
        """Whether a single item needs a comma behind it."""
        return self.close == ")" and not self.calls


Node = str | Group


def comment(text: str) -> str:
    """Text for a `#` comment; a second number sign in it could start a directive for some tool."""
    return python_doc(text).replace("#", "")


def call(head: str, items: Iterable[Node]) -> Group:
    """A call of `head`."""
    return Group(f"{head}(", tuple(items), calls=True)


def assigned(name: str, node: Group) -> Group:
    """The expression with the assignment to a name before it."""
    return replace(node, head=f"{name} = {node.head}")


def laid_out(node: Node, indent: int) -> str:
    """The expression at that indentation, with a comma expected behind it."""
    if isinstance(node, str):
        return node
    line = flat(node)
    return line if indent + len(line) < WIDTH else _spread(node, indent)


def _spread(node: Group, indent: int) -> str:
    """One item a line.

    Formatters join a tuple of one item again where lines may be longer, whatever the comma behind it, unless the item
    itself is spread.
    """
    inner, only = " " * (indent + 4), node.items[0] if len(node.items) == 1 else ""
    if isinstance(only, Group) and only.items and node.is_tuple:
        return f"{node.head}\n{inner}{_spread(only, indent + 4)},\n{' ' * indent}{node.close}"
    items = "".join(f"{inner}{laid_out(item, indent + 4)},\n" for item in node.items)
    return f"{node.head}\n{items}{' ' * indent}{node.close}"


def flat(node: Node) -> str:
    """The expression on one line."""
    if isinstance(node, str):
        return node
    comma = "," if len(node.items) == 1 and node.is_tuple else ""
    return f"{node.head}{', '.join([flat(item) for item in node.items])}{comma}{node.close}"
