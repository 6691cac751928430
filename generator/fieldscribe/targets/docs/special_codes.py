"""The special codes that many points share, each set shown once."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.records import dataclass
from fieldscribe.targets.docs.cells import anchor, by_rows, cell, code

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device, Point


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


def _sharing(device: Device) -> dict[str, list[Point]]:
    """The points that share codes, by the type, group or format that declares the codes."""
    points_of_codes: dict[str, list[Point]] = {}
    for point in device.points:
        if point.shape.specials_of:
            points_of_codes.setdefault(point.specials_of, []).append(point)
    return points_of_codes
