"""The special codes that many points share, each set shown once."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.targets.docs.cells import by_rows, cell, code, target

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device, Point, Special


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


def _sharing(device: Device) -> dict[str, list[Point]]:
    """The points that share codes, by the type, group or format that declares the codes."""
    points_of_codes: dict[str, list[Point]] = {}
    for point in device.points:
        if point.shape.specials_of:
            points_of_codes.setdefault(point.specials_of, []).append(point)
    return points_of_codes
