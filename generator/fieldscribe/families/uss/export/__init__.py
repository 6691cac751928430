"""What the family adds to exports: its facts in the limits, and the tasks that read or write a point."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.uss.facts import UssBus, of_bus, of_frame
from fieldscribe.families.uss.parts import READ_TASK, write_task

if TYPE_CHECKING:
    from fieldscribe.model import Bus, Frame, Point

LIMIT_CLASSES = {"pkw": "wire", "pzd": "wire", "variant_pzd": "behaviour", "bitrate": "wire"}
"""How grave a difference in a fact of `limits` is: a class of `differences`."""

FRAME_CLASSES = {"pkw": "docs"}
"""The same for worked examples."""


def limits(bus: Bus | None) -> dict[str, object]:
    """What the family alone knows of a bus; of a bus of another family what stands for nothing."""
    uss_bus = UssBus() if bus is None else of_bus(bus)
    return {
        "pkw": list(uss_bus.pkw),
        "pzd": list(uss_bus.pzd),
        "variant_pzd": {str(variant): most for variant, most in uss_bus.variant_pzd},
        "bitrate": uss_bus.bitrate,
    }


def frame(frame: Frame | None) -> dict[str, object]:
    """The parameter part of a worked example; of a frame of another family what stands for nothing."""
    return {"pkw": None if frame is None else of_frame(frame).pkw}


def tasks(bus: Bus, point: Point) -> tuple[tuple[str, int], ...]:
    """The tasks of a parameter: to `read` it, to change it in the `ram`, and to `write` it so that it is kept."""
    if not point.addresses or point.telegram is not None:
        return ()
    known = {code.number for code in bus.functions}
    array = point.index is not None
    ways = [("read", READ_TASK)] if point.readable else []
    if point.writable:
        ways += [("ram", write_task(point.words, array=array, keep=False))] if point.keeps != "yes" else []
        ways += [("write", write_task(point.words, array=array, keep=True))] if point.keeps != "no" else []
    return tuple((purpose, task) for purpose, task in ways if task in known)
