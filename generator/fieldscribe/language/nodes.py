"""YAML values that remember their place in the file, and which of their keys were dropped as wrong."""

from __future__ import annotations

from decimal import Decimal
from typing import TYPE_CHECKING, Any, TypeAlias

from fieldscribe.diagnostics import Span

if TYPE_CHECKING:
    from fieldscribe.language.source import SourceFile

Place = tuple[int, int]
"""Line and column, counted from 1."""
KeyPlaces = tuple[int, int, int, int]
"""Line and column of a key, then of its value."""


class Map(dict[str, Any]):
    """A YAML mapping. `at` is where it starts; `places` give line and column of the key, then of the value, by key.

    `broken` are the keys whose values had the wrong shape; they are gone from the mapping. `uses` is there for what
    aliases repeat: one copy for each shape that is expected of it, and whether it has that shape.
    """

    __slots__ = ("_places", "at", "broken", "file", "uses")

    def __init__(self, file: SourceFile, at: Place) -> None:
        super().__init__()
        self.file = file
        self.at = at
        self._places: dict[str, KeyPlaces] | None = {}
        self.broken: tuple[str, ...] = ()
        self.uses: dict[object, tuple[Map, bool]] | None = None

    @property
    def places(self) -> dict[str, KeyPlaces]:
        """Where each key and its value stand; in a plain file they are looked for when a finding first asks."""
        if self._places is None:
            from fieldscribe.language.positions import places_of_keys

            self._places = places_of_keys(self.file.text, self.file.offset(self.at), self.at)
        return self._places

    def copied(self) -> Map:
        """A copy from which keys can be dropped; the values are shared with the original."""
        copy = Map(self.file, self.at)
        copy.update(self)
        copy._places = self.places
        return copy

    def span(self, key: str | None = None) -> Span:
        """Where the value of `key` stands, or the whole mapping."""
        if key is None:
            return Span(self.file.name, *self.at)
        return Span.sought(self.file.name, lambda: self.places.get(key, (*self.at, *self.at))[2:])

    def key_span(self, key: str) -> Span:
        """Where `key` itself stands."""
        return Span.sought(self.file.name, lambda: self.places.get(key, (*self.at, *self.at))[:2], max(1, len(key)))


class Seq(list[Any]):
    """A YAML sequence. `item_at` gives places by index; `uses` as in `Map`."""

    __slots__ = ("_item_at", "at", "file", "uses")

    def __init__(self, file: SourceFile, at: Place) -> None:
        super().__init__()
        self.file = file
        self.at = at
        self._item_at: list[Place] | None = []
        self.uses: dict[object, tuple[Seq, bool]] | None = None

    @property
    def item_at(self) -> list[Place]:
        """Where each item stands, as in `Map`."""
        if self._item_at is None:
            from fieldscribe.language.positions import places_of_items

            self._item_at = places_of_items(self.file.text, self.file.offset(self.at), self.at)
        return self._item_at

    def copied(self) -> Seq:
        """A copy from which items can be dropped; they are shared with the original."""
        copy = Seq(self.file, self.at)
        copy.extend(self)
        copy._item_at = list(self.item_at)
        return copy

    def span(self, index: int | None = None) -> Span:
        """Where the item stands, or the whole sequence."""
        if index is None:
            return Span(self.file.name, *self.at)
        return Span.sought(self.file.name, lambda: self.item_at[index])


def unplaced_map(file: SourceFile, at: Place) -> Map:
    """A mapping of a plain file, in which places are looked for when a finding asks."""
    result = _new_map(Map)
    result.file = file
    result.at = at
    result._places = None
    result.broken = ()
    result.uses = None
    return result


def unplaced_seq(file: SourceFile, at: Place) -> Seq:
    """As `unplaced_map`."""
    result = _new_seq(Seq)
    result.file = file
    result.at = at
    result._item_at = None
    result.uses = None
    return result


_new_map, _new_seq = Map.__new__, Seq.__new__

Value: TypeAlias = Map | Seq | int | Decimal | bool | str | None


def share(value: Value) -> None:
    """Mark a value that an alias repeats, and all inside it: each place checks and drops for itself."""
    waiting = [value]
    while waiting:
        node = waiting.pop()
        if isinstance(node, Map | Seq) and node.uses is None:
            node.uses = {}
            waiting.extend(node.values() if isinstance(node, Map) else node)
