"""Finding points by what a person has at hand: a code, a name, or an address in any notation and numbering."""

from __future__ import annotations

import re
from dataclasses import dataclass
from operator import ne
from typing import TYPE_CHECKING

from fieldscribe.families import family
from fieldscribe.pasted_numbers import number_of
from fieldscribe.text import line
from fieldscribe.wording.buses import word_text
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.model import Device, Place, Point

_ELEMENT = re.compile(r"([^\[\]]+)\[([0-9]{1,5})\]")
_LONGEST = 64
_NOT_ALONE = frozenset({"mux", "word"})
"""Numberings that are only searched when a prefix asks for them, for their numbers fit many points."""

_NEAR = 5
_ALIKE = str.maketrans("oil", "011")


@dataclass(frozen=True, slots=True)
class Match:
    """A point that was found, how the question was understood, and which word it names (empty for all)."""

    reading: str
    point: Point
    word: str


def find(device: Device, what: str) -> list[Match]:
    """Every point that `what` can mean, each reading labelled.

    `what` is a code, a name, or a number (`0x1028`, `1028h`, `H'1028`, `4136`) read as wire address and in each
    numbering of the device; `[1]` behind it chooses one element of an array. A prefix forces one reading: `code:`,
    `name:`, `wire:`, or a numbering such as `modicon:`.
    """
    forced, asked = _split(device, what.strip())
    element = _ELEMENT.fullmatch(asked[:_LONGEST])
    if element is not None:
        matches = find(device, f"{forced}:{element[1]}" if forced else element[1])
        return [match for match in matches if match.point.index == int(element[2])]
    matches_of_form = [*_by_code(device, asked, forced), *_by_name(device, asked, forced)]
    number = number_of(asked)
    if number is not None and forced in (None, "wire"):
        matches_of_form += _by_wire(device, number)
    for key in _numberings(device):
        if forced == key.lower() or (forced is None and key not in _NOT_ALONE):
            matches_of_form += _by_reference(device, key, asked, number)
    return matches_of_form


def near(device: Device, what: str) -> list[str]:
    """For a question without a match: similar names and codes, or for a number the points next to it."""
    from difflib import get_close_matches

    asked = _split(device, what.strip())[1][:_LONGEST].lower()
    number = number_of(asked)
    if number is not None:
        return [point.item for point in _neighbours(device, number)]
    known = {point.item: point.item for point in device.points}
    known |= {point.code.lower(): point.code for point in device.points if point.code}
    spellings = dict.fromkeys([*_slips(asked, known), *get_close_matches(asked, list(known), _NEAR)])
    return [known[spelling] for spelling in list(spellings)[:_NEAR]]


def _slips(asked: str, known: Iterable[str]) -> list[str]:
    """What was typed with one wrong character at most; those that look the same come first."""
    alike, slips = asked.translate(_ALIKE), []
    for spelling in known:
        if len(spelling) == len(asked) > 2:
            wrong = sum(map(ne, alike, spelling.translate(_ALIKE)))
            if wrong < 2:
                slips.append((wrong, spelling))
    return [spelling for _, spelling in sorted(slips)]


def _split(device: Device, what: str) -> tuple[str | None, str]:
    """The prefix, if any, and the text after it."""
    prefix, colon, rest = what.partition(":")
    prefix = prefix.strip().lower()
    known = {"wire", "code", "name", *(key.lower() for key in _numberings(device))}
    return (prefix, rest.strip()) if colon and prefix in known else (None, what)


def _numberings(device: Device) -> tuple[str, ...]:
    return tuple(dict.fromkeys(key for point in device.points for key in point.references))


def _by_code(device: Device, asked: str, forced: str | None) -> Iterator[Match]:
    if forced not in (None, "code"):
        return
    points = [point for point in device.points if point.code and point.code.lower() == asked.lower()]
    exactly = [point for point in points if point.code == asked]
    for point in exactly or points:
        yield Match(f"code {line(point.code or '')}", point, "")


def _by_name(device: Device, asked: str, forced: str | None) -> Iterator[Match]:
    if forced not in (None, "name"):
        return
    asked = asked.lower()
    for point in device.points:
        if asked in (point.name, point.item):
            yield Match(f"name {asked}", point, "")
        elif asked in point.was:
            yield Match(f"old name {asked}", point, "")


def _by_wire(device: Device, number: int) -> Iterator[Match]:
    reading = f"wire address {hex_text(number)} ({number})"
    for point in device.points:
        for place in point.places:
            if number in place.addresses:
                meaning = f"{reading}, {point.space}{_purpose(point, place)}"
                if point.telegram is not None:
                    meaning = f"word {number} of the telegram {line(point.telegram)}"
                elif point.index is not None and point.space in family(device.family).indexed:
                    meaning += f", index {point.index}"
                yield Match(meaning, point, word_text(place.addresses, number, text=point.text is not None))
                break


def _by_reference(device: Device, key: str, asked: str, number: int | None) -> Iterator[Match]:
    """Points whose printed number is this one; each further word of a point has the next number."""
    per_frame = _words_per_frame(device)
    for point in device.points:
        size = per_frame.get(point.telegram or "", 0)
        if key in _NOT_ALONE and size:
            yield from _in_frames(point, key, number, size)
            continue
        for place in point.places:
            printed, purpose = place.references.get(key), _purpose(point, place)
            if isinstance(printed, int) and number is not None:
                if printed <= number < printed + len(place.addresses):
                    address = min(place.addresses) + number - printed
                    yield Match(f"{line(key)} {number}{purpose}", point, word_text(place.addresses, address))
            elif isinstance(printed, str) and printed.lower() == asked.lower():
                yield Match(f"{line(key)} {line(printed)}{purpose}", point, "")


def _purpose(point: Point, place: Place) -> str:
    """What a place is for, if it is not the first one."""
    return ", to write" if place is point.write_place else ""


def _words_per_frame(device: Device) -> dict[str, int]:
    """For each telegram in several frames, how many words one frame carries."""
    parts = [message for message in device.messages if any(role.kind == "multiplexer" for role in message.roles)]
    words = {message.name: message.words for message in parts}
    return {telegram.name: words.get(telegram.message or "", 0) for telegram in device.telegrams}


def _in_frames(point: Point, key: str, number: int | None, size: int) -> Iterator[Match]:
    """A point of a multiplexed telegram by the number of its frame, or of its word (from 1) in the frame."""
    for address in point.addresses:
        slot, word = divmod(address, size)
        if number == (slot if key == "mux" else word + 1):
            yield Match(f"{key} {number}", point, word_text(point.addresses, address))
            return


def _neighbours(device: Device, number: int) -> list[Point]:
    """The nearest points below and above an address."""
    placed = [(point.address, point) for point in device.points if point.address is not None]
    below = max((entry for entry in placed if entry[0] < number), key=lambda entry: entry[0], default=None)
    above = min((entry for entry in placed if entry[0] > number), key=lambda entry: entry[0], default=None)
    return [entry[1] for entry in (below, above) if entry is not None]
