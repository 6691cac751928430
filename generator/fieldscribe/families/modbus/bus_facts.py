"""What the documentation and exports say of a Modbus bus."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.modbus import BROADCAST, ModbusBus, of_bus
from fieldscribe.targets.docs.bus import span
from fieldscribe.targets.docs.cells import cell
from fieldscribe.wording import address_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.model import Bus, Code

LIMIT_CLASSES = {"pad_coil_bytes": "wire"}
"""How grave a difference in a fact of `limits` is: a class of `differences`."""

_DIGITS = {"discrete": 1, "input": 3, "holding": 4}
"""The first digit of traditional references; that of coils is 0, which leaves the number as it is."""


def limits(bus: Bus | None) -> dict[str, object]:
    """Return the facts that only this family has; empty values for a bus of another family."""
    return {"pad_coil_bytes": (ModbusBus() if bus is None else of_bus(bus)).pad_coil_bytes}


def facts(bus: Bus) -> Iterator[tuple[str, str]]:
    """Yield label and text of each fact about the line."""
    yield "Framing", cell(", ".join(bus.framings))
    yield "Unit numbers", span(bus.units)
    yield "Broadcast", "none" if bus.broadcast is None else f"unit {bus.broadcast}, not answered"
    padding = of_bus(bus).pad_coil_bytes
    if padding:
        yield "Data bytes when coils are written", cell(f"padded to an {padding} number")
    for space, gaps in bus.gaps.items():
        spans = ", ".join(f"{address_text(low)} to {address_text(high)}" for low, high in gaps)
        yield cell(f"No request may cross ({space})"), spans


def numbers(space: str, address: int) -> Mapping[str, int]:
    """Return an address as PLC and panel tools count: from 1, and with the digit of the space before it."""
    modicon = {"modicon": address + 1}
    return modicon if space == "coil" else {**modicon, "reference": _DIGITS[space] * 100000 + address + 1}


def goes_to_all(function: Code) -> bool:
    """Return True if the protocol allows to broadcast a function."""
    return function.number in BROADCAST
