"""The view of the USS header: tasks, responses and errors, requests point by point, words of process data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families.uss import of_bus
from fieldscribe.names import upper
from fieldscribe.targets.c.frames import (
    Descriptor,
    Frame,
    Frames,
    Layouts,
    kind_of,
    lies,
    names_of,
    old_names_of,
    places_of,
    shares,
)
from fieldscribe.targets.c.literals import hexadecimal
from fieldscribe.targets.identifiers import Owner
from fieldscribe.text import c_comment, c_string

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from fieldscribe.model import Bus, Code, Device, Point, Telegram
    from fieldscribe.targets.c.kinds import Placed
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import AliasView, PointView
    from fieldscribe.targets.identifiers import Named

_READ = (1, 6)
_RAM = {(1, False): 2, (2, False): 3, (1, True): 7, (2, True): 8}
_EEPROM = {(1, False): 14, (2, False): 13, (1, True): 12, (2, True): 11}
"""The tasks that write, by the words of the value and whether it is an element of an array."""

_TITLES = ("Tasks", "Responses", "Errors")
_KINDS = {"task": "function", "response": "response", "error": "exception"}
"""The names of the lists of codes: in the header, and in the description."""


NAMED_CODES: tuple[str, ...] = ("task", "response", "error")


@dataclass(frozen=True, slots=True)
class CodesView:
    """A list of codes: enumerators with comments, and the function that returns the name of a code."""

    title: str
    kind: str
    function: str
    entries: tuple[tuple[str, str, str, str], ...]


@dataclass(frozen=True, slots=True)
class BusView:
    """The USS header of a device."""

    guard: str
    units: tuple[int, int]
    broadcast: str
    pkw: tuple[int, ...]
    pzd: tuple[int, int]
    tasks: tuple[tuple[str, str, str], ...]
    codes: tuple[CodesView, ...]
    layouts: tuple[Descriptor, ...]
    frames: Frames
    """The tasks that read and write parameters."""
    words: Frames
    """The points in the words of process data."""
    aliases: tuple[AliasView, ...]


def bus_view(device: Device, placed: Sequence[Placed], scope: HeaderScope) -> BusView:
    """The view of `<device>_uss.h`."""
    bus = device.bus
    tasks = {code.number: f"{scope.upper}_TASK_{upper(code.name)}" for code in bus.functions}
    telegrams = {telegram.name: telegram for telegram in device.telegrams}
    numbers = [each for each in placed if each.point.addresses and each.point.text is None]
    parameters = [each for each in numbers if each.point.space == "parameter"]
    heard = [each for each in numbers if each.point.telegram in telegrams and each.point.words <= 2]
    layouts = Layouts(scope)
    frames = Frames(parameters, lambda point, view: _frame(point, view, frozenset(tasks), layouts))
    words = Frames(heard, lambda point, view: _word(point, view, telegrams[point.telegram or ""], layouts, scope))
    return BusView(
        guard=f"{scope.upper}_USS_H",
        units=bus.units,
        broadcast="FIELDSCRIBE_USS_NO_BROADCAST" if bus.broadcast is None else hexadecimal(bus.broadcast, 2),
        pkw=of_bus(bus).pkw,
        pzd=of_bus(bus).pzd,
        tasks=tuple(
            (
                tasks[code.number],
                hexadecimal(sum(1 << answer for answer in set(code.answers))),
                c_comment(code.title["en"]),
            )
            for code in bus.functions
        ),
        codes=tuple(
            _codes(title, kind, codes, scope)
            for title, kind, codes in zip(_TITLES, _KINDS, _lists(bus), strict=True)
            if codes
        ),
        layouts=layouts.descriptors,
        frames=frames,
        words=words,
        aliases=(*frames.aliases(scope), *words.aliases(scope)),
    )


def identifiers(device: Device, bus: BusView, scope: HeaderScope) -> Iterator[Named]:
    """Every identifier of the header, with what it belongs to."""
    own = Owner("target", "what the header of frames needs")
    yield own, [bus.guard, *(f"{scope.prefix}_{name}" for name in ("uss_tasks", "uss_pkw", "uss_profile"))]
    yield own, [codes.function for codes in bus.codes]
    lists = dict(zip(_KINDS, _lists(device.bus), strict=True))
    for codes_view in bus.codes:
        for code, (name, _, _, _) in zip(lists[codes_view.kind], codes_view.entries, strict=True):
            yield Owner(_KINDS[codes_view.kind], code.name), (name,)
    yield from names_of(bus.layouts, [bus.frames, bus.words])
    yield from old_names_of(bus.aliases)


def sections(bus: BusView) -> dict[str, Frames]:
    """Parameters and process data."""
    return {"frames": bus.frames, "words": bus.words}


def _lists(bus: Bus) -> tuple[tuple[Code, ...], ...]:
    return bus.functions, of_bus(bus).responses, bus.exceptions


def _codes(title: str, kind: str, codes: tuple[Code, ...], scope: HeaderScope) -> CodesView:
    prefix = f"{scope.upper}_{upper(kind)}"
    entries = (
        (f"{prefix}_{upper(code.name)}", str(code.number), c_string(code.name), c_comment(code.title["en"]))
        for code in codes
    )
    return CodesView(title, kind, f"{scope.prefix}_{kind}_name", tuple(entries))


def _frame(point: Point, view: PointView, tasks: frozenset[int], layouts: Layouts) -> Frame | None:
    """The tasks of a parameter; None if no task of the device reaches it."""
    width = 2 if point.info.bits == 32 else 1
    if point.info.bits > 32:
        return None
    key = (width, point.index is not None)
    read = next((task for task in _READ if task in tasks), None) if point.readable else None
    ram = _RAM[key] if point.writable and _RAM[key] in tasks else None
    eeprom = _EEPROM[key] if point.writable and point.keeps != "no" and _EEPROM[key] in tasks else None
    if read is None and ram is None and eeprom is None:
        return None
    layout = layouts.of(point, range(width))
    changes = "u" if shares(point) else "w"
    ways = [(task, way) for task, way in ((read, "r"), (ram, changes)) if task is not None]
    descriptors = [_descriptor(point, view, "_frame", layout, ways)] if ways else []
    if eeprom is not None:
        descriptors.append(_descriptor(point, view, "_eeprom_frame", layout, [(eeprom, changes)]))
    writes = {"write": (ram, "_frame"), "store": (eeprom, "_eeprom_frame")}
    tails = {kind: tail for kind, (task, tail) in writes.items() if task is not None}
    lying = [f"LIES({descriptor.name}, {lies(point)})" for descriptor in descriptors]
    return Frame(tuple(descriptors), (*lying, *_cases(point, view, read is not None, tails)))


def _cases(point: Point, view: PointView, reads: bool, writes: Mapping[str, str]) -> Iterator[str]:
    """The macros by which a parameter runs the vectors of whole exchanges."""
    name, what = f"{view.function}_frame", f"{kind_of(point)}, {view.raw_type}"
    if reads:
        yield f"READ({name}, {what})"
    for kind, tail in writes.items():
        if shares(point) and reads:
            yield f'UPDATE("{kind}", {name}.read, {view.function}{tail}, {what})'
        elif not shares(point):
            yield f'WRITE("{kind}", {view.function}{tail}, {what})'


def _descriptor(point: Point, view: PointView, tail: str, layout: str, ways: list[tuple[int, str]]) -> Descriptor:
    """The descriptor of a parameter: how its value lies in words, and the tasks that read and write it."""
    width = 2 if point.info.bits == 32 else 1
    places = [f"{{{task}U, {view.words.number}U, {point.index or 0}U, {width}U}}" for task, _ in ways]
    kind = f"fieldscribe_uss_{''.join(way for _, way in ways)}"
    return Descriptor(kind, view.function + tail, f"{{{', '.join((layout, *places))}}}", tail)


def _word(point: Point, view: PointView, telegram: Telegram, layouts: Layouts, scope: HeaderScope) -> Frame:
    """The place of a point in the words of process data."""
    position = f"{{{view.words.number}U, {point.words}U}}"
    ways = f"{'h' if point.readable else ''}{'s' if point.writable else ''}"
    value = f"{{{', '.join((layouts.of(point, places_of(point)), *[position] * len(ways)))}}}"
    descriptor = Descriptor(f"fieldscribe_uss_{ways}", f"{view.function}_frame", value, "_frame")
    words = f"{view.macro}, {scope.upper}_TELEGRAM_{upper(telegram.name)}_WORDS"
    return Frame((descriptor,), tuple(_word_cases(point, view, words)))


def _word_cases(point: Point, view: PointView, words: str) -> Iterator[str]:
    """The macros by which process data runs the vectors of telegrams."""
    name, what = f"{view.function}_frame", f"{kind_of(point)}, {view.raw_type}"
    yield f"LIES({name}, {lies(point)})"
    if point.writable:
        yield f"SEND({name}, {what})"
        yield f"PUT({name}, {what}, {words})"
    if point.readable:
        yield f"TAKE({name}, {what}, {words})"
    if point.readable and not point.writable:
        yield f"HEAR({name}, {what})"
