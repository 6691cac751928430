"""What a page break or a table sets again: the heads of new pages, the entries of a cell that belongs to two rows."""

from __future__ import annotations

import re
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


def is_head_of_page(finding: Finding, text: Words, bearing: Container[int]) -> bool:
    """Whether new lines stand so at several pages, one below the other, and no fact stands there on their words."""
    if finding.kind != "added" or finding.drafts or finding.new is None:
        return False
    numbers = [line for line in range(1, len(text.lines) + 1) if text.of_line(line)]
    written = [[text.texts[word] for word in text.of_line(line)] for line in numbers]
    first = sum(line < finding.new[0] for line in numbers)
    last = sum(line <= finding.new[1] for line in numbers)
    block = written[first:last]
    if len(block) < _HEAD or any(is_row(text.line(line)) for line in numbers[first:last]):
        return False
    starts = [at for at in range(len(written)) if at != first and written[at : at + len(block)] == block]
    words = (word for at in starts for line in numbers[at : at + len(block)] for word in text.of_line(line))
    return are_far_apart([numbers[at] for at in starts]) and not any(word in bearing for word in words)


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
