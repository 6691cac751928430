"""Finds where keys, values and items of a plain file stand: only what a finding asks for."""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING

from fieldscribe.language.flow import EMPTY, ENTRY, FOLLOWING, ITEM, KEY

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.language.nodes import KeyPlaces, Place

_KEY = re.compile(rf"({KEY}):(?=[ \n]|\Z)")
_BLANKS = re.compile("[ ]*")
_BELOW = re.compile(r"(?:[ ]*(?:#[^\n]*)?\n)*[ ]*")


def places_of_keys(text: str, start: int, at: Place) -> dict[str, KeyPlaces]:
    """The places of the keys and values of the mapping that starts there."""
    where = _Where(text, start, at)
    pairs = _keys_in_braces(text, start) if text[start] == "{" else _keys_of_block(text, start, at[1] - 1)
    return {_bare(text[key : key + width]): (*where(key), *where(value)) for key, width, value in pairs}


def places_of_items(text: str, start: int, at: Place) -> list[Place]:
    """The places of the items of the list that starts there."""
    where = _Where(text, start, at)
    items = _items_in_brackets(text, start) if text[start] == "[" else _items_of_block(text, start, at[1] - 1)
    return [where(item) for item in items]


class _Where:
    """Line and column of what stands behind a place. It goes on where it was asked last: all keys cost one pass."""

    def __init__(self, text: str, start: int, at: Place) -> None:
        self.text, self.known, self.at = text, start, at
        self.first = start, at

    def __call__(self, offset: int) -> Place:
        if offset < self.known:
            self.known, self.at = self.first
        breaks = self.text.count("\n", self.known, offset)
        line, column = self.at
        column = offset - self.text.rfind("\n", 0, offset) if breaks else column + offset - self.known
        self.known, self.at = offset, (line + breaks, column)
        return self.at


def _keys_in_braces(text: str, start: int) -> Iterator[tuple[int, int, int]]:
    """Offset and width of each key, and the offset of its value."""
    for entry, value in _in_brackets(text, start)[0]:
        yield entry.start(1), len(entry[1]), value


def _items_in_brackets(text: str, start: int) -> Iterator[int]:
    return (value for _, value in _in_brackets(text, start)[0])


def _in_brackets(text: str, start: int) -> tuple[list[tuple[re.Match[str], int]], int]:
    """Each entry with the offset of its value, behind the quote; and where the closing bracket ends."""
    pattern, plain = (ENTRY, 2) if text[start] == "{" else (ITEM, 1)
    entries: list[tuple[re.Match[str], int]] = []
    at, following = start + 1, pattern.match(text, start + 1)
    while following is not None:
        value, at, goes_on = _value(text, following, plain)
        entries.append((following, value))
        following = pattern.match(text, at) if goes_on else None
    empty = None if entries else EMPTY.match(text, at)
    return entries, at if empty is None else empty.end()


def _value(text: str, entry: re.Match[str], plain: int) -> tuple[int, int, bool]:
    """Where a value in brackets starts, where what follows it does, and whether that is an entry."""
    quoted, flat, stop, opening = range(plain + 1, plain + 5)
    if entry[opening] is None:
        value = next(entry.start(kind) for kind in (plain, quoted, flat) if entry[kind] is not None)
        return value + (entry[quoted] is not None), entry.end(), entry[stop] == ","
    _, end = _in_brackets(text, entry.start(opening))
    following = FOLLOWING.match(text, end)
    return entry.start(opening), _end(FOLLOWING, text, end), following is not None and following[1] == ","


def _keys_of_block(text: str, start: int, indent: int) -> Iterator[tuple[int, int, int]]:
    """The same for keys that start their lines, from this one to the first line that is indented less."""
    key_line, end_line = _block_lines(indent)
    ends = end_line.search(text, start)
    key = _KEY.match(text, start)
    lines = key_line.finditer(text, start, ends.start() if ends else len(text))
    while key is not None:
        yield key.start(), len(key[1]), _behind(text, key.end())
        line = next(lines, None)
        key = line and _KEY.match(text, line.end())


@cache
def _block_lines(indent: int) -> tuple[re.Pattern[str], re.Pattern[str]]:
    """The start of a line with a key of that indentation, and a line that ends the mapping."""
    less = rf" {{0,{indent - 1}}}[^ #\n]" if indent else "---"
    return re.compile(rf"\n {{{indent}}}(?=[^ #\n\-]|-[^ ])"), re.compile(rf"\n{less}")


def _items_of_block(text: str, start: int, indent: int) -> Iterator[int]:
    """The items of a list, behind their dashes, from this one to the first line of what holds the list."""
    item_line, end_line = _list_lines(indent)
    ends = end_line.search(text, start)
    dash: int | None = start
    lines = item_line.finditer(text, start, ends.start() if ends else len(text))
    while dash is not None:
        item = _end(_BLANKS, text, dash + 1)
        yield item if _KEY.match(text, item) else item + (text[item] in "\"'")
        line = next(lines, None)
        dash = line and line.end()


@cache
def _list_lines(indent: int) -> tuple[re.Pattern[str], re.Pattern[str]]:
    """The start of a line with an item of that indentation, and a line that ends the list."""
    less = rf" {{0,{indent - 1}}}[^ #\n]|" if indent else "---|"
    return re.compile(rf"\n {{{indent}}}(?=- )"), re.compile(rf"\n(?:{less} {{{indent}}}(?:[^ #\n\-]|-[^ ]))")


def _behind(text: str, colon: int) -> int:
    """Where the value behind a colon starts: on this line, behind its quote, or on the next one with something."""
    value = _end(_BELOW, text, colon)
    on_line = text.count("\n", colon, value) == 0
    return value + (on_line and text[value] in "\"'")


def _end(pattern: re.Pattern[str], text: str, start: int) -> int:
    """Where the text ends that the pattern matches there."""
    match = pattern.match(text, start)
    return start if match is None else match.end()


def _bare(key: str) -> str:
    return key[1:-1] if key[0] in "\"'" else key
