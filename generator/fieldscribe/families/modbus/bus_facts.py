"""What the family adds to exports: its facts in the limits."""

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


def limits(bus: Bus | None) -> dict[str, object]:
    """What the family alone knows of a bus; of a bus of another family what stands for nothing."""
    return {"pad_coil_bytes": (ModbusBus() if bus is None else of_bus(bus)).pad_coil_bytes}


_DIGITS = {"discrete": 1, "input": 3, "holding": 4}
"""The first digit of traditional references; that of coils is 0, which leaves the number as it is."""


def facts(bus: Bus) -> Iterator[tuple[str, str]]:
    """Label and text of each fact that people must know about the line."""
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
    """The numbers of an address as PLC and panel tools count: from 1, and with the digit of the space before it."""
    modicon = {"modicon": address + 1}
    return modicon if space == "coil" else {**modicon, "reference": _DIGITS[space] * 100000 + address + 1}


def goes_to_all(function: Code) -> bool:
    """Whether a function may be broadcast where the description does not say so."""
    return function.number in BROADCAST
