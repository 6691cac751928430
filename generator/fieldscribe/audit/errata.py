"""What errata say: what the manual prints, on which lines, and what the description took instead."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from typing import Any, NamedTuple

from fieldscribe.audit.claims import Cited, absolute, cited_lines, numbers_in
from fieldscribe.diagnostics import Span
from fieldscribe.language.nodes import Map
from fieldscribe.model import About
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.errata import LocatedErratum

_LINES_NAMED = re.compile(r"\blines?\s+[0-9]+(?:(?:,|\s+and|\s+to|\.\.)\s*[0-9]+)*(?:\s+and\s+[0-9]+)?")
_QUOTED = re.compile('["\u201e\u201c]([^"\u201c\u201d]+)["\u201c\u201d]')


class PrintedErratum(NamedTuple):
    """What an erratum says that the manual prints, and where."""

    id: str
    shown: str
    place: Span
    numbers: tuple[Fraction, ...]
    texts: tuple[str, ...]
    """What a sentence quotes."""
    cited: tuple[Cited, ...]
    subjects: tuple[About, ...]
    taken: frozenset[Fraction]
    """The numbers that the description has instead. The manual need not print them there."""
    taken_text: str
    """`taken` as the author wrote it: it may name codes that the manual does not print."""
    is_sentence: bool
    """Whether `printed` is a sentence: then it may speak of what stands around the cited line too."""


def printed_errata(subject: Analysis) -> list[PrintedErratum]:
    """Return all errata that name a line."""
    return [_printed_erratum(erratum) for erratum in subject.errata if erratum.erratum.source.line is not None]


def _printed_erratum(written: LocatedErratum) -> PrintedErratum:
    node = written.node
    printed, taken, lines = (node.get(key) for key in ("printed", "taken", "lines"))
    cited = list(cited_lines(node["line"], node.span("line")))
    if isinstance(lines, Map):
        cited += [line for key, value in lines.items() for line in cited_lines(value, lines.span(key))]
    texts: list[str] = []
    if isinstance(printed, Map):
        numbers = _numbers_of(printed)
    else:
        sentence = str(printed)
        named = [line for lines in _LINES_NAMED.findall(sentence) for line in re.findall("[0-9]+", lines)]
        cited += [Cited(int(line), 0, node.span("printed")) for line in named]
        texts = [text for text in _QUOTED.findall(sentence) if len(text) > 1]
        numbers = numbers_in(_LINES_NAMED.sub("", sentence))
    return PrintedErratum(
        written.erratum.id,
        written.erratum.printed,
        node.span("id"),
        tuple(map(abs, numbers)),
        tuple(texts),
        tuple(cited),
        written.subjects,
        absolute(_numbers_of(taken) if isinstance(taken, Map) else numbers_in(taken)),
        written.erratum.taken,
        not isinstance(printed, Map),
    )


def _numbers_of(facts: Map) -> list[Fraction]:
    return [number for key, value in facts.items() for number in _printed_numbers(key, value)]


def _printed_numbers(key: str, value: Any) -> Iterator[Fraction]:
    """The numbers of a printed fact; a checksum is bytes."""
    if key == "crc":
        yield from map(Fraction, bytes.fromhex("".join(str(value).split())))
    else:
        yield from numbers_in(value)
