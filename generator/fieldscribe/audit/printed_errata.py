"""What errata say that the manual prints, and the lines where it prints that."""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from fieldscribe.audit.citing import numbers_in, spans_of
from fieldscribe.language.nodes import Map

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import About
    from fieldscribe.resolve.analysis import Analysis
    from fieldscribe.resolve.errata import LocatedErratum

_LINES_NAMED = re.compile(r"\blines?\s+[0-9]+(?:(?:,|\s+and|\s+to|\.\.)\s*[0-9]+)*(?:\s+and\s+[0-9]+)?")
_QUOTED = re.compile('["\u201e\u201c]([^"\u201c\u201d]+)["\u201c\u201d]')


@dataclass(frozen=True, slots=True)
class PrintedErratum:
    """What an erratum says that the manual prints, and where."""

    id: str
    shown: str
    numbers: tuple[Fraction, ...]
    texts: tuple[str, ...]
    cited: tuple[tuple[int, int], ...]
    """Lines (first, last); last is 0 where the line opens a row or section."""
    subjects: tuple[About, ...]
    taken: frozenset[Fraction]
    """The numbers that the description has instead. The manual does not print them, so no fact misses them there."""
    is_sentence: bool
    """Whether `printed` is a sentence: it may speak of what stands around the cited line too."""
    taken_text: str = ""
    """`taken` as the author wrote it: it may name codes that the manual does not print."""


def printed_errata_of(subject: Analysis) -> Iterator[PrintedErratum]:
    """All errata that name a line."""
    return (_printed_erratum(erratum) for erratum in subject.errata if erratum.erratum.source.line is not None)


def _printed_erratum(written: LocatedErratum) -> PrintedErratum:
    printed, taken, lines = (written.node.get(key) for key in ("printed", "taken", "lines"))
    cited = list(spans_of(written.node["line"]))
    cited += [span for value in lines.values() for span in spans_of(value)] if isinstance(lines, Map) else []
    texts: list[str] = []
    if isinstance(printed, Map):
        numbers = _numbers_of(printed)
    else:
        sentence = str(printed)
        cited += [(int(line), 0) for lines in _LINES_NAMED.findall(sentence) for line in re.findall("[0-9]+", lines)]
        texts = [text for text in _QUOTED.findall(sentence) if len(text) > 1]
        numbers = numbers_in(_LINES_NAMED.sub("", sentence))
    return PrintedErratum(
        written.erratum.id,
        written.erratum.printed,
        tuple(numbers),
        tuple(texts),
        tuple(cited),
        written.subjects,
        frozenset(map(abs, _numbers_of(taken) if isinstance(taken, Map) else numbers_in(taken))),
        is_sentence=not isinstance(printed, Map),
        taken_text=written.erratum.taken,
    )


def _numbers_of(facts: Map) -> list[Fraction]:
    return [number for key, value in facts.items() for number in _printed_numbers(key, value)]


def _printed_numbers(key: str, value: Any) -> list[Fraction]:
    """The numbers of a printed fact; a checksum is bytes."""
    if key != "crc":
        return numbers_in(value)
    return [Fraction(byte) for byte in bytes.fromhex("".join(str(value).split()))]
