"""The telegrams that read and write points."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.arithmetic.words import insert, with_fixed, words_in, words_of
from fieldscribe.families.frame_results import BuiltFrames, WriteMethod, refused
from fieldscribe.families.uss.parts import READ_TASK, VARIABLE, Link, asked, default_link, link_of, write_task
from fieldscribe.families.uss.remarks import code_text, titled_code, words_printed
from fieldscribe.families.uss.telegrams import Request, build
from fieldscribe.text import line
from fieldscribe.user_errors import RefusedError, UnclearError
from fieldscribe.wording import label
from fieldscribe.wording.buses import spaced

if TYPE_CHECKING:
    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.model import Device, Point
    from fieldscribe.user_errors import Options


def frames_for(device: Device, point: Point, raw: int, settings: Settings, options: Options) -> BuiltFrames:
    """The telegram that writes a raw number, or only its words. Raises RefusedError, UnclearError."""
    framing = options.framing or "uss"
    if framing == "broadcast":
        raise UnclearError("a broadcast is not built here", "take uss, pkw or pzd")
    link, keep = link_of(device, options), asked(options).keep
    unit = device.bus.usual_unit if options.unit is None else options.unit
    if point.telegram is not None:
        return _process_data(device, point, raw, (settings, link, unit, framing), keep=keep)
    if framing == "pzd":
        raise UnclearError(f"{label(point)} is a parameter, no word of process data", "take --framing uss or pkw")
    words, notes = process_words(device, link, settings)
    if framing == "pkw":
        link, words, notes = replace(link, pzd=0), (), []
    request = write_request(point, raw, unit, words, keep=keep)
    data = _built(device, point, link, request)
    task = titled_code(device.bus.functions, request.task, "task")
    return BuiltFrames((_shown(data, framing, link, 0),), (task, *notes))


def process_words(
    device: Device, link: Link, settings: Settings, own: dict[int, int] | None = None
) -> tuple[tuple[int, ...], list[str]]:
    """The process data of a telegram: known values, all other words 0; and notes on what these 0 mean."""
    words = dict(own or {})
    notes: list[str] = []
    telegrams = {telegram.name for telegram in device.telegrams if telegram.direction == "request"}
    for point in device.points:
        raw = settings.get(point.name)
        if point.telegram in telegrams and isinstance(raw, int):
            for place, word in zip(point.addresses, words_of(point, raw), strict=False):
                words.setdefault(place, insert(point, word, word) if point.bits is None else word)
    for point in device.points:
        place = point.addresses[0] if point.addresses else link.pzd
        if point.telegram in telegrams and point.fixed is not None and place < link.pzd and place not in words:
            always = wording.fixed_text(point)
            notes.append(
                f"{label(point)} goes along as 0000h ({always} is not kept, so that the device ignores it); "
                f"give --with {line(point.code or point.name)}=VALUE for another"
            )
    return tuple(words.get(place, 0) for place in range(link.pzd)), notes


def write_request(point: Point, raw: int, unit: int, words: tuple[int, ...], *, keep: bool) -> Request:
    """The request that writes a parameter; task 0 where none can carry it."""
    task = write_task(point.words, array=point.index is not None, keep=keep) if point.words in (1, 2) else 0
    value = raw & ((1 << 16 * point.words) - 1)
    return Request(unit, task, point.addresses[0], point.index or 0, point.words, value, words)


def read_request(device: Device, point: Point, link: Link, unit: int) -> bytes:
    """The telegram that reads a point; empty if there is none."""
    if point.telegram is not None:
        request = Request(unit, 0, words=(0,) * link.pzd)
    else:
        request = Request(unit, READ_TASK, point.addresses[0], point.index or 0, words=(0,) * link.pzd)
    return build(device.bus, link, request)[1]


def part_words(data: bytes, link: Link) -> str:
    """The words of the parameter part of a telegram, as manuals print them: `143A 0000 0000 0000`."""
    return words_printed(words_in(data[3 : 3 + 2 * link.sent]))


def _process_data(
    device: Device, point: Point, raw: int, how: tuple[Settings, Link, int, str], *, keep: bool
) -> BuiltFrames:
    settings, link, unit, framing = how
    if keep or framing == "pkw":
        said = "--keep" if keep else "--framing pkw"
        raise UnclearError(f"{label(point)} is a word of process data; {said} is for parameters")
    last = max(point.addresses) + 1
    if last > link.pzd:
        message = f"{label(point)} is word {last} of the process data, the link has {link.pzd}"
        raise RefusedError("bad_link", message, f"take --pzd {last}, if the device is set so")
    own = dict(zip(point.addresses, words_of(point, raw), strict=True))
    words, notes = process_words(device, link, settings, own)
    data = _built(device, point, link, Request(unit, 0, words=words))
    return BuiltFrames((_shown(data, framing, link, link.pzd),), tuple(notes))


def _built(device: Device, point: Point, link: Link, request: Request) -> bytes:
    status, data = build(device.bus, link, request)
    if status != "ok":
        raise refused(device.bus, point, status, _hint(link, status))
    return data


def _hint(link: Link, status: str) -> str:
    if status not in ("bad_task", "bad_value"):
        return ""
    length = "is variable" if link.pkw == VARIABLE else f"has {link.pkw} words"
    return f"the parameter part of this link {length}; take another --pkw, if the device is set so"


def _shown(data: bytes, framing: str, link: Link, words: int) -> str:
    if framing == "uss":
        return spaced(data)
    return part_words(data, link) if framing == "pkw" else words_printed(words_in(data[-1 - 2 * words : -1]))


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
