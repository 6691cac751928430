"""The Modbus family: its facts, the functions of the protocol, and the requests that a device accepts."""

from collections.abc import Mapping
from dataclasses import dataclass, fields

from fieldscribe.families import BusKeys, Codes, Family
from fieldscribe.model import Bus, FamilyFacts

FRAMINGS = ("rtu", "tcp")
FAMILY = Family(
    name="modbus",
    folder=__name__,
    spaces={"coil": "bit", "discrete": "bit", "holding": "word", "input": "word"},
    last_address=0xFFFF,
    bus=BusKeys(("framings", "functions"), codes=(1, 127)),
    framings=FRAMINGS,
    codes=(Codes("functions", "function", "function", emitted=False), Codes("exceptions", "exception", "exception")),
    commands_in="holding",
    writes_elsewhere=True,
    has_bases=True,
)


@dataclass(frozen=True, slots=True)
class Function:
    """A function: its common name, its space, what it does there, and the most items of one request.

    `does` is the field of `Space` that it fills (`read`, `write_one`, `write_many`), or another word if none.
    """

    name: str
    space: str
    does: str
    most: int


FUNCTIONS: Mapping[int, Function] = {
    0x01: Function("read coils", "coil", "read", 2000),
    0x02: Function("read discrete inputs", "discrete", "read", 2000),
    0x03: Function("read holding registers", "holding", "read", 125),
    0x04: Function("read input registers", "input", "read", 125),
    0x05: Function("write one coil", "coil", "write_one", 1),
    0x06: Function("write one register", "holding", "write_one", 1),
    0x08: Function("loopback test", "", "test", 1),
    0x0F: Function("write several coils", "coil", "write_many", 1968),
    0x10: Function("write several registers", "holding", "write_many", 123),
}
"""The functions that the runtimes support, with the limits of the protocol."""
READS = frozenset(number for number, function in FUNCTIONS.items() if function.does == "read")
SINGLE = frozenset(number for number, function in FUNCTIONS.items() if function.does in ("write_one", "test"))
"""Functions that carry exactly one value; the reply repeats the request."""
BIT_LISTS = frozenset({0x01, 0x02, 0x0F})
"""Functions whose data are bits, eight to a byte."""
BROADCAST = frozenset(number for number, function in FUNCTIONS.items() if function.does.startswith("write"))
"""Functions that the protocol allows to broadcast."""


@dataclass(frozen=True, slots=True)
class Space:
    """The functions of a space: read, write one item, write several items; None without one."""

    read: int
    write_one: int | None = None
    write_many: int | None = None


_DOES = frozenset(field.name for field in fields(Space))
SPACES: Mapping[str, Space] = {
    name: Space(
        **{each.does: number for number, each in FUNCTIONS.items() if each.space == name and each.does in _DOES}
    )
    for name in FAMILY.spaces
}


@dataclass(frozen=True, slots=True)
class ModbusBus(FamilyFacts):
    """`pad_coil_bytes` is "even" if the bytes of several coils are padded to an even number."""

    pad_coil_bytes: str | None = None


def of_bus(bus: Bus) -> ModbusBus:
    """Return the facts of a bus that only this family has."""
    return bus.family_facts if isinstance(bus.family_facts, ModbusBus) else ModbusBus()


def framings_of(bus: Bus) -> tuple[str, ...]:
    """Return the framings of the device: those in the description, or both if it gives none."""
    return bus.framings or FRAMINGS


@dataclass(frozen=True, slots=True)
class Profile:
    """The requests that a device accepts: the largest count for each allowed function, unit numbers, framings.

    `broadcast` is the unit number that addresses all units, `broadcasts` are the functions that may be sent to it.
    """

    most: Mapping[int, int]
    units: tuple[int, int]
    broadcast: int | None
    pad_coil_bytes_even: bool
    broadcasts: frozenset[int] = BROADCAST
    framings: tuple[str, ...] = FRAMINGS

    def write_function(self, space: str, count: int) -> int | None:
        """Return the function that writes this many items: the one for a single item if it is allowed."""
        functions = SPACES[space]
        return functions.write_one if count == 1 and functions.write_one in self.most else functions.write_many


def profile_of(bus: Bus) -> Profile:
    """Return the profile of a device's bus, without functions that the runtimes do not support."""
    known = [code for code in bus.functions if code.number in FUNCTIONS]
    limits = {code.number: FUNCTIONS[code.number].most for code in known}
    most = {
        code.number: limits[code.number] if code.most is None else min(code.most, limits[code.number]) for code in known
    }
    silent = {code.number for code in known if code.broadcast is False}
    pads = of_bus(bus).pad_coil_bytes == "even"
    return Profile(most, bus.units, bus.broadcast, pads, BROADCAST - silent, framings_of(bus))
