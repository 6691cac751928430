"""The map of a space: all points by address."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.records import dataclass
from fieldscribe.targets.docs.cells import anchor, by_rows, cell, link
from fieldscribe.targets.docs.subjects import numbers_head, numbers_text, reference_heads

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device, Point


@dataclass(frozen=True, slots=True)
class MapView:
    """The points of one space, sorted."""

    anchor: str
    heading: str
    rows: str


def map_views(device: Device) -> Iterator[MapView]:
    """The map of each space, and of each telegram, in the order of their first points."""
    spaces: dict[tuple[str, str], list[Point]] = {}
    for point in device.points:
        if point.addresses:
            spaces.setdefault((point.terms.space, point.terms.telegram or ""), []).append(point)
    for (space, telegram), points in spaces.items():
        heading = cell(f"Telegram {telegram}" if telegram else space.capitalize())
        yield MapView(anchor("map", telegram or space), heading, _table(sorted(points, key=_order)))


def _order(point: Point) -> tuple[int, int, int, str]:
    """By address, then by index, the high bits of a word first."""
    high = point.terms.bits[0] if point.terms.bits else 0
    return min(point.place.addresses), -1 if point.index is None else point.index, -high, point.item


def _table(points: list[Point]) -> str:
    keys = reference_heads(points)
    rows = [
        (
            wording.words_text(point),
            "" if point.index is None else str(point.index),
            numbers_text(point, keys),
            wording.type_text(point),
            point.access,
            cell(point.code) if point.code else "",
            link("point", point.item),
        )
        for point in points
    ]
    return by_rows(("Wire address", "Index", numbers_head(keys), "Type", "R/W", "Code", "Name"), rows)
