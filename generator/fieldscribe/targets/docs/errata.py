"""The table of errata: where the manual is wrong, unclear or silent, and what was taken instead."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from fieldscribe.targets.docs.tables import Column, Table, source_cells

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.model import Device
    from fieldscribe.targets.docs.tables import Encode

COLUMNS = (
    Column("id", "the id, which the column `errata` of points names"),
    Column("points", "the points that it is about"),
    Column("where", "what else it is about"),
    Column("printed", "what the manual prints"),
    Column("taken", "what was taken"),
    Column("why", "why"),
    Column("certainty", "how sure that is: `certain`, `likely`, `unknown`"),
    Column("document", "the manual"),
    Column("section", "the section of the manual"),
    Column("page", "the page", True),
    Column("line", "the line of the manual's text", True),
)


def items_of(device: Device) -> Mapping[str, list[str]]:
    """The names in code of the points of a name, one for each variant."""
    items: dict[str, list[str]] = {}
    for point in device.points:
        items.setdefault(point.name, []).append(point.item)
    return items


def errata_table(device: Device) -> Table:
    """The errata of a device."""
    return Table("errata", COLUMNS, partial(_rows, device))


def _rows(device: Device, encode: Encode) -> Iterator[tuple[str, ...]]:
    items = items_of(device)
    for erratum in device.errata:
        points = "; ".join(item for name in erratum.points for item in items.get(name, ()))
        where = str(erratum.where)
        told = (erratum.id, points, where, erratum.printed, erratum.taken, erratum.why, erratum.certainty)
        yield (*map(encode, told), *source_cells(erratum.source, encode))
