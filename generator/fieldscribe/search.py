"""Lists and searches descriptions.

Summaries are read quickly, because no point is resolved. An entry is anything with a name, with its texts. Words
are searched in these; the nearest hits come first.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from functools import lru_cache
from operator import itemgetter
from pathlib import Path
from typing import Any, NamedTuple

from fieldscribe.diagnostics import Report, Span
from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import integer_in
from fieldscribe.model import Entry as EnumEntry
from fieldscribe.model.numbers import Titles
from fieldscribe.pasted_numbers import number_of
from fieldscribe.pipeline import load_outline
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.points import ResolvedPoint
from fieldscribe.resolve.scope import Scope, titles
from fieldscribe.text import line
from fieldscribe.wording import label, title_text

_FAULT_NAMES = ("fault", "error", "trip", "alarm")
"""A point whose name has one of these words lists faults."""


class Text(NamedTuple):
    """A text of an entry: its kind, its place, and the number that it names (in an enum)."""

    kind: str
    text: str
    place: Span
    number: int | None = None


@dataclass(frozen=True, slots=True)
class Entry:
    """A point, command, message, code, ...; `number` is that of a code; `lists_faults`: its numbers are faults."""

    device: str
    kind: str
    name: str
    code: str | None
    heading: str
    texts: list[Text] = field(default_factory=list)
    number: int | None = None
    lists_faults: bool = False


def entries_of(subject: Analysis) -> Iterator[Entry]:
    """Return an entry for everything in a device that has a name."""
    device = str(subject.scope.header["device"])
    for resolved in subject.resolved:
        yield _point(device, subject.scope, resolved)
    for section in ("commands", "messages", "telegrams"):
        for node in subject.scope.listed(section):
            yield _named(device, section[:-1], node)
    for opened in subject.located_frames:
        yield _named(device, "frame", opened.node)
    yield from _codes(device, subject)


def _point(device: str, scope: Scope, resolved: ResolvedPoint) -> Entry:
    point, draft = resolved.point, resolved.facts
    lists_faults = any(word in point.name for word in _FAULT_NAMES)
    heading = f"{label(point)}: {line(title_text(point.title))}"
    of_keys = [
        ("name", "name", dict.fromkeys((point.item, point.name))),
        ("code", "code", [point.code]),
        ("title", "title", _distinct(point.title)),
        ("old name", "was", point.was),
        ("section", "section", [point.source.section]),
    ]
    texts = [Text(kind, text, draft.span(key)) for kind, key, known in of_keys for text in known if text]
    texts.append(Text("group", point.group, draft.span()))
    for special in point.specials:
        texts += [Text("special code", text, draft.span()) for text in (special.name, *_distinct(special.title))]
    texts += _enum("enum", point.enum.entries if point.enum else (), _enum_map(scope, draft), draft)
    if point.digits is not None:
        texts += _enum("digit", point.digits.enum.entries, None, draft)
    flags = draft.get("flags")
    for flag in point.flags:
        place = _place_of_flag(flags, flag.name, draft)
        texts += [Text("flag", text, place) for text in (flag.name, *_distinct(flag.title))]
        texts += [Text("flag", text, place) for entry in flag.values for text in (entry.name, *_distinct(entry.title))]
    return Entry(device, "point", point.item, point.code, heading, texts, lists_faults=lists_faults)


def _distinct(titles: Titles) -> Iterable[str]:
    return dict.fromkeys(titles.values())


def _enum(kind: str, entries: Iterable[EnumEntry], listed: Map | None, draft: PointFacts) -> Iterator[Text]:
    keys = {integer_in(key): key for key in listed or ()}
    for entry in entries:
        key = keys.get(entry.raw)
        place = draft.span() if listed is None or key is None else listed.key_span(key)
        for text in dict.fromkeys((entry.name, *entry.title.values(), entry.quantity or "")):
            if text:
                yield Text(kind, text, place, entry.raw)


def _enum_map(scope: Scope, draft: PointFacts) -> Map | None:
    """Return the mapping of the point's enum, its own or a shared one; None if there is none."""
    node = draft.get("enum")
    node = scope.named_enums.get(node) if isinstance(node, str) else node
    return node if isinstance(node, Map) else None


