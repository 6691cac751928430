"""YAML values that remember their place in the file, and which of their keys were dropped as wrong."""

from __future__ import annotations

from decimal import Decimal
from typing import TYPE_CHECKING, Any, TypeAlias

from fieldscribe.diagnostics import Span

if TYPE_CHECKING:
    from fieldscribe.language.source import SourceFile

Place = tuple[int, int]
"""Line and column, counted from 1."""


class Map(dict[str, Any]):
    """A YAML mapping. `at` is where it starts; `places` give line and column of the key, then of the value, by key.

    `broken` are the keys whose values had the wrong shape; they are gone from the mapping. `uses` is there for what
    aliases repeat: one copy for each shape that is expected of it, and whether it has that shape.
    """

    __slots__ = ("at", "broken", "file", "places", "uses")

    def __init__(self, file: SourceFile, at: Place) -> None:
        super().__init__()
        self.file = file
        self.at = at
        self.places: dict[str, tuple[int, int, int, int]] = {}
        self.broken: tuple[str, ...] = ()
        self.uses: dict[object, tuple[Map, bool]] | None = None

    def copied(self) -> Map:
        """A copy from which keys can be dropped; the values are shared with the original."""
        copy = Map(self.file, self.at)
        copy.update(self)
        copy.places = self.places
        return copy

    def span(self, key: str | None = None) -> Span:
        """Where the value of `key` stands, or the whole mapping."""
        place = None if key is None else self.places.get(key)
        line, column = self.at if place is None else place[2:]
        return Span(self.file.name, line, column)

    def key_span(self, key: str) -> Span:
        """Where `key` itself stands."""
        line, column = self.places.get(key, self.at)[:2]
        return Span(self.file.name, line, column, max(1, len(key)))


class Seq(list[Any]):
    """A YAML sequence. `item_at` gives places by index; `uses` as in `Map`."""

    __slots__ = ("at", "file", "item_at", "uses")

    def __init__(self, file: SourceFile, at: Place) -> None:
        super().__init__()
        self.file = file
        self.at = at
        self.item_at: list[Place] = []
        self.uses: dict[object, tuple[Seq, bool]] | None = None

    def copied(self) -> Seq:
        """A copy from which items can be dropped; they are shared with the original."""
        copy = Seq(self.file, self.at)
        copy.extend(self)
        copy.item_at = list(self.item_at)
        return copy

    def span(self, index: int | None = None) -> Span:
        """Where the item stands, or the whole sequence."""
        line, column = self.at if index is None else self.item_at[index]
        return Span(self.file.name, line, column)


Value: TypeAlias = Map | Seq | int | Decimal | bool | str | None


def share(value: Value) -> None:
    """Mark a value that an alias repeats, and all inside it: each place checks and drops for itself."""
    waiting = [value]
    while waiting:
        node = waiting.pop()
        if isinstance(node, Map | Seq) and node.uses is None:
            node.uses = {}
            waiting.extend(node.values() if isinstance(node, Map) else node)
