"""Messages of a CAN device: building their frames, and reading frames back. Pure functions, no I/O."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.model import Message, Role

LENGTH = 8
"""How many bytes every message of this family has."""
_WORD = 0xFFFF
_STATUSES = {"constant": "wrong_constant", "unit": "wrong_unit"}
"""What is wrong with a frame whose bytes of this role differ."""


@dataclass(frozen=True, slots=True)
class CanFrame:
    """A frame on the bus: its identifier and its data."""

    id: int
    data: bytes


@dataclass(frozen=True, slots=True)
class Parsed:
    """A frame read as a message; what the message does not carry is 0, and all is 0 unless `status` is "ok"."""

    status: str
    address: int = 0
    raw: int = 0


@dataclass(frozen=True, slots=True)
class Difference:
    """A byte that a message cannot have: its place, the kind of its role, what is here and what is due."""

    place: int
    kind: str
    here: int
    due: int


def identifier(message: Message, unit: int) -> int:
    """The identifier that carries a message to or from a unit."""
    return message.identifier + unit if message.adds_unit else message.identifier


def checksum(data: Sequence[int], mask: int) -> int:
    """The exclusive or of the bytes that `mask` selects."""
    result = 0
    for place, byte in enumerate(data):
        if mask >> place & 1:
            result ^= byte
    return result


def places(message: Message, kind: str) -> list[int]:
    """The bytes of the message with a role of this kind."""
    return [place for place, role in enumerate(message.roles) if role.kind == kind]


def carries(message: Message, kind: str) -> bool:
    """Whether any byte of the message has a role of this kind."""
    return bool(places(message, kind))


def carried(message: Message, frame: CanFrame, kind: str) -> int:
    """The number that the bytes with a role of this kind make up."""
    bytes_by_role = zip(message.roles, frame.data, strict=False)
    return sum(
        byte << (0 if kind == "multiplexer" else role.number) for role, byte in bytes_by_role if role.kind == kind
    )


def unit_of(message: Message, frame: CanFrame) -> int | None:
    """The unit that a frame says it is to or from, by its identifier or its bytes; None where neither tells."""
    if message.adds_unit:
        return frame.id - message.identifier
    return carried(message, frame, "unit") if carries(message, "unit") else None


def telegram_words(message: Message, frame: CanFrame) -> dict[int, int]:
    """The words of a telegram that a frame brings, by their position in the telegram."""
    first = carried(message, frame, "multiplexer") * message.words
    words: dict[int, int] = {}
    for role, byte in zip(message.roles, frame.data, strict=True):
        if role.kind == "word":
            place = first + role.number // 2
            words[place] = words.get(place, 0) | byte << (0 if role.number & 1 else 8)
    return words


def build(message: Message, units: tuple[int, int], unit: int, address: int, raw: int) -> tuple[str, CanFrame]:
    """The frame of a message; (status, an empty frame) when it must not be sent.

    The first failure wins: `bad_unit` (outside `units`), `bad_address` and `bad_value` (not 16 bits).
    """
    for status, number, low, high in (
        ("bad_unit", unit, *units),
        ("bad_address", address, 0, _WORD),
        ("bad_value", raw, 0, _WORD),
    ):
        if not low <= number <= high:
            return status, CanFrame(0, b"")
    data = [_byte(role, unit, address, raw) for role in message.roles]
    for place in places(message, "xor"):
        data[place] = checksum(data, message.roles[place].number)
    return "ok", CanFrame(identifier(message, unit), bytes(data))


def _byte(role: Role, unit: int, address: int, raw: int) -> int:
    if role.kind == "constant":
        return role.number
    carried = {"unit": unit, "address": address, "raw": raw}.get(role.kind, 0)
    return carried >> role.number & 0xFF


def differences(message: Message, unit: int, frame: CanFrame) -> tuple[Difference, ...]:
    """The bytes of a frame of the right length that this message of this unit cannot have, whatever its checksum."""
    result = []
    for place, (role, here) in enumerate(zip(message.roles, frame.data, strict=True)):
        if role.kind in _STATUSES:
            due = _byte(role, unit, 0, 0)
            result += [Difference(place, role.kind, here, due)] if here != due else []
    return tuple(result)


def sums(message: Message, data: bytes) -> tuple[bytes, bytes]:
    """The checksums in the data of a message, and those that its other bytes give."""
    masks = {place: message.roles[place].number for place in places(message, "xor")}
    return bytes([data[place] for place in masks]), bytes([checksum(data, mask) for mask in masks.values()])


def parse(message: Message, unit: int, frame: CanFrame) -> Parsed:
    """The frame read as this message of this unit. Any bytes at any length are safe; the first failure wins.

    `wrong_id`, `wrong_length` (not 8 bytes), `wrong_constant`, `wrong_unit`, `wrong_check`.
    """
    if frame.id != identifier(message, unit):
        return Parsed("wrong_id")
    if len(frame.data) != LENGTH:
        return Parsed("wrong_length")
    wrong = {difference.kind for difference in differences(message, unit, frame)}
    for kind, status in _STATUSES.items():
        if kind in wrong:
            return Parsed(status)
    here, right = sums(message, frame.data)
    if here != right:
        return Parsed("wrong_check")
    return Parsed("ok", carried(message, frame, "address"), carried(message, frame, "raw"))
