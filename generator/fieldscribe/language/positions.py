"""Finds where keys, values and items stand in a YAML text; only a file with a finding is read for this."""

from __future__ import annotations

from contextlib import suppress
from typing import Any, NamedTuple

import yaml

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
    # The mappings and lists that are open: the event at the start of each, and those of the values inside.
    opened: list[tuple[Any, list[Any]]] = []
    with suppress(yaml.YAMLError):  # the reader has reported it
        for event in iter(yaml.CSafeLoader(text).get_event, None):
            if isinstance(event, yaml.CollectionEndEvent):
                _add(result, *opened.pop())
            elif isinstance(event, yaml.NodeEvent):
                if opened:
                    opened[-1][1].append(event)
                if isinstance(event, yaml.CollectionStartEvent):
                    opened.append((event, []))
    while opened:
        _add(result, *opened.pop())
    return result


def _add(result: Positions, start: Any, inside: list[Any]) -> None:
    """Note where a mapping or list stands, and what is inside; of two equal keys the first counts."""
    offset = start.start_mark.index
    result.starts[offset] = _place(start)
    if isinstance(start, yaml.SequenceStartEvent):
        result.items[offset] = [_content_place(item) for item in inside]
        return
    keys = result.keys[offset] = {}
    for key, value in zip(inside[::2], inside[1::2], strict=False):
        keys.setdefault(getattr(key, "value", ""), (*_place(key), *_content_place(value)))


def _content_place(event: Any) -> Place:
    """Return where a value starts, behind the quote if it has one: columns in formulas count from there."""
    line, column = _place(event)
    quoted = isinstance(event, yaml.ScalarEvent) and event.style in ("'", '"')
    return line, column + quoted


def _place(event: Any) -> Place:
    return event.start_mark.line + 1, event.start_mark.column + 1
