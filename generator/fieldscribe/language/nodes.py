"""YAML values that remember where they stand, and which of their facts were dropped because they were wrong."""

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

    `broken` are the keys whose values had the wrong shape; they are gone from the mapping. `verdict` is what the check
    of its shape said, so that a mapping that aliases repeat is checked once.
    """

    __slots__ = ("at", "broken", "file", "places", "verdict")

    def __init__(self, file: SourceFile, at: Place) -> None:
        super().__init__()
        self.file = file
        self.at = at
        self.places: dict[str, tuple[int, int, int, int]] = {}
        self.broken: tuple[str, ...] = ()
        self.verdict: tuple[object, bool] | None = None

    def span(self, key: str | None = None) -> Span:
        """Where the value of `key` stands, or the whole mapping."""
        found = None if key is None else self.places.get(key)
        line, column = self.at if found is None else found[2:]
        return Span(self.file.name, line, column)

    def key_span(self, key: str) -> Span:
        """Where `key` itself stands."""
        line, column = self.places.get(key, self.at)[:2]
        return Span(self.file.name, line, column, max(1, len(key)))


class Seq(list[Any]):
    """A YAML sequence. `item_at` gives places by index; `verdict` as in `Map`."""

    __slots__ = ("at", "file", "item_at", "verdict")

    def __init__(self, file: SourceFile, at: Place) -> None:
        super().__init__()
        self.file = file
        self.at = at
        self.item_at: list[Place] = []
        self.verdict: tuple[object, bool] | None = None

    def span(self, index: int | None = None) -> Span:
        """Where the item stands, or the whole sequence."""
        line, column = self.at if index is None else self.item_at[index]
        return Span(self.file.name, line, column)


Value: TypeAlias = Map | Seq | int | Decimal | bool | str | None
