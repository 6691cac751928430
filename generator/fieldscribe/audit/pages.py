"""Heads and feet of pages in a text: lines that count pages, and what stands beside them again and again."""

from __future__ import annotations

import re
from collections import Counter
from itertools import pairwise
from statistics import median
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

_DIGITS = re.compile(r"[0-9]+")
_COUNTS = re.compile(
    r"\b(?:Seite|Blatt|page|sheet)\s*[0-9]+\b|\b[A-Z][-\u2013][0-9]+\s*$|[-\u2013]\s*[0-9]+\s*[-\u2013]\s*$|\b[0-9]+\s*(?:/|von|of)\s*[0-9]+\s*$",
    re.IGNORECASE,
)
_LETTERS = re.compile(r"[^\W\d_]{4}")
_PAGES = 3
"""So many pages have the same head or foot."""
_APART = 8
"""Half of them stand at least so many lines apart."""
_LONGEST = 120
_MOSTLY = 0.8
_DEEP = 3
"""A head or foot has at most so many lines beside the one that counts."""
_BOTH = 2
_SURE = 5
"""At so many pages even what looks like a row is part of a head or foot."""
_SENTENCE = re.compile(r"[.:;,=]$|(?:\S+\s+){11}")
"""What no head or foot has: the end of a sentence, many words."""
_NEAR = 4
"""The bare number of a page stands at most so many lines from a line that counts it in words."""


def page_lines(lines: Sequence[str]) -> frozenset[int]:
    """The lines, counted from 1, that are heads or feet of pages."""
    groups: dict[str, list[int]] = {}
    for number, line in enumerate(lines, 1):
        if len(line) <= _LONGEST and not line.startswith("|") and _COUNTS.search(line):
            groups.setdefault(_pattern(line), []).append(number)
    counting = {number: page for group in groups.values() for number, page in _counted(lines, group).items()}
    alike = Counter(map(_plain, lines))
    pages = counting | _bare(lines, counting)
    for step in (-1, 1, -1):
        front = pages
        for _ in range(_DEEP):
            front = _beside(lines, front, step, pages, alike)
            pages.update(front)
    return frozenset(pages)


def _counted(lines: Sequence[str], group: list[int]) -> dict[int, int]:
    """The page that each of these lines counts; none if one of their numbers does not count up."""
    if len(group) < _PAGES or median(below - above for above, below in pairwise(group)) < _APART:
        return {}
    columns = list(zip(*(map(int, _DIGITS.findall(lines[number - 1])) for number in group), strict=True))
    changing = [column for column in columns if len(set(column)) > 1]
    if len(changing) != 1 or len(set(changing[0])) < len(group):
        return {}
    rising = sum(above < below for above, below in pairwise(changing[0]))
    if rising < _MOSTLY * (len(group) - 1):  # a section may have moved with its pages
        return {}
    return dict(zip(group, changing[0], strict=True))


def _bare(lines: Sequence[str], counting: dict[int, int]) -> dict[int, int]:
    """The bare numbers near lines that count pages, where they count with them."""
    near = ((number + far, page) for number, page in counting.items() for far in range(-_NEAR, _NEAR + 1))
    near = ((place, page) for place, page in near if 1 <= place <= len(lines) and lines[place - 1].strip().isdecimal())
    bare = [(place, page, int(lines[place - 1]) - page) for place, page in near]
    often = Counter(apart for _, _, apart in bare)
    sure = {place: page for place, page, apart in bare if often[apart] >= _PAGES}
    return sure | _farther(lines, counting, {apart for apart, count in often.items() if count >= _PAGES})


def _farther(lines: Sequence[str], counting: dict[int, int], aparts: set[int]) -> dict[int, int]:
    """Bare numbers of two digits that count with the next page below, where the text lies in disorder."""
    told: dict[int, int] = {}
    page = None
    for number in range(len(lines), 0, -1):
        page = counting.get(number, page)
        text = lines[number - 1].strip()
        if page is not None and len(text) > 1 and text.isdecimal() and int(text) - page in aparts:
            told[number] = page
    return told


def _beside(
    lines: Sequence[str], front: dict[int, int], step: int, pages: dict[int, int], alike: Counter[str]
) -> dict[int, int]:
    """The next lines that belong to the same heads or feet, each with its page."""
    near = {_next(lines, number, step): page for number, page in front.items()}
    near = {place: page for place, page in near.items() if place and place not in pages}
    pages_of: dict[str, set[int]] = {}
    for place, page in (*near.items(), *pages.items()):
        pages_of.setdefault(_plain(lines[place - 1]), set()).add(page)
    return {place: page for place, page in near.items() if _repeats(lines[place - 1], pages_of, alike)}


def _repeats(line: str, pages_of: dict[str, set[int]], alike: Counter[str]) -> bool:
    """Whether a line stands so at several pages, and seldom elsewhere: a title, and no row or sentence of the text."""
    text = _plain(line)
    pages, often = pages_of[text], alike[text]
    if line.startswith("|") or _LETTERS.search(text) is None or _SENTENCE.search(text):
        return False
    if len(pages) == _BOTH:
        return max(pages) - min(pages) == 1 and often <= _BOTH + 1 and "\t" not in line.strip()
    return len(pages) >= (_SURE if "\t" in line.strip() else _PAGES) and len(pages) * 2 >= often


def _next(lines: Sequence[str], number: int, step: int) -> int:
    """The next line with words, 0 if none is near."""
    places = (number + step * far for far in range(1, _DEEP + 1))
    return next((place for place in places if 1 <= place <= len(lines) and lines[place - 1].strip()), 0)


def _pattern(line: str) -> str:
    return _DIGITS.sub("#", _plain(line))


def _plain(line: str) -> str:
    return " ".join(line.split())
