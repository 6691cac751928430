"""What all rows of a device share, and the cells with addresses and printed numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe import wording
from fieldscribe.targets.docs.cells import LINE_BREAK, cell, number_cell
from fieldscribe.wording.rules import RenamedPoints

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from fieldscribe.model import Device, Point


class Scope(NamedTuple):
    """What all rows of a device share."""

    device: Device
    by_name: Mapping[str, Point]
    by_code: RenamedPoints
    several: bool
    """Whether facts come from several documents, so that each source names its own."""


def scope_of(device: Device) -> Scope:
    """Return what the rows of a device share."""
    by_name = {point.name: point for point in device.points}
    by_code = RenamedPoints(by_name, _codes(device.points))
    return Scope(device, by_name, by_code, len(device.documents) > 1)


def _codes(points: Iterable[Point]) -> dict[str, str]:
    """The codes by which rules call points: those that belong to one name."""
    names: dict[str, set[str]] = {}
    for point in points:
        if point.code:
            names.setdefault(point.code, set()).add(point.name)
    return {next(iter(known)): code for code, known in names.items() if len(known) == 1}


def place_text(point: Point) -> str:
    """Return where a point starts and how many words it has: `3100h (12544)`, then `2 words, low word first`."""
    if not point.addresses:
        return ""
    start = wording.address_text(min(point.addresses))
    order = wording.order_text(point)
    return f"{start}{LINE_BREAK}{len(point.addresses)} words, {cell(order)}" if order else start


def reference_heads(points: Iterable[Point]) -> tuple[str, ...]:
    """Return the numberings of the manual that some of the points have, in the order of their first use."""
    heads: dict[str, None] = {}
    for point in points:
        heads |= dict.fromkeys(point.place.references)
    return tuple(heads)


def numbers_head(keys: Sequence[str]) -> str:
    """Return the head of the column with all numberings: `Modicon / Reference`."""
    return cell(" / ".join(key.capitalize() for key in keys))


def numbers_text(point: Point, keys: Sequence[str]) -> str:
    """Return the numbers of a point in these numberings: `4115 / 404115`, with a dash for one that it lacks."""
    references = point.place.references
    if not references:
        return ""
    return " / ".join([number_cell(references.get(key, "-")) for key in keys])
