"""Tables of contents: which lines are one, and where the title of each entry ends. Leaders and pages are layout."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

_PAGE = re.compile(r"(?<![0-9])[0-9]{1,4}[\s|]*$")
_SECTION = re.compile(r"\s*([0-9]+(?:\.[0-9]+)*)\.?(?=\s)")
_BEHIND_TITLE = " \t|.\u2026"
_LEADERS = re.compile(r"\.{4}|\u2026|(?:\.{2,})(?=[\s|])")
_RULE = re.compile(r"[\s|:-]*")
_HEADING = re.compile("(?:tableof)?contents|inhalt(?:sverzeichnis)?")
_FEWEST = 2
"""So many entries make a table of contents."""


class _Entry(NamedTuple):
    line: int
    end: int
    page: int
    titles: tuple[str, ...]
    is_sure: bool


class Contents:
    """The lines of a text that are a table of contents; `ends` is where the title of each entry ends."""

    def __init__(self, lines: Sequence[str]) -> None:
        self.lines: set[int] = set()
        self.ends: dict[int, int] = {}
        letters = set(map(_letters, lines))
        for entries in _runs(lines, letters):
            if len(entries) >= _FEWEST and any(entry.is_sure for entry in entries) and _are_titles(entries, letters):
                first = entries[0].line
                has_heading = first > 1 and _HEADING.fullmatch(_letters(lines[first - 2]))
                self.lines.update(range(first - 1 if has_heading else first, entries[-1].line + 1))
                self.ends |= {entry.line: entry.end for entry in entries}


def _runs(lines: Sequence[str], letters: set[str]) -> Iterator[list[_Entry]]:
    """Entries below each other whose pages never fall; a title may begin on the line above."""
    run: list[_Entry] = []
    others, above = 0, ""
    for number, line in enumerate(lines, 1):
        if _RULE.fullmatch(line):
            continue
        entry = _entry(number, line, letters)
        if entry is None:
            entry = _entry(number, line, letters, above)
            if entry is not None and run and not others and entry.page >= run[-1].page:
                entry = None  # the line above is an entry by itself
            elif entry is not None and run and not others:
                run.pop()  # it ended with a number that is no page
        is_first, above = _HEADING.fullmatch(_letters(above)) is not None, line
        if entry is None:
            others += 1
            continue
        if run and (others > 1 or entry.page < run[-1].page):
            yield run
            run = []
        run.append(entry._replace(is_sure=entry.is_sure or is_first))
        others = 0
    yield run


def _entry(number: int, line: str, letters: set[str], above: str = "") -> _Entry | None:
    """A title and a page, with a section's number before them, leaders between, or a title that stands elsewhere."""
    page, section = _PAGE.search(line), _SECTION.match(above or line)
    if page is None:
        return None
    title = line[: page.start()].rstrip(_BEHIND_TITLE)
    has_leaders = _LEADERS.search(line, len(title), page.start()) is not None
    is_parted = page.start() > len(title) and title and not line.startswith("|")
    has_section = section and section.end() < len(above or title)
    is_title = "\t" in line and not above and _letters(title) in letters
    if not has_leaders and not (is_parted and (has_section or is_title)):
        return None
    whole = f"{above} {title}" if above else title
    titles = _letters(whole), _letters(whole[section.end() :] if section else whole)
    is_sure = has_leaders or (section is not None and "." in section[1])
    return _Entry(number, len(title), int(re.sub(r"\D", "", page[0])), titles, is_sure)


def _are_titles(entries: list[_Entry], letters: set[str]) -> bool:
    """Whether at least half of them stand as lines of their own, with the section's number or without."""
    return 2 * sum(not letters.isdisjoint(entry.titles) for entry in entries) >= len(entries)


def _letters(text: str) -> str:
    return "".join(filter(str.isalnum, text.casefold()))
