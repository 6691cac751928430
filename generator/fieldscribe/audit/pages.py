"""Heads and feet of pages: lines that count pages, and what stands beside them again and again, in one text or two."""

from __future__ import annotations

import re
from collections import Counter
from itertools import pairwise
from statistics import median
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

_DIGITS = re.compile(r"[0-9]+")
_COUNTS = re.compile(
    r"\b(?:Seite|Blatt|page|sheet)\s*[0-9]+\b|\b[A-Z][-\u2013][0-9]+\s*$|[-\u2013]\s*[0-9]+\s*[-\u2013]\s*$|\b[0-9]+\s*(?:/|von|of)\s*[0-9]+\s*$",
    re.IGNORECASE,
)
_NAMES_PAGE = re.compile(r"(?:|.*\W)(?:Seite|page)\s+[0-9]+(?:\s+(?:von|of)\s+[0-9]+)?", re.IGNORECASE)
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
            groups.setdefault(pattern(line), []).append(number)
    counting = {number: page for group in groups.values() for number, page in _counted(lines, group).items()}
    alike = Counter(map(_plain, lines))
    pages = counting | _bare(lines, counting)
    for step in (-1, 1, -1):
        front = pages
        for _ in range(_DEEP):
            front = _beside(lines, front, step, pages, alike)
            pages.update(front)
    return frozenset(pages)


def page_lines_of_both(old: Sequence[str], new: Sequence[str]) -> tuple[frozenset[int], frozenset[int]]:
    """The same for two editions: what two pages repeat is no head or foot where the other edition has it as text."""
    was, now = page_lines(old), page_lines(new)
    return _without_text(old, was, _text(new, now)), _without_text(new, now, _text(old, was))


def repeated(lines: Sequence[str], numbers: Iterable[int]) -> Iterator[int]:
    """Those of the lines that only one edition has which are heads or feet, too: less tells them than one text alone.

    They end with a page in words, or repeat far apart and count pages, or have the same line above or below.
    """
    groups: dict[str, list[int]] = {}
    for number in sorted(numbers):
        groups.setdefault(pattern(lines[number - 1]), []).append(number)
    for group in groups.values():
        if are_far_apart(group) and (_counted(lines, group) or _are_in_blocks(lines, group)):
            yield from group
        else:
            yield from (number for number in group if _NAMES_PAGE.fullmatch(lines[number - 1].strip()))


def are_far_apart(group: list[int]) -> bool:
    """Whether lines stand at several pages, each by itself."""
    return len(group) >= _PAGES and median(below - above for above, below in pairwise(group)) >= _APART


def _are_in_blocks(lines: Sequence[str], group: list[int]) -> bool:
    """Whether the line above is the same at all places, or the one below."""
    beside = ({_next(lines, number, step) for number in group} for step in (-1, 1))
    return any(all(places) and len({pattern(lines[place - 1]) for place in places}) == 1 for places in beside)


def _text(lines: Sequence[str], pages: frozenset[int]) -> Counter[str]:
    return Counter(_plain(line) for number, line in enumerate(lines, 1) if number not in pages)


def _without_text(lines: Sequence[str], pages: frozenset[int], text: Counter[str]) -> frozenset[int]:
    plain = {number: _plain(lines[number - 1]) for number in pages}
    often = Counter(plain.values())
    return frozenset(number for number, line in plain.items() if often[line] != _BOTH or text[line] < _BOTH)


def _counted(lines: Sequence[str], group: list[int]) -> dict[int, int]:
    """The page that each of these lines counts; none if one of their numbers does not count up."""
    if not are_far_apart(group):
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
    """Bare numbers of two digits that count with the pages above and below, where the text lies in disorder."""
    told: dict[int, int] = {}
    above: dict[int, int] = {}
    page = 0
    for number in range(1, len(lines) + 1):
        above[number] = page = counting.get(number, page)
    below = None
    for number in range(len(lines), 0, -1):
        below = counting.get(number, below)
        text = lines[number - 1].strip()
        if below is not None and len(text) > 1 and text.isdecimal():
            counts = {int(text) - apart for apart in aparts} & set(range(above[number] + 1, below + 1))
            told.update(dict.fromkeys((number,) if counts else (), below))
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


def pattern(line: str) -> str:
    """A line with a sign for each of its numbers."""
    return _DIGITS.sub("#", _plain(line))


def _plain(line: str) -> str:
    return " ".join(line.split())
