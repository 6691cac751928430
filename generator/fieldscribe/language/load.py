"""Reads YAML 1.2 text with libyaml, and returns a mapping for each document; values know where they stand.

Mappings and lists become `Map` and `Seq`, plain scalars what the core rules of YAML 1.2 say. Tags are refused; depth,
number of values and expansion of aliases are limited.
"""

import re
from collections.abc import Iterator
from decimal import Decimal
from sys import intern
from typing import Any, NoReturn

import yaml
from yaml import AliasEvent, MappingEndEvent, MappingStartEvent, ScalarEvent, SequenceEndEvent, StreamEndEvent

from fieldscribe.diagnostics import LINE_BREAK, Report, Span
from fieldscribe.language.nodes import Map, Place, Seq, SourceFile, Value, share

MOST_DIGITS = 64

_NUMBER = re.compile(
    r"([-+]?[0-9]+)|(0o[0-7]+|0x[0-9a-fA-F]+)|[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-3]?[0-9]{1,2})?"
)
WORDS: dict[str, bool | None] = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
}
_PLAIN = re.compile(r"[^\W_][\w .+*/=()°%;<>!'-]*(?<! )")
_OTHERWISE = frozenset({"on", "off", "yes", "no", "y", "n"})
"""Words that readers of YAML 1.1 take for true or false."""
_NUMBER_STARTS = frozenset("-+.0123456789")
_NUMBER_ENDS = frozenset(".0123456789abcdefABCDEF")


def scalar(text: str) -> int | Decimal | bool | str | None:
    """Return the value of a plain scalar: `on`, `NO` and `12:30` are text, `010` is ten, decimals are exact.

    These are the rules of the core schema of YAML 1.2, but infinities and overlong numbers stay text.
    """
    if text[:1] not in _NUMBER_STARTS:
        return WORDS.get(text, text)
    if text.isdecimal() and text.isascii():  # most numbers are, and a pattern takes longer
        return int(text) if len(text) <= MOST_DIGITS else text
    if text[-1] not in _NUMBER_ENDS:
        return text
    number = _NUMBER.fullmatch(text)
    if number is None or len(text) > MOST_DIGITS:
        return text
    if number[1]:
        return int(text)
    return int(text, 0) if number[2] else Decimal(text)


