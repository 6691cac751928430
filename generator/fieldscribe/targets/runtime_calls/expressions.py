"""Expressions as structure: calls of names of the runtime with plain values, tuples and dicts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Self


class Name(str):
    """A name, such as `U16` or `enums.Direction`; or what stands for an expression in a template of text."""

    __slots__ = ()


class PointName(str):
    """A text that names a point, of this device: what it is called there is for the language to say."""

    __slots__ = ()


class Hex(int):
    """A number that is written in hexadecimal, with at least so many digits."""

    digits: int

    def __new__(cls, number: int, digits: int = 4) -> Self:
        """Make a number."""
        made = super().__new__(cls, number)
        made.digits = digits
        return made


@dataclass(frozen=True, slots=True)
class Call:
    """A call of a name, with its arguments by position and by keyword."""

    name: str
    positional: tuple[Node, ...] = ()
    keywords: Mapping[str, Node] = field(default_factory=dict)


Leaf = str | int | float | None
Branch = Call | tuple["Node", ...] | Mapping[Any, "Node"]
Node = Leaf | Branch
"""An expression; a string that is no `Name` is a literal."""


def call(name: str, /, *positional: Node, **keywords: Node) -> Call:
    """Return a call of `name`."""
    return Call(name, positional, keywords)
