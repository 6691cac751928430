"""Builds the telegrams that read and write points, for `encode` and as examples for `explain`."""

from dataclasses import replace

from fieldscribe.arithmetic.codec import Settings
from fieldscribe.arithmetic.words import with_fixed, words_in, words_of
from fieldscribe.diagnostics import RefusedError, UnclearError
from fieldscribe.families.frame_results import BuiltFrames, Options, WriteMethod, refused
from fieldscribe.families.uss.remarks import code_text, titled_code, words_printed
from fieldscribe.families.uss.telegrams import (
    READ_TASK,
    VARIABLE,
    Link,
    Request,
    build,
    default_link,
    link_of,
    write_task,
)
from fieldscribe.model import Device, Point
from fieldscribe.text import line
from fieldscribe.wording import fixed_text, label
from fieldscribe.wording.numbers import spaced


def frames_for(device: Device, point: Point, raw: int, settings: Settings, options: Options) -> BuiltFrames:
    """Return the telegram that writes a raw number, or only its words. Raises RefusedError, UnclearError."""
    framing = options.framing or "uss"
    if framing == "broadcast":
        raise UnclearError("a broadcast is not built here", "take uss, pkw or pzd")
    link, keep = link_of(device, options), options.of_family.get("keep", False)
    unit = device.bus.usual_unit if options.unit is None else options.unit
    notes: list[str] = []
    if point.telegram is not None:
        if keep or framing == "pkw":
            option = "--keep" if keep else "--framing pkw"
            raise UnclearError(f"{label(point)} is a word of process data; {option} is for parameters")
        words, notes = _process_words(device, point, raw, link, settings)
        request = Request(unit, 0, words=words)
    else:
        if framing == "pzd":
            raise UnclearError(f"{label(point)} is a parameter, no word of process data", "take --framing uss or pkw")
        words, notes = process_words(device, link, settings)
        if framing == "pkw":
            link, words, notes = replace(link, pzd=0), (), []
        request = write_request(point, raw, unit, words, keep=keep)
        notes = [titled_code(device.bus.functions, request.task, "task"), *notes]
    status, data = build(device.bus, link, request)
    if status != "ok":
        raise refused(device.bus, point, status, _hint(link, status))
    texts = {"uss": spaced(data), "pkw": part_words(data, link), "pzd": words_printed(request.words)}
    return BuiltFrames((texts[framing],), tuple(notes))


def _process_words(
    device: Device, point: Point, raw: int, link: Link, settings: Settings
) -> tuple[tuple[int, ...], list[str]]:
    """Return the process data that writes a point, and notes. Raises RefusedError."""
    last = max(point.addresses) + 1
    if last > link.pzd:
        message = f"{label(point)} is word {last} of the process data, the link has {link.pzd}"
        raise RefusedError("bad_link", message, f"take --pzd {last}, if the device is set so")
    return process_words(device, link, settings, dict(zip(point.addresses, words_of(point, raw), strict=True)))


def process_words(
    device: Device, link: Link, settings: Settings, written: dict[int, int] | None = None
) -> tuple[tuple[int, ...], list[str]]:
    """Return the process data of a telegram, and notes: written words, known values, and 0 for all other words."""
    words = dict(written or {})
    notes: list[str] = []
    telegrams = {telegram.name for telegram in device.telegrams if telegram.direction == "request"}
    points = [point for point in device.points if point.telegram in telegrams]
    for point in points:
        raw = settings.get(point.name)
        if isinstance(raw, int):
            for place, word in zip(point.addresses, words_of(point, with_fixed(point, raw)), strict=False):
                words.setdefault(place, word)
    for point in points:
        place = point.addresses[0] if point.addresses else link.pzd
        if point.fixed is not None and place < link.pzd and place not in words:
            notes.append(
                f"{label(point)} goes along as 0000h ({fixed_text(point)} is not kept, so that the device ignores it); "
                f"give --with {line(point.code or point.name)}=VALUE for another"
            )
    return tuple(words.get(place, 0) for place in range(link.pzd)), notes


def write_request(point: Point, raw: int, unit: int, words: tuple[int, ...], *, keep: bool) -> Request:
    """Return the request that writes a parameter; task 0 if none can carry it."""
    task = write_task(point.words, array=point.index is not None, keep=keep) if point.words in (1, 2) else 0
    value = raw & ((1 << 16 * point.words) - 1)
    return Request(unit, task, point.addresses[0], point.index or 0, point.words, value, words)


def part_words(data: bytes, link: Link) -> str:
    """Return the words of the parameter part of a telegram, as manuals print them: `143A 0000 0000 0000`."""
    return words_printed(words_in(data[3 : 3 + 2 * link.sent]))


def _hint(link: Link, status: str) -> str:
    if status not in ("bad_task", "bad_value"):
        return ""
    length = "is variable" if link.pkw == VARIABLE else f"has {link.pkw} words"
    return f"the parameter part of this link {length}; take another --pkw, if the device is set so"


def read_text(device: Device, point: Point) -> str:
    """Return how to read the point: its task, or its word of process data; empty if it cannot be read."""
    link, unit = default_link(device.bus), device.bus.usual_unit
    if point.telegram is not None:
        return f"{_word(point)} of every answer, for example to task 0{_example(device, Request(unit, 0), link)}"
    request = Request(unit, READ_TASK, point.addresses[0], point.index or 0)
    return code_text(device.bus.functions, READ_TASK, "task") + _example(device, request, link)


def way_to_write(device: Device, point: Point) -> WriteMethod | None:
    """Return how to write the point; None if it cannot be written."""
    if point.words > 2:
        return None
    if point.telegram is not None:
        return WriteMethod(f"{_word(point)} of every request", lambda raw: _process_example(device, point, raw))
    array, tasks = point.index is not None, device.bus.functions
    ram, eeprom = (code_text(tasks, write_task(point.words, array=array, keep=keep), "task") for keep in (False, True))
    how = f"{ram} (RAM) or {eeprom} (EEPROM too)" if point.keeps == "choice" else ram
    unit, link = device.bus.usual_unit, default_link(device.bus)
    return WriteMethod(
        how, lambda raw: _example(device, write_request(point, with_fixed(point, raw), unit, (), keep=False), link)
    )


def _process_example(device: Device, point: Point, raw: int) -> str:
    """Return a telegram with the other process data 0; empty if the usual telegram is too short for the point."""
    link = default_link(device.bus)
    if max(point.addresses) >= link.pzd or point.words != 1:
        return ""
    value = with_fixed(point, raw) & 0xFFFF
    words = tuple(value if place == point.addresses[0] else 0 for place in range(link.pzd))
    return _example(device, Request(device.bus.usual_unit, 0, words=words), link)


def _word(point: Point) -> str:
    return f"word {point.addresses[0] + 1} of the process data"


def _example(device: Device, request: Request, link: Link) -> str:
    """Return the telegram of a request, and its parameter part; empty if it cannot be sent over the link."""
    request = replace(request, words=request.words or (0,) * link.pzd)
    status, data = build(device.bus, link, request)
    pkw = "variable" if link.pkw == VARIABLE else str(link.pkw)
    telegram = f"telegram to unit {request.unit} (PKW {pkw}, PZD {link.pzd}): {spaced(data)}"
    return "" if status != "ok" else f"; PKW {part_words(data, link)}; {telegram}" if request.task else f"; {telegram}"