def as_yaml(text: str) -> str:
    """Return a text as a YAML scalar, in quotes where a reader of YAML 1.1 or 1.2 needs them."""
    if _PLAIN.fullmatch(text) and scalar(text) == text and text.lower() not in _OTHERWISE:
        return text
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def flow_text(value: Any) -> str:
    """Return a value as YAML on one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {flow_text(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(flow_text, value)) + "]"
    if isinstance(value, str):
        return value if value in ("yes", "no") or value.startswith("0x") else as_yaml(value)
    return str(value).lower() if isinstance(value, bool) else "~" if value is None else str(value)


MOST_DEPTH = 40
MOST_VALUES = 1_000_000
MOST_DOCUMENTS = 10_000

_MOST_PIECES = 100
_WORD = re.compile(r"[a-z][a-z0-9_]*")
_KEY = re.compile(r" *[^\s:]+")
_NO_KEY = re.compile(r" *(?:-[^\s-].*|(?!.*:(?: |$))[^ #-].*)")
"""A line that should have a key but has no colon, or no blank after its dash."""
_NOTICED_LATE = ("expected ':'", "expected ',' or '", "end of stream")

_SYNTAX_HINTS = (
    ("start any token", "tabs cannot indent YAML, and `%`, `@` and a backquote start no plain text: quote it"),
    (
        "mapping values are not allowed",
        "quote a text that holds `: `, or look at dash, colon and indentation here and in the line above",
    ),
    ("expected ',' or '", "a bracket is not closed, or a text in it holds a comma, a colon or a brace: quote it"),
    ("expected key", "this line is indented like a key, but is none: look at the indentation and at open quotes"),
    ("block end", "look at the indentation: all keys of a mapping start in one column"),
    ("end of stream", "a quote or a bracket is not closed"),
    ("alphabetic", "an anchor or alias is a plain word: quote the text if `&` or `*` belongs to it"),
    ("anchor", "an anchor or alias is a plain word: quote the text if `&` or `*` belongs to it"),
    ("expected ':'", "a key stands on one line with `: ` after it, and has at most 1,000 characters"),
    ("document start", "a line `---` divides documents; nothing stands after `...`"),
)


class _StopReading(Exception):  # noqa: N818  # no error: the finding is already reported
    """Raised to leave the rest of the file unread."""


def load(source: SourceFile, report: Report) -> list[Map | None]:
    """Return the mapping of each document; None, with a finding, for one that is no mapping or cannot be read.

    Empty documents are left out; of two equal keys the first counts.
    """
    documents: list[Map | None] = []
    try:
        documents.extend(_Reader(source, report).documents())
    except _StopReading:
        documents.append(None)
    except yaml.MarkedYAMLError as error:
        _report_syntax(source, error, report)
        documents.append(None)
    except yaml.YAMLError as error:
        message = f"this is not YAML: {error}".splitlines()[0]
        report.error("yaml-syntax", message, source.span(1, 1), "save the file as plain UTF-8 text")
        documents.append(None)
    return documents


def _report_syntax(source: SourceFile, error: yaml.MarkedYAMLError, report: Report) -> None:
    problem = error.problem or "it ends too early"
    span = source.span(*_place_of(source, error, problem))
    context = f" {error.context}," if error.context else ""
    hint = "look at the indentation, at missing quotes and at brackets that are not closed"
    hint = next((text for words, text in _SYNTAX_HINTS if words in problem), hint)
    report.error("yaml-syntax", f"this is not YAML:{context} {problem}", span, hint)


def _place_of(source: SourceFile, error: yaml.MarkedYAMLError, problem: str) -> Place:
    """Return where to look: libyaml notices an open quote or bracket, or a key without colon, on a later line."""
    mark, opened = error.problem_mark or error.context_mark, error.context_mark
    if mark is None:
        return 1, 1
    lines = [*LINE_BREAK.split(source.text), ""]
    here, above = lines[mark.line], lines[mark.line - 1] if mark.line else ""
    if opened is not None and any(words in problem for words in _NOTICED_LATE):
        if _indentation(here) <= _indentation(lines[opened.line]):
            return opened.line + 1, opened.column + 1
    elif problem.startswith("mapping values") and _KEY.fullmatch(here[: mark.column]) and _NO_KEY.fullmatch(above):
        return mark.line, _indentation(above) + 1
    return mark.line + 1, mark.column + 1


def _indentation(text: str) -> int:
    return len(text) - len(text.lstrip(" "))


class _Scalars(dict[str, Any]):
    """The values of plain scalars, each worked out once; equal texts are one object."""

    def __missing__(self, text: str) -> Any:
        value = self[text] = scalar(text)
        return value


class _Reader:
    """Builds values from libyaml's events."""

    def __init__(self, source: SourceFile, report: Report) -> None:
        self.source = source
        self.report = report
        self.anchors: dict[str, tuple[Value, int]] = {}
        """The value of each anchor, and how many values are inside it."""
        self.values = 0
        self.scalars = _Scalars()
        self.next_event = yaml.CSafeLoader(source.text).get_event

    def documents(self) -> Iterator[Map | None]:
        """Yield the documents that are not empty, as far as they can be read."""
        self.next_event()  # the start of the stream
        count = filled = 0
        while type(event := self.next_event()) is not StreamEndEvent:
            count += 1
            if count > MOST_DOCUMENTS:
                message = f"more than {MOST_DOCUMENTS} documents"
                self._refuse("yaml-size", message, event, "split the description with `parts`")
            event = self.next_event()
            if not _is_empty(event):
                filled += 1
                yield self._document(event)
            self.next_event()  # the end of the document
            self.anchors.clear()
        if not filled:
            self._refuse("file-empty", "the file holds only comments", event, self.source.beginning)

    def _document(self, event: Any) -> Map | None:
        root = self._value(event, 0)
        if isinstance(root, Map):
            return root
        message = "a document must be a mapping of keys to values"
        self._error("wrong-type", message, event, self.source.beginning)
        return None

    def _value(self, event: Any, depth: int) -> Value:
        """Return the value that starts with this event."""
        if type(event) is AliasEvent:
            return self._alias(event)
        if event.tag is not None:
            message = f"the tag `{event.tag[:60]}` is not allowed"
            self._error("yaml-tag", message, event, "remove the tag: types follow from the key")
        before = self.values
        value: Value
        if type(event) is ScalarEvent:
            value = event.value if event.style else self.scalars[event.value]
        elif depth >= MOST_DEPTH:
            message = f"nested deeper than {MOST_DEPTH} levels"
            self._refuse("yaml-depth", message, event, "a description never needs this; check the brackets")
        else:
            is_mapping = type(event) is MappingStartEvent
            value = self._mapping(event, depth) if is_mapping else self._sequence(event, depth)
            self.values += len(value)
            if self.values > MOST_VALUES:
                self._refuse_size(event, "split the description with `parts`")
        if event.anchor is not None:
            self.anchors[event.anchor] = value, self.values - before + 1
        return value

    def _mapping(self, start: Any, depth: int) -> Map:
        result = Map(self.source, start.start_mark.index)
        next_event, scalars = self.next_event, self.scalars
        without_colon: list[Any] = []
        last: Any = None
        while type(key := next_event()) is ScalarEvent:
            event = next_event()
            if type(event) is not ScalarEvent or event.tag is not None or event.anchor is not None:
                value = self._value(event, depth + 1)
            elif event.style:
                value = event.value
            elif event.value or _has_colon(key, event):
                value = scalars[event.value]
            else:
                without_colon.append(key)
                continue
            if without_colon:
                self._join(result, last, without_colon)
                without_colon = []
            name = intern(key.value)
            if name in result or key.tag is not None or key.anchor is not None:
                self._wrong_key(key, result)
                result.setdefault(name, value)
            else:
                result[name] = value
            last = event
        if type(key) is not MappingEndEvent:
            self._refuse(
                "yaml-key", "a key must be plain text, not a list, a mapping or an alias", key, "quote the key"
            )
        if without_colon:
            self._join(result, last, without_colon)
        return result

    def _wrong_key(self, key: Any, mapping: Map) -> None:
        """Report a key that is given twice, or that has a tag or an anchor."""
        if key.tag is not None or key.anchor is not None:
            self._error("yaml-tag", "a key takes no tag and no anchor", key, "remove it")
        if key.value in mapping:
            span = self._span(key).moved(0, max(1, len(key.value)))
            first = (mapping.key_span(key.value), "first given here")
            message = f"the key `{key.value[:60]}` is given twice"
            self.report.error("duplicate-key", message, span, "remove or rename one of them", [first])
            mapping.broken += (key.value,)  # which of the two is right is not known

    def _join(self, mapping: Map, last: Any, pieces: list[Any]) -> None:
        """Report words between commas that have no value, and put them back into the text that they were cut from."""
        key, first = next(reversed(mapping), None), pieces[0].value[:60]
        texts = type(last) is ScalarEvent and not last.style and len(pieces) <= _MOST_PIECES
        keys = all(_WORD.fullmatch(piece.value) for piece in pieces) and not (texts and "(" in last.value)
        hint = f"give it a value: `{first}: …`"
        if key is None or not texts or keys:
            mapping.broken += tuple(piece.value for piece in pieces[:_MOST_PIECES])
        if key is not None and texts:
            whole = ", ".join([last.value, *(piece.value for piece in pieces)])
            quoted = f'if the comma belongs to the text, quote it: `{key[:60]}: "{whole[:200]}"`'
            hint = f"{hint}; {quoted}" if keys else quoted
            mapping[key] = mapping[key] if keys else whole
        message = f"`{first}` stands between commas and has no value"
        self._error("yaml-comma", message, pieces[0], hint)

    def _sequence(self, start: Any, depth: int) -> Seq:
        result = Seq(self.source, start.start_mark.index)
        next_event, append, depth = self.next_event, result.append, depth + 1
        while type(event := next_event()) is not SequenceEndEvent:
            if type(event) is ScalarEvent and event.tag is None and event.anchor is None:
                append(event.value if event.style else self.scalars[event.value])
            else:
                append(self._value(event, depth))
        return result

    def _alias(self, event: Any) -> Value:
        if event.anchor not in self.anchors:
            message = f"the alias `*{event.anchor[:60]}` stands inside its own anchor, or has no anchor above"
            self._refuse("yaml-alias", message, event, "write it out")
        value, size = self.anchors[event.anchor]
        self.values += size
        if self.values > MOST_VALUES:
            hint = "aliases count each time; write out what repeats, or share it under `formats`"
            self._refuse_size(event, hint)
        share(value)
        return value

    def _refuse_size(self, event: Any, hint: str) -> NoReturn:
        self._refuse("yaml-size", f"more than {MOST_VALUES} values", event, hint)

    def _span(self, event: Any) -> Span:
        mark = event.start_mark
        return self.source.span(mark.line + 1, mark.column + 1)

    def _error(self, rule: str, message: str, event: Any, hint: str) -> None:
        self.report.error(rule, message, self._span(event), hint)

    def _refuse(self, rule: str, message: str, event: Any, hint: str) -> NoReturn:
        self._error(rule, message, event, hint)
        raise _StopReading


def _is_empty(event: Any) -> bool:
    """Return True if a document holds nothing."""
    return type(event) is ScalarEvent and not (event.value or event.style or event.tag or event.anchor)


def _has_colon(key: Any, value: Any) -> bool:
    """Return True if a colon stands between a key and its empty value.

    `{when: a in (0, 1)}` has a key without one: `1)`.
    """
    return bool(value.start_mark.index > key.end_mark.index)
