"""Finds points by a code, a name, or an address in any notation and numbering."""

import re
from collections.abc import Iterable, Iterator
from difflib import get_close_matches
from operator import itemgetter, ne
from typing import NamedTuple

from fieldscribe.diagnostics import did_you_mean, either
from fieldscribe.families import family
from fieldscribe.model import Device, Place, Point
from fieldscribe.pasted_numbers import number_of
from fieldscribe.text import line
from fieldscribe.wording.numbers import hex_text, word_text

_ELEMENT = re.compile(r"([^\[\]]+)\[([0-9]{1,5})\]")
_BEHIND_CODE = re.compile(r"[\[.: ]")
_SEPARATORS = re.compile(r"[^a-z0-9]")
_LEADING_ZEROS = re.compile(r"(?<=[a-z])0+(?=[0-9])")
_LONGEST = 64
_ONLY_FORCED = frozenset({"mux", "word"})
"""Numberings that need a prefix: their numbers fit many points."""
_MOST_NEAR = 3
_NEAR = 256
"""How far away an address may be for its point to be near."""
_LOOK_ALIKE = str.maketrans("oil", "011")


class Match(NamedTuple):
    """A point that a text names, the reading of the text, and the word of the point that it names (empty for all)."""

    reading: str
    point: Point
    word: str


def find(device: Device, what: str) -> list[Match]:
    """Return every point that `what` may mean, each with its reading.

    `what` is a code, a name, or a number (`0x1028`, `1028h`, `H'1028`, `4136`) read as wire address and in each
    numbering of the device; `[1]` after it chooses one element of an array. A prefix forces one reading: `code:`,
    `name:`, `wire:`, or a numbering such as `modicon:`. A number that matches nothing is read in the numberings of the
    family.
    """
    forced, text = _split(device, what.strip())
    element = _ELEMENT.fullmatch(text[:_LONGEST])
    if element is not None and not _by_code(device, text):
        matches = find(device, f"{forced}:{element[1]}" if forced else element[1])
        return [match for match in matches if match.point.index == int(element[2])]
    matches = []
    if forced in (None, "code"):
        matches += _by_code(device, text)
    if forced in (None, "name"):
        matches += _by_name(device, text.lower())
    number = number_of(text)
    if number is not None and forced in (None, "wire"):
        matches += _by_wire_address(device, number)
    for key in _numberings(device):
        if forced == key.lower() or (forced is None and key not in _ONLY_FORCED):
            matches += _by_reference(device, key, text, number)
    if not matches and number is not None:
        matches += _by_computed_number(device, forced, number)
    return matches


def advice(device: Device, what: str) -> str:
    """Return advice for a text without a match; may be empty."""
    forced, text = _split(device, what.strip())
    if forced not in (None, "wire") and number_of(text) is not None:
        return ""
    if any(text.lower() == command.name for command in device.all_commands):
        return f"it is a command, and no point: `fieldscribe explain {device.id} {line(text)}` says what it writes"
    names = near(device, what)
    if number_of(text) is not None:
        return f"described near it: {either(names)}" if names else ""
    return did_you_mean(names) or f"`fieldscribe search --device {device.id} …` looks into titles, flags and labels"


def near(device: Device, what: str) -> list[str]:
    """Return similar names and codes for a text without a match; for a number, the points next to it."""
    text = _split(device, what.strip())[1][:_LONGEST].lower()
    number = number_of(text)
    if number is not None:
        return _neighbours(device, number)
    known = {point.item: point.item for point in device.points}
    known |= {point.code.lower(): point.code for point in device.points if point.code}
    whole, base = _plain(text), _plain(_BEHIND_CODE.split(text)[0])
    for wanted in (whole, base):
        if same := [name for spelling, name in known.items() if _plain(spelling) == wanted]:
            return same[:_MOST_NEAR]
    spellings = dict.fromkeys([*_with_one_error(text, known), *get_close_matches(text, list(known), _MOST_NEAR)])
    return [known[spelling] for spelling in list(spellings)[:_MOST_NEAR]]


def _plain(spelling: str) -> str:
    """Return a code without separators and leading zeros: `a-020` and `a20` are one."""
    return _LEADING_ZEROS.sub("", _SEPARATORS.sub("", spelling))


def _with_one_error(text: str, known: Iterable[str]) -> list[str]:
    """Return the spellings that differ in at most one character, look-alikes first."""
    folded, near_spellings = text.translate(_LOOK_ALIKE), []
    for spelling in known:
        if len(spelling) == len(text) > 2:
            wrong = sum(map(ne, folded, spelling.translate(_LOOK_ALIKE)))
            if wrong < 2:
                near_spellings.append((wrong, spelling))
    return [spelling for _, spelling in sorted(near_spellings)]