def _place_of_flag(flags: object, name: str, draft: PointFacts) -> Span:
    if isinstance(flags, Map):
        for key, value in flags.items():
            if value == name or (isinstance(value, Map) and value.get("name") == name):
                return flags.key_span(key)
    return draft.span()


def _named(device: str, kind: str, node: Map) -> Entry:
    """Return the entry of a command, message, telegram or frame."""
    name, titles = str(node["name"]), node.get("title", {})
    named = [str(text) for text in titles.values()] if isinstance(titles, Map) else []
    heading = line(f"{kind} {name}: {' / '.join(named)}".rstrip(": "))
    texts = [Text("name", name, node.span("name"))]
    texts += [Text("title", text, node.span("title")) for text in named]
    if node.get("section"):
        texts.append(Text("section", str(node["section"]), node.span("section")))
    return Entry(device, kind, name, None, heading, texts)


def _codes(device: str, subject: Analysis) -> Iterator[Entry]:
    """Return the numbered codes of the protocol: functions, exceptions, tasks, errors, ..."""
    bus = subject.scope.bus
    for codes in subject.scope.family.codes:
        listed = None if bus is None else bus.get(codes.section)
        keys = {integer_in(key): key for key in listed or ()}
        for code in subject.bus.codes(codes.section):
            heading = line(f"{codes.kind} {keys.get(code.number, code.number)} {code.name}: {title_text(code.title)}")
            place = subject.scope.header.span()
            if isinstance(listed, Map):
                place = listed.key_span(keys[code.number])
            texts = [Text("name", code.name, place)]
            texts += [Text("title", text, place) for text in _distinct(code.title)]
            texts.append(Text("number", str(code.number), place, code.number))
            yield Entry(device, codes.kind, code.name, None, heading, texts, code.number)


class Summary(NamedTuple):
    """A device in a list; `points` is their number, `names` are their names and codes."""

    device: str
    vendor: str
    model: str
    title: dict[str, str]
    family: str
    version: str
    points: int
    names: tuple[str, ...]

    def as_data(self) -> dict[str, Any]:
        """Return the summary for JSON."""
        return {key: value for key, value in self._asdict().items() if key != "names"}


def summary_of(device_file: Path) -> Summary | None:
    """Return the summary of a description; None if it cannot be read."""
    outline = load_outline(device_file, Report())
    if outline is None:
        return None
    header, drafts = outline
    texts = [line(str(header.get(key, ""))) for key in ("device", "vendor", "model", "family", "version")]
    device, vendor, model, family, version = texts
    title = {str(key): line(str(text)) for key, text in titles(header.get("title")).items()}
    names = dict.fromkeys(line(name) for draft in drafts for name in (draft.item, draft.code) if name)
    return Summary(device, vendor, model, title, family, version, len(drafts), tuple(names))


_FAULTS = frozenset({"error", "exception", "fault"})
"""Kinds of codes that people do not distinguish."""
_UMLAUTS = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue"})
_WORD = re.compile(r"\w+(?:[.-]\w+)*")
_WEIGHTS = {"name": 0, "code": 0, "section": 1, "number": 1, "title": 2, "old name": 3, "flag": 4, "group": 6}
_OTHER_WEIGHT = 5
_WHOLE, _WHOLE_WORD, _PREFIX, _INSIDE = 0, 10, 20, 30
"""Ranks of a match: the whole text, a word of it, the start of a word, some letters. The lower the rank, the nearer."""
_LEAST_INSIDE = 3


class Hit(NamedTuple):
    """An entry that has all the words: the matching texts, the nearest first, and a rank (low is near)."""

    entry: Entry
    texts: tuple[Text, ...]
    rank: int


