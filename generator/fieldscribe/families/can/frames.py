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


def carries(message: Message, kind: str) -> bool:
    """Whether any byte of the message has a role of this kind."""
    return any(role.kind == kind for role in message.roles)


def carried(message: Message, frame: CanFrame, kind: str) -> int:
    """The number that the bytes with a role of this kind make up."""
    bytes_by_role = zip(message.roles, frame.data, strict=False)
    return sum(
        byte << (0 if kind == "multiplexer" else role.number) for role, byte in bytes_by_role if role.kind == kind
    )


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
    for place, role in enumerate(message.roles):
        if role.kind == "xor":
            data[place] = checksum(data, role.number)
    return "ok", CanFrame(identifier(message, unit), bytes(data))


def _byte(role: Role, unit: int, address: int, raw: int) -> int:
    if role.kind == "constant":
        return role.number
    carried = {"unit": unit, "address": address, "raw": raw}.get(role.kind, 0)
    return carried >> role.number & 0xFF


def parse(message: Message, unit: int, frame: CanFrame) -> Parsed:
    """The frame read as this message of this unit. Any bytes at any length are safe; the first failure wins.

    `wrong_id`, `wrong_length` (not 8 bytes), `wrong_constant`, `wrong_unit`, `wrong_check`.
    """
    data = frame.data
    if frame.id != identifier(message, unit):
        return Parsed("wrong_id")
    if len(data) != LENGTH:
        return Parsed("wrong_length")
    bytes_by_role = list(zip(message.roles, data, strict=True))
    if any(role.kind == "constant" and byte != role.number for role, byte in bytes_by_role):
        return Parsed("wrong_constant")
    if any(role.kind == "unit" and byte != unit >> role.number & 0xFF for role, byte in bytes_by_role):
        return Parsed("wrong_unit")
    if any(role.kind == "xor" and byte != checksum(data, role.number) for role, byte in bytes_by_role):
        return Parsed("wrong_check")
    return Parsed("ok", _carried(bytes_by_role, "address"), _carried(bytes_by_role, "raw"))


def _carried(bytes_by_role: list[tuple[Role, int]], kind: str) -> int:
    return sum(byte << role.number for role, byte in bytes_by_role if role.kind == kind)
