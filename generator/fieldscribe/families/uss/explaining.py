"""How a point of a USS device is read and written, with telegrams as examples."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import with_fixed
from fieldscribe.families.frame_results import WriteMethod
from fieldscribe.families.uss.links import default_link
from fieldscribe.families.uss.parts import READ_TASK, VARIABLE, Link, write_task
from fieldscribe.families.uss.remarks import code_text
from fieldscribe.families.uss.sending import part_words, read_request, write_request
from fieldscribe.families.uss.telegrams import Request, build
from fieldscribe.wording.buses import spaced

if TYPE_CHECKING:
    from fieldscribe.model import Device, Point


def read_text(device: Device, point: Point) -> str:
    """How to read the point: the task, or the word of process data; empty if it cannot be read."""
    link, unit = default_link(device.bus), device.bus.usual_unit
    data = read_request(device, point, link, unit)
    if point.telegram is not None:
        return f"{_word(point)} of every answer, for example to task 0; {_example(data, link, unit)}"
    task = code_text(device.bus.functions, READ_TASK, "task")
    return f"{task}; PKW {part_words(data, link)}; {_example(data, link, unit)}"


def way_to_write(device: Device, point: Point) -> WriteMethod | None:
    """How to write the point; None if it cannot be written."""
    if point.words > 2:
        return None
    if point.telegram is not None:
        return WriteMethod(f"{_word(point)} of every request", lambda raw: _sent(device, point, raw))
    array = point.index is not None
    tasks = [
        code_text(device.bus.functions, write_task(point.words, array=array, keep=keep), "task")
        for keep in (False, True)
    ]
    how = f"{tasks[0]} (RAM) or {tasks[1]} (EEPROM too)" if point.keeps == "choice" else tasks[0]
    return WriteMethod(how, lambda raw: _written(device, point, raw))


def _written(device: Device, point: Point, raw: int) -> str:
    """The telegram that writes a parameter; empty where there is none over the usual link."""
    link, unit = default_link(device.bus), device.bus.usual_unit
    request = write_request(point, with_fixed(point, raw), unit, (0,) * link.pzd, keep=False)
    status, data = build(device.bus, link, request)
    return f"; PKW {part_words(data, link)}; {_example(data, link, unit)}" if status == "ok" else ""


def _sent(device: Device, point: Point, raw: int) -> str:
    """A telegram with the other process data 0; empty if the usual telegram is too short for the point."""
    link, unit = default_link(device.bus), device.bus.usual_unit
    if max(point.addresses) >= link.pzd or point.words != 1:
        return ""
    value = with_fixed(point, raw) & 0xFFFF
    words = tuple(value if place == point.addresses[0] else 0 for place in range(link.pzd))
    status, data = build(device.bus, link, Request(unit, 0, words=words))
    return f"; {_example(data, link, unit)}" if status == "ok" else ""


def _word(point: Point) -> str:
    return f"word {point.addresses[0] + 1} of the process data"


def _example(data: bytes, link: Link, unit: int) -> str:
    pkw = "variable" if link.pkw == VARIABLE else str(link.pkw)
    return f"telegram to unit {unit} (PKW {pkw}, PZD {link.pzd}): {spaced(data)}"
