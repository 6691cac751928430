"""Writes the lines of the new edition into the files of a description, and touches nothing else there."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.citations import span_there
from fieldscribe.audit.editions.places import UnclearPlaceError, citations_in, lines_in_comments

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.audit.editions.changes import Editions
    from fieldscribe.audit.editions.citations import Citations
    from fieldscribe.audit.editions.places import Citation
    from fieldscribe.language.nodes import Map
    from fieldscribe.language.source import SourceFile


@dataclass(slots=True)
class Renumbered:
    """The texts of the files that change, by name; how many numbers that are; and what stands in the way.

    `by_hand` are sentences that name lines that are gone, and comments, which stay as they are.
    """

    texts: dict[str, str] = field(default_factory=dict)
    count: int = 0
    hindrances: list[str] = field(default_factory=list)
    by_hand: list[str] = field(default_factory=list)


def renumber(files: Iterable[Map], document: str, citations: Citations) -> Renumbered:
    """All numbers of lines of a document, as the new edition counts them."""
    outcome = Renumbered()
    if citations.all_count_new:
        return outcome
    try:
        places = citations_in(files, document)
    except UnclearPlaceError as error:
        outcome.hindrances.append(f"{error}: a line is cited by an alias: write its number")
        return outcome
    ends: dict[str, int] = {}
    pieces: dict[str, list[str]] = {}
    sources = {place.source.name: place.source for place in places}
    for place in places:
        name, text = place.source.name, place.source.text
        written = text[place.start : place.end]
        wanted = _wanted(place, citations, outcome)
        pieces.setdefault(name, []).extend((text[ends.get(name, 0) : place.start], wanted or written))
        ends[name] = place.end
        outcome.count += wanted not in (None, written)
    for name, source in sources.items():
        text = "".join((*pieces[name], source.text[ends[name] :]))
        if text != source.text:
            outcome.texts[name] = text
            outcome.by_hand += _in_comments(source, citations.editions)
    return outcome


def _in_comments(source: SourceFile, editions: Editions) -> Iterator[str]:
    """Comments are left as they are; what they name is told."""
    for place, line in lines_in_comments(source):
        now = editions.now(line) if line <= len(editions.old.lines) else None
        if now is None or now[0] != line:
            said = "is gone" if now is None else f"is {now[0]} now"
            yield f"{source.name}:{place}: a comment names line {line}, which {said}"


def _wanted(place: Citation, citations: Citations, outcome: Renumbered) -> str | None:
    """What is to be written at a place; None if that stays."""
    editions = citations.editions
    if citations.counts_new_at(place.key, place.first, place.last):
        return None
    if place.kind == "sentence":
        return _in_sentence(place, editions, outcome)
    if place.kind == "looked_through":
        ranges = _ranges(place.first, place.last or place.first, editions)
        if ranges:
            is_range = place.last > 0 and len(ranges) == 1
            written = ", ".join(_range((first, last if last > first or is_range else 0)) for first, last in ranges)
            return written if place.is_item or len(ranges) == 1 else f"[{written}]"
    elif (span := span_there(place.first, place.last, editions.now)) is not None:
        return _range(span)
    outcome.hindrances.append(f"{place.where}: line {place.first} is gone: cite another, or remove what cites it")
    return None


def _in_sentence(place: Citation, editions: Editions, outcome: Renumbered) -> str | None:
    """A sentence may name the last line of a run: then only `last` is given."""
    line = place.first or place.last
    now = editions.now(line) if line <= len(editions.old.lines) else (line, line)
    if now is None:
        outcome.by_hand.append(f"{place.where}: the sentence names line {line}, which is gone")
        return None
    return str(now[0] if place.first else now[1])


def _ranges(first: int, last: int, editions: Editions) -> list[tuple[int, int]]:
    """Where the lines of a passage stand now, without new lines between them."""
    text = editions.new
    with_words = [line for line in range(first, last + 1) if editions.old.of_line(line)]
    places = {line: place for line in with_words if (place := editions.now(line)) is not None}
    lines = sorted({line for place in places.values() for line in range(place[0], place[1] + 1)})
    if not with_words:
        place = editions.now(first)
        return [] if place is None else [(place[0], place[0] + last - first)]
    ranges: list[tuple[int, int]] = []
    for line in lines:
        if ranges and not any(text.of_line(between) for between in range(ranges[-1][1] + 1, line)):
            ranges[-1] = (ranges[-1][0], line)
        else:
            ranges.append((line, line))
    if len(ranges) == 1:
        return [_with_blank_ends(ranges[0], with_words[0] - first, last - with_words[-1], editions)]
    return ranges


def _with_blank_ends(lines: tuple[int, int], above: int, below: int, editions: Editions) -> tuple[int, int]:
    """The lines with as many empty ones above and below as were there before, if they are still there."""
    first, last = lines
    text = editions.new
    while above and first > 1 and not text.of_line(first - 1):
        first, above = first - 1, above - 1
    while below and last < len(text.lines) and not text.of_line(last + 1):
        last, below = last + 1, below - 1
    return first, last


def _range(lines: tuple[int, int]) -> str:
    """A line, or a range; `780..780` is that line alone, where `780` opens a row."""
    first, last = lines
    return f"{first}..{last}" if last else str(first)
