"""The view of the Modbus header: the device's profile, reads block by block, requests point by point, commands."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.names import upper
from fieldscribe.targets.c.literals import hexadecimal, raw_type, unsigned
from fieldscribe.targets.c.places import fixed_number, fixes
from fieldscribe.text import c_comment

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Block, Command, Device, Place, Point
    from fieldscribe.targets.c.scope import Scope
    from fieldscribe.targets.c.views import Define, DeviceView, PointView

_MOST = {1: 2000, 2: 2000, 3: 125, 4: 125, 5: 1, 6: 1, 8: 1, 15: 1968, 16: 123}
"""The functions that the frames know, with the protocol's own limits."""

_BROADCAST = (5, 6, 15, 16)
"""The functions that may be sent to all units, unless the manual says otherwise."""

_READS = {"coil": 1, "discrete": 2, "holding": 3, "input": 4}


@dataclass(frozen=True, slots=True)
class RequestView:
    """The requests of one point: `read` and `write` are functions' numbers or empty.

    `number` is stored, in one word or in several.
    """

    function: str
    macro: str
    read: str
    write: str
    write_address: str
    raw_type: str
    count: int
    number: str
    single: bool
    text: bool
    shares: bool
    raw_of_words: str


@dataclass(frozen=True, slots=True)
class BlocksView:
    """The reads that bring a group's points."""

    name: str
    array: str
    count_name: str
    rows: tuple[tuple[str, str, str], ...]


@dataclass(frozen=True, slots=True)
class CommandView:
    """A named constant write."""

    function: str
    comment: str
    defines: tuple[Define, ...]
    code: str
    address: str
    value: str


@dataclass(frozen=True, slots=True)
class BusView:
    """The Modbus header of a device."""

    guard: str
    functions: tuple[tuple[str, str, str, str], ...]
    units: tuple[int, int]
    broadcast: str
    pads: str
    blocks: tuple[BlocksView, ...]
    requests: tuple[RequestView, ...]
    commands: tuple[CommandView, ...]
    exceptions: tuple[tuple[str, str, str], ...]


def modbus_view(device: Device, view: DeviceView, scope: Scope) -> BusView:
    """The view of `<device>_modbus.h`."""
    bus = device.bus
    functions = tuple(
        (
            hexadecimal(code.number, 2),
            f"{min(code.most or _MOST[code.number], _MOST[code.number])}U",
            "true" if code.number in _BROADCAST and code.broadcast is not False else "false",
            c_comment(code.name),
        )
        for code in bus.functions
        if code.number in _MOST
    )
    numbers = frozenset(code.number for code in bus.functions)
    views = {entry.item: entry for group in view.groups for entry, _ in group.entries if entry is not None}
    requests = (
        _request(point, views[point.item], numbers, scope)
        for point in device.points
        if point.generated and point.places
    )
    return BusView(
        guard=f"{scope.upper}_MODBUS_H",
        functions=functions,
        units=bus.units,
        broadcast="FIELDSCRIBE_MODBUS_NO_BROADCAST" if bus.broadcast is None else f"{bus.broadcast}U",
        pads="true" if bus.pad_coil_bytes == "even" else "false",
        blocks=tuple(_blocks(group, blocks, scope) for group, blocks in device.blocks.items() if blocks),
        requests=tuple(request for request in requests if request is not None),
        commands=tuple(_command(command, scope) for command in device.commands),
        exceptions=exceptions_of(device, scope),
    )


def exceptions_of(device: Device, scope: Scope) -> tuple[tuple[str, str, str], ...]:
    """The codes with which a device refuses: enumerator, number and comment."""
    return tuple(
        (f"{scope.upper}_EXCEPTION_{upper(code.name)}", hexadecimal(code.number, 2), c_comment(code.title["en"]))
        for code in device.bus.exceptions
    )


def identifiers(bus: BusView, view: DeviceView) -> Iterator[tuple[str, str]]:
    """Every identifier of the header, with what it belongs to."""
    for blocks in bus.blocks:
        yield from ((name, f"the blocks of {blocks.name}") for name in (blocks.array, blocks.count_name))
    for command in bus.commands:
        names = (command.function, *(name for name, _ in command.defines))
        yield from ((name, f"command {command.function}") for name in names)
    yield from ((name, f"exception {title}") for name, _, title in bus.exceptions)
    for request in bus.requests:
        item = request.function[len(view.prefix) + 1 :]
        yield from ((f"{request.function}{tail}", item) for tail in ("_read_request", "_write_request"))


