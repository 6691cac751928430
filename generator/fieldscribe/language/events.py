"""Any YAML 1.2 text, read with PyYAML: one mapping for each document, and what is wrong with the text.

Mappings and sequences become `Map` and `Seq`, plain scalars what `scalars.py` makes of them. Nothing is constructed
from tags, and what aliases and nesting may cost is bounded.
"""

from __future__ import annotations

import re
from sys import intern
from typing import TYPE_CHECKING, Any, NoReturn

import yaml

from fieldscribe.language.nodes import Map, Seq, Value, share
from fieldscribe.language.scalars import scalar

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.diagnostics import Report, Span
    from fieldscribe.language.source import SourceFile

MOST_DEPTH = 40
MOST_NODES = 1_000_000
MOST_DOCUMENTS = 10_000

_MOST_PIECES = 100
_WORD = re.compile(r"[a-z][a-z0-9_]*")

_SYNTAX_HINTS = (
    ("start any token", "tabs cannot indent YAML, and `%`, `@` and a backquote start no plain text: quote it"),
    ("mapping values are not allowed", "quote a text that holds `: `, or look at the indentation"),
    ("expected ',' or '", "a bracket is not closed, or a text in it holds a comma, a colon or a brace: quote it"),
    ("expected key", "this line is indented like a key, but is none: look at the indentation and at open quotes"),
    ("block end", "look at the indentation: all keys of a mapping start in one column"),
    ("end of stream", "a quote or a bracket is not closed"),
    ("anchor", "an anchor or alias is a plain word: quote the text if `&` or `*` is meant"),
)


class _RefusedError(Exception):
    """Reading stops here; the finding is already reported."""


def load_any(source: SourceFile, report: Report) -> list[Map | None]:
    """The mapping of each document; None, with a finding, for a document that is no mapping or cannot be read.

    Empty documents are left out; duplicate keys are left out.
    """
    documents: list[Map | None] = []
    try:
        documents.extend(_Builder(source, report).documents())
    except _RefusedError:
        documents.append(None)
    except yaml.MarkedYAMLError as error:
        _syntax(source, error, report)
        documents.append(None)
    except yaml.YAMLError as error:
        message = f"this is not YAML: {error}".splitlines()[0]
        report.error("yaml-syntax", message, source.span(1, 1), "save the file as plain UTF-8 text")
        documents.append(None)
    return documents


def _syntax(source: SourceFile, error: yaml.MarkedYAMLError, report: Report) -> None:
    mark = error.problem_mark or error.context_mark
    span = source.span(1, 1) if mark is None else source.span(mark.line + 1, mark.column + 1)
    problem = error.problem or "it ends too early"
    context = f" {error.context}," if error.context else ""
    hint = "look at the indentation, at missing quotes and at brackets that are not closed"
    hint = next((said for words, said in _SYNTAX_HINTS if words in problem), hint)
    report.error("yaml-syntax", f"this is not YAML:{context} {problem}", span, hint)


