"""What the family adds to exports: its facts in the limits, and the tasks that read or write a point."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.uss import UssBus, of_bus, of_frame
from fieldscribe.families.uss.parts import READ_TASK, VARIABLE, write_task
from fieldscribe.targets.docs.bus import span
from fieldscribe.targets.docs.cells import cell
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.model import Bus, Code, Frame, Point


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


def facts(bus: Bus) -> Iterator[tuple[str, str]]:
    """Label and text of each fact that people must know about the line."""
    own = of_bus(bus)
    yield "Unit numbers", span(bus.units)
    if bus.broadcast is not None:
        yield "Broadcast", f"address byte {hex_text(bus.broadcast, 2)}, not answered"
    lengths = (f"variable ({VARIABLE})" if length == VARIABLE else str(length) for length in own.pkw)
    yield "Words of the parameter part (PKW)", cell(", ".join(lengths))
    yield "Words of process data (PZD)", span(own.pzd)


def numbers(space: str, address: int) -> Mapping[str, int]:
    """The numbers that people use for an address, whatever the manual prints."""
    del space, address  # an address is a number for people already
    return {}


def goes_to_all(function: Code) -> bool:
    """Whether a function may be broadcast where the description does not say so."""
    del function  # broadcasts are telegrams of their own
    return False
