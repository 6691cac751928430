"""The view of the USS header: tasks, responses and errors, requests point by point, words of process data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families.uss.facts import of_bus
from fieldscribe.names import upper
from fieldscribe.targets.c.frames import (
    Descriptor,
    Layouts,
    aliases_of,
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
    from collections.abc import Iterator

    from fieldscribe.model import Bus, Code, Device, Point, Telegram
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import AliasView, DeviceView, PointView
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
class FrameView:
    """The tasks that read and write one parameter, and their vectors; `eeprom` is the task that keeps a value."""

    descriptors: tuple[Descriptor, ...]
    function: str
    kind: str
    raw_type: str
    read: bool
    ram: bool
    eeprom: bool
    shares: bool
    lies: str


@dataclass(frozen=True, slots=True)
class WordView:
    """A point in the words of process data."""

    descriptor: Descriptor
    function: str
    macro: str
    kind: str
    raw_type: str
    telegram: str
    words_name: str
    read: bool
    write: bool
    lies: str


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
    frames: tuple[FrameView, ...]
    words: tuple[WordView, ...]
    aliases: tuple[AliasView, ...]


def bus_view(device: Device, view: DeviceView, scope: HeaderScope) -> BusView:
    """The view of `<device>_uss.h`."""
    bus = device.bus
    views = {entry.item: entry for group in view.groups for entry, _ in group.entries if entry is not None}
    points = [point for point in device.points if point.generated and point.addresses and point.text is None]
    tasks = {code.number: f"{scope.upper}_TASK_{upper(code.name)}" for code in bus.functions}
    layouts = Layouts(scope)
    frames = [
        _frame(point, views[point.item], frozenset(tasks), layouts) for point in points if point.space == "parameter"
    ]
    telegrams = {telegram.name: telegram for telegram in device.telegrams}
    words = tuple(
        _word(point, views[point.item], telegrams[point.telegram or ""], layouts, scope)
        for point in points
        if point.telegram in telegrams and point.words <= 2
    )
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
        frames=tuple(frame for frame in frames if frame is not None),
        words=words,
        aliases=aliases_of(
            (
                *(descriptor for frame in frames if frame is not None for descriptor in frame.descriptors),
                *(word.descriptor for word in words),
            ),
            device,
            scope,
        ),
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
    frames = (descriptor for frame in bus.frames for descriptor in frame.descriptors)
    yield from names_of(bus.layouts, (*frames, *(word.descriptor for word in bus.words)))
    yield from old_names_of(bus.aliases)


def adapters(bus: BusView) -> Iterator[tuple[str, str]]:
    """The code by which parameters and process data run the vectors of whole exchanges."""
    for frame in bus.frames:
        yield from ((frame.function, case) for case in _cases(frame))
    for word in bus.words:
        yield from ((word.function, case) for case in _word_cases(word))


def _cases(frame: FrameView) -> Iterator[str]:
    name, what = f"{frame.function}_frame", f"{frame.kind}, {frame.raw_type}"
    yield from (f"LIES({descriptor.name}, {frame.lies})" for descriptor in frame.descriptors)
    if frame.read:
        yield f"READ({name}, {what})"
    for kind, there, to in (("write", frame.ram, name), ("store", frame.eeprom, f"{frame.function}_eeprom_frame")):
        if there and frame.shares and frame.read:
            yield f'UPDATE("{kind}", {name}.read, {to}, {what})'
        elif there and not frame.shares:
            yield f'WRITE("{kind}", {to}, {what})'


def _word_cases(word: WordView) -> Iterator[str]:
    name, what = word.descriptor.name, f"{word.kind}, {word.raw_type}"
    yield f"LIES({name}, {word.lies})"
    if word.write:
        yield f"SEND({name}, {what})"
        yield f"PUT({name}, {what}, {word.macro}, {word.words_name})"
    if word.read:
        yield f"TAKE({name}, {what}, {word.macro}, {word.words_name})"
    if word.read and not word.write:
        yield f"HEAR({name}, {what})"


def _lists(bus: Bus) -> tuple[tuple[Code, ...], ...]:
    return bus.functions, of_bus(bus).responses, bus.exceptions


def _codes(title: str, kind: str, codes: tuple[Code, ...], scope: HeaderScope) -> CodesView:
    prefix = f"{scope.upper}_{upper(kind)}"
    entries = (
        (f"{prefix}_{upper(code.name)}", str(code.number), c_string(code.name), c_comment(code.title["en"]))
        for code in codes
    )
    return CodesView(title, kind, f"{scope.prefix}_{kind}_name", tuple(entries))


def _frame(point: Point, view: PointView, tasks: frozenset[int], layouts: Layouts) -> FrameView | None:
    """The tasks of a point; None if no task of the device reaches it."""
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
    return FrameView(
        descriptors=tuple(descriptors),
        function=view.function,
        kind=kind_of(point),
        raw_type=view.raw_type,
        read=read is not None,
        ram=ram is not None,
        eeprom=eeprom is not None,
        shares=shares(point),
        lies=lies(point),
    )


def _descriptor(point: Point, view: PointView, tail: str, layout: str, ways: list[tuple[int, str]]) -> Descriptor:
    """The descriptor of a parameter: how its value lies in words, and the tasks that read and write it."""
    width = 2 if point.info.bits == 32 else 1
    places = [f"{{{task}U, {point.address}U, {point.index or 0}U, {width}U}}" for task, _ in ways]
    kind = f"fieldscribe_uss_{''.join(way for _, way in ways)}"
    return Descriptor(kind, view.function + tail, f"{{{', '.join((layout, *places))}}}", view.item, tail)


def _word(point: Point, view: PointView, telegram: Telegram, layouts: Layouts, scope: HeaderScope) -> WordView:
    position = f"{{{min(point.addresses)}U, {point.words}U}}"
    ways = f"{'h' if point.readable else ''}{'s' if point.writable else ''}"
    value = f"{{{', '.join((layouts.of(point, places_of(point)), *[position] * len(ways)))}}}"
    return WordView(
        descriptor=Descriptor(f"fieldscribe_uss_{ways}", f"{view.function}_frame", value, view.item, "_frame"),
        function=view.function,
        macro=view.macro,
        kind=kind_of(point),
        raw_type=view.raw_type,
        telegram=telegram.name,
        words_name=f"{scope.upper}_TELEGRAM_{upper(telegram.name)}_WORDS",
        read=point.readable,
        write=point.writable,
        lies=lies(point),
    )
