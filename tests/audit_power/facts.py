"""The cited facts of a description, read from its points and frames: what each says, and on which lines it is printed.

This module reads the YAML and the model itself. It takes nothing from the audit, which is what is measured.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from typing import Any, NamedTuple

from fieldscribe.language.nodes import Map, Seq
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.points import ResolvedPoint

_LITERAL = re.compile(r"0b[01]+|0[xX][0-9A-Fa-f]+|[0-9][0-9A-Fa-f]*h\b|[0-9]+(?:\.(?!\.)[0-9]+)?")
_SMALL = 9
"""Addresses up to this one are positions in a telegram, which manuals do not print as numbers of their own."""
_LONGEST_PLACE = 30
"""A fact is looked for in at most so many lines below the one that its point cites."""


class CitedFact(NamedTuple):
    """One fact: a number, a label or the bytes of a frame. `beside` is the number of a label, or the other limit."""

    subject: str
    key: str
    kind: str
    value: Fraction | str
    lines: tuple[int, ...]
    beside: Fraction | None = None


def facts_of(subject: Analysis) -> list[CitedFact]:
    """Return every number and label of the points, and the bytes of the frames, that cite a line."""
    language = next(document.language for document in subject.scope.documents.values())
    starts = sorted({resolved.point.source.line for resolved in subject.resolved if resolved.point.source.line})
    facts: dict[CitedFact, None] = {}
    for resolved in subject.resolved:
        if resolved.point.source.line is not None:
            facts |= dict.fromkeys(_PointFacts(resolved, language, starts).all())
    for file in subject.scope.files:
        for frame in file.get("frames", ()):
            if "line" in frame:
                digits = "".join(str(frame["bytes"]).split()).upper()
                lines = tuple(range(frame["line"], frame["line"] + _LONGEST_PLACE))
                facts[CitedFact(f"frame {frame['name']}", "bytes", "bytes", digits, lines)] = None
    return list(facts)


class _PointFacts:
    """The facts of one point, each with the lines that it cites."""

    def __init__(self, resolved: ResolvedPoint, language: str, starts: list[int]) -> None:
        self.point, self.point_facts, self.language = resolved.point, resolved.facts, language
        line = resolved.point.source.line or 0
        end = next((start for start in starts if start > line), line + _LONGEST_PLACE)
        self.own_lines = tuple(range(line, min(end, line + _LONGEST_PLACE)))
        lines = self.point_facts.get("lines")
        self.lines_of_key = {key: tuple(_spans(value)) for key, value in lines.items()} if lines else {}

    def all(self) -> Iterator[CitedFact]:
        """Every fact that the point itself (not its group) says."""
        if self.point.address is not None and self.point.address > _SMALL:
            yield from self._numbers("at", "address", [Fraction(self.point.address)])
        for key in ("range", "range_in_units", "scale", "bits"):
            layer = self.point_facts.layer(key)
            if layer is not None and layer is not self.point_facts.group:
                kind = key.removesuffix("_in_units")
                numbers = numbers_in(self.point_facts.get(key))
                yield from self._numbers(key, kind, [number for number in numbers if number != 1])
        printed = self.point_facts.get("printed")
        for key, value in printed.items() if isinstance(printed, Map) else ():
            if key in ("wire", "modicon"):
                yield from self._numbers("printed", "address", numbers_in(value))
            elif key in ("range", "range_in_units", "resolution"):
                yield from self._numbers("printed", "printed" if key == "resolution" else "range", numbers_in(value))
        yield from self._labels("title", "title", self.point_facts.get("title"), None)
        for key in ("enum", "flags", "special"):
            entries = self.point_facts.get(key) if self.point_facts.layer(key) is not self.point_facts.group else None
            for number, entry in entries.items() if isinstance(entries, Map) else ():
                yield from self._entry(key, numbers_in(number), entry)

    def _entry(self, key: str, numbers: list[Fraction], entry: Any) -> Iterator[CitedFact]:
        titles = entry.get("title", entry) if isinstance(entry, Map) else None
        yield from self._labels(key, key, titles, numbers[0])
        values = entry.get("values") if isinstance(entry, Map) else None
        for word, titles in values.items() if isinstance(values, Map) else ():  # not those of a shared enum
            label = titles.get("title", titles) if isinstance(titles, Map) else None
            kind = "values" if "values" in self.lines_of_key else key
            yield from self._labels(key, kind, label, numbers_in(word)[0])
        for value, name in enumerate(("zero", "one")):
            if isinstance(entry, Map) and name in entry:
                yield from self._labels(key, key, entry[name], Fraction(value))

    def _numbers(self, key: str, kind: str, numbers: list[Fraction]) -> Iterator[CitedFact]:
        lines = self.lines_of_key.get(kind, self.own_lines)
        for number in numbers:
            other = next((end for end in numbers if end != number), None) if kind == "range" else None
            yield CitedFact(self.point.item, key, "number", abs(number), lines, other)

    def _labels(self, key: str, kind: str, titles: Any, beside: Fraction | None) -> Iterator[CitedFact]:
        text = titles.get(self.language) if isinstance(titles, dict) else titles if self.language == "en" else None
        if isinstance(text, str) and re.search(r"[^\W\d]{3}", text):
            lines = self.lines_of_key.get(kind, self.own_lines)
            yield CitedFact(self.point.item, key, "label", text, lines, beside)


def numbers_in(value: Any) -> list[Fraction]:
    """Return the numbers in a value of the YAML, as the author wrote them."""
    if isinstance(value, Map):
        return [number for item in value.values() for number in numbers_in(item)]
    if isinstance(value, Seq | list | tuple):
        return [number for item in value for number in numbers_in(item)]
    return [_number(text) for text in _LITERAL.findall(str(value).replace("..", " "))]


def _number(text: str) -> Fraction:
    if text.startswith("0b"):
        return Fraction(int(text, 2))
    if text.lower().startswith("0x") or text.endswith("h"):
        return Fraction(int(text.lower().removeprefix("0x").removesuffix("h"), 16))
    return Fraction(text)


def _spans(value: Any) -> Iterator[int]:
    for place in value if isinstance(value, Seq) else (value,):
        first, _, last = str(place).partition("..")
        yield from range(int(first), int(last or int(first) + _LONGEST_PLACE - 1) + 1)
