"""Writes the new line numbers of an edition, and its checksum, into the files of a description."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from fieldscribe.audit.comparison import Editions
from fieldscribe.diagnostics import Span
from fieldscribe.language.keys import forms, keys_of
from fieldscribe.language.keys.places import DEVICE, LINES_OF, PART
from fieldscribe.language.load import as_yaml
from fieldscribe.language.nodes import Map, Seq, SourceFile
from fieldscribe.language.shape import compiled_pattern
from fieldscribe.schema_types import Items, Place, ValueShape
from fieldscribe.wording import LINES_NAMED

_WRITTEN = re.compile(r"""(?:&\S+\s+)?["']?(?P<lines>(?P<first>[0-9]+)(?:\.\.(?P<last>[0-9]+))?)""")
_SENTENCES = ("note", "printed", "taken", "where", "why")
"""The keys whose texts may name lines."""
_COMMENT = re.compile(r"(?:^|\s)#")
_NUMBER = re.compile(r"[0-9]+")
LONGEST = {"file": 200, "edition": 80}
"""The facts recorded of a document in addition to its checksum, with the most characters of each."""


class WrittenLines(NamedTuple):
    """Lines first..last as a file cites them at start..end of its text; `last` is 0 for one line.

    `kind` is `line` for a line that opens a row or section, `lines` for others, `looked_through`, or `sentence`.
    """

    source: SourceFile
    start: int
    end: int
    first: int
    last: int
    kind: str
    key: Span
    """The place of the value of the key."""
    is_item: bool = False

    @property
    def where(self) -> str:
        """Its place: file:line."""
        return f"{self.source.name}:{self.source.text.count(chr(10), 0, self.start) + 1}"


@dataclass(slots=True)
class Renumbered:
    """The new texts of files by name, the number of changes, what prevents them, and what is left to do by hand."""

    texts: dict[str, str] = field(default_factory=dict)
    count: int = 0
    hindrances: list[str] = field(default_factory=list)
    by_hand: list[str] = field(default_factory=list)


class _AliasError(Exception):
    """A cited line is an alias; the argument says where."""


def renumber(files: Iterable[Map], document: str, editions: Editions) -> Renumbered:
    """Return the files with every line number of a document as in the new edition."""
    outcome = Renumbered()
    try:
        written = _all_written_lines(files, document)
    except _AliasError as error:
        outcome.hindrances.append(f"{error}: a line is cited by an alias: write its number")
        return outcome
    pieces: dict[str, list[str]] = {}
    ends: dict[str, int] = {}
    sources = {lines.source.name: lines.source for lines in written}
    for lines in written:
        name, text = lines.source.name, lines.source.text
        before = text[lines.start : lines.end]
        after = before if editions.counts_new(lines.key) else _as_in_new(lines, editions, outcome) or before
        pieces.setdefault(name, []).extend((text[ends.get(name, 0) : lines.start], after))
        ends[name] = lines.end
        outcome.count += after != before
    for name, source in sources.items():
        text = "".join((*pieces[name], source.text[ends[name] :]))
        if text != source.text:
            outcome.texts[name] = text
            outcome.by_hand += _in_comments(source, editions)
    return outcome


def _as_in_new(lines: WrittenLines, editions: Editions, outcome: Renumbered) -> str | None:
    """Return the text to write in place of lines of the old edition; None if they stay."""
    now = editions.alignment.now
    if lines.kind == "sentence":
        line = now(lines.first)
        if line is None:
            outcome.by_hand.append(f"{lines.where}: the sentence names line {lines.first}, which is gone")
        return None if line is None else str(line)
    places = sorted({place for line in range(lines.first, max(lines.first, lines.last) + 1) if (place := now(line))})
    if not places:
        hint = "cite another, or take out what cites it"
        outcome.hindrances.append(f"{lines.where}: line {lines.first} is gone: {hint}")
        return None
    if not lines.last:
        return str(places[0])
    runs = _runs(places, editions) if lines.kind == "looked_through" else [(places[0], places[-1])]
    text = ", ".join(f"{first}..{last}" for first, last in runs)
    return text if lines.is_item or len(runs) == 1 else f"[{text}]"


def _runs(places: list[int], editions: Editions) -> list[tuple[int, int]]:
    """Return the runs of lines without new ones in between, which nobody has looked through yet."""
    runs: list[tuple[int, int]] = []
    for place in places:
        between = range(runs[-1][1] + 1, place) if runs else range(0)
        if runs and all(editions.is_blank_in_new(line) for line in between):
            runs[-1] = (runs[-1][0], place)
        else:
            runs.append((place, place))
    return runs


def _in_comments(source: SourceFile, editions: Editions) -> Iterator[str]:
    """List the lines named in comments that moved: comments are not changed."""
    scalars = list(scalars_in(source.text))
    for named in LINES_NAMED.finditer(source.text):
        before = source.text[source.text.rfind("\n", 0, named.start()) + 1 : named.start()]
        if _COMMENT.search(before) and not any(first <= named.start() < end for first, end in scalars):
            for number in map(int, _NUMBER.findall(named[0])):
                line = editions.alignment.now(number)
                if line != number:
                    change = "is gone" if line is None else f"is {line} now"
                    place = source.text.count("\n", 0, named.start()) + 1
                    yield f"{source.name}:{place}: a comment names line {number}, which {change}"


