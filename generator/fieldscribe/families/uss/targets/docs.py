"""What the documentation says about the bus line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.uss.facts import of_bus
from fieldscribe.families.uss.parts import VARIABLE
from fieldscribe.targets.docs.bus import span
from fieldscribe.targets.docs.cells import cell
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.model import Bus, Code


def facts(bus: Bus) -> Iterator[tuple[str, str]]:
    """Label and text of each fact that people must know about the line."""
    own = of_bus(bus)
    yield "Unit numbers", span(bus.units)
    if bus.broadcast is not None:
        yield "Broadcast", f"address byte {hex_text(bus.broadcast, 2)}, not answered"
    lengths = (f"variable ({VARIABLE})" if length == VARIABLE else str(length) for length in own.pkw)
    yield "Words of the parameter part (PKW)", cell(", ".join(lengths))
    yield "Words of process data (PZD)", span(own.pzd)


def numbers(space: str, address: int) -> Mapping[str, int]:
    """The numbers that people use for an address, whatever the manual prints."""
    del space, address  # an address is a number for people already
    return {}


def goes_to_all(function: Code) -> bool:
    """Whether a function may be broadcast where the description does not say so."""
    del function  # broadcasts are telegrams of their own
    return False
