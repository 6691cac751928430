"""What a description takes from its manual: all facts that name a line, and the lines that hold nothing for it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.audit.citing import Citing, numbers_in, spans_of
from fieldscribe.audit.claims_of_bus import claims_of_codes, claims_of_entry, claims_of_frames, claims_of_line_settings
from fieldscribe.audit.claims_of_points import claims_of_point
from fieldscribe.audit.wordings import Wordings
from fieldscribe.families import sections_of_codes
from fieldscribe.language.nodes import Map

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.audit.citing import Claim
    from fieldscribe.resolve.analysis import Analysis

_ENTRIES = {"command": "commands", "message": "messages", "telegram": "telegrams"}
"""Sections of named entries, by what one is called."""


def claims_of(subject: Analysis) -> Iterator[Claim]:
    """All facts of points, frames, codes of the bus, messages and telegrams that name a line."""
    wordings = Wordings(subject.scope.header["documents"])
    parts = _parts_of_addresses(subject)
    for resolved in subject.resolved:
        yield from claims_of_point(resolved.point, resolved.facts, subject.scope.named_enums, wordings, parts)
    for name, entries in subject.scope.named_enums.items():
        yield from _claims_of_enum(name, entries, wordings)
    for file in subject.scope.files:
        for kind, section in _ENTRIES.items():
            for entry in file.get(section, ()):
                yield from claims_of_entry(kind, entry, wordings)
        yield from claims_of_frames(file)
        bus = file.get("bus")
        if isinstance(bus, Map):
            yield from claims_of_line_settings(bus)
            for kind, section in sections_of_codes().items():
                yield from claims_of_codes(kind, bus.get(section))


def _parts_of_addresses(subject: Analysis) -> frozenset[str]:
    """The numberings of which one number belongs to several addresses, such as `mux` of `Mux 3 Word 2`."""
    addresses: dict[tuple[str, object], set[int]] = {}
    for resolved in subject.resolved:
        for place in resolved.point.places:
            for name, number in place.references.items():
                addresses.setdefault((name, number), set()).add(min(place.addresses))
    return frozenset(name for (name, _), places in addresses.items() if len(places) > 1)


def _claims_of_enum(name: str, entries: Map, wordings: Wordings) -> Iterator[Claim]:
    for key, entry in entries.items():
        if isinstance(entry, Map) and "line" in entry:
            place = entries.key_span(key)
            citing = Citing(f"enum {name}", place, entry["line"], None)
            yield from citing.numbers("enum", str(key), numbers_in(key), anchor=True)
            yield from citing.label("enum", wordings.label(entry), beside=numbers_in(key), place=place)


def looked_through_of(subject: Analysis) -> dict[int, frozenset[str]]:
    """The lines that the description says hold nothing for it, or only facts and these numbers that are none."""
    return by_line(
        (line, listed_in(passage))
        for file in subject.scope.files
        for passage in file.get("looked_through", ())
        for first, last in spans_of(passage["lines"])
        for line in range(first, max(first, last) + 1)
    )


def listed_in(passage: Map) -> frozenset[str]:
    """The numbers and words that a passage under `looked_through` says are no facts."""
    return frozenset(str(text) for key in ("numbers", "words") for text in passage.get(key, ()))


def by_line(passed_over: Iterable[tuple[int, frozenset[str]]]) -> dict[int, frozenset[str]]:
    """The numbers of each line that are no facts; none where the line as a whole holds nothing."""
    numbers_of_line: dict[int, frozenset[str]] = {}
    for line, numbers in passed_over:
        before = numbers_of_line.get(line, numbers)
        numbers_of_line[line] = before | numbers if before and numbers else frozenset()
    return numbers_of_line
