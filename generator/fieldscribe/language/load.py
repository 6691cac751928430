"""YAML 1.2 text to plain values that remember where they stand.

Mappings and sequences become `Map` and `Seq`; scalars become int, Decimal, bool, None or str by the YAML 1.2 core rules, so
that `on`, `NO`, `010` and `12:30` mean what they look like and decimal fractions stay exact. Nothing is constructed from tags.
"""

from __future__ import annotations

import re
from decimal import Decimal
from typing import Any, NoReturn, TypeAlias

import yaml

from fieldscribe.diagnostics import Report, Span
from fieldscribe.language.source import SourceFile

MOST_DEPTH = 40
MOST_NODES = 3_000_000
MOST_DIGITS = 64

_INTEGER = re.compile(r"[-+]?[0-9]+")
_RADIX = re.compile(r"0o[0-7]+|0x[0-9a-fA-F]+")
_FLOAT = re.compile(r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?")
_WORDS: dict[str, bool | str | None] = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
}
_NUMBER_STARTS = frozenset("-+.0123456789")


class Map(dict[str, Any]):
    """A YAML mapping. `key_at` and `value_at` give (line, column) by key; `at` is where it starts."""

    __slots__ = ("at", "file", "key_at", "value_at")

    def __init__(self, file: SourceFile, at: tuple[int, int]) -> None:
        super().__init__()
        self.file = file
        self.at = at
        self.key_at: dict[str, tuple[int, int]] = {}
        self.value_at: dict[str, tuple[int, int]] = {}

    def span(self, key: str | None = None) -> Span:
        """Where the value of `key` stands, or the whole mapping."""
        line, column = self.at if key is None else self.value_at.get(key, self.at)
        return Span(self.file.name, line, column)

    def key_span(self, key: str) -> Span:
        """Where `key` itself stands."""
        line, column = self.key_at.get(key, self.at)
        return Span(self.file.name, line, column, max(1, len(key)))


class Seq(list[Any]):
    """A YAML sequence. `item_at` gives (line, column) by index."""

    __slots__ = ("at", "file", "item_at")

    def __init__(self, file: SourceFile, at: tuple[int, int]) -> None:
        super().__init__()
        self.file = file
        self.at = at
        self.item_at: list[tuple[int, int]] = []

    def span(self, index: int | None = None) -> Span:
        """Where the item stands, or the whole sequence."""
        line, column = self.at if index is None else self.item_at[index]
        return Span(self.file.name, line, column)


Value: TypeAlias = Map | Seq | int | Decimal | bool | str | None


class _Refused(Exception):
    """The text cannot be read any further; the finding is already reported."""


def load(source: SourceFile, report: Report) -> Map | None:
    """The file's mapping, or None with findings: bad syntax, duplicate keys, tags, aliases or nesting out of bounds."""
    before = len(report.findings)
    try:
        root = _Builder(source, report).build()
    except _Refused:
        return None
    except yaml.MarkedYAMLError as error:
        _syntax(source, error, report)
        return None
    except yaml.YAMLError as error:
        report.error(
            "yaml-syntax",
            f"this is not YAML: {error}".splitlines()[0],
            source.span(1, 1),
            "save the file as plain UTF-8 text",
        )
        return None
    if not isinstance(root, Map):
        report.error(
            "wrong-type",
            "the file must be a mapping of keys to values",
            source.span(1, 1),
            "start with `fieldscribe: 1`",
        )
        return None
    return None if len(report.findings) > before else root


def _syntax(source: SourceFile, error: yaml.MarkedYAMLError, report: Report) -> None:
    mark = error.problem_mark or error.context_mark
    span = source.span(mark.line + 1, mark.column + 1) if mark else source.span(1, 1)
    problem = error.problem or "it ends too early"
    context = f" {error.context}" if error.context else ""
    hint = "look at the indentation, at missing quotes and at brackets that are not closed"
    if "\t" in problem or "cannot start any token" in problem:
        hint = "tabs cannot indent YAML, and `%`, `@` and a backquote start no plain text: quote it"
    report.error("yaml-syntax", f"this is not YAML:{context} {problem}".replace(":  ", ": "), span, hint)