def _all_written_lines(files: Iterable[Map], document: str) -> list[WrittenLines]:
    """Return all line numbers of one document, by file and place. Raises _AliasError."""
    found: dict[tuple[str, int], WrittenLines] = {}
    for number, file in enumerate(files):
        walk = _Walk(document)
        walk.mapping(file, (DEVICE if number == 0 else PART).shape, document)
        found |= {(lines.source.name, lines.start): lines for lines in walk.found}
    return [found[place] for place in sorted(found)]


class _Walk:
    """Goes through a file along the shape that the table of keys gives it."""

    def __init__(self, document: str) -> None:
        self.document = document
        self.found: list[WrittenLines] = []
        self._scalars: dict[str, list[tuple[int, int]]] = {}

    def mapping(self, value: Map, shape: ValueShape, document: str) -> None:
        source = value.get("source")
        document = str(value.get("document") or (source.get("document") if isinstance(source, Map) else "") or document)
        for key, item in value.items():
            inner = _shape_of(key, shape)
            if inner is None:
                continue
            if key == "line" or inner is LINES_OF:
                if document == self.document:
                    self._lines(value, key)
            elif key in _SENTENCES:
                self._sentences(value, key, document)
            if isinstance(item, Map) and key not in _SENTENCES:
                self.mapping(item, inner, document)
            elif isinstance(item, Seq):
                for item_shape in (kind.item for kind in inner.kinds if isinstance(kind, Items)):
                    for element in (element for element in item if isinstance(element, Map)):
                        self.mapping(element, item_shape, document)

    def _lines(self, holder: Map, key: str) -> None:
        value, span, source = holder[key], holder.span(key), holder.file
        kind = key if key == "line" else "looked_through" if key == "lines" else "lines"
        if isinstance(value, Seq):
            offsets = [source.offset(value.span(number).at) for number in range(len(value))]
        else:
            offsets = [source.offset(span.at)]
        for offset in offsets:
            match = _WRITTEN.match(source.text, offset)
            if match is None:
                raise _AliasError(f"{source.name}:{source.text.count(chr(10), 0, offset) + 1}")
            first, last = int(match["first"]), int(match["last"] or 0)
            place = match.span("lines")
            self.found.append(WrittenLines(source, *place, first, last, kind, span, isinstance(value, Seq)))

    def _sentences(self, holder: Map, key: str, document: str) -> None:
        """Yield the lines in a sentence, or in a note in several languages; printed facts name no lines."""
        value, source = holder[key], holder.file
        if document != self.document or not LINES_NAMED.search(source.text):
            return
        for texts, name in ((value, name) for name in value) if isinstance(value, Map) else ((holder, key),):
            if isinstance(texts[name], str):
                self._sentence(texts, name)

    def _sentence(self, holder: Map, key: str) -> None:
        source, span = holder.file, holder.span(key)
        if source.name not in self._scalars:
            self._scalars[source.name] = list(scalars_in(source.text))
        offset = source.offset(span.at)
        start, end = next((ends for ends in self._scalars[source.name] if ends[0] <= offset < ends[1]), (0, 0))
        for named in LINES_NAMED.finditer(source.text, start, end):
            for number in _NUMBER.finditer(source.text, named.start(), named.end()):
                self.found.append(WrittenLines(source, *number.span(), int(number[0]), 0, "sentence", span))


def _shape_of(key: str, shape: ValueShape) -> ValueShape | None:
    for kind in shape.kinds:
        if isinstance(kind, Place):
            if key in (keys := keys_of(kind)):
                return keys[key].shape
            for form, inner in kind.by_form.items():
                if form is forms.ANY or compiled_pattern(form.pattern).search(key):
                    return inner
    return None


def scalars_in(text: str) -> Iterator[tuple[int, int]]:
    """Yield the begin and the end of each scalar of a YAML text."""
    import yaml

    for token in yaml.scan(text, Loader=yaml.SafeLoader):
        if isinstance(token, yaml.ScalarToken):
            yield token.start_mark.index, token.end_mark.index


def hindrances(document: str, recorded: Map, given: Mapping[str, str], name: str, sha256: str) -> Iterator[str]:
    """Yield why the text of this name and checksum cannot be recorded from the given facts: nothing is guessed."""
    if "sha256" not in recorded:
        yield f"documents.{document} records no text: add `sha256: {sha256}` there"
    yield from (f"documents.{document} has no `{key}`: add it there" for key in given if key not in recorded)
    if recorded.get("sha256") == sha256:
        return
    was = recorded.get("file", name)
    if was != name and "file" not in given:
        ways = f"give --file {name}, or --file {was} if it takes that name"
        yield f"documents.{document}.file is `{was}`, the new text is `{name}`: {ways}"
    if "edition" in recorded and "edition" not in given:
        yield f"documents.{document}.edition is `{recorded['edition']}`: give --edition and what the new manual prints"


def with_recorded(recorded: Map, facts: Mapping[str, str]) -> str | None:
    """Return the text of the file with these facts of a document; None if one of them is an alias there."""
    text = recorded.file.text
    scalars = list(scalars_in(text))
    changes: list[tuple[int, int, str]] = []
    for key, value in facts.items():
        at = recorded.file.offset(recorded.span(key).at)
        ends = next((ends for ends in scalars if ends[0] <= at < ends[1]), None)
        if ends is None:
            return None
        if recorded[key] != value:
            changes.append((*ends, as_yaml(value)))
    for start, end, written in sorted(changes, reverse=True):
        text = text[:start] + written + text[end:]
    return text