def _neighbours(device: Device, number: int) -> list[str]:
    """Return the nearest points below and above an address, if they are not far away."""
    placed = [(point.address, point.item) for point in device.points if point.address is not None]
    below = max((entry for entry in placed if entry[0] < number), key=itemgetter(0), default=None)
    above = min((entry for entry in placed if entry[0] > number), key=itemgetter(0), default=None)
    return [entry[1] for entry in (below, above) if entry is not None and abs(entry[0] - number) <= _NEAR]


def _split(device: Device, what: str) -> tuple[str | None, str]:
    """Return the prefix (perhaps empty) and the text after it."""
    prefix, colon, rest = what.partition(":")
    prefix = prefix.strip().lower()
    return (prefix, rest.strip()) if colon and prefix in prefixes(device) else (None, what)


def prefixes(device: Device) -> list[str]:
    """Return the prefixes that force one reading, before a colon."""
    return ["wire", "code", "name", *(key.lower() for key in _numberings(device))]


def _numberings(device: Device) -> tuple[str, ...]:
    first = device.points[0].space if device.points else ""
    computed = family(device.family).numbers(first, 0)
    return tuple(dict.fromkeys([*(key for point in device.points for key in point.references), *computed]))


def _by_code(device: Device, text: str) -> list[Match]:
    points = [point for point in device.points if point.code and point.code.lower() == text.lower()]
    exact = [point for point in points if point.code == text]
    return [Match(f"code {line(point.code or '')}", point, "") for point in exact or points]


def _by_name(device: Device, name: str) -> Iterator[Match]:
    for point in device.points:
        if name in (point.name, point.item):
            yield Match(f"name {name}", point, "")
        elif name in point.was:
            yield Match(f"old name {name}", point, "")


def _by_wire_address(device: Device, number: int) -> Iterator[Match]:
    for point in device.points:
        if point.place.bit is not None:  # no frame carries its words
            continue
        place = next((place for place in point.places if number in place.addresses), None)
        if place is None:
            continue
        reading = f"wire address {hex_text(number)} ({number}), {point.space}{_purpose(point, place)}"
        if point.telegram is not None:
            reading = f"word {number} of the telegram {line(point.telegram)}"
        elif point.index is not None and point.space in family(device.family).indexed:
            reading += f", index {point.index}"
        yield Match(reading, point, _word(point, place, number))


def _by_reference(device: Device, key: str, text: str, number: int | None) -> Iterator[Match]:
    """Return points with this printed number or text; each further word of a point has the next number."""
    per_frame = _words_per_frame(device)
    for point in device.points:
        size = per_frame.get(point.telegram or "", 0)
        if key in _ONLY_FORCED and size:
            yield from _in_frames(point, key, number, size)
            continue
        for place in point.places:
            printed, purpose = place.references.get(key), _purpose(point, place)
            if isinstance(printed, int) and number is not None:
                if printed <= number < printed + len(place.addresses):
                    address = min(place.addresses) + number - printed
                    yield Match(f"{line(key)} {number}{purpose}", point, _word(point, place, address))
            elif isinstance(printed, str) and printed.lower() == text.lower():
                yield Match(f"{line(key)} {line(printed)}{purpose}", point, "")


def _by_computed_number(device: Device, forced: str | None, number: int) -> Iterator[Match]:
    """Return points by a number that the manual does not print but people (and our pages) use for the address."""
    numbers = family(device.family).numbers
    for point in device.points:
        for place in point.places:
            for address in place.addresses:
                for key, computed in numbers(point.space, address).items():
                    if computed == number and key not in place.references and forced in (None, key):
                        reading = f"{key} {number}, computed{_purpose(point, place)}"
                        yield Match(reading, point, _word(point, place, address))


def _word(point: Point, place: Place, address: int) -> str:
    """Return the word of the point at an address; empty if the manual leaves the order open."""
    return "" if point.untyped is not None else word_text(place.addresses, address, text=point.text is not None)


def _purpose(point: Point, place: Place) -> str:
    return ", to write" if place is point.write_place else ""


def _words_per_frame(device: Device) -> dict[str, int]:
    """Return the number of words in one frame, for each telegram of several frames."""
    parts = [message for message in device.messages if any(role.kind == "multiplexer" for role in message.roles)]
    words = {message.name: message.words for message in parts}
    return {telegram.name: words.get(telegram.message or "", 0) for telegram in device.telegrams}


def _in_frames(point: Point, key: str, number: int | None, size: int) -> Iterator[Match]:
    """Return a point of a multiplexed telegram by the number of its frame, or of its word (from 1) in the frame."""
    for address in point.addresses:
        slot, word = divmod(address, size)
        if number == (slot if key == "mux" else word + 1):
            yield Match(f"{key} {number}", point, word_text(point.addresses, address))
            return
