"""The Modbus family: spaces and functions, frames of RTU and TCP, and the batched reads that a device allows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families import BusKeys, Codes, Family
from fieldscribe.model import Own

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Bus


FAMILY = Family(
    name="modbus",
    folder=__package__,
    spaces={"coil": "bit", "discrete": "bit", "holding": "word", "input": "word"},
    last_address=0xFFFF,
    bus=BusKeys(("framings", "functions"), codes=(1, 127)),
    framings=("rtu", "tcp"),
    codes=(Codes("functions", "function", "function", emitted=False), Codes("exceptions", "exception", "exception")),
    commands_in="holding",
    writes_elsewhere=True,
)


@dataclass(frozen=True, slots=True)
class ModbusBus(Own):
    """`pad_coil_bytes` is "even" if the bytes of several coils are padded to an even number."""

    pad_coil_bytes: str | None = None


def of_bus(bus: Bus) -> ModbusBus:
    """What the family alone knows of a bus."""
    return bus.own if isinstance(bus.own, ModbusBus) else ModbusBus()


FRAMINGS = ("rtu", "tcp")
READ_BITS = frozenset({0x01, 0x02})
READ_WORDS = frozenset({0x03, 0x04})
READS = READ_BITS | READ_WORDS
SINGLE = frozenset({0x05, 0x06, 0x08})
"""Functions that carry exactly one value; the answer repeats the request."""
FUNCTIONS = (0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x08, 0x0F, 0x10)
BROADCAST = frozenset({0x05, 0x06, 0x0F, 0x10})
"""Functions that the protocol allows to broadcast."""
PROTOCOL_MOST: Mapping[int, int] = {
    0x01: 2000,
    0x02: 2000,
    0x03: 125,
    0x04: 125,
    0x05: 1,
    0x06: 1,
    0x08: 1,
    0x0F: 1968,
    0x10: 123,
}
"""The largest count of items in one request that the protocol itself allows."""


@dataclass(frozen=True, slots=True)
class Space:
    """The functions of a space: read, write one item, write several items; None without one."""

    read: int
    write_one: int | None
    write_many: int | None


SPACES: Mapping[str, Space] = {
    "coil": Space(0x01, 0x05, 0x0F),
    "discrete": Space(0x02, None, None),
    "holding": Space(0x03, 0x06, 0x10),
    "input": Space(0x04, None, None),
}
SPACE_OF: Mapping[int, str] = {
    function: name
    for name, space in SPACES.items()
    for function in (space.read, space.write_one, space.write_many)
    if function is not None
}
"""The space that a function reads or writes; none for 08h."""


@dataclass(frozen=True, slots=True)
class Profile:
    """What a device takes: the largest count per allowed function, unit numbers, broadcast, padding of 0Fh, framings.

    `broadcast` is the unit number that means all, `broadcasts` the functions that may be sent to it.
    """

    most: Mapping[int, int]
    units: tuple[int, int]
    broadcast: int | None
    pad_coil_bytes_even: bool
    broadcasts: frozenset[int] = BROADCAST
    framings: tuple[str, ...] = FRAMINGS


def profile_of(bus: Bus) -> Profile:
    """The profile of a device's bus. Functions outside the nine are left out; no count means the protocol's."""
    most = {
        code.number: PROTOCOL_MOST[code.number] if code.most is None else min(code.most, PROTOCOL_MOST[code.number])
        for code in bus.functions
        if code.number in PROTOCOL_MOST
    }
    silent = {code.number for code in bus.functions if code.broadcast is False}
    return Profile(
        most, bus.units, bus.broadcast, of_bus(bus).pad_coil_bytes == "even", BROADCAST - silent, framings_of(bus)
    )


def framings_of(bus: Bus) -> tuple[str, ...]:
    """The framings of the device: those of the manual, or both where it gives none."""
    return bus.framings or FRAMINGS
