"""The map of a space: all points and commands by address."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe import wording
from fieldscribe.targets.docs.bus import part_of
from fieldscribe.targets.docs.cells import LINE_BREAK, anchor, by_rows, cell, link, number_cell
from fieldscribe.targets.docs.scope import numbers_head, place_text
from fieldscribe.targets.docs.sheet import wanted_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from fieldscribe.model import Command, Device, Point
    from fieldscribe.targets.docs.bus import OfFamily


@dataclass(frozen=True, slots=True)
class MapView:
    """The points of one space, sorted."""

    anchor: str
    heading: str
    rows: str


class _Place(NamedTuple):
    """What stands at an address."""

    order: tuple[int, int, int, str]
    """By address, then by index, the high bits of a word first."""
    wire: str
    element: str
    numbers: Mapping[str, int | str]
    others: tuple[str, ...]


def map_views(device: Device) -> Iterator[MapView]:
    """The map of each space, and of each telegram, in the order of their first points."""
    part = part_of(device)
    spaces: dict[tuple[str, str], list[_Place]] = {}
    for point in device.points:
        if point.addresses:
            spaces.setdefault((point.terms.space, point.terms.telegram or ""), []).append(_of_point(point, part))
    for command in device.commands:
        spaces.setdefault((command.space, ""), []).append(_of_command(command, part))
    for (space, telegram), places in spaces.items():
        heading = cell(f"Telegram {telegram}" if telegram else space.capitalize())
        yield MapView(anchor("map", telegram or space), heading, _table(sorted(places, key=lambda place: place.order)))


def _of_point(point: Point, part: OfFamily) -> _Place:
    lowest = min(point.place.addresses)
    high = point.terms.bits[0] if point.terms.bits else 0
    return _Place(
        (lowest, -1 if point.index is None else point.index, -high, point.item),
        place_text(point),
        "" if point.index is None else str(point.index),
        {**point.place.references, **_missing(part.numbers(point.space, lowest), point.place.references)},
        (wording.type_text(point), point.access, cell(point.code) if point.code else "", link("point", point.item)),
    )


def _missing(numbers: Mapping[str, int], printed: Mapping[str, int | str]) -> Mapping[str, int]:
    return {name: number for name, number in numbers.items() if name not in printed}


def _of_command(command: Command, part: OfFamily) -> _Place:
    name = f"{link('command', command.name)}{LINE_BREAK}{wanted_text(command)}"
    numbers = part.numbers(command.space, command.address)
    wire = wording.address_text(command.address)
    return _Place((command.address, -1, 0, command.name), wire, "", numbers, ("command", "w", "", name))


def _table(places: Sequence[_Place]) -> str:
    keys = tuple(dict.fromkeys(key for place in places for key in place.numbers))
    rows = [
        (
            place.wire,
            place.element,
            " / ".join([number_cell(place.numbers.get(key, "-")) for key in keys]) if place.numbers else "",
            *place.others,
        )
        for place in places
    ]
    return by_rows(("Wire address", "Index", numbers_head(keys), "Type", "R/W", "Code", "Name"), rows)
