"""The facts of a bus and of frames that only this family has, and the facts about the line for people."""

from collections.abc import Iterator

from fieldscribe.facts.schema import ADDRESS, INTEGER, null_or
from fieldscribe.facts.table import DOCS, WIRE, Fact, family_facts
from fieldscribe.families.can import CanBus, CanExample, of_bus
from fieldscribe.model import Bus

LIMITS = family_facts(
    CanBus,
    Fact("bitrate", "CAN and USS: bits a second.", null_or(INTEGER), WIRE),
    Fact("identifier_bits", "CAN: how many bits the identifiers have.", null_or(INTEGER), WIRE),
)
"""The facts of a bus that only this family has."""

_CAN_ID = Fact("can_id", "The identifier of a CAN frame.", null_or(ADDRESS), DOCS, attribute="identifier")
FRAME = family_facts(CanExample, _CAN_ID)
"""The same for worked examples."""


def facts(bus: Bus) -> Iterator[tuple[str, str]]:
    """Yield label and text of each fact about the line."""
    details = of_bus(bus)
    if details.bitrate is not None:
        yield "Bit rate", f"{details.bitrate} bit/s"
    if details.identifier_bits is not None:
        yield "Identifier", f"{details.identifier_bits} bits"
    yield "Unit numbers", "{}..{}".format(*bus.units)
