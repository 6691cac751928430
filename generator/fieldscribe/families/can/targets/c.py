"""The view of the CAN header: messages, cyclic telegrams, and frames point by point."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families.can import identifier_bits, of_bus
from fieldscribe.families.can.frames import request_and_answer
from fieldscribe.names import upper
from fieldscribe.targets.c.frames import Descriptor, Frame, Frames, Layouts, exceptions_of, lies, shares
from fieldscribe.targets.c.literals import hexadecimal, wire_kind
from fieldscribe.targets.identifiers import Owner
from fieldscribe.text import c_comment

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from fieldscribe.model import Device, Message, Point, Role, Telegram
    from fieldscribe.targets.c.point_templates import GeneratedPoint
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import AliasView, PointView
    from fieldscribe.targets.identifiers import Named

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
    """The CAN header of a device.

    `exchanges` are the arrays of the messages that read, answer that, write, answer that; empty for a missing one.
    """

    guard: str
    units: tuple[int, int]
    identifier_bits: int
    bitrate: int | None
    messages: tuple[MessageView, ...]
    telegrams: tuple[TelegramView, ...]
    exchanges: tuple[str, ...]
    exceptions: tuple[tuple[str, str, str], ...]
    groups: tuple[GroupView, ...]
    layouts: tuple[Descriptor, ...]
    parameters: Frames
    cyclic: Frames
    aliases: tuple[AliasView, ...]


def bus_view(device: Device, placed: Sequence[GeneratedPoint], scope: HeaderScope) -> BusView:
    """Return the view of `<device>_can.h`."""
    messages = {message.name: message for message in device.messages}
    carriers = {
        telegram.name: messages[telegram.message] for telegram in device.telegrams if telegram.message in messages
    }
    exchanges = [request_and_answer(device.messages, writes=writes) for writes in (False, True)]
    arrays = tuple(_array(message, scope) for exchange in exchanges for message in exchange)
    reached = [each for each in placed if each.point.addresses]
    layouts = Layouts(scope)
    parameters = Frames(
        [each for each in reached if each.point.space == "parameter" and _fits(each.point, 1)],
        lambda point, view: _parameter(point, view, layouts, arrays),
    )
    cyclic = Frames(
        [each for each in reached if each.point.telegram in carriers and _fits(each.point, 2)],
        lambda point, view: _cyclic(point, view, layouts),
    )
    telegrams = [(telegram, carriers[telegram.name]) for telegram in device.telegrams if telegram.name in carriers]
    return BusView(
        guard=f"{scope.upper}_CAN_H",
        units=device.bus.units,
        identifier_bits=identifier_bits(device.bus),
        bitrate=of_bus(device.bus).bitrate,
        messages=tuple(_message(message, scope) for message in device.messages),
        telegrams=tuple(_telegram(telegram, message, scope) for telegram, message in telegrams if message.words),
        exchanges=arrays,
        exceptions=exceptions_of(device, scope),
        groups=tuple(_groups(device, scope)),
        layouts=layouts.descriptors,
        parameters=parameters,
        cyclic=cyclic,
        aliases=(*parameters.aliases(scope), *cyclic.aliases(scope)),
    )


def identifiers(device: Device, bus: BusView, scope: HeaderScope) -> Iterator[Named]:
    """Yield the identifiers of the header that only this family has, with their owners."""
    fixed = (f"{scope.prefix}_can_profile", f"{scope.prefix}_can_dialogue", f"{scope.upper}_CAN_BITRATE")
    yield Owner("target", "what the header of frames needs"), (bus.guard, *fixed)
    for message in bus.messages:
        yield Owner("message", message.name), (message.array,)
    for telegram in bus.telegrams:
        yield Owner("telegram", telegram.name), (telegram.constant, telegram.slots_name)
    for group in bus.groups:
        yield Owner("group", group.title), (group.array, group.count_name)


def sections(bus: BusView) -> dict[str, Frames]:
    """Return parameters, and points of telegrams."""
    return {"parameters": bus.parameters, "cyclic": bus.cyclic}


def _array(message: Message | None, scope: HeaderScope) -> str:
    return "" if message is None else f"{scope.prefix}_message_{message.name}"


def _message(message: Message, scope: HeaderScope) -> MessageView:
    roles = [(f"FIELDSCRIBE_CAN_{upper(role.kind)}", _role_number(role)) for role in message.roles]
    comment, number = c_comment(message.title["en"]), hexadecimal(message.identifier, 3)
    adds_unit = "true" if message.adds_unit else "false"
    return MessageView(message.name, _array(message, scope), comment, number, adds_unit, tuple(roles))


def _role_number(role: Role) -> str:
    return hexadecimal(role.number, 2) if role.kind in ("constant", "xor") else f"{role.number}U"


def _telegram(telegram: Telegram, message: Message, scope: HeaderScope) -> TelegramView:
    macro, name = f"{scope.upper}_TELEGRAM_{upper(telegram.name)}", f"{scope.prefix}_telegram_{telegram.name}"
    slots, array = -(-telegram.words // message.words), _array(message, scope)
    return TelegramView(telegram.name, name, f"{macro}_WORDS", f"{macro}_SLOTS", slots, array, message.words)


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
    """Return True if a point is a text, or has at most so many words."""
    return point.text is not None or point.words <= words


def _parameter(point: Point, view: PointView, layouts: Layouts, arrays: Sequence[str]) -> Frame | None:
    """Return the frames of a parameter, one for each word; None if the device has no message for it."""
    read_request, read_answer, write_request, write_answer = map(bool, arrays)
    read, write = read_request and point.readable, write_request and point.writable
    if not read and not write:
        return None
    text = point.text is not None
    place = f"{{{view.function}_addresses, {point.words}U}}" if text else f"{{{view.fields.start}}}"
    parts = [*([] if text else [layouts.of(point, (0,))]), *[place] * (read + write)]
    ways = f"{'r' if read else ''}{('u' if shares(point) else 'w') if write else ''}"
    name = f"{view.function}_frame"
    what = f"{name}, " + (f"{view.function}, {view.macro}" if text else f"{wire_kind(point)}, {view.raw_type}")
    cases = []
    if read and read_answer:
        cases.append(f"READ{'_TEXT' if text else ''}({what})")
    if write and write_answer and (cases or not shares(point)):
        cases.append(f"WRITE{'_TEXT' if text else '_SHARED' if shares(point) else ''}({what})")
    return _frame(point, view, ways, parts, cases)


def _cyclic(point: Point, view: PointView, layouts: Layouts) -> Frame:
    """Return the place of a point in its telegram."""
    name = f"{view.function}_frame"
    if point.text is not None:
        parts, case = [f"{{{view.function}_addresses, {point.words}U}}"], f"RECEIVED_TEXT({name}, {view.macro})"
    else:
        parts = [layouts.of(point, range(point.words)), f"{{{view.fields.start}, {view.fields.end}}}"]
        case = f"RECEIVED({name}, {wire_kind(point)}, {view.raw_type})"
    return _frame(point, view, "h", parts, [case])


def _frame(point: Point, view: PointView, ways: str, parts: list[str], cases: Iterable[str]) -> Frame:
    """Return the frames of a point; the letters are r (read), w (write), u (update) and h (receive)."""
    name, text = f"{view.function}_frame", point.text is not None
    kind = f"fieldscribe_can_{'text_' if text else ''}{ways}"
    layout_cases = [] if text else [f"LIES({name}, {lies(point)})"]
    return Frame((Descriptor(kind, name, f"{{{', '.join(parts)}}}", "_frame"),), (*layout_cases, *cases))
