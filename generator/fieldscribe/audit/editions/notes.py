"""Sentences of a description that say what a line said before it changed: no claim holds them against the text."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, NamedTuple

from fieldscribe.audit.editions.findings import StaleNote
from fieldscribe.audit.editions.places import SENTENCES
from fieldscribe.audit.editions.vocabulary import is_name
from fieldscribe.audit.manual import tokens_of
from fieldscribe.language.nodes import Map, Seq

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.audit.editions.changes import Change, Editions
    from fieldscribe.audit.editions.findings import Finding
    from fieldscribe.audit.editions.tracing import Trace
    from fieldscribe.diagnostics import Span
    from fieldscribe.resolve.analysis import Analysis

_NAME = re.compile(r"[^\W\d]\w*(?:\[[0-9/]+\])?")
_WORD = re.compile(r"[^\W\d_]{4,}")
_QUOTED = re.compile("[\"\u201c\u201e`][^\"\u201c\u201d\u201e`]{1,80}[\"\u201c\u201d`]|(?<!\\w)'[^']{1,80}'(?!\\w)")
_OPENS = re.compile(r"(?:^|[.:;!?(])\s*$")
_TELLING = 4
"""A number of so many digits says by itself what it is about; a shorter one where its subject is named beside it."""
_ANYTHING = ("#0", "#1")
"""Numbers that every note may have."""
_IN_QUOTES = ("printed",)
"""What the manual printed stays as it was printed: a claim of its own holds it against the text."""


class Sentence(NamedTuple):
    """A text of a description: whose it is, its key, and where it stands; the numbers and names in it."""

    owner: str
    key: str
    place: Span
    numbers: dict[str, list[int]]
    names: list[tuple[int, str]]
    words: frozenset[str]
    marked: frozenset[str]


class Gone(NamedTuple):
    """What a change took from its lines: numbers and words by what they are compared with, as they were written."""

    numbers: dict[str, str]
    words: dict[str, str]


class Notes:
    """All sentences of a description, by what they say."""

    def __init__(self, subject: Analysis, old: Trace, editions: Editions) -> None:
        self.old, self.editions = old, editions
        self.sentences = [sentence for file in subject.scope.files for sentence in _sentences(file, "device")]
        self.names_of = _names_of(subject)
        self.holders: dict[str, set[int]] = {}
        for place, sentence in enumerate(self.sentences):
            for said in (*sentence.numbers, *sentence.words, *(name for _, name in sentence.names)):
                self.holders.setdefault(said, set()).add(place)
        self.codes = _codes_of(subject)
        self.still = {text.casefold() for text in editions.new.texts}

    def stale(self, findings: Iterable[tuple[Change, Finding]]) -> list[StaleNote]:
        """The sentences that say what changed, in the order of the files, each with all of it."""
        told: dict[int, dict[str, str]] = {}
        for change, finding in findings:
            for place, said in self._of_change(change, finding):
                told.setdefault(place, {}).setdefault(said, _where(finding))
        return [_stale(self.sentences[place], said) for place, said in sorted(told.items())]

    def _of_change(self, change: Change, finding: Finding) -> Iterator[tuple[int, str]]:
        gone = self._gone(change)
        subjects = dict.fromkeys(cite.subject for cite in finding.cited_by)
        names = {name for subject in subjects for name in self.names_of.get(subject, {subject.rpartition(" ")[2]})}
        for key, shown in (gone.numbers | gone.words).items():
            for place in self.holders.get(key, ()):
                sentence = self.sentences[place]
                is_removed = finding.kind == "removed" and _is_code_number(shown)
                if is_removed or self._is_about(sentence, key, names, is_number=key in gone.numbers):
                    yield place, shown
        for code in {self.codes[subject] for subject in subjects if subject in self.codes} & gone.words.keys():
            yield from ((place, code) for place in self.holders.get(code, ()))

    def _is_about(self, sentence: Sentence, key: str, names: set[str], *, is_number: bool) -> bool:
        """Whether a sentence says what was meant by the line: its own, or one that says enough by itself."""
        if not is_number:
            if any(map(str.isdigit, key)):
                return sentence.owner in names or key.casefold() not in self.still
            return key not in self.still and key in sentence.marked
        written = key.removeprefix("#").removeprefix("x")
        digits = len(written) + any(map(str.isalpha, written))
        if digits >= _TELLING or (sentence.owner in names and key not in _ANYTHING):
            return True
        beside = (name for at in sentence.numbers[key] for name in _beside(at, sentence.names))
        return any(name in names for name in beside)

    def _gone(self, change: Change) -> Gone:
        """The numbers, names and codes that stood on words which the new edition does not have."""
        words = {word for old, _ in change.gaps for word in old}
        gone = Gone({}, {})
        for line in change.old:
            in_numbers: set[int] = set()
            for token in self.old.manual.tokens[line - 1]:
                inside = self.old.words_of_token(token)
                in_numbers.update(inside)
                if words.intersection(inside):
                    gone.numbers.setdefault(_key(token.text), token.text)
            texts = self.editions.old.texts
            for word in self.editions.old.of_line(line):
                if word in words and word not in in_numbers and is_name(texts[word]):
                    is_code = any(map(str.isdigit, texts[word]))
                    gone.words.setdefault(texts[word] if is_code else texts[word].casefold(), texts[word])
        return gone


def _sentences(value: Any, owner: str) -> Iterator[Sentence]:
    """All texts that are sentences, with the name of what has them."""
    if isinstance(value, Seq):
        for item in value:
            yield from _sentences(item, owner)
    elif isinstance(value, Map):
        named = next((str(value[key]) for key in ("id", "group", "name", "code") if key in value), owner)
        for key, item in value.items():
            if key not in SENTENCES or key in _IN_QUOTES:
                inner = key if named == "device" and isinstance(item, Map) else named
                yield from _sentences(item, inner) if isinstance(item, Map | Seq) else ()
            elif isinstance(item, str):
                yield _sentence(named, key, item, value.span(key))
            elif isinstance(item, Map):
                texts = ((language, text) for language, text in item.items() if isinstance(text, str))
                yield from (_sentence(named, key, text, item.span(language)) for language, text in texts)


def _sentence(owner: str, key: str, text: str, place: Span) -> Sentence:
    names = [(match.start(), match[0]) for match in _NAME.finditer(text)]
    numbers: dict[str, list[int]] = {}
    rest = _NAME.sub(lambda match: " " * len(match[0]) if any(map(str.isdigit, match[0])) else match[0], text)
    for token in tokens_of(rest, 1):
        numbers.setdefault(_key(token.text), []).append(token.column)
    words = frozenset(word.casefold() for word in _WORD.findall(text))
    return Sentence(owner, key, place, numbers, names, words, frozenset(_marked(text)))


def _marked(text: str) -> Iterator[str]:
    """The words of a text that are in quotes, or have a capital within a sentence: they are the manual's."""
    for match in _QUOTED.finditer(text):
        yield from (word.casefold() for word in _WORD.findall(match[0]))
    for match in _WORD.finditer(text):
        if match[0][0].isupper() and not _OPENS.search(text, 0, match.start()):
            yield match[0].casefold()


