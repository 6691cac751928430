"""How a point of a USS device is read and written, with telegrams as examples."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import with_fixed
from fieldscribe.conversation.hexadecimal import spaced
from fieldscribe.conversation.samples import sample_raw, sample_said
from fieldscribe.families.uss.conversation.links import default_link
from fieldscribe.families.uss.conversation.remarks import code_text
from fieldscribe.families.uss.conversation.sending import part_words, read_request
from fieldscribe.families.uss.telegrams import READ_TASK, VARIABLE, Link, Request, build, write_task

if TYPE_CHECKING:
    from fieldscribe.model import Device, Point


def read_text(device: Device, point: Point) -> str:
    """How to read the point: by which task, or in which word of process data; empty if it cannot be read."""
    if not point.readable or not point.places:
        return ""
    link, unit = default_link(device.bus), device.bus.usual_unit
    data = read_request(device, point, link, unit)
    if point.telegram is not None:
        return f"{_word(point)} of every answer, for example to task 0; {_example(data, link, unit)}"
    task = code_text(device.bus.functions, READ_TASK, "task")
    return f"{task}; PKW {part_words(data, link)}; {_example(data, link, unit)}"


def write_text(device: Device, point: Point) -> str:
    """How to write the point, with a telegram for one allowed number; empty if it cannot be written."""
    if not point.writable or not point.places or point.words > 2:
        return ""
    link, unit = default_link(device.bus), device.bus.usual_unit
    raw = sample_raw(point)
    if point.telegram is not None:
        return f"{_word(point)} of every request{_sent(device, point, link, unit, raw)}"
    array = point.index is not None
    tasks = [
        code_text(device.bus.functions, write_task(point.words, array=array, keep=keep), "task")
        for keep in (False, True)
    ]
    how = f"{tasks[0]} (RAM) or {tasks[1]} (EEPROM too)" if point.keeps == "choice" else tasks[0]
    if raw is None:
        return how
    value = with_fixed(point, raw) & ((1 << 16 * point.words) - 1)
    task = write_task(point.words, array=array, keep=False)
    request = Request(unit, task, point.addresses[0], point.index or 0, point.words, value, (0,) * link.pzd)
    status, data = build(device.bus, link, request)
    if status != "ok":
        return how
    return f"{how}; {sample_said(point, raw)}; PKW {part_words(data, link)}; {_example(data, link, unit)}"


def _sent(device: Device, point: Point, link: Link, unit: int, raw: int | None) -> str:
    """An example of process data with the other words 0, if the point is in the usual length."""
    if raw is None or max(point.addresses) >= link.pzd or point.words != 1:
        return ""
    value = with_fixed(point, raw)
    words = tuple(value & 0xFFFF if place == point.addresses[0] else 0 for place in range(link.pzd))
    status, data = build(device.bus, link, Request(unit, 0, words=words))
    return f"; {sample_said(point, value)}; {_example(data, link, unit)}" if status == "ok" else ""


def _word(point: Point) -> str:
    return f"word {point.addresses[0] + 1} of the process data"


def _example(data: bytes, link: Link, unit: int) -> str:
    pkw = "variable" if link.pkw == VARIABLE else str(link.pkw)
    return f"telegram to unit {unit} (PKW {pkw}, PZD {link.pzd}): {spaced(data)}"
