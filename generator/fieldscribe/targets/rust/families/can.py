"""What a crate of a CAN device says of its bus: messages, telegrams, which points are in them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.targets.identifiers import Identifier, Owner
from fieldscribe.targets.rust.documentation import sentence
from fieldscribe.targets.rust.families.numbers import code_names, constants
from fieldscribe.targets.rust.layout import array, assignment, binding
from fieldscribe.targets.rust.literals import integer, mask, type_name
from fieldscribe.text import rust_string

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from fieldscribe.model import Device, Message, Role, Telegram
    from fieldscribe.targets.rust.subjects import Scope, Subject

_NUMBERED = {"unit": "Unit", "address": "Address", "raw": "Raw", "word": "Word"}
_PLAIN = {"multiplexer": "Multiplexer"}


@dataclass(frozen=True, slots=True)
class MessageView:
    """A message as a constant."""

    doc: str
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class TelegramView:
    """A telegram: final name, the lines that say its name, its sizes, the constant of its message."""

    doc: str
    name: str
    lines: tuple[str, ...]
    words: int
    slots: int
    message: str


def can_context(device: Device) -> dict[str, object]:
    """What the template of the family's items sees."""
    bus = device.bus
    carriers = {message.name: message for message in device.messages}
    return {
        "example_link": str(bus.units[0]),
        "exception_type": "u16",
        "exception_names": code_names(bus.exceptions),
        "units": f"({bus.units[0]}, {bus.units[1]})",
        "identifier_bits": bus.identifier_bits or 11,
        "bitrate": "" if bus.bitrate is None else integer(bus.bitrate),
        "dialogues": tuple(_dialogues(device.messages)),
        "messages": tuple(map(_message, device.messages)),
        "message_names": array([f"&messages::{message.name.upper()}" for message in device.messages]),
        "numbers": (("exceptions", "Exception codes.", constants(bus.exceptions, "u16", "code")),),
        "telegrams": tuple(
            _telegram(one, carriers[one.message])
            for one in device.telegrams
            if one.message in carriers and carriers[one.message].words
        ),
    }


def can_traits(subject: Subject, scope: Scope) -> Iterator[str]:
    """A parameter is read and written word by word; a point of a telegram is received in frames."""
    point = subject.point
    if point.telegram is None:
        yield "impl runtime::can::Parameter {}"
        return
    _, message = scope.telegrams.get(point.telegram, (None, None))
    if not point.readable or message is None or not message.words:
        return
    frames = {position // message.words for position in point.addresses}
    # Of more words than two in several frames nobody can tell whether they belong together.
    if len(frames) == 1 or len(point.addresses) == 2:
        yield f"impl runtime::can::Received {{ type Telegram = crate::telegrams::{type_name(point.telegram)}; }}"


def can_identifiers(device: Device) -> Iterator[Identifier]:
    """The names of messages and telegrams."""
    for message in device.messages:
        yield Identifier("Rust, messages", message.name.upper(), Owner("message", message.name))
    for telegram in device.telegrams:
        yield Identifier("Rust, telegrams", type_name(telegram.name), Owner("telegram", telegram.name))


def _dialogues(messages: Sequence[Message]) -> Iterator[tuple[str, str, str]]:
    """The constants of the messages that read and write a parameter: names and answers, empty if there are none."""
    requests = [one for one in messages if one.direction == "request" and _carries(one, "address")]
    for name, writes in (("READ", False), ("WRITE", True)):
        request = next((one for one in requests if _carries(one, "raw") is writes), None)
        answer = next((one for one in messages if request is not None and one.answers == request.name), None)
        if request is None or (answer is None and not writes):
            yield name, "", ""
        else:
            yield name, request.name.upper(), "None" if answer is None else f"Some(&messages::{answer.name.upper()})"


def _carries(message: Message, kind: str) -> bool:
    return any(role.kind == kind for role in message.roles)


def _message(message: Message) -> MessageView:
    width = "u16" if message.can_id <= 0xFFFF else "u32"
    roles = (f"        Role::{_role(role)}," for role in message.roles)
    adds_unit = "true" if message.adds_unit else "false"
    head = (f"    {one}," for one in (rust_string(message.name), mask(message.can_id, width), adds_unit))
    literal = ("Message::new(", *head, "    [", *roles, "    ],", ")")
    return MessageView(sentence(message.name), assignment(4, f"pub const {message.name.upper()}: Message", literal))


def _role(role: Role) -> str:
    if role.kind in _PLAIN:
        return _PLAIN[role.kind]
    if role.kind in _NUMBERED:
        return f"{_NUMBERED[role.kind]}({role.number})"
    if role.kind == "xor":
        return f"Xor(0b{role.number >> 4:04b}_{role.number & 15:04b})"
    return f"Constant(0x{role.number:02X})"


def _telegram(telegram: Telegram, message: Message) -> TelegramView:
    slots = -(-telegram.words // message.words)
    name = binding(8, "const NAME: &'static str", rust_string(telegram.name))
    return TelegramView(
        sentence(telegram.name), type_name(telegram.name), name, telegram.words, slots, message.name.upper()
    )