class _Builder:
    """Builds values from parser events; the depth is bounded before Python's own stack could be."""

    def __init__(self, source: SourceFile, report: Report) -> None:
        self.source = source
        self.report = report
        self.anchors: dict[str, tuple[Value, int]] = {}
        self.nodes = 0
        self.next_event = yaml.CSafeLoader(source.text).get_event

    def build(self) -> Value:
        """The value of the one document in the text."""
        self.next_event()  # stream start
        event = self.next_event()
        if type(event) is yaml.StreamEndEvent:
            self._refuse(
                "file-empty", "the file holds only comments", event, "a description starts with `fieldscribe: 1`"
            )
        root = self._node(self.next_event(), 0)
        self.next_event()  # document end
        event = self.next_event()
        if type(event) is not yaml.StreamEndEvent:
            self._refuse(
                "yaml-syntax",
                "a second YAML document starts here",
                event,
                "one file holds one document: remove the `---`",
            )
        return root

    def _node(self, event: Any, depth: int) -> Value:
        kind = type(event)
        if kind is yaml.AliasEvent:
            return self._alias(event)
        self.nodes += 1
        if event.tag is not None:
            self._refuse(
                "yaml-tag",
                f"the tag {event.tag[:60]!r} is not allowed",
                event,
                "remove the tag: types follow from the key",
            )
        if kind is yaml.ScalarEvent:
            value: Value = scalar(event.value) if event.implicit[0] else event.value
            self._remember(event, value, self.nodes - 1)
            return value
        if depth >= MOST_DEPTH:
            self._refuse(
                "yaml-depth",
                f"nested deeper than {MOST_DEPTH} levels",
                event,
                "a description never needs this; check the brackets",
            )
        first = self.nodes
        collection = self._mapping(event, depth) if kind is yaml.MappingStartEvent else self._sequence(event, depth)
        self._remember(event, collection, first)
        return collection

    def _mapping(self, event: Any, depth: int) -> Map:
        mark = event.start_mark
        result = Map(self.source, (mark.line + 1, mark.column + 1))
        next_event, node = self.next_event, self._node
        key_at, value_at = result.key_at, result.value_at
        while True:
            event = next_event()
            if type(event) is yaml.MappingEndEvent:
                return result
            key = self._key(event, result)
            mark = event.start_mark
            event = next_event()
            value_mark = event.start_mark
            value = node(event, depth + 1)
            if key is not None:
                result[key] = value
                key_at[key] = (mark.line + 1, mark.column + 1)
                value_at[key] = (value_mark.line + 1, value_mark.column + 1)

    def _sequence(self, event: Any, depth: int) -> Seq:
        mark = event.start_mark
        result = Seq(self.source, (mark.line + 1, mark.column + 1))
        while True:
            event = self.next_event()
            if type(event) is yaml.SequenceEndEvent:
                return result
            mark = event.start_mark
            result.append(self._node(event, depth + 1))
            result.item_at.append((mark.line + 1, mark.column + 1))

    def _key(self, event: Any, into: Map) -> str | None:
        if type(event) is not yaml.ScalarEvent:
            self._refuse(
                "yaml-key", "a key must be plain text, not a list, a mapping or an alias", event, "quote the key"
            )
        if event.tag is not None or event.anchor is not None:
            self._refuse("yaml-tag", "a key takes no tag and no anchor", event, "remove it")
        key: str = event.value
        if key in into:
            mark = event.start_mark
            span = self.source.span(mark.line + 1, mark.column + 1, max(1, len(key)))
            first = (into.key_span(key), "first given here")
            self.report.error(
                "duplicate-key", f"the key `{key}` is given twice", span, "remove or rename one of them", [first]
            )
            return None
        return key

    def _remember(self, event: Any, value: Value, first: int) -> None:
        if event.anchor is not None:
            self.anchors[event.anchor] = (value, self.nodes - first + 1)
        if self.nodes > MOST_NODES:
            self._refuse(
                "yaml-size", f"more than {MOST_NODES} values", event, "aliases count each time; split the description"
            )

    def _alias(self, event: Any) -> Value:
        if event.anchor not in self.anchors:
            self._refuse(
                "yaml-alias",
                f"the alias *{event.anchor} stands inside what it names, or names nothing",
                event,
                "write it out",
            )
        value, size = self.anchors[event.anchor]
        self.nodes += size
        if self.nodes > MOST_NODES:
            self._refuse(
                "yaml-size", f"more than {MOST_NODES} values", event, "aliases count each time; write out what repeats"
            )
        return value

    def _refuse(self, rule: str, message: str, event: Any, hint: str) -> NoReturn:
        mark = event.start_mark
        self.report.error(rule, message, self.source.span(mark.line + 1, mark.column + 1), hint)
        raise _Refused


def scalar(text: str) -> int | Decimal | bool | str | None:
    """A plain scalar by the rules of the YAML 1.2 core schema; infinities and not-a-numbers stay text."""
    if text[:1] not in _NUMBER_STARTS:
        return _WORDS.get(text, text)
    if _INTEGER.fullmatch(text):
        return int(text) if len(text) <= MOST_DIGITS else text
    if _RADIX.fullmatch(text) and len(text) <= MOST_DIGITS:
        return int(text, 0)
    if _FLOAT.fullmatch(text) and len(text) <= MOST_DIGITS:
        return Decimal(text)
    return text
