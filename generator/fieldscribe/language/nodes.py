"""The text files of a description, read within limits, and YAML values that know where they stand in their file.

`load` reads a file by `read_source` and makes `Map` and `Seq` of it. Places in the text are found when a finding first
asks for one.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from contextlib import suppress
from dataclasses import dataclass, field
from decimal import Decimal
from errno import EFBIG
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import yaml

from fieldscribe.diagnostics import LINE_BREAK, Report, Span
from fieldscribe.safe_files import Content, Inputs, UnfitFileError, path_text, read_regular

MOST_BYTES = 16 * 1024 * 1024
"""The largest description file that is read: about 100,000 points."""

_FORBIDDEN = "[^\\t\\n\\r -~\\x85\\xa0-\\ud7ff\\ue000-\\ufefe\\uff00-\\ufffd\\U00010000-\\U0010ffff]"
"""The characters that YAML forbids; only a file with strange ones needs the pattern."""

# Files, and places in their texts.


Place = tuple[int, int]
"""Line and column, counted from 1."""
KeyPlaces = tuple[int, int, int, int]
"""Line and column of a key, then of its value."""


class Positions(NamedTuple):
    """The places in a text: of each mapping and list, of the keys in a mapping, and of the items in a list.

    All three are keyed by the offset where the mapping or list starts.
    """

    starts: dict[int, Place]
    keys: dict[int, dict[str, KeyPlaces]]
    items: dict[int, list[Place]]


BEGINNING = "a description starts with `fieldscribe: 1` and `device: …`, a part with `group: …` or shared facts"
"""How a description and its parts begin."""


@dataclass(eq=False)
class SourceFile:
    """A file's text; `name` is its path as messages show it, relative to the working folder if it lies below that.

    `beginning` is the hint that says how such a file begins. `lost` collects the names in dropped values: a reference
    to one of them is not reported as unknown.
    """

    name: str
    text: str
    beginning: str = BEGINNING
    lost: set[str] = field(default_factory=set)

    def span(self, line: int, column: int, width: int = 1) -> Span:
        """Return a place in this file."""
        return Span(self.name, line, column, width)

    @cached_property
    def positions(self) -> Positions:
        """The places of its keys, values and items, computed for the first finding."""
        return find_positions(self.text)

    @cached_property
    def _line_starts(self) -> list[int]:
        return [0, *(line_break.end() for line_break in LINE_BREAK.finditer(self.text))]

    def offset(self, place: Place) -> int:
        """Return how many characters stand before a line and column."""
        line, column = place
        return self._line_starts[line - 1] + column - 1

    def place(self, offset: int) -> Place:
        """Return the line and column after so many characters."""
        line = bisect_right(self._line_starts, offset)
        return line, offset - self._line_starts[line - 1] + 1


def read_source(
    path: Path, report: Report, inputs: Inputs | None = None, beginning: str = BEGINNING
) -> SourceFile | None:
    """Return the text of a file; None, with a finding, if it cannot be read or is no text that YAML allows.

    `inputs` records the bytes that were read; `beginning` says how such a file begins.
    """
    name = path_text(path)
    content = _content(path, Span(name, 1, 1), report)
    if content is None:
        return None
    if inputs is not None:
        inputs.note(path, content)
    return decoded(name, content.data, report, beginning)


def _content(path: Path, start: Span, report: Report) -> Content | None:
    try:
        return read_regular(path, MOST_BYTES)
    except UnfitFileError as error:
        if error.errno == EFBIG:
            message = f"the file is larger than {MOST_BYTES >> 20} MiB"
            report.error("file-too-large", message, start, "split it with `parts`")
        else:
            hint = "a description is made of regular files: move this away, or name another"
            report.error("file-unreadable", f"cannot read the file: {error.strerror}", start, hint)
    except OSError as error:
        message = f"cannot read the file: {error.strerror}"
        report.error("file-unreadable", message, start, "check the path and its permissions")
    return None


def decoded(name: str, data: bytes, report: Report, beginning: str = BEGINNING) -> SourceFile | None:
    """Return the text of these bytes, or None and a finding."""
    try:
        source = SourceFile(name, data.decode("utf-8-sig"), beginning)
    except UnicodeDecodeError as error:
        before = SourceFile(name, data[: error.start].decode("utf-8-sig"))
        message = f"byte {data[error.start]:02X}h is not UTF-8"
        report.error("file-not-utf8", message, before.span(*before.place(len(before.text))), "save the file as UTF-8")
        return None
    text = source.text
    if not text.strip():
        report.error("file-empty", "the file is empty", Span(name, 1, 1), beginning)
        return None
    strange = None if text.replace("\n", "").isprintable() else re.search(_FORBIDDEN, text)
    if strange is None:
        return source
    message = f"the control character U+{ord(strange[0]):04X} is not allowed in YAML"
    hint = "remove it: editors show it as a box, or not at all"
    report.error("yaml-character", message, source.span(*source.place(strange.start())), hint)
    return None


def find_positions(text: str) -> Positions:
    """Return the places in a text, as far as it is YAML; only a file with a finding is read for this."""
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
    """Record the place of a mapping or list, and of what is inside; of two equal keys the first counts."""
    offset = start.start_mark.index
    result.starts[offset] = _place(start)
    if isinstance(start, yaml.SequenceStartEvent):
        result.items[offset] = [_content_place(item) for item in inside]
        return
    keys = result.keys[offset] = {}
    for key, value in zip(inside[::2], inside[1::2], strict=False):
        keys.setdefault(getattr(key, "value", ""), (*_place(key), *_content_place(value)))


def _content_place(event: Any) -> Place:
    """Return where a value starts, after the quote if it has one: columns in formulas count from there."""
    line, column = _place(event)
    quoted = isinstance(event, yaml.ScalarEvent) and event.style in ("'", '"')
    return line, column + quoted


def _place(event: Any) -> Place:
    return event.start_mark.line + 1, event.start_mark.column + 1


# Values.


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