class _Builder:
    """Builds values from parser events; the depth is bounded before Python's own stack could be."""

    def __init__(self, source: SourceFile, report: Report) -> None:
        self.source = source
        self.report = report
        self.anchors: dict[str, tuple[Value, int]] = {}
        self.nodes = 0
        self.next_event = yaml.CSafeLoader(source.text).get_event

    def documents(self) -> Iterator[Map | None]:
        """The documents that hold something, as far as they can be read."""
        self.next_event()  # stream start
        count = held = 0
        while type(event := self.next_event()) is not yaml.StreamEndEvent:
            count += 1
            if count > MOST_DOCUMENTS:
                message = f"more than {MOST_DOCUMENTS} documents"
                self._refuse("yaml-size", message, event, "split the description with `parts`")
            event = self.next_event()
            if not _is_nothing(event):
                held += 1
                yield self._document(event)
            self.next_event()  # document end
            self.anchors.clear()
        if not held:
            hint = "a description starts with `fieldscribe: 1` and `device: …`"
            self._refuse("file-empty", "the file holds only comments", event, hint)

    def _document(self, event: Any) -> Map | None:
        root = self._node(event, 0)
        if isinstance(root, Map):
            return root
        hint = "a description starts with `fieldscribe: 1` and `device: …`, a part with `group: …` or shared facts"
        self._error("wrong-type", "a document must be a mapping of keys to values", event, hint)
        return None

    def _node(self, event: Any, depth: int) -> Value:
        kind = type(event)
        if kind is yaml.AliasEvent:
            return self._alias(event)
        self.nodes += 1
        if event.tag is not None:
            message = f"the tag `{event.tag[:60]}` is not allowed"
            self._error("yaml-tag", message, event, "remove the tag: types follow from the key")
        if kind is yaml.ScalarEvent:
            text: str = event.value
            value: Value = text if event.style else scalar(text)
            if event.anchor is not None:
                self._remember(event, value, self.nodes)
            return value
        if depth >= MOST_DEPTH:
            message = f"nested deeper than {MOST_DEPTH} levels"
            self._refuse("yaml-depth", message, event, "a description never needs this; check the brackets")
        first = self.nodes
        collection = self._mapping(event, depth) if kind is yaml.MappingStartEvent else self._sequence(event, depth)
        self._remember(event, collection, first)
        return collection

    def _mapping(self, event: Any, depth: int) -> Map:
        mark = event.start_mark
        result = Map(self.source, (mark.line + 1, mark.column + 1))
        next_event, node = self.next_event, self._node
        places = result.places
        cut: list[Any] = []
        last: Any = None
        while True:
            event = next_event()
            if type(event) is yaml.MappingEndEvent:
                if cut:
                    self._cut(result, last, cut)
                return result
            named, event = event, next_event()
            if type(event) is yaml.ScalarEvent and not event.value and _lacks_colon(named, event):
                cut.append(named)
                continue
            if cut:
                self._cut(result, last, cut)
                cut = []
            key = self._key(named, result)
            mark = named.start_mark
            at = _place(event)
            value = node(event, depth + 1)
            last = event
            if key is not None:
                result[key] = value
                places[key] = (mark.line + 1, mark.column + 1, *at)

    def _cut(self, into: Map, last: Any, pieces: list[Any]) -> None:
        """Report words between commas that have no value, and put them back into the text that they were cut from."""
        key, first = next(reversed(into), None), pieces[0].value[:60]
        texts = type(last) is yaml.ScalarEvent and not last.style and len(pieces) <= _MOST_PIECES
        keys = all(_WORD.fullmatch(piece.value) for piece in pieces) and not (texts and "(" in last.value)
        hint = f"give it a value: `{first}: …`"
        if key is None or not texts or keys:
            into.broken += tuple(piece.value for piece in pieces[:_MOST_PIECES])
        if key is not None and texts:
            whole = ", ".join([last.value, *(piece.value for piece in pieces)])
            quoted = f'if the comma belongs to the text, quote it: `{key[:60]}: "{whole[:200]}"`'
            hint = f"{hint}; {quoted}" if keys else quoted
            into[key] = into[key] if keys else whole
        message = f"`{first}` stands between commas and has no value"
        self._error("yaml-comma", message, pieces[0], hint)

    def _sequence(self, event: Any, depth: int) -> Seq:
        mark = event.start_mark
        result = Seq(self.source, (mark.line + 1, mark.column + 1))
        while True:
            event = self.next_event()
            if type(event) is yaml.SequenceEndEvent:
                return result
            result.item_at.append(_place(event))
            result.append(self._node(event, depth + 1))

    def _key(self, event: Any, into: Map) -> str | None:
        if type(event) is not yaml.ScalarEvent:
            self._refuse(
                "yaml-key", "a key must be plain text, not a list, a mapping or an alias", event, "quote the key"
            )
        if event.tag is not None or event.anchor is not None:
            self._error("yaml-tag", "a key takes no tag and no anchor", event, "remove it")
        key: str = intern(event.value)
        if key in into:
            span = self._span(event).moved(0, max(1, len(key)))
            first = (into.key_span(key), "first given here")
            message = f"the key `{key[:60]}` is given twice"
            self.report.error("duplicate-key", message, span, "remove or rename one of them", [first])
            into.broken += (key,)  # which of the two is meant is not known
            return None
        return key

    def _remember(self, event: Any, value: Value, first: int) -> None:
        if event.anchor is not None:
            self.anchors[event.anchor] = (value, self.nodes - first + 1)
        if self.nodes > MOST_NODES:
            self._refuse("yaml-size", f"more than {MOST_NODES} values", event, "split the description with `parts`")

    def _alias(self, event: Any) -> Value:
        if event.anchor not in self.anchors:
            message = f"the alias `*{event.anchor[:60]}` stands inside what it names, or names nothing above"
            self._refuse("yaml-alias", message, event, "write it out")
        value, size = self.anchors[event.anchor]
        self.nodes += size
        if self.nodes > MOST_NODES:
            hint = "aliases count each time; write out what repeats, or share it under `formats`"
            self._refuse("yaml-size", f"more than {MOST_NODES} values", event, hint)
        share(value)
        return value

    def _span(self, event: Any) -> Span:
        mark = event.start_mark
        return self.source.span(mark.line + 1, mark.column + 1)

    def _error(self, rule: str, message: str, event: Any, hint: str) -> None:
        self.report.error(rule, message, self._span(event), hint)

    def _refuse(self, rule: str, message: str, event: Any, hint: str) -> NoReturn:
        self._error(rule, message, event, hint)
        raise _RefusedError


def _is_nothing(event: Any) -> bool:
    """Whether a document is empty."""
    return type(event) is yaml.ScalarEvent and not (event.value or event.style or event.tag or event.anchor)


def _lacks_colon(key: Any, value: Any) -> bool:
    """Whether a key in braces has neither value nor colon: `{when: a in (0, 1)}` has such a key, `1)`."""
    if type(key) is not yaml.ScalarEvent or value.style or value.tag or value.anchor:
        return False
    start, end = value.start_mark, key.end_mark
    return start is not None and end is not None and bool(start.index == end.index)


def _place(event: Any) -> tuple[int, int]:
    """Where a value starts, behind the quote if it has one: columns in formulas count from there."""
    mark = event.start_mark
    quoted = type(event) is yaml.ScalarEvent and event.style in ("'", '"')
    return mark.line + 1, mark.column + 1 + quoted
