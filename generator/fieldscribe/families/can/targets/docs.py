"""What the documentation says about the bus line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.can.facts import of_bus
from fieldscribe.targets.docs.bus import span

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.model import Bus, Code


def facts(bus: Bus) -> Iterator[tuple[str, str]]:
    """Label and text of each fact that people must know about the line."""
    own = of_bus(bus)
    if own.bitrate is not None:
        yield "Bit rate", f"{own.bitrate} bit/s"
    if own.identifier_bits is not None:
        yield "Identifier", f"{own.identifier_bits} bits"
    yield "Unit numbers", span(bus.units)


def numbers(space: str, address: int) -> Mapping[str, int]:
    """The numbers that people use for an address, whatever the manual prints."""
    del space, address  # an address is a number for people already
    return {}


def goes_to_all(function: Code) -> bool:
    """Whether a function may be broadcast where the description does not say so."""
    del function  # there are no functions
    return False
