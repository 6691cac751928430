"""What every stage may know of the family, and what it alone knows of a bus."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families.contract import BusKeys, Codes, Family
from fieldscribe.model import Own

if TYPE_CHECKING:
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
