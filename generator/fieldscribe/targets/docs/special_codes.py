"""The special codes that many points share, each set shown once, and the sheet of all special codes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.targets.docs.cells import by_rows, cell, code, target
from fieldscribe.text import csv_cell

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device, Point, Special

_HEADS = ("of", "type", "code", "raw_first", "raw_last", "name", "no_value", "writable")


def codes_table(device: Device) -> str:
    """The shared codes, each type, group or format once, in the order of their first points."""
    rows = [
        (
            _sharers(name, points) if first else "",
            wording.special_numbers(special, points[0].width),
            code(special.name),
            cell(wording.title_text(special.title)),
            cell(wording.special_remarks(special)),
        )
        for name, points in _sharing(device).items()
        for first, special in _marked([special for special in points[0].specials if not special.own])
    ]
    return by_rows(("Codes of", "Raw", "Name", "Title", "Remarks"), rows)


def _sharers(name: str, points: list[Point]) -> str:
    return f"{target('codes', name)}: {len(points)} point{'' if len(points) == 1 else 's'} of type {points[0].type}"


def _marked(specials: list[Special]) -> Iterator[tuple[bool, Special]]:
    """Each code, and whether it is the first."""
    return ((place == 0, special) for place, special in enumerate(specials))


def sheet_of_codes(device: Device) -> str:
    """The lines of the table of all codes, its head first; shared codes have one row, not one for each point."""
    coded = [point for point in device.points if point.shape.specials]
    languages = tuple(dict.fromkeys(key for point in coded for special in point.specials for key in special.title))
    shared = [(name, points[0], False) for name, points in _sharing(device).items()]
    owners = [*shared, *((point.item, point, True) for point in device.points)]
    rows = [
        _row(name, point, special, languages)
        for name, point, own in owners
        for special in point.specials
        if special.own == own
    ]
    heads = (*_HEADS, *(f"title_{key}" for key in languages))
    return "".join(f"{','.join(map(csv_cell, row))}\n" for row in (heads, *rows)) if rows else ""


def _row(name: str, point: Point, special: Special, languages: tuple[str, ...]) -> tuple[str, ...]:
    return (
        name,
        point.type,
        wording.special_numbers(special, point.width),
        str(special.low),
        str(special.high),
        special.name,
        "yes" if special.no_value else "no",
        "yes" if special.writable else "no",
        *(special.title.get(key, "") for key in languages),
    )


def _sharing(device: Device) -> dict[str, list[Point]]:
    """The points that share codes, by the type, group or format that declares the codes."""
    points_of_codes: dict[str, list[Point]] = {}
    for point in device.points:
        if point.shape.specials_of:
            points_of_codes.setdefault(point.specials_of, []).append(point)
    return points_of_codes
