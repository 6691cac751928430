"""Vectors of the constants of a bus: what its functions and tasks carry, its units, and how long its tables are."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.can import facts as can_facts
from fieldscribe.families.can.facts import identifier_bits
from fieldscribe.families.modbus import profile_of
from fieldscribe.families.uss import LAST_PARAMETER
from fieldscribe.families.uss.facts import of_bus

if TYPE_CHECKING:
    from fieldscribe.model import Bus, Device
    from fieldscribe.targets.vectors.lines import Lines

_NO_BROADCAST = 0xFFFF
"""Larger than any unit number."""

_RTU_BYTES, _TCP_BYTES, _USS_BYTES = 256, 260, 256
"""The longest frames that the protocols allow."""


def limits(lines: Lines, device: Device) -> None:
    """Everything about the constants of the bus."""
    bus = device.bus
    _limits(lines, first_unit=bus.units[0], last_unit=bus.units[1])
    _OF_FAMILY[device.family](lines, bus)
    for telegram in device.telegrams:
        lines.add("size", "words", telegram.name, telegram.words)


def _limits(lines: Lines, **numbers: int) -> None:
    for what, number in numbers.items():
        lines.add("limit", what, number)


def _modbus(lines: Lines, bus: Bus) -> None:
    profile = profile_of(bus)
    known = [code.number for code in bus.functions if code.number in profile.most]
    for index, number in enumerate(known):
        lines.add("function", index, number, profile.most[number], int(number in profile.broadcasts))
    _limits(lines, functions=len(known), broadcast=_NO_BROADCAST if bus.broadcast is None else bus.broadcast)
    _limits(lines, no_broadcast=_NO_BROADCAST, rtu_bytes=_RTU_BYTES, tcp_bytes=_TCP_BYTES)


def _can(lines: Lines, bus: Bus) -> None:
    _limits(lines, identifier_bits=identifier_bits(bus))
    bitrate = can_facts.of_bus(bus).bitrate
    if bitrate is not None:
        lines.add("size", "bitrate", None, bitrate)


def _uss(lines: Lines, bus: Bus) -> None:
    for index, code in enumerate(bus.functions):
        lines.add("function", index, code.number, None, None, sum(1 << answer for answer in set(code.answers)))
    _limits(lines, functions=len(bus.functions), parameter_parts=len(of_bus(bus).pkw))
    _limits(lines, broadcast=_NO_BROADCAST if bus.broadcast is None else bus.broadcast, no_broadcast=_NO_BROADCAST)
    _limits(lines, telegram_bytes=_USS_BYTES, last_parameter=LAST_PARAMETER)
    _limits(lines, least_process_words=of_bus(bus).pzd[0], most_process_words=of_bus(bus).pzd[1])


_OF_FAMILY = {"modbus": _modbus, "can": _can, "uss": _uss}
