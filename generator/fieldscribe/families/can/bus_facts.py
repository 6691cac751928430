"""The facts of a bus and of frames that only this family has, and what people must know about the line."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from fieldscribe.facts.schema import ADDRESS, INTEGER, null_or
from fieldscribe.facts.table import DOCS, WIRE, Fact
from fieldscribe.families.can import identifier_of, of_bus
from fieldscribe.model import Bus

if TYPE_CHECKING:
    from fieldscribe.facts.schema import Schema


def _limit(key: str, doc: str, schema: Schema) -> Fact:
    return Fact(key, doc, schema, WIRE, value=lambda bus, _: getattr(of_bus(bus), key))


LIMITS = (
    _limit("bitrate", "CAN and USS: bits a second.", null_or(INTEGER)),
    _limit("identifier_bits", "CAN: how many bits the identifiers have.", null_or(INTEGER)),
)
"""The facts of a bus that only this family has; they are empty on a bus of another family."""

FRAME = (
    Fact(
        "can_id", "The identifier of a CAN frame.", null_or(ADDRESS), DOCS, value=lambda frame, _: identifier_of(frame)
    ),
)
"""The same for worked examples."""


def facts(bus: Bus) -> Iterator[tuple[str, str]]:
    """Yield label and text of each fact about the line."""
    details = of_bus(bus)
    if details.bitrate is not None:
        yield "Bit rate", f"{details.bitrate} bit/s"
    if details.identifier_bits is not None:
        yield "Identifier", f"{details.identifier_bits} bits"
    yield "Unit numbers", "{}..{}".format(*bus.units)
