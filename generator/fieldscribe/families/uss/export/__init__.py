"""What the family adds to exports: its facts in the limits, and a place for each task that reads or writes a point."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.uss.facts import UssBus, of_bus
from fieldscribe.families.uss.parts import READ_TASK, write_task
from fieldscribe.model import Place

if TYPE_CHECKING:
    from fieldscribe.model import Bus, Point


def limits(bus: Bus | None) -> dict[str, object]:
    """What the family alone knows of a bus; of a bus of another family what stands for nothing."""
    uss_bus = UssBus() if bus is None else of_bus(bus)
    return {
        "pkw": list(uss_bus.pkw),
        "pzd": list(uss_bus.pzd),
        "variant_pzd": dict(uss_bus.variant_pzd),
        "bitrate": uss_bus.bitrate,
    }


def places(bus: Bus, point: Point) -> tuple[Place, ...]:
    """The places of a parameter: to `read`, in the `ram`, and to `write` it so that it is kept; others as they are."""
    if not point.places or point.telegram is not None:
        return point.places
    known = {code.number for code in bus.functions}
    array = point.index is not None
    tasks = [("read", READ_TASK)] if point.readable else []
    if point.writable:
        tasks += [("ram", write_task(point.words, array=array, keep=False))] if point.keeps != "yes" else []
        tasks += [("write", write_task(point.words, array=array, keep=True))] if point.keeps != "no" else []
    first = point.places[0]
    known_places = [Place(purpose, first.space, first.addresses, task) for purpose, task in tasks if task in known]
    return tuple(known_places) or point.places
