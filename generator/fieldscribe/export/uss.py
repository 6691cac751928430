"""Where a point of a USS device is: one place for each task that reads or writes it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.uss import write_task
from fieldscribe.model import Place

if TYPE_CHECKING:
    from fieldscribe.model import Bus, Point

_READ = 1


def uss_places(bus: Bus, point: Point) -> tuple[Place, ...]:
    """The places of a parameter: to `read`, in the `ram`, and to `write` it so that it is kept; others as they are."""
    if not point.places or point.space != "parameter":
        return point.places
    known = {code.number for code in bus.functions}
    array = point.index is not None
    tasks = [("read", _READ)] if point.readable else []
    if point.writable:
        tasks += [("ram", write_task(point.words, array=array, keep=False))] if point.keeps != "yes" else []
        tasks += [("write", write_task(point.words, array=array, keep=True))] if point.keeps != "no" else []
    first = point.places[0]
    places = [Place(purpose, first.space, first.addresses, task) for purpose, task in tasks if task in known]
    return tuple(places) or point.places
