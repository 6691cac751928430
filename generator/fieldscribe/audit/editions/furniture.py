"""Heads and feet of pages: lines that repeat far apart, with a page number that counts up or as parts of a block."""

from __future__ import annotations

import re
from itertools import pairwise
from statistics import median
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from fieldscribe.audit.editions.findings import Finding

_DIGITS = re.compile(r"[0-9]+")
_PAGES = 3
"""So many pages have the same head or foot."""
_APART = 8
"""Half of them stand at least so many lines apart."""
_ROW = re.compile(r"\||\S\t|\S {3,}\S")
_PAGE = re.compile(r"(|.*\W)(?:Seite|page)\s+[0-9]+(?:\s+(?:von|of)\s+[0-9]+)?", re.IGNORECASE)
_LONGEST = 3
"""A head or foot that is known by the word for a page has at most so many lines."""


def heads_and_feet(findings: Sequence[Finding], old: list[str], new: list[str]) -> Iterator[Finding]:
    """The findings that are about heads and feet of pages."""
    groups: dict[object, list[Finding]] = {}
    for finding in findings:
        if finding.kind in ("added", "removed", "changed") and _may_be(finding, old, new):
            likeness = finding.kind, _pattern(finding.was), _pattern(finding.now)
            groups.setdefault(likeness, []).append(finding)
    for group in groups.values():
        if _names_page(group[0]) or (_repeat(group) and (_counts_up(group) or _is_part_of_block(group, old, new))):
            yield from group


def _may_be(finding: Finding, old: list[str], new: list[str]) -> bool:
    """Whether it is about lines of text, and no fact is lost with it; facts may seem to stand on it by chance."""
    if finding.drafts or finding.void or any(reason.kind in ("missing", "gone") for reason in finding.reasons):
        return False
    lines = [*finding.was, *finding.now]
    if finding.kind == "changed" and finding.old and finding.new:  # a foot may have tabs, but not the rows of a table
        lines = [*old[finding.old[0] - 1 : finding.old[1]], *new[finding.new[0] - 1 : finding.new[1]]]
    return not any(map(_ROW.search, lines))


def _names_page(finding: Finding) -> bool:
    """Whether a line ends with the word for a page and a number."""
    was, now = ([line for line in lines if line] for lines in (finding.was, finding.now))
    if finding.kind == "changed" and [_without_page(line) for line in was] != [_without_page(line) for line in now]:
        return False
    return len(now or was) <= _LONGEST and any(map(_PAGE.fullmatch, now or was))


def _without_page(line: str) -> str:
    match = _PAGE.fullmatch(line)
    return line if match is None else match[1]


def _pattern(lines: Sequence[str]) -> tuple[str, ...]:
    return tuple(_DIGITS.sub("#", line) for line in lines)


def _places(group: list[Finding]) -> list[int]:
    """The line of each place, in the new edition if it is there."""
    return sorted((place.new or place.old or (0, 0))[0] for finding in group for place in finding.places)


def _repeat(group: list[Finding]) -> bool:
    """Whether they are many, and far apart."""
    lines = _places(group)
    return len(lines) >= _PAGES and median(below - above for above, below in pairwise(lines)) >= _APART


def _counts_up(group: list[Finding]) -> bool:
    """Whether one number of each line is larger than the one before, and all others stay."""
    columns = zip(*(map(int, _DIGITS.findall(" ".join(finding.now or finding.was))) for finding in group), strict=True)
    changing = [column for column in columns if len(set(column)) > 1]
    return len(changing) == 1 and all(above < below for above, below in pairwise(changing[0]))


def _is_part_of_block(group: list[Finding], old: list[str], new: list[str]) -> bool:
    """Whether the line above is the same at all places, or the one below."""
    places = [place for finding in group for place in finding.places]
    text = new if places[0].new else old
    ends = [place.new or place.old or (1, 1) for place in places]
    above = {_pattern([_line_beside(text, first - 1, -1)]) for first, _ in ends}
    below = {_pattern([_line_beside(text, last + 1, 1)]) for _, last in ends}
    return any(len(lines) == 1 and lines != {("",)} for lines in (above, below))


def _line_beside(text: list[str], line: int, step: int) -> str:
    """The nearest line with words from a line on."""
    while 1 <= line <= len(text) and not text[line - 1].strip():
        line += step
    return " ".join(text[line - 1].split()) if 1 <= line <= len(text) else ""
