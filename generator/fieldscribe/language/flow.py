"""Reads mappings and lists in brackets, as far as they are plain: `{en: Speed, de: Drehzahl}`, `[1, 0x2]`.

The same two patterns, `ENTRY` and `ITEM`, give the values and, when a finding asks for them, their places.
"""

from __future__ import annotations

import re
from sys import intern
from typing import TYPE_CHECKING, Any

from fieldscribe.language.nodes import Map, Seq, unplaced_map, unplaced_seq
from fieldscribe.language.scalars import WORDS, scalar

if TYPE_CHECKING:
    from fieldscribe.language.source import SourceFile


_DEEPEST = 6


class DoubtError(Exception):
    """The text is not plain: PyYAML says what it means, or what is wrong."""


class Scalars(dict[str, Any]):
    """What plain scalars mean, worked out once for each text."""

    def __missing__(self, text: str) -> Any:
        value = self[text] = scalar(text.rstrip(" "))
        return value


class Names(dict[str, str]):
    """Keys without their quotes, each a single object however often it stands."""

    def __missing__(self, text: str) -> str:
        key = self[text] = intern(text[1:-1] if text[0] in "\"'" else text)
        return key


_IN_LINE = r"""(?:"[^"\\\n]*+"|'[^'\n]*+')"""
QUOTED = r"""(?:"(?:[^"\\\n]++|\\["\\]|\n[ ]++(?!\n))*"|'[^'\n]*+')"""
"""A text in quotes; one in double quotes may go on below, and escape quotes and backslashes."""
_IN_KEY = r"[^\s:,\[\]{}#'\"]"
_KEY_STARTS = r"(?:[^\s\-?:,\[\]{}#&*!|>'\"%@`]|-(?=\w))"
KEY = rf"(?:[a-z_]++(?=:)|{_KEY_STARTS}{_IN_KEY}{{0,99}}+(?:[ ]{_IN_KEY}{{1,99}}+){{0,9}}+|{_IN_LINE})"
_GAP = r"[ ]*+(?:\n[ ]++)*"
_PLAIN = r"""(?:[^\s\-?:,\[\]{}#&*!|>'"%@`]|-(?=[\w.]))[^\n:,\[\]{}#?]*+(?::(?=\w)[^\n:,\[\]{}#?]*+)*"""
_FLAT = rf"\[{_PLAIN}(?:,[ ]{_PLAIN})*\]"
_VALUE = rf"(?:(?:({_PLAIN})|({QUOTED})|({_FLAT})){_GAP}"
WORD = "[A-Za-z_]"
"""Starts a text, or one of the words that mean something else: never a number."""
_PAIR = rf"[\w/]++: (?:{_PLAIN}(?<! )|{_FLAT})"
_PAIRS = re.compile(rf"([\w/]++): (?:({_PLAIN})|({_FLAT}))")
SIMPLE = rf"\{{{_PAIR}(?:, {_PAIR})*\}}"
ENTRY = re.compile(rf"{_GAP}({KEY}):[ ]{_GAP}{_VALUE}([,}}])|([\[{{]))")
"""Key, then a plain scalar, a quoted one or a list of plain ones, and what follows it; or the bracket that it opens."""
ITEM = re.compile(rf"{_GAP}{_VALUE}([,\]])|([\[{{]))")
FOLLOWING = re.compile(rf"{_GAP}([,\]}}])")
_BREAK, _ESCAPE = re.compile(r" *\n +"), re.compile(r"\\(.)")
EMPTY = re.compile(rf"{_GAP}[\]}}]")


def unquoted(text: str) -> str:
    """What stands between quotes; a line break there is a blank."""
    inner = _BREAK.sub(" ", text[1:-1]) if "\n" in text else text[1:-1]
    return _ESCAPE.sub(r"\1", inner) if "\\" in inner and text[0] == '"' else inner


def flow_value(text: str, source: SourceFile, line: int, column: int, scalars: Scalars) -> Map | Seq:
    """The mapping or list that fills the text, which stands at this place of the file."""
    value, end = _Flow(text, source, line, column, scalars).value(0)
    if end != len(text):
        raise DoubtError
    return value


