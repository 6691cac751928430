"""The context of the Markdown reference of a device: its facts, and the map of each space by address."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from fieldscribe import wording
from fieldscribe.families import family
from fieldscribe.grouping import grouped
from fieldscribe.model import Command, Device, Message, Point
from fieldscribe.targets.docs import device_tables
from fieldscribe.targets.docs.cells import (
    MARKDOWN,
    DocsScope,
    anchor,
    by_rows,
    cell,
    code,
    computed_numberings,
    link,
    numbers_head,
    numbers_text,
    paragraph,
    place_text,
    reference_heads,
)
from fieldscribe.targets.docs.device_tables import bus_view
from fieldscribe.targets.docs.points import group_views
from fieldscribe.targets.docs.sheet import wanted_text
from fieldscribe.targets.docs.words import is_broken
from fieldscribe.targets.identifiers import command as command_line
from fieldscribe.targets.identifiers import head_lines

_COMPUTED = "The address maps compute it where the manual does not print it."
_NUMBERINGS = {
    "modicon": "the number with one added, as many PLC and panel tools count; the space is not part of the number",
    "reference": "the traditional reference whose first digit says the space (4: holding registers)",
}


def page_of(scope: DocsScope) -> dict[str, object]:
    """Return the context of the template for a device's page."""
    device = scope.device
    generated, _, _ = head_lines(device, "docs", cell)
    printed, computed = reference_heads(device.points), computed_numberings(device)
    distinct = {(id(point.shape), id(point.terms)): point for point in device.points}.values()
    numberings = (*printed, *(key for key in computed if key not in printed))
    return {
        "generated": generated,
        "regenerate": code(command_line(device, "docs")),
        "heading": cell(f"{device.vendor} {device.model}: {wording.title_text(device.title)}"),
        "note": paragraph(wording.title_text(device.note)) if device.note else "",
        "facts": device_tables.facts(device, MARKDOWN),
        "documents": device_tables.documents(device, MARKDOWN),
        "identifications": device_tables.identifications(scope, MARKDOWN),
        "bases": device_tables.bases(device, MARKDOWN),
        "found": device_tables.found(device.found, MARKDOWN),
        "numberings": tuple(
            f"{cell(key.capitalize())}: {_NUMBERINGS.get(key, 'as the manual prints it')}."
            + (f" {_COMPUTED}" if key in computed else "")
            for key in numberings
        ),
        "shares_words": any(wording.shares_word(point) for point in distinct),
        "has_telegrams": any(point.telegram is not None and point.place.bit is None for point in device.points),
        "has_broken_words": any(is_broken(point) for point in distinct),
        "bus": bus_view(device, MARKDOWN),
        "groups": list(group_views(scope)),
        "codes": device_tables.codes(device, MARKDOWN),
        "maps": list(map_views(device)),
        "frames": device_tables.frames(scope, MARKDOWN),
        "errata": device_tables.errata(device, MARKDOWN),
        "missing": device_tables.missing(device, MARKDOWN),
    }


class _Place(NamedTuple):
    """A point or a command at an address."""

    order: tuple[int, int, int, str]
    """Sort key: address, index, position of the bits from the top, name."""
    wire: str
    element: str
    numbers: Mapping[str, int | str]
    others: tuple[str, ...]


def map_views(device: Device) -> Iterator[dict[str, str]]:
    """Yield the map of each space and of each telegram, in the order of their first points."""
    numbers_at = family(device.family).numbers
    spaces: dict[tuple[str, str, str], list[_Place]] = {}
    bases = {base.name: f", counted from {wording.base_text(base)}" for base in device.bases}
    drawn = {message.name: message for message in device.messages if message.fields}
    for point in device.points:
        if point.addresses:
            numbers = {} if point.terms.base else numbers_at(point.space, min(point.addresses))
            key = point.terms.space, point.terms.telegram or "", point.terms.base or ""
            spaces.setdefault(key, []).append(_of_point(point, numbers))
    for command in device.commands:
        spaces.setdefault((command.space, "", ""), []).append(
            _of_command(command, numbers_at(command.space, command.address))
        )
    for (space, telegram, base), places in spaces.items():
        if telegram in drawn:
            rows = _bits(drawn[telegram], device.points)
            yield {"anchor": anchor("map", telegram), "heading": cell(f"Message {telegram}"), "rows": rows}
            continue
        heading = cell(f"Telegram {telegram}" if telegram else space.capitalize() + bases.get(base, ""))
        where = f"{space}_{base}" if base else telegram or space
        rows = _table(sorted(places, key=lambda place: place.order))
        yield {"anchor": anchor("map", where), "heading": heading, "rows": rows}


def _bits(message: Message, points: Iterable[Point]) -> str:
    """Return the bits of a message with their signals, a row for each byte; `=` repeats the bit to the left."""
    by_word = {point.addresses[0]: point for point in points if point.telegram == message.name and point.addresses}
    names = grouped((bit, link("point", by_word[field.word].item)) for field in message.fields for bit in field.bits)
    rows = []
    for byte in range(message.length):
        held = [MARKDOWN.lines(*names.get(8 * byte + bit, ["-"])) for bit in reversed(range(8))]
        cells = ("=" if place and text == held[place - 1] else text for place, text in enumerate(held))
        rows.append((str(byte), *cells))
    return by_rows(("Byte", *(f"Bit {bit}" for bit in reversed(range(8)))), rows)


def _of_point(point: Point, numbers: Mapping[str, int]) -> _Place:
    lowest = min(point.place.addresses)
    high = point.terms.bits[0] if point.terms.bits else 0
    unprinted = {name: number for name, number in numbers.items() if name not in point.place.references}
    return _Place(
        (lowest, -1 if point.index is None else point.index, -high, point.item),
        place_text(point),
        "" if point.index is None else str(point.index),
        {**point.place.references, **unprinted},
        (wording.type_text(point), point.access, cell(point.code) if point.code else "", link("point", point.item)),
    )


def _of_command(command: Command, numbers: Mapping[str, int]) -> _Place:
    name = f"{link('command', command.name)}{MARKDOWN.line_break}{wanted_text(command)}"
    wire = wording.address_text(command.address)
    return _Place((command.address, -1, 0, command.name), wire, "", numbers, ("command", "w", "", name))


def _table(places: Sequence[_Place]) -> str:
    keys = tuple(dict.fromkeys(key for place in places for key in place.numbers))
    rows = [(place.wire, place.element, numbers_text(place.numbers, keys), *place.others) for place in places]
    return by_rows(("Wire address", "Index", numbers_head(keys), "Type", "R/W", "Code", "Name"), rows)