def _beside(at: int, names: list[tuple[int, str]]) -> Iterator[str]:
    """The names of points before and behind a number, with no other between."""
    coded = [(place, name) for place, name in names if any(map(str.isdigit, name)) or "_" in name]
    yield from [name for place, name in coded if place < at][-1:]
    yield from [name for place, name in coded if place >= at][:1]


def _names_of(subject: Analysis) -> dict[str, set[str]]:
    """How sentences name each point: by its name, that of its row, its code."""
    names: dict[str, set[str]] = {}
    for resolved in subject.resolved:
        draft = resolved.facts
        names[resolved.point.item] = {draft.name, str(draft.row.get("name")), draft.code or draft.name}
    return names


def _codes_of(subject: Analysis) -> dict[str, str]:
    """The code of each point that has one for itself."""
    points: dict[str, list[str]] = {}
    for resolved in subject.resolved:
        if resolved.facts.code:
            points.setdefault(resolved.facts.code, []).append(resolved.point.item)
    return {items[0]: code for code, items in points.items() if len(items) == 1}


def _is_code_number(text: str) -> bool:
    """Whether a number is written as codes are, such as `0Fh`: where its row is gone, it is gone for all."""
    return text[0].isdecimal() and text[-1] in "hH"


def _key(number: str) -> str:
    """What notations of a number share: `38.400` and `38400`, `0,5` and `0.5`, `1Bh` and `0x1B`, `02` and `2`."""
    text = number.casefold()
    if text.startswith(("0x", "h'")) or text.endswith("h"):
        return "#x" + text.removeprefix("0x").removeprefix("h'").removesuffix("h").lstrip("0")
    digits = re.sub(r"[.,\s]", "", text)
    return "#" + (digits if digits != text else digits.lstrip("0") or "0")


def _stale(sentence: Sentence, said: dict[str, str]) -> StaleNote:
    place = f"{sentence.place.file}:{sentence.place.line}:{sentence.place.column}"
    return StaleNote(sentence.owner, sentence.key, place, tuple(said.items()))


def _where(finding: Finding) -> str:
    assert finding.old is not None
    now = "" if finding.new is None or finding.new[0] == finding.old[0] else f", now {finding.new[0]}"
    return f"line {finding.old[0]}{now}"
