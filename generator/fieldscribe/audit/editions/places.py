"""Every number of a line in the files of a description, with its place there: in keys, and in sentences."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, NamedTuple

from fieldscribe.language.keys import forms, keys_of
from fieldscribe.language.keys.places import DEVICE, PART
from fieldscribe.language.keys.shapes import LINES_OF
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.value_checks import compiled_pattern
from fieldscribe.schema_types import Items, Place
from fieldscribe.wording.lines import LINES_NAMED

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.diagnostics import Span
    from fieldscribe.language.source import SourceFile
    from fieldscribe.schema_types import Shape

_WRITTEN = re.compile(r"""(?:&\S+\s+)?["']?(?P<lines>(?P<first>[0-9]+)(?:\.\.(?P<last>[0-9]+))?)""")
SENTENCES = ("note", "printed", "taken", "where", "why")
"""The keys whose texts may name lines."""
_COMMENT = re.compile(r"(?:^|\s)#")
_NUMBER = re.compile(r"(?P<run>to\s+|\.\.\s*)?(?P<line>[0-9]+)")


class Citation(NamedTuple):
    """Lines first..last that a file cites at start..end; `last` is 0 where it is one line.

    `kind` is `line` for a line that opens a row or section, `lines` for others, `looked_through`, or `sentence`.
    """

    source: SourceFile
    start: int
    end: int
    first: int
    last: int
    kind: str
    key: Span
    """Where the value of its key stands."""
    is_item: bool = False
    """Whether it is an item of a list."""

    @property
    def where(self) -> str:
        """Its place: file:line."""
        return f"{self.source.name}:{self.source.text.count(chr(10), 0, self.start) + 1}"


class UnclearPlaceError(Exception):
    """A cited line is not written out where it is cited; the argument says where."""


def citations_in(files: Iterable[Map], document: str) -> list[Citation]:
    """All numbers of lines of one document, by file and place. Raises UnclearPlaceError."""
    found: dict[tuple[str, int], Citation] = {}
    for number, file in enumerate(files):
        walk = _Walk(document)
        walk.mapping(file, (DEVICE if number == 0 else PART).shape, document)
        for citation in walk.found:
            found[citation.source.name, citation.start] = citation
    return [found[place] for place in sorted(found)]


class _Walk:
    """Goes through a file along the shape that the table of keys gives it."""

    def __init__(self, document: str) -> None:
        self.document = document
        self.found: list[Citation] = []
        self._texts: dict[str, list[tuple[int, int]]] = {}

    def mapping(self, value: Map, shape: Shape, document: str) -> None:
        source = value.get("source")
        document = str(value.get("document") or (source.get("document") if isinstance(source, Map) else "") or document)
        for key, item in value.items():
            inner = _shape_of(key, shape)
            if inner is None:
                continue
            offset = value.file.offset(value.span(key).at)
            if key == "line" or inner is LINES_OF:
                if document == self.document:
                    self._lines(value, key, offset)
            elif key in SENTENCES and isinstance(item, str):
                if document == self.document:
                    self._sentence(value, key)
            else:
                self._inside(key, item, inner, document)

    def _inside(self, key: str, value: Any, shape: Shape, document: str) -> None:
        if isinstance(value, Map):
            if key in SENTENCES:
                self._texts_of(value, document)
            else:
                self.mapping(value, shape, document)
        elif isinstance(value, Seq):
            for item_shape in (kind.item for kind in shape.kinds if isinstance(kind, Items)):
                for item in value:
                    if isinstance(item, Map):
                        self.mapping(item, item_shape, document)

    def _texts_of(self, value: Map, document: str) -> None:
        """A note in several languages; what is printed as facts names no lines."""
        for key, text in value.items():
            if isinstance(text, str) and document == self.document:
                self._sentence(value, key)

    def _lines(self, holder: Map, key: str, offset: int) -> None:
        value, span = holder[key], holder.span(key)
        kind = key if key == "line" else "looked_through" if key == "lines" else "lines"
        if isinstance(value, Seq):
            for number in range(len(value)):
                at = holder.file.offset(value.span(number).at)
                self.found.append(_written(holder.file, at, kind, span, is_item=True))
        else:
            self.found.append(_written(holder.file, offset, kind, span))

    def _sentence(self, holder: Map, key: str) -> None:
        source, span = holder.file, holder.span(key)
        if not LINES_NAMED.search(source.text):
            return
        if source.name not in self._texts:
            self._texts[source.name] = list(scalars_in(source.text))
        offset = source.offset(span.at)
        start, end = next((ends for ends in self._texts[source.name] if ends[0] <= offset < ends[1]), (0, 0))
        for named in LINES_NAMED.finditer(source.text, start, end):
            for number in _NUMBER.finditer(source.text, named.start(), named.end()):
                line = int(number["line"])
                first, last = (0, line) if number["run"] else (line, 0)
                place = number.span("line")
                self.found.append(Citation(source, *place, first, last, "sentence", span))


def lines_in_comments(source: SourceFile) -> Iterator[tuple[int, int]]:
    """The numbers of lines that comments name: the line of the file, and the number."""
    for named in LINES_NAMED.finditer(source.text):
        before = source.text[source.text.rfind("\n", 0, named.start()) + 1 : named.start()]
        if _COMMENT.search(before) and not any(first <= named.start() < end for first, end in scalars_in(source.text)):
            for number in _NUMBER.finditer(source.text, named.start(), named.end()):
                yield source.text.count("\n", 0, named.start()) + 1, int(number["line"])


def _written(source: SourceFile, offset: int, kind: str, key: Span, *, is_item: bool = False) -> Citation:
    match = _WRITTEN.match(source.text, offset)
    if match is None:
        line = source.text.count("\n", 0, offset) + 1
        raise UnclearPlaceError(f"{source.name}:{line}")
    last = int(match["last"] or 0)
    return Citation(source, match.start("lines"), match.end("lines"), int(match["first"]), last, kind, key, is_item)


def _shape_of(key: str, shape: Shape) -> Shape | None:
    for kind in shape.kinds:
        if isinstance(kind, Place):
            if key in (keys := keys_of(kind)):
                return keys[key].shape
            for form, inner in kind.by_form.items():
                if form is forms.ANY or compiled_pattern(form.pattern).search(key):
                    return inner
    return None


def scalars_in(text: str) -> Iterator[tuple[int, int]]:
    """Where each scalar of a YAML text begins and ends."""
    import yaml

    for token in yaml.scan(text, Loader=yaml.SafeLoader):
        if isinstance(token, yaml.ScalarToken):
            yield token.start_mark.index, token.end_mark.index
