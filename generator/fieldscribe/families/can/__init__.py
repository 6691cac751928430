"""The CAN family: a maker's own messages, laid out byte by byte in the description, and multiplexed telegrams."""

from dataclasses import dataclass

from fieldscribe.families import BusKeys, Codes, Family, Option
from fieldscribe.model import Bus, FamilyFacts, Frame

USUAL_BITS = 11
"""The bits of an identifier if the description does not give them."""

FAMILY = Family(
    name="can",
    folder=__name__,
    spaces={"parameter": "word", "telegram": "word", "signal": "signal"},
    last_address=0xFFFF,
    bus=BusKeys((), frozenset({"bitrate"}), (0, 0)),
    framings=("can",),
    codes=(Codes("exceptions", "exception", "exception"),),
    words={"parameter": 1},
    frame_keys=("can_id",),
    lays_out_messages=True,
    options=(
        Option("can_id", "the identifier of frames without one, in hexadecimal", ("decode",), str, "ID"),
        Option("with_word", "the word that a bit group is put into, as in 1234h", ("encode",), str, "WORD"),
    ),
    exports=("dbc",),
)


@dataclass(frozen=True, slots=True)
class CanBus(FamilyFacts):
    """The speed of the bus and the bits of its identifiers; None if the description does not give them."""

    bitrate: int | None = None
    identifier_bits: int | None = None


@dataclass(frozen=True, slots=True)
class CanExample(FamilyFacts):
    """The identifier of a worked example; None after a finding."""

    identifier: int | None = None


def of_bus(bus: Bus) -> CanBus:
    """Return the facts of a bus that only this family has."""
    return bus.family_facts if isinstance(bus.family_facts, CanBus) else CanBus()


def identifier_bits(bus: Bus) -> int:
    """Return the number of bits of an identifier."""
    return of_bus(bus).identifier_bits or USUAL_BITS


def identifier_of(frame: Frame) -> int | None:
    """Return the identifier of a worked example; None if it has none."""
    return frame.family_facts.identifier if isinstance(frame.family_facts, CanExample) else None
