"""What a page break or a table sets again: the heads of new pages, the entries of a cell that belongs to two rows."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.parting import is_row
from fieldscribe.audit.pages import are_far_apart

if TYPE_CHECKING:
    from collections.abc import Container, Iterator, Sequence

    from fieldscribe.audit.editions.changes import Editions
    from fieldscribe.audit.editions.findings import Ends, Finding
    from fieldscribe.audit.editions.words import Words

_HEAD = 2
"""The head of a page that nothing counts has at least so many lines."""
_ENTRY = re.compile(r"\b\w+ ?= ?\w")
_ALNUM = re.compile(r"[^\W_]+")


class Heads:
    """Heads of pages in one edition: lines that several pages have one below the other, and that bear no fact."""

    def __init__(self, text: Words, bearing: Container[int]) -> None:
        self._text, self._bearing = text, bearing

    def has(self, ends: Ends | None) -> bool:
        """Whether some lines are such a head."""
        if ends is None:
            return False
        numbers, written = self._numbers, self._written
        first, last = bisect_left(numbers, ends[0]), bisect_right(numbers, ends[1])
        block = written[first:last]
        if not block or any(is_row(self._text.line(line)) for line in numbers[first:last]):
            return False
        starts = [at for at in range(len(written)) if at != first and written[at : at + len(block)] == block]
        bearing = sum(any(map(self._bears, numbers[at : at + len(block)])) for at in starts)  # some do by chance
        return are_far_apart([numbers[at] for at in starts]) and bearing * 2 < len(starts)

    def is_long(self, ends: Ends | None) -> bool:
        """Whether so many of some lines have words that they do not repeat by chance."""
        return ends is not None and bisect_right(self._numbers, ends[1]) - bisect_left(self._numbers, ends[0]) >= _HEAD

    def _bears(self, line: int) -> bool:
        return any(word in self._bearing for word in self._text.of_line(line))

    @cached_property
    def _numbers(self) -> list[int]:
        return [line for line in range(1, len(self._text.lines) + 1) if self._text.of_line(line)]

    @cached_property
    def _written(self) -> list[list[str]]:
        return [[self._text.texts[word] for word in self._text.of_line(line)] for line in self._numbers]


def is_head_of_page(finding: Finding, old: Heads, new: Heads) -> bool:
    """Whether a page got a head that others have, or each has another head now, which says nothing new."""
    if finding.drafts or finding.kind not in ("added", "changed"):
        return False
    if finding.kind == "added":
        return new.is_long(finding.new) and new.has(finding.new)
    return finding.explained and old.is_long(finding.old) and old.has(finding.old) and new.has(finding.new)


def in_shared_cells(findings: Sequence[Finding], editions: Editions) -> Iterator[Finding]:
    """Entries `0 = word` that one edition has in the first of two rows with all others, and one in the second."""
    for above, below in pairwise(findings):
        if above.kind == below.kind == "changed" and _holds(above) and _holds(below):
            ends = ((above.old, below.old), (above.new, below.new))
            for side, text in enumerate((editions.old, editions.new)):
                entries = _going_over(above, below, side)
                if entries and _has_more(text, *ends[side], entries):
                    yield from (above, below)


def _holds(finding: Finding) -> bool:
    """Whether a change asks for nothing but for what its own words say."""
    return not finding.void and all(reason.kind in ("number", "word") for reason in finding.reasons)


def _going_over(above: Finding, below: Finding, side: int) -> int:
    """How many entries of the upper row in this edition the lower one has in the other; 0 if anything else changed."""
    upper, lower = (" ".join(pair[at] for pair in row.words) for row, at in ((above, side), (below, 1 - side)))
    rest = [pair[at] for row, at in ((above, 1 - side), (below, side)) for pair in row.words]
    same = not any(rest) and _ENTRY.match(upper) is not None and _ALNUM.findall(upper) == _ALNUM.findall(lower)
    return len(_ENTRY.findall(upper)) if same else 0


def _has_more(text: Words, above: Ends | None, below: Ends | None, entries: int) -> bool:
    """Whether the upper row has more entries, which it keeps, and the one right below it has none."""
    if above is None or below is None or below[0] != above[1] + 1:
        return False
    upper, lower = (" ".join(text.line(line) for line in range(first, last + 1)) for first, last in (above, below))
    return len(_ENTRY.findall(upper)) > entries and _ENTRY.search(lower) is None
