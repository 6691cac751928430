"""YAML values that know where they stand in their file, and which of their keys were dropped as wrong."""

from __future__ import annotations

from decimal import Decimal
from typing import Any, TypeAlias

from fieldscribe.diagnostics import Span
from fieldscribe.language.source import Place, SourceFile


class Map(dict[str, Any]):
    """A YAML mapping that starts at this offset of its file.

    `broken` names the keys that were dropped because their values were wrong. `uses` is set for a mapping that aliases
    repeat: for each check of a shape one copy, and whether it has that shape.
    """

    __slots__ = ("broken", "file", "start", "uses")

    def __init__(self, file: SourceFile, start: int) -> None:
        self.file = file
        self.start = start
        self.broken: tuple[str, ...] = ()
        self.uses: dict[object, tuple[Map, bool]] | None = None

    def copied(self) -> Map:
        """Return a copy from which keys can be dropped; the values are shared with the original."""
        copy = Map(self.file, self.start)
        copy.update(self)
        return copy

    def span(self, key: str | None = None) -> Span:
        """Return the place of the value of `key`, or of the whole mapping."""
        return Span.sought(self.file.name, lambda: self._places(key)[2:])

    def key_span(self, key: str) -> Span:
        """Return the place of `key` itself."""
        return Span.sought(self.file.name, lambda: self._places(key)[:2], max(1, len(key)))

    def _places(self, key: str | None) -> tuple[int, int, int, int]:
        positions = self.file.positions
        start = positions.starts.get(self.start, (1, 1))
        whole = (*start, *start)
        return whole if key is None else positions.keys.get(self.start, {}).get(key, whole)


class Seq(list[Any]):
    """A YAML list that starts at this offset of its file; `broken` if wrong items were dropped; `uses` as in `Map`."""

    __slots__ = ("_item_places", "broken", "file", "start", "uses")

    def __init__(self, file: SourceFile, start: int) -> None:
        self.file = file
        self.start = start
        self._item_places: list[Place] | None = None
        self.broken = False
        self.uses: dict[object, tuple[Seq, bool]] | None = None

    def copied(self) -> Seq:
        """Return a copy from which items can be dropped; they are shared with the original."""
        copy = Seq(self.file, self.start)
        copy.extend(self)
        copy._item_places = self._item_places and self._item_places.copy()
        return copy

    def drop(self, index: int) -> None:
        """Remove an item; the places of the others stay correct."""
        del self[index], self._places[index]
        self.broken = True

    def span(self, index: int | None = None) -> Span:
        """Return the place of the item, or of the whole list."""
        if index is None:
            return Span.sought(self.file.name, lambda: self.file.positions.starts.get(self.start, (1, 1)))
        return Span.sought(self.file.name, lambda: self._places[index])

    @property
    def _places(self) -> list[Place]:
        if self._item_places is None:
            self._item_places = self.file.positions.items[self.start].copy()
        return self._item_places


Value: TypeAlias = Map | Seq | int | Decimal | bool | str | None


def share(value: Value) -> None:
    """Mark a value that an alias repeats, with everything inside: each use of it is checked on a copy."""
    waiting = [value]
    while waiting:
        node = waiting.pop()
        if isinstance(node, Map | Seq) and node.uses is None:
            node.uses = {}
            waiting.extend(node.values() if isinstance(node, Map) else node)
