"""Finds where the keys, values and items of a YAML text stand: only findings ask, so the reader keeps offsets."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import yaml

if TYPE_CHECKING:
    from collections.abc import Iterator

Place = tuple[int, int]
"""Line and column, counted from 1."""
KeyPlaces = tuple[int, int, int, int]
"""Line and column of a key, then of its value."""


class Positions(NamedTuple):
    """The places in a text: of each mapping and list, of the keys in a mapping, and of the items in a list.

    All three are by the offset where the mapping or list starts.
    """

    starts: dict[int, Place]
    keys: dict[int, dict[str, KeyPlaces]]
    items: dict[int, list[Place]]


def find_positions(text: str) -> Positions:
    """Return the places in a text, as far as it is YAML."""
    result = Positions({}, {}, {})
    inside: list[_Mapping | _Sequence] = []
    for event in _events(text):
        if isinstance(event, yaml.CollectionEndEvent):
            inside.pop()
        elif isinstance(event, yaml.NodeEvent):
            if inside:
                inside[-1].add(event)
            if isinstance(event, yaml.CollectionStartEvent):
                inside.append(_opened(event, result))
    return result


def _opened(event: Any, result: Positions) -> _Mapping | _Sequence:
    mark = event.start_mark
    result.starts[mark.index] = mark.line + 1, mark.column + 1
    if isinstance(event, yaml.MappingStartEvent):
        return _Mapping(result.keys.setdefault(mark.index, {}))
    return _Sequence(result.items.setdefault(mark.index, []))


class _Mapping:
    """A mapping that is being read: each key, then its value."""

    def __init__(self, places: dict[str, KeyPlaces]) -> None:
        self._places = places
        self._key: Any = None

    def add(self, event: Any) -> None:
        """Note where a key or a value stands; of two equal keys the first counts."""
        if self._key is None:
            self._key = event
            return
        mark, name = self._key.start_mark, getattr(self._key, "value", "")
        self._places.setdefault(name, (mark.line + 1, mark.column + 1, *_content_place(event)))
        self._key = None


class _Sequence:
    """A list that is being read."""

    def __init__(self, places: list[Place]) -> None:
        self._places = places

    def add(self, event: Any) -> None:
        """Note where an item stands."""
        self._places.append(_content_place(event))


def _events(text: str) -> Iterator[Any]:
    """Yield the parser's events up to the first error: the reader has reported that one."""
    loader = yaml.CSafeLoader(text)
    try:
        while (event := loader.get_event()) is not None:
            yield event
    except yaml.YAMLError:
        return


def _content_place(event: Any) -> Place:
    """Return where a value starts, behind the quote if it has one: columns in formulas count from there."""
    mark = event.start_mark
    quoted = isinstance(event, yaml.ScalarEvent) and event.style in ("'", '"')
    return mark.line + 1, mark.column + 1 + quoted
