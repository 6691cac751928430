"""The view of the CAN header: messages, cyclic telegrams, and frames point by point."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families.can.facts import identifier_bits, of_bus
from fieldscribe.names import upper
from fieldscribe.targets.c.frames import (
    Descriptor,
    Layouts,
    aliases_of,
    exceptions_of,
    kind_of,
    lies,
    names_of,
    names_of_exceptions,
    old_names_of,
    shares,
)
from fieldscribe.targets.c.literals import hexadecimal
from fieldscribe.targets.identifiers import Owner
from fieldscribe.text import c_comment

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device, Message, Point, Telegram
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import AliasView, DeviceView, PointView
    from fieldscribe.targets.identifiers import Named

_BYTES = 8
_IN_A_ROW = 12


NAMED_CODES: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class MessageView:
    """The layout of a message; `roles` are kinds and numbers."""

    name: str
    array: str
    comment: str
    id: str
    adds_unit: str
    roles: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class TelegramView:
    """A telegram that comes in frames of a message."""

    name: str
    constant: str
    words_name: str
    slots_name: str
    slots: int
    message: str
    per_frame: int


@dataclass(frozen=True, slots=True)
class FrameView:
    """The frames that read, write or receive one point, and the vectors that they are tested with."""

    descriptor: Descriptor
    function: str
    macro: str
    kind: str
    raw_type: str
    read: bool
    write: bool
    text: bool
    shares: bool
    lies: str


@dataclass(frozen=True, slots=True)
class GroupView:
    """The addresses that reading a group takes, each word once."""

    title: str
    array: str
    count_name: str
    count: str
    lines: list[str]


@dataclass(frozen=True, slots=True)
class BusView:
    """The CAN header of a device; the four message fields are names of arrays, or empty."""

    guard: str
    units: tuple[int, int]
    identifier_bits: int
    bitrate: int | None
    messages: tuple[MessageView, ...]
    telegrams: tuple[TelegramView, ...]
    read_request: str
    read_answer: str
    write_request: str
    write_answer: str
    exceptions: tuple[tuple[str, str, str], ...]
    groups: tuple[GroupView, ...]
    layouts: tuple[Descriptor, ...]
    parameters: tuple[FrameView, ...]
    cyclic: tuple[FrameView, ...]
    aliases: tuple[AliasView, ...]


def bus_view(device: Device, view: DeviceView, scope: HeaderScope) -> BusView:
    """The view of `<device>_can.h`."""
    views = {entry.item: entry for group in view.groups for entry, _ in group.entries if entry is not None}
    points = [point for point in device.points if point.generated and point.addresses]
    messages = {message.name: message for message in device.messages}
    cyclic = {
        telegram.name: messages[telegram.message] for telegram in device.telegrams if telegram.message in messages
    }
    reading, writing = _request_and_answer(device, writes=False), _request_and_answer(device, writes=True)
    layouts = Layouts(scope)
    asked = (reading[0] is not None, writing[0] is not None)
    parameters = [
        _parameter(point, views[point.item], layouts, asked)
        for point in points
        if point.space == "parameter" and (point.words == 1 or point.text is not None)
    ]
    heard = tuple(
        _cyclic(point, views[point.item], layouts)
        for point in points
        if point.telegram in cyclic and (point.words <= 2 or point.text is not None)
    )
    return BusView(
        guard=f"{scope.upper}_CAN_H",
        units=device.bus.units,
        identifier_bits=identifier_bits(device.bus),
        bitrate=of_bus(device.bus).bitrate,
        messages=tuple(_message(message, scope) for message in device.messages),
        telegrams=tuple(
            _telegram(telegram, cyclic[telegram.name], scope)
            for telegram in device.telegrams
            if telegram.name in cyclic and cyclic[telegram.name].words
        ),
        read_request=_array(reading[0], scope),
        read_answer=_array(reading[1], scope),
        write_request=_array(writing[0], scope),
        write_answer=_array(writing[1], scope),
        exceptions=exceptions_of(device, scope),
        groups=tuple(_groups(device, scope)),
        layouts=layouts.descriptors,
        parameters=tuple(parameter for parameter in parameters if parameter is not None),
        cyclic=heard,
        aliases=aliases_of((reachable.descriptor for reachable in (*filter(None, parameters), *heard)), device, scope),
    )


def identifiers(device: Device, bus: BusView, scope: HeaderScope) -> Iterator[Named]:
    """Every identifier of the header, with what it belongs to."""
    own = (f"{scope.prefix}_can_profile", f"{scope.prefix}_can_dialogue", f"{scope.upper}_CAN_BITRATE")
    yield Owner("target", "what the header of frames needs"), (bus.guard, *own)
    for message in bus.messages:
        yield Owner("message", message.name), (message.array,)
    for telegram in bus.telegrams:
        yield Owner("telegram", telegram.name), (telegram.constant, telegram.slots_name)
    yield from names_of_exceptions(device, bus.exceptions)
    for group in bus.groups:
        yield Owner("group", group.title), (group.array, group.count_name)
    yield from names_of(bus.layouts, (reachable.descriptor for reachable in (*bus.parameters, *bus.cyclic)))
    yield from old_names_of(bus.aliases)


def adapters(bus: BusView) -> Iterator[tuple[str, str]]:
    """The code by which points of telegrams and parameters run the conformance vectors."""
    for each in (*bus.parameters, *bus.cyclic):
        if not each.text:
            yield each.function, f"LIES({each.descriptor.name}, {each.lies})"
    for heard in bus.cyclic:
        name = heard.descriptor.name
        how = f"TEXT({name}, {heard.macro}" if heard.text else f"({name}, {heard.kind}, {heard.raw_type}"
        yield heard.function, f"RECEIVED{'_' if heard.text else ''}{how})"
    for parameter in bus.parameters:
        name = parameter.descriptor.name
        read = parameter.read and bus.read_answer
        how = (
            f"{name}, {parameter.function}, {parameter.macro}"
            if parameter.text
            else f"{name}, {parameter.kind}, {parameter.raw_type}"
        )
        if read:
            yield parameter.function, f"READ{'_TEXT' if parameter.text else ''}({how})"
        if parameter.write and bus.write_answer and (read or not parameter.shares):
            tail = "_TEXT" if parameter.text else "_SHARED" if parameter.shares else ""
            yield parameter.function, f"WRITE{tail}({how})"


def _array(message: Message | None, scope: HeaderScope) -> str:
    return "" if message is None else f"{scope.prefix}_message_{message.name}"


def _message(message: Message, scope: HeaderScope) -> MessageView:
    roles = (
        (
            f"FIELDSCRIBE_CAN_{upper(role.kind)}",
            hexadecimal(role.number, 2) if role.kind in ("constant", "xor") else f"{role.number}U",
        )
        for role in message.roles
    )
    return MessageView(
        message.name,
        _array(message, scope),
        c_comment(message.title["en"]),
        hexadecimal(message.identifier, 3),
        "true" if message.adds_unit else "false",
        tuple(roles),
    )


def _telegram(telegram: Telegram, message: Message, scope: HeaderScope) -> TelegramView:
    macro = f"{scope.upper}_TELEGRAM_{upper(telegram.name)}"
    name = f"{scope.prefix}_telegram_{telegram.name}"
    slots = -(-telegram.words // message.words)
    return TelegramView(
        telegram.name, name, f"{macro}_WORDS", f"{macro}_SLOTS", slots, _array(message, scope),
        message.words,
    )  # fmt: skip


def _request_and_answer(device: Device, *, writes: bool) -> tuple[Message | None, Message | None]:
    """The request that reads or writes a parameter, and its answer; None for what the device lacks."""
    for request in device.messages:
        kinds = {role.kind for role in request.roles}
        if request.direction == "request" and "address" in kinds and ("raw" in kinds) == writes:
            return request, next((message for message in device.messages if message.answers == request.name), None)
    return None, None


def _groups(device: Device, scope: HeaderScope) -> Iterator[GroupView]:
    for group in device.groups:
        addresses: dict[int, None] = {}
        for point in device.points:
            if point.generated and point.readable and point.group == group.name and point.space == "parameter":
                addresses.update(dict.fromkeys(point.addresses))
        if addresses:
            name = f"{scope.prefix}_{group.name}_group"
            count = f"{scope.upper}_{upper(group.name)}_GROUP_COUNT"
            numbers = list(map(hexadecimal, addresses))
            rows = [", ".join(numbers[first : first + _IN_A_ROW]) for first in range(0, len(numbers), _IN_A_ROW)]
            lines = [*(f"{row}," for row in rows[:-1]), rows[-1]]
            yield GroupView(group.name, name, count, f"{len(addresses)}U", lines)


def _parameter(point: Point, view: PointView, layouts: Layouts, asked: tuple[bool, bool]) -> FrameView | None:
    """The frames of a parameter, one for each word; None where the device has no message for it."""
    read, write = (asked[0] and point.readable), (asked[1] and point.writable)
    if not read and not write:
        return None
    text = point.text is not None
    place = f"{{{view.function}_addresses, {point.words}U}}" if text else f"{{{hexadecimal(point.addresses[0])}}}"
    parts = [*([] if text else [layouts.of(point, (0,))]), *[place] * (read + write)]
    ways = f"{'r' if read else ''}{('u' if shares(point) else 'w') if write else ''}"
    return _frame(point, view, ways, parts)


def _cyclic(point: Point, view: PointView, layouts: Layouts) -> FrameView:
    """Where a point stands in its telegram."""
    if point.text is not None:
        return _frame(point, view, "h", [f"{{{view.function}_addresses, {point.words}U}}"])
    where = f"{{{hexadecimal(point.addresses[0])}, {hexadecimal(point.addresses[-1])}}}"
    return _frame(point, view, "h", [layouts.of(point, range(point.words)), where])


def _frame(point: Point, view: PointView, ways: str, parts: list[str]) -> FrameView:
    """The frames of a point; the letters are r (read), w (write), u (update) and h (receive)."""
    value, text = f"{{{', '.join(parts)}}}", point.text is not None
    return FrameView(
        descriptor=Descriptor(
            f"fieldscribe_can_{'text_' if text else ''}{ways}", f"{view.function}_frame", value, view.item, "_frame"
        ),
        function=view.function,
        macro=view.macro,
        kind=kind_of(point),
        raw_type=view.raw_type,
        read="r" in ways,
        write=ways[-1] in "wu",
        text=text,
        shares=shares(point),
        lies=lies(point),
    )