def simple_map(text: str, source: SourceFile, line: int, column: int, scalars: Scalars) -> Map:
    """A mapping of one line, of plain scalars and lists of them: what is `SIMPLE`."""
    result = unplaced_map(source, (line, column))
    if "[" in text:
        pairs = _PAIRS.findall(text)
        start = 0
        for key, plain, flat in pairs:
            if plain:
                result[intern(key)] = scalars[plain]
                continue
            start = text.index("[", start + 1)
            items = result[intern(key)] = unplaced_seq(source, (line, column + start))
            items.extend(map(scalars.__getitem__, flat[1:-1].split(", ")))
    else:
        pairs = text[1:-1].split(", ")
        for pair in pairs:
            key, _, plain = pair.partition(": ")
            result[intern(key)] = WORDS.get(plain, plain) if plain[0].isalpha() else scalars[plain]
    if len(result) < len(pairs):
        raise DoubtError
    return result


def _balanced() -> str:
    """Brackets within brackets, over several lines if all but the first are indented."""
    pattern = inner = ""
    for _ in range(_DEEPEST):
        pattern = rf"[\[{{](?:[^\[\]{{}}\"'#\n]++|(?<=\w)[\"']|{QUOTED}|\n[ ]++{inner})*[\]}}]"
        inner = f"|{pattern}"
    return pattern


BRACKETS = _balanced()


class _Flow:
    """One text, and the place where it starts."""

    __slots__ = ("column", "depth", "line", "scalars", "several", "source", "text")

    def __init__(self, text: str, source: SourceFile, line: int, column: int, scalars: Scalars) -> None:
        self.text, self.source, self.line, self.column, self.scalars = text, source, line, column, scalars
        self.several, self.depth = "\n" in text, 0

    def value(self, start: int) -> tuple[Map | Seq, int]:
        """The mapping or list whose bracket stands there, and where it ends."""
        self.depth += 1
        if self.depth > _DEEPEST:
            raise DoubtError
        result = self._mapping(start) if self.text[start] == "{" else self._list(start)
        self.depth -= 1
        return result

    def _mapping(self, start: int) -> tuple[Map, int]:
        result = unplaced_map(self.source, self._place(start))
        text, match, scalars = self.text, ENTRY.match, self.scalars
        end, stop = start + 1, ","
        while stop == ",":
            entry = match(text, end)
            if entry is None:
                return result, self._end(result, end)
            key, plain, quoted, flat, stop, opening = entry.groups()
            end = entry.end()
            key = intern(key if key[0] not in "\"'" else key[1:-1])
            if key in result:
                raise DoubtError
            if plain:
                result[key] = scalars[plain]
            elif flat:
                result[key] = self._flat(flat, entry.start(4))
            elif quoted:
                result[key] = unquoted(quoted)
            else:
                result[key], end, stop = self._nested(end - len(opening), "}")
        return result, end

    def _list(self, start: int) -> tuple[Seq, int]:
        result = unplaced_seq(self.source, self._place(start))
        text, match, scalars = self.text, ITEM.match, self.scalars
        end, stop = start + 1, ","
        while stop == ",":
            item = match(text, end)
            if item is None:
                return result, self._end(result, end)
            plain, quoted, flat, stop, opening = item.groups()
            end = item.end()
            if plain:
                result.append(scalars[plain])
            elif flat:
                result.append(self._flat(flat, item.start(3)))
            elif quoted:
                result.append(unquoted(quoted))
            else:
                value, end, stop = self._nested(end - len(opening), "]")
                result.append(value)
        return result, end

    def _flat(self, text: str, start: int) -> Seq:
        """A list of plain scalars, each a comma and a blank from the next."""
        scalars = self.scalars
        result = unplaced_seq(self.source, self._place(start))
        result.extend([scalars[item] for item in text[1:-1].split(", ")])
        return result

    def _nested(self, start: int, closing: str) -> tuple[Map | Seq, int, str]:
        """What opens there, and what stands behind it: a comma or the bracket that closes what holds it."""
        value, end = self.value(start)
        following = FOLLOWING.match(self.text, end)
        if following is None or following[1] not in (",", closing):
            raise DoubtError
        return value, following.end(), following[1]

    def _end(self, result: Map | Seq, end: int) -> int:
        """Where a mapping or list without entries ends."""
        empty = EMPTY.match(self.text, end)
        if result or empty is None or (empty[0][-1] == "}") != isinstance(result, Map):
            raise DoubtError
        return empty.end()

    def _place(self, offset: int) -> tuple[int, int]:
        if not self.several:
            return self.line, self.column + offset
        breaks = self.text.count("\n", 0, offset)
        return (
            (self.line + breaks, offset - self.text.rfind("\n", 0, offset))
            if breaks
            else (self.line, self.column + offset)
        )
