"""The view of the CAN header: messages, cyclic telegrams, and frames point by point."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families.can import identifier_bits, of_bus
from fieldscribe.names import upper
from fieldscribe.targets.c.frames import (
    Descriptor,
    Frame,
    Frames,
    Layouts,
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
    from collections.abc import Iterable, Iterator, Sequence

    from fieldscribe.model import Device, Message, Point, Telegram
    from fieldscribe.targets.c.kinds import Placed
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import AliasView, PointView
    from fieldscribe.targets.identifiers import Named

_BYTES = 8


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
class GroupView:
    """The addresses that reading a group takes, each word once."""

    title: str
    array: str
    count_name: str
    count: str
    rows: list[tuple[str, str]]


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
    parameters: Frames
    cyclic: Frames
    aliases: tuple[AliasView, ...]


def bus_view(device: Device, placed: Sequence[Placed], scope: HeaderScope) -> BusView:
    """The view of `<device>_can.h`."""
    reached = [each for each in placed if each.point.addresses]
    messages = {message.name: message for message in device.messages}
    cyclic = {
        telegram.name: messages[telegram.message] for telegram in device.telegrams if telegram.message in messages
    }
    reading, writing = _request_and_answer(device, writes=False), _request_and_answer(device, writes=True)
    layouts = Layouts(scope)
    asked, answered = ([message is not None for message in messages] for messages in zip(reading, writing, strict=True))
    parameters = Frames(
        [each for each in reached if each.point.space == "parameter" and _fits(each.point, 1)],
        lambda point, view: _parameter(point, view, layouts, asked, answered),
    )
    heard = Frames(
        [each for each in reached if each.point.telegram in cyclic and _fits(each.point, 2)],
        lambda point, view: _cyclic(point, view, layouts),
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
        parameters=parameters,
        cyclic=heard,
        aliases=(*parameters.aliases(scope), *heard.aliases(scope)),
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
    yield from names_of(bus.layouts, [bus.parameters, bus.cyclic])
    yield from old_names_of(bus.aliases)


def sections(bus: BusView) -> dict[str, Frames]:
    """Parameters, and points of telegrams."""
    return {"parameters": bus.parameters, "cyclic": bus.cyclic}


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
        first_with: dict[int, str] = {}
        for point in device.points:
            if point.generated and point.readable and point.group == group.name and point.space == "parameter":
                for address in point.addresses:
                    first_with.setdefault(address, point.item)
        if first_with:
            name = f"{scope.prefix}_{group.name}_group"
            count = f"{scope.upper}_{upper(group.name)}_GROUP_COUNT"
            rows = [(hexadecimal(address), item) for address, item in first_with.items()]
            yield GroupView(group.name, name, count, f"{len(rows)}U", rows)


def _fits(point: Point, words: int) -> bool:
    """Whether a point is a text, or has at most so many words."""
    return point.text is not None or point.words <= words


def _parameter(
    point: Point, view: PointView, layouts: Layouts, asked: Sequence[bool], answered: Sequence[bool]
) -> Frame | None:
    """The frames of a parameter, one for each word; None where the device has no message for it."""
    read, write = (asked[0] and point.readable), (asked[1] and point.writable)
    if not read and not write:
        return None
    text = point.text is not None
    place = f"{{{view.function}_addresses, {point.words}U}}" if text else f"{{{view.words.start}}}"
    parts = [*([] if text else [layouts.of(point, (0,))]), *[place] * (read + write)]
    ways = f"{'r' if read else ''}{('u' if shares(point) else 'w') if write else ''}"
    cases = _exchanges(point, view, read and answered[0], write and answered[1])
    return _frame(point, view, ways, parts, cases)


def _exchanges(point: Point, view: PointView, reads: bool, writes: bool) -> Iterator[str]:
    """The macros by which a parameter runs the vectors of whole exchanges."""
    text = point.text is not None
    name = f"{view.function}_frame"
    what = f"{name}, " + (f"{view.function}, {view.macro}" if text else f"{kind_of(point)}, {view.raw_type}")
    if reads:
        yield f"READ{'_TEXT' if text else ''}({what})"
    if writes and (reads or not shares(point)):
        yield f"WRITE{'_TEXT' if text else '_SHARED' if shares(point) else ''}({what})"


def _cyclic(point: Point, view: PointView, layouts: Layouts) -> Frame:
    """Where a point stands in its telegram."""
    name = f"{view.function}_frame"
    if point.text is not None:
        parts, case = [f"{{{view.function}_addresses, {point.words}U}}"], f"RECEIVED_TEXT({name}, {view.macro})"
    else:
        parts = [layouts.of(point, range(point.words)), f"{{{view.words.start}, {view.words.end}}}"]
        case = f"RECEIVED({name}, {kind_of(point)}, {view.raw_type})"
    return _frame(point, view, "h", parts, [case])


def _frame(point: Point, view: PointView, ways: str, parts: list[str], cases: Iterable[str]) -> Frame:
    """The frames of a point; the letters are r (read), w (write), u (update) and h (receive)."""
    name, text = f"{view.function}_frame", point.text is not None
    kind = f"fieldscribe_can_{'text_' if text else ''}{ways}"
    lying = [] if text else [f"LIES({name}, {lies(point)})"]
    return Frame((Descriptor(kind, name, f"{{{', '.join(parts)}}}", "_frame"),), (*lying, *cases))
