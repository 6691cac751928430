"""The special codes that many points share, each set shown once, and the sheet of all special codes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.records import dataclass
from fieldscribe.targets.docs.cells import anchor, by_rows, cell, code
from fieldscribe.text import csv_cell

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device, Point, Special

_HEADS = ("of", "type", "code", "raw_first", "raw_last", "name", "no_value", "writable")


@dataclass(frozen=True, slots=True)
class CodesView:
    """Codes that many points share; `users` says how many points of which type."""

    anchor: str
    heading: str
    users: str
    rows: str


def code_views(device: Device) -> Iterator[CodesView]:
    """The shared codes, in the order of their first point."""
    for name, points in _sharing(device).items():
        rows = [
            (
                wording.special_numbers(special, points[0].width),
                code(special.name),
                cell(wording.title_text(special.title)),
                cell(wording.special_remarks(special)),
            )
            for special in points[0].specials
            if not special.own
        ]
        table = by_rows(("Raw", "Name", "Title", "Remarks"), rows)
        count = f"{len(points)} point{'' if len(points) == 1 else 's'} of type {points[0].type}"
        yield CodesView(anchor("codes", name), cell(name), count, table)


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