def search(entries: Iterable[Entry], words: Sequence[str]) -> list[Hit]:
    """Return the entries that have all the words in any of their texts: the nearest first, else in their order."""
    queries = [_Query(word) for word in words]
    hits = [hit for entry in entries if (hit := _hit(entry, queries)) is not None]
    return sorted(hits, key=lambda hit: hit.rank)


def near_words(entries: Iterable[Entry], words: Sequence[str]) -> list[str]:
    """Return words of the entries that are similar to the given ones."""
    known: dict[str, str] = {}
    for entry in entries:
        for text in entry.texts:
            for word in _WORD.findall(text.text):
                known.setdefault(_folded(word)[0], word)
    close = [near for word in words for near in get_close_matches(_folded(word)[0][:60], list(known), 3, 0.7)]
    return list(dict.fromkeys(known[word] for word in close))


def _hit(entry: Entry, queries: Sequence[_Query]) -> Hit | None:
    best = []
    for query in queries:
        ranked = [(rank, text) for text in entry.texts if (rank := query.rank(entry, text)) is not None]
        if not ranked:
            return None
        best.append(min(ranked, key=itemgetter(0)))
    best.sort(key=itemgetter(0))
    return Hit(entry, tuple({id(text): text for _, text in best}.values()), sum(rank for rank, _ in best))


class _Query:
    """A search word: folded, with the number that it may mean."""

    def __init__(self, word: str) -> None:
        kind, colon, rest = word.strip().partition(":")
        self.kind = kind.lower() if colon else ""
        self.number = number_of((rest if colon else word).strip())
        self.spellings = _folded(word)
        self.digits_only = bool(re.fullmatch(r"[0-9.]+", word))

    def rank(self, entry: Entry, text: Text) -> int | None:
        """Return the rank of a text; None if it does not have the word."""
        if self.kind and self.number is not None:
            return self._rank_of_number(entry, text)
        ranks = [rank for rank in map(self._rank, self.spellings, _folded(text.text)) if rank is not None]
        if text.kind == "number" and self.number == text.number:
            ranks.append(_WHOLE_WORD)
        return min(ranks) + _WEIGHTS.get(text.kind, _OTHER_WEIGHT) if ranks else None

    def _rank_of_number(self, entry: Entry, text: Text) -> int | None:
        """Return the rank for `error:21h`: a code of that kind, or an entry of a list of faults."""
        if text.number != self.number:
            return None
        if entry.number is not None:
            if entry.kind == self.kind:
                return _WHOLE
            return _WHOLE + 1 if {entry.kind, self.kind} <= _FAULTS else None
        return _WHOLE_WORD if self.kind in _FAULTS and entry.lists_faults else None

    def _rank(self, word: str, text: str) -> int | None:
        if word == text:
            return _WHOLE
        if word not in text:
            return None
        parts = _parts(text)
        if word in parts:
            return _WHOLE_WORD
        start = f"{word}." if self.digits_only else word
        if any(part.startswith(start) for part in parts):
            return _PREFIX
        return _INSIDE if len(word) >= _LEAST_INSIDE and not self.digits_only else None


@lru_cache(maxsize=65536)
def _folded(text: str) -> tuple[str, str]:
    """Return the text without case and accents, once with umlauts as `ae` and once as `a`."""
    lowered = text.casefold().strip()
    if lowered.isascii():
        return lowered, lowered
    return _without_marks(lowered.translate(_UMLAUTS)), _without_marks(lowered)


def _without_marks(text: str) -> str:
    return "".join(char for char in unicodedata.normalize("NFKD", text) if not unicodedata.combining(char))


@lru_cache(maxsize=65536)
def _parts(text: str) -> frozenset[str]:
    """Return the words of a folded text, and their parts between underscores and dashes."""
    words = _WORD.findall(text)
    return frozenset([*words, *(part for word in words for part in re.split(r"[_-]", word) if part)])
