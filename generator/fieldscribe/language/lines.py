"""Reads the plain part of YAML line by line: block mappings and lists, values of one line, and what stands in brackets.

Every file of ours but those with anchors is written so. Whatever is written otherwise, or could be wrong, is a doubt:
then PyYAML reads the whole file. Nothing is reported here, and places are found when a finding asks for them.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from fieldscribe.language.flow import (
    BRACKETS,
    KEY,
    QUOTED,
    SIMPLE,
    WORD,
    DoubtError,
    Names,
    Scalars,
    flow_value,
    simple_map,
    unquoted,
)
from fieldscribe.language.nodes import Map, Seq, unplaced_map, unplaced_seq
from fieldscribe.language.scalars import WORDS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.language.nodes import Value
    from fieldscribe.language.source import SourceFile

_MOST_VALUES = 1_000_000
_MOST_DOCUMENTS = 1000
_MOST_DEPTH = 12


_PLAIN = r"""(?:[^\s\-?:,\[\]{}#&*!|>'"%@`]|-(?=[\w.]))[^\n:#]*+(?:(?::(?=[^\s])|(?<! )#)[^\n:#]*+)*"""
_LINE = re.compile(
    rf"([ ]*+(?:-[ ]++)?)({KEY}):[ ](?:({WORD}[^\n:#]*+(?<! ))|([0-9]{{1,18}})|([0-9.][^\n:#]*+)|({SIMPLE}))\n"
    rf"|([^\n\[{{\"]*+(?:{BRACKETS}|{QUOTED})?[^\n]*+\n)"
)
"""Indentation with the dash of an item, key, and a plain value or a simple mapping; or another line, with what follows
in its brackets or quotes."""
_OTHER_LINE = re.compile(
    rf"([ ]*+(?:-[ ]++)?)(?:({KEY}):(?:[ ]++|(?=\n)))?"
    rf"(?:({_PLAIN})|(?<![ ][ ])([\[{{](?s:.)*[\]}}])|({QUOTED}))?[ ]*+(?:(?<![^ \n])#[^\n]*+)?\n"
)
"""The same, but the key may be missing, the value may be any, and a comment may follow."""


def plain_documents(source: SourceFile) -> list[Map] | None:
    """The documents of a file that is plain and has one at least; None if PyYAML must read it."""
    if not _may_be_plain(source):
        return None
    try:
        return list(_Reader(source).documents()) or None
    except DoubtError:
        return None


def _may_be_plain(source: SourceFile) -> bool:
    """Whether no character is strange, and there are surely no more values and documents than a file may have."""
    text = source.text
    if not source.printable or text.count("\n---") > _MOST_DOCUMENTS:
        return False
    return len(text) < _MOST_VALUES or sum(map(text.count, ",:[\n")) < _MOST_VALUES


class _Reader:
    """Keeps the mappings and lists that the current line stands in, each with its column, the innermost last."""

    def __init__(self, source: SourceFile) -> None:
        self.source = source
        self.scalars, self.names = Scalars(), Names()
        self.within: list[tuple[int, Any]] = []
        self.opened: tuple[Map, str] | None = None
        """The mapping, and its key whose value starts on a line of its own."""

    def documents(self) -> Iterator[Map]:
        """Each document that holds something."""
        source, scalars, names = self.source, self.scalars, self.names
        text = source.text if source.text[-1] == "\n" else f"{source.text}\n"
        number = 0
        indent: str | None = None
        holder: Any = None
        for prefix, name, word, digits, plain, simple, other in _LINE.findall(text):
            number += 1
            if other:
                yield from self._other(number, other)
                number += other.count("\n") - 1
                indent = None
                continue
            if prefix != indent:
                holder = self._holder(number, prefix, name)
                indent = " " * len(prefix)
            key = names[name]
            if key in holder:
                raise DoubtError
            if word:
                holder[key] = WORDS.get(word, word)
            elif digits:
                holder[key] = int(digits)
            elif plain:
                holder[key] = scalars[plain]
            else:
                holder[key] = simple_map(simple, source, number, len(prefix) + len(name) + 3, scalars)
        yield from self._document()

    def _other(self, number: int, text: str) -> Iterator[Map]:
        """Any other line: a comment, the mark of a document, an item without key, a key without value, other values."""
        if text == "---\n":
            yield from self._document()
            return
        line = _OTHER_LINE.fullmatch(text)
        if line is None:
            raise DoubtError
        prefix, name, plain, brackets, quoted = line.groups()
        if name or plain or brackets or quoted:
            holder = self._holder(number, prefix, name)
            _deeper(text, len(prefix) if name else prefix.index("-"))
            if plain:
                self._put(holder, name, self.scalars[plain])
            elif brackets:
                column = 1 + line.start(4)
                self._put(holder, name, flow_value(brackets, self.source, number, column, self.scalars))
            elif quoted:
                self._put(holder, name, unquoted(quoted))
            else:
                self._put(holder, name, None)
                self.opened = holder, self.names[name]
        elif prefix.strip():
            raise DoubtError

    def _put(self, holder: Any, name: str | None, value: Value) -> None:
        """Add a value: with this key, or to a list."""
        if name is None:
            holder.append(value)
        elif self.names[name] in holder:
            raise DoubtError
        else:
            holder[self.names[name]] = value

    def _document(self) -> Iterator[Map]:
        """The document that ends here; nothing if it is empty."""
        if self.opened is not None:
            raise DoubtError
        if self.within:
            _, root = self.within[0]
            self.within = []
            yield root

    def _holder(self, line: int, prefix: str, name: str | None) -> Any:
        """The mapping or list to which a line of this indentation belongs."""
        column, dash = len(prefix), prefix.find("-")
        if dash < 0:
            if not name:
                raise DoubtError
            return self._at(column, Map, line)
        items = self._at(dash, Seq, line)
        if not name:
            return items
        item = unplaced_map(self.source, (line, column + 1))
        items.append(item)
        self._enter(column, item)
        return item

    def _at(self, column: int, kind: type[Map | Seq], line: int) -> Any:
        """The mapping or list of that column: a new one where a key waits for its value, and at the very start."""
        within = self.within
        if within and self.opened is None:
            while within and (within[-1][0] > column or type(within[-1][1]) is not kind):
                within.pop()
            if not within or within[-1][0] != column:
                raise DoubtError
            return within[-1][1]
        make: Any = unplaced_map if kind is Map else unplaced_seq
        new = make(self.source, (line, column + 1))
        if self.opened is not None:
            mapping, key = self.opened
            if column < within[-1][0] + (kind is Map):
                raise DoubtError
            mapping[key] = new
            self.opened = None
        elif kind is Seq:
            raise DoubtError
        self._enter(column, new)
        return new

    def _enter(self, column: int, node: Any) -> None:
        if len(self.within) > _MOST_DEPTH:
            raise DoubtError
        self.within.append((column, node))


def _deeper(text: str, column: int) -> None:
    """Doubts a value whose further lines are not deeper than the line on which it starts."""
    if any(len(below) - len(below.lstrip(" ")) <= column for below in text.split("\n")[1:-1]):
        raise DoubtError