def adapters(bus: BusView) -> Iterator[tuple[str, str]]:
    """How points answer vectors of whole exchanges."""
    for one in bus.requests:
        if one.read:
            how = f"READ_TEXT({one.function}" if one.text else f"READ({one.function}, {one.raw_of_words}"
            yield one.function, f"{how})"
        if one.write:
            how = f"WRITE_TEXT({one.function}" if one.text else f"WRITE({one.function}, {one.raw_type}"
            yield one.function, f"{how}, {one.count}U)"
        if one.read and one.shares:
            yield one.function, f"UPDATE({one.function}, {one.raw_type}, {one.write_address})"


def _request(point: Point, view: PointView, functions: frozenset[int], scope: Scope) -> RequestView | None:
    """None for a point that no function of the device reaches, or that needs its word read first to be written."""
    place = point.places[0]
    read = (place.function or _READS.get(place.space, 0)) if point.readable else 0
    target = next((one for one in point.places if one.purpose == "write"), place)
    write = _writing(point, target, functions) if point.writable and point.bits is None else 0
    read = read if read in functions else 0
    if not read and not write:
        return None
    moved = target is not place and target.addresses
    return RequestView(
        function=view.function,
        macro=view.macro,
        read=hexadecimal(read, 2) if read else "",
        write=hexadecimal(write, 2) if write else "",
        write_address=f"{view.macro}_WRITE_ADDRESS" if moved else f"{view.macro}_ADDRESS",
        raw_type=view.raw_type,
        count=point.words,
        number=_number(point, view, scope),
        single=view.words is None,
        text=point.text is not None,
        shares=point.bits is not None,
        raw_of_words=_raw_of_words(point, view),
    )


def _raw_of_words(point: Point, view: PointView) -> str:
    """The raw number that the words of a reply are."""
    if point.bits is not None:
        return f"{view.function}_extract(words[0])"
    if view.words is not None:
        return f"{view.function}_from_words(words)"
    return "words[0] != 0U" if raw_type(point) == "bool" else f"({view.raw_type})words[0]"


def _number(point: Point, view: PointView, scope: Scope) -> str:
    """What is stored for a raw number, with its constant bits: a word made of masks may lack them."""
    if fixes(point):
        return fixed_number(point, view.macro, scope, "raw")
    return "raw ? 1U : 0U" if raw_type(point) == "bool" else "raw"


def _writing(point: Point, place: Place, functions: frozenset[int]) -> int:
    """The function that writes a point: the manual's, else the one for a single item, else the one for several."""
    if place.function in (5, 6, 15, 16) and place is not point.places[0]:
        return place.function
    if place.space == "coil":
        wanted = (5, 15)
    elif place.space == "holding":
        wanted = (6, 16) if point.words == 1 else (16, 16)
    else:
        return 0
    return next((number for number in wanted if number in functions), 0)


def _blocks(group: str, blocks: tuple[Block, ...], scope: Scope) -> BlocksView:
    rows = tuple((hexadecimal(one.function, 2), hexadecimal(one.address), unsigned(one.count)) for one in blocks)
    name = f"{scope.upper}_{upper(group)}_BLOCKS_COUNT"
    return BlocksView(group, f"{scope.prefix}_{group}_blocks", name, rows)


def _command(command: Command, scope: Scope) -> CommandView:
    macro = f"{scope.upper}_COMMAND_{upper(command.name)}"
    value = "1U" if command.value is None else unsigned(command.value)
    comment = c_comment(command.title["en"]) + (": any value does" if command.value is None else "")
    if command.wears is not None:
        comment += f"; the memory stands {command.wears} writes"
    defines = ((f"{macro}_ADDRESS", hexadecimal(command.address)), (f"{macro}_VALUE", value))
    function = f"{scope.prefix}_command_{command.name}_request"
    code = hexadecimal(command.function, 2)
    return CommandView(function, f"{comment}.", defines, code, f"{macro}_ADDRESS", f"{macro}_VALUE")
