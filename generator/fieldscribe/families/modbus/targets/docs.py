"""What the documentation says of the family's line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.modbus.facts import of_bus
from fieldscribe.families.modbus.functions import BROADCAST
from fieldscribe.targets.docs.bus import span
from fieldscribe.targets.docs.cells import cell
from fieldscribe.wording import address_text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Bus, Code


def facts(bus: Bus) -> Iterator[tuple[str, str]]:
    """What people must know of the line, with what it is called."""
    yield "Framing", cell(", ".join(bus.framings))
    yield "Unit numbers", span(bus.units)
    yield "Broadcast", "none" if bus.broadcast is None else f"unit {bus.broadcast}, not answered"
    padding = of_bus(bus).pad_coil_bytes
    if padding:
        yield "Data bytes when coils are written", cell(f"padded to an {padding} number")
    for space, gaps in bus.gaps.items():
        spans = ", ".join(f"{address_text(low)} to {address_text(high)}" for low, high in gaps)
        yield cell(f"No request may cross ({space})"), spans


def goes_to_all(function: Code) -> bool:
    """Whether a function goes to all units at once where the description does not say it."""
    return function.number in BROADCAST
