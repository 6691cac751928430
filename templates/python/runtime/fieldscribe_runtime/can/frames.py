# SPDX-License-Identifier: 0BSD
"""CAN messages with a layout of bytes, without any I/O. Any bytes of any length are safe to parse."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from ..arguments import check_number
from ..errors import AccessError, FrameError
from ..records import Record

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..facts import Telegram
    from .signals import Signal

LENGTH = 8
"""How many bytes every message has."""


class Frame(Record):
    """A data frame on the bus: its identifier and its bytes."""

    id: int
    data: bytes

    def hex(self, separator: str) -> str:
        """Return the identifier and the bytes as text."""
        return f"{self.id:X}: {self.data.hex(separator)}"


class Role(NamedTuple):
    """The content of one byte of a message.

    `constant` (number: the byte itself), `unit`, `address`, `raw` (number: how far the byte lies above bit 0),
    `multiplexer`, `word` (number: 2 * word of the frame, and 1 more for its low byte), `xor` (number: a mask of the
    bytes of the message that are combined).
    """

    kind: str
    number: int = 0


class Message(Record):
    """A layout of bytes with an identifier: `can_id`, plus the unit number if `adds_unit`.

    It has `roles` for its 8 bytes, or `length` bytes with signals, whose words are a telegram of the same name. `bits`
    is the length of its identifier if it is not that of the device, `every` how often it comes, in milliseconds.
    """

    name: str
    direction: str
    can_id: int
    roles: tuple[Role, ...]
    adds_unit: bool = False
    answers: str | None = None
    signals: tuple[Signal, ...] = ()
    length: int = LENGTH
    bits: int | None = None
    every: int | None = None

    def identifier(self, unit: int) -> int:
        """The identifier that carries the message to or from a unit."""
        return self.can_id + unit if self.adds_unit else self.can_id

    def carries(self, kind: str) -> bool:
        """Return True if some byte has that role."""
        return any(role.kind == kind for role in self.roles)


class Profile(Record):
    """What a device sends and receives: unit numbers, the bits of identifiers, messages and telegrams."""

    units: tuple[int, int]
    identifier_bits: int
    messages: tuple[Message, ...]
    telegrams: tuple[Telegram, ...] = ()

    def message(self, name: str | None) -> Message:
        """A message by name; raises AccessError."""
        for message in self.messages:
            if message.name == name:
                return message
        raise AccessError(f"the device has no message {name}")

    def telegram(self, name: str | None) -> Telegram:
        """A telegram by name; raises AccessError."""
        for telegram in self.telegrams:
            if telegram.name == name:
                return telegram
        known = ", ".join([telegram.name for telegram in self.telegrams])
        raise AccessError(f"the device has no telegram {name}" + (f", only {known}" if known else ""))

    def request(self, *, writes: bool) -> Message:
        """The request that reads or writes a parameter; raises AccessError."""
        for message in self.messages:
            if message.direction == "request" and message.carries("address") and message.carries("raw") == writes:
                return message
        raise AccessError(f"the device has no message that {'writes' if writes else 'reads'} a parameter")

    def answer(self, request: Message) -> Message | None:
        """Return the message that answers a request; None if nothing does."""
        return next((message for message in self.messages if message.answers == request.name), None)


def _combined(data: bytes | bytearray, mask: int) -> int:
    """The bytes of a mask, combined by exclusive or."""
    result = 0
    for place, byte in enumerate(data):
        if mask >> place & 1:
            result ^= byte
    return result


def build(message: Message, profile: Profile, unit: int, address: int = 0, raw: int = 0) -> Frame:
    """The frame of a message; raises RequestError (bad_unit, bad_address, bad_value)."""
    for status, what, number, ends in (
        ("bad_unit", "unit", unit, profile.units),
        ("bad_address", "address", address, (0, 0xFFFF)),
        ("bad_value", "raw number", raw, (0, 0xFFFF)),
    ):
        check_number(status, what, number, ends)
    carried = {"unit": unit, "address": address, "raw": raw}
    data = bytearray()
    for kind, number in message.roles:
        if kind == "constant":
            data.append(number)
        else:
            data.append(carried.get(kind, 0) >> number & 0xFF)
    for place, (kind, mask) in enumerate(message.roles):
        if kind == "xor":
            data[place] = _combined(data, mask)
    return Frame(message.identifier(unit), bytes(data))


def check(message: Message, unit: int, frame: Frame) -> None:
    """Raises FrameError if a frame is not that message of that unit; the one place that says so.

    The first failure decides: wrong_id, wrong_length, wrong_constant, wrong_unit, wrong_check.
    """
    if frame.id != message.identifier(unit):
        raise FrameError("wrong_id", f"identifier {frame.id:X}h is not that of {message.name}")
    if len(frame.data) != message.length:
        raise FrameError("wrong_length", f"{message.name} has {message.length} bytes, not {len(frame.data)}")
    found = list(zip(message.roles, frame.data, strict=not message.signals))
    for kind, status, what in _FIXED:
        for role, byte in found:
            if role.kind == kind and byte != _expected(role, unit, frame.data):
                raise FrameError(status, f"a byte that {message.name} has as its {what} is {byte:02X}h")


def recognizer(message: Message, unit: int) -> Callable[[Frame], bool]:
    """Return True if `check` accepts a frame, from the bytes that are known beforehand."""
    can_id, length = message.identifier(unit), message.length
    roles = list(enumerate(message.roles))
    known = tuple([(at, _expected(role, unit, b"")) for at, role in roles if role.kind in ("constant", "unit")])
    combined = tuple([(at, role.number) for at, role in roles if role.kind == "xor"])

    def is_it(frame: Frame) -> bool:
        data = frame.data
        if frame.id != can_id or len(data) != length:
            return False
        for at, byte in known:
            if data[at] != byte:
                return False
        return not combined or all(data[at] == _combined(data, mask) for at, mask in combined)

    return is_it


_FIXED = (("constant", "wrong_constant", "constant"), ("unit", "wrong_unit", "unit"), ("xor", "wrong_check", "check"))
"""The kinds of bytes that are known beforehand, in the order in which they are checked."""


def _expected(role: Role, unit: int, data: bytes) -> int:
    """Return the value that a byte of such a kind must have."""
    if role.kind == "constant":
        return role.number
    return unit >> role.number & 0xFF if role.kind == "unit" else _combined(data, role.number)


def parse(message: Message, unit: int, frame: Frame) -> tuple[int, int]:
    """Return the address and the raw number in a message; 0 for the one that it does not carry.

    Raises FrameError as `check` does.
    """
    check(message, unit, frame)
    carried = {"address": 0, "raw": 0}
    for (kind, number), byte in zip(message.roles, frame.data, strict=not message.signals):
        if kind in carried:
            carried[kind] += byte << number
    return carried["address"], carried["raw"]
