"""The view of the CAN header: messages, cyclic telegrams, and frames point by point."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.names import upper
from fieldscribe.targets.c.literals import hexadecimal, raw_type
from fieldscribe.targets.c.modbus import exceptions_of
from fieldscribe.targets.c.places import fixed_number, fixes
from fieldscribe.targets.identifiers import Owner
from fieldscribe.text import c_comment

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device, Message, Point, Telegram
    from fieldscribe.targets.c.scope import Scope
    from fieldscribe.targets.c.views import DeviceView, PointView

_BYTES = 8


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
    listen: str
    message: str
    per_frame: int


@dataclass(frozen=True, slots=True)
class ParameterView:
    """The frames of one parameter: `raw_of_word` and `word_of_raw` convert, `shares` its word with others."""

    function: str
    macro: str
    raw_type: str
    read: bool
    write: bool
    text: bool
    shares: bool
    raw_of_word: str
    word_of_raw: str


@dataclass(frozen=True, slots=True)
class CyclicView:
    """A point of a telegram: `words` are their positions, the high one first."""

    function: str
    raw_type: str
    macro: str
    words: tuple[str, ...]
    text: bool
    raw_of_words: str
    store: tuple[int, int] | None


@dataclass(frozen=True, slots=True)
class GroupView:
    """The parameters that a group reads, each word once."""

    title: str
    array: str
    count_name: str
    addresses: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class BusView:
    """The CAN header of a device; the four messages are names of arrays, or empty."""

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
    parameters: tuple[ParameterView, ...]
    cyclic: tuple[CyclicView, ...]


def can_view(device: Device, view: DeviceView, scope: Scope) -> BusView:
    """The view of `<device>_can.h`."""
    views = {entry.item: entry for group in view.groups for entry, _ in group.entries if entry is not None}
    points = [point for point in device.points if point.generated and point.places]
    messages = {one.name: one for one in device.messages}
    cyclic = {one.name: messages[one.message] for one in device.telegrams if one.message in messages}
    reading, writing = _dialogue(device, writes=False), _dialogue(device, writes=True)
    return BusView(
        guard=f"{scope.upper}_CAN_H",
        units=device.bus.units,
        identifier_bits=device.bus.identifier_bits or 11,
        bitrate=device.bus.bitrate,
        messages=tuple(_message(one, scope) for one in device.messages),
        telegrams=tuple(
            _telegram(one, cyclic[one.name], scope)
            for one in device.telegrams
            if one.name in cyclic and cyclic[one.name].words
        ),
        read_request=_array(reading[0], scope),
        read_answer=_array(reading[1], scope),
        write_request=_array(writing[0], scope),
        write_answer=_array(writing[1], scope),
        exceptions=exceptions_of(device, scope),
        groups=tuple(_groups(device, scope)),
        parameters=tuple(
            _parameter(point, views[point.item], scope)
            for point in points
            if point.space == "parameter" and (point.words == 1 or point.text is not None)
        ),
        cyclic=tuple(
            _cyclic(point, views[point.item])
            for point in points
            if point.telegram in cyclic and (point.words <= 2 or point.text is not None)
        ),
    )


def identifiers(bus: BusView, view: DeviceView) -> Iterator[tuple[str, Owner]]:
    """Every identifier of the header, with what it belongs to."""
    yield f"{view.prefix}_can_profile", Owner("target")
    yield f"{view.upper}_CAN_BITRATE", Owner("target")
    for message in bus.messages:
        yield message.array, Owner("message", message.name)
    for telegram in bus.telegrams:
        owner = Owner("telegram", telegram.name)
        yield from ((name, owner) for name in (telegram.constant, telegram.listen, telegram.slots_name))
    yield from ((name, Owner("code", name)) for name, _, _ in bus.exceptions)
    for group in bus.groups:
        yield from ((name, Owner("group", group.title)) for name in (group.array, group.count_name))
    for point in bus.parameters:
        item = point.function[len(view.prefix) + 1 :]
        tails = ["_read_request", "_read_answer"] if point.read else []
        tails += ["_read_word"] if point.read and point.shares else []
        tails += ["_write_request", "_write_answer"] if point.write else []
        yield from ((point.function + tail, Owner("point", item, f"function {tail}")) for tail in tails)
    for one in bus.cyclic:
        yield f"{one.function}_received", Owner("point", one.function[len(view.prefix) + 1 :], "function")


def adapters(bus: BusView) -> Iterator[tuple[str, str]]:
    """How points of telegrams, and parameters, answer conformance vectors."""
    for heard in bus.cyclic:
        if heard.text:
            yield heard.function, f"RECEIVED_TEXT({heard.function}, {heard.macro})"
        else:
            yield heard.function, f"RECEIVED({heard.function}, {heard.raw_type})"
    for one in bus.parameters:
        read = one.read and bus.read_request and bus.read_answer
        how = f"{one.function}, {one.macro}" if one.text else f"{one.function}, {one.raw_type}"
        if read:
            yield one.function, f"READ{'_TEXT' if one.text else ''}({how})"
        if one.write and bus.write_request and bus.write_answer and (read or not one.shares):
            tail = "_TEXT" if one.text else "_SHARED" if one.shares else ""
            yield one.function, f"WRITE{tail}({how})"


def _array(message: Message | None, scope: Scope) -> str:
    return "" if message is None else f"{scope.prefix}_message_{message.name}"


def _message(message: Message, scope: Scope) -> MessageView:
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
        hexadecimal(message.can_id, 3),
        "true" if message.adds_unit else "false",
        tuple(roles),
    )


def _telegram(telegram: Telegram, message: Message, scope: Scope) -> TelegramView:
    macro = f"{scope.upper}_TELEGRAM_{upper(telegram.name)}"
    name = f"{scope.prefix}_telegram_{telegram.name}"
    slots = -(-telegram.words // message.words)
    return TelegramView(
        telegram.name, name, f"{macro}_WORDS", f"{macro}_SLOTS", slots, f"{name}_listen", _array(message, scope),
        message.words,
    )  # fmt: skip


def _dialogue(device: Device, *, writes: bool) -> tuple[Message | None, Message | None]:
    """The message that reads (or writes) one parameter, and the one that answers it."""
    for request in device.messages:
        kinds = {role.kind for role in request.roles}
        if request.direction == "request" and "address" in kinds and ("raw" in kinds) == writes:
            return request, next((one for one in device.messages if one.answers == request.name), None)
    return None, None


def _groups(device: Device, scope: Scope) -> Iterator[GroupView]:
    for group in device.groups:
        addresses: dict[int, None] = {}
        for point in device.points:
            if point.generated and point.readable and point.group == group.name and point.space == "parameter":
                addresses.update(dict.fromkeys(point.addresses))
        if addresses:
            name = f"{scope.prefix}_{group.name}_group"
            count = f"{scope.upper}_{upper(group.name)}_GROUP_COUNT"
            yield GroupView(group.name, name, count, tuple(hexadecimal(address) for address in addresses))


def _parameter(point: Point, view: PointView, scope: Scope) -> ParameterView:
    """The frames of a point whose every word travels in a message of its own."""
    return ParameterView(
        view.function,
        view.macro,
        view.raw_type,
        point.readable,
        point.writable,
        point.text is not None,
        point.bits is not None,
        raw_of_word(point, view, "word"),
        word_of_raw(point, view, "word", scope),
    )


def raw_of_word(point: Point, view: PointView, word: str) -> str:
    """The raw number of a point that lies in one word."""
    if point.bits is not None:
        return f"{view.function}_extract({word})"
    if view.words is not None:
        return f"{view.function}_from_words(&{word})"
    if raw_type(point) == "bool":
        return f"{word} != 0U"
    return word if point.info.bits == 16 else f"({view.raw_type})({word} & 0xFFU)"


def word_of_raw(point: Point, view: PointView, word: str, scope: Scope) -> str:
    """The one word of a raw number, with its constant bits: a word made of masks may lack them.

    `word` is what stands there now, for a point that shares it.
    """
    if point.bits is not None:
        return f"{view.function}_insert({word}, raw)"
    if fixes(point):
        number = fixed_number(point, view.macro, scope, "raw")
        return f"(uint16_t)({number})" if point.info.signed else number
    if raw_type(point) == "bool":
        return "raw ? 1U : 0U"
    return "(uint16_t)raw" if point.info.signed else "raw"


def _cyclic(point: Point, view: PointView) -> CyclicView:
    first = min(point.addresses)
    words = tuple(f"{view.macro}_ADDRESS{f' + {one - first}U' if one > first else ''}" for one in point.addresses)
    double = len(words) == 2 and point.text is None
    order = sorted(point.addresses)
    return CyclicView(
        view.function,
        view.raw_type,
        view.macro,
        words,
        point.text is not None,
        f"{view.function}_from_words(words)" if double else raw_of_word(point, view, "word"),
        (order.index(point.addresses[0]), order.index(point.addresses[1])) if double else None,
    )
