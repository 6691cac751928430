"""The facts of a bus that only this family has, and further facts for people and pages."""

from collections.abc import Iterator, Mapping

from fieldscribe.facts.schema import STRING, null_or
from fieldscribe.facts.table import WIRE, Fact, family_facts
from fieldscribe.families.modbus import BROADCAST, FUNCTIONS, ModbusBus, of_bus
from fieldscribe.families.modbus.remarks import EXCEPTIONS
from fieldscribe.model import Bus, Code
from fieldscribe.wording import address_text

_PADDING = "Modbus: to which number of bytes the data of written coils is padded."
LIMITS = family_facts(ModbusBus, Fact("pad_coil_bytes", _PADDING, null_or(STRING), WIRE))
"""The facts of a bus that only this family has."""

_DIGITS = {"discrete": 1, "input": 3, "holding": 4}
"""The first digit of traditional references; that of coils is 0 and not printed."""


def facts(bus: Bus) -> Iterator[tuple[str, str]]:
    """Yield label and text of each fact about the line."""
    yield "Framing", (", ".join(bus.framings))
    yield "Unit numbers", "{}..{}".format(*bus.units)
    yield "Broadcast", "none" if bus.broadcast is None else f"unit {bus.broadcast}, not answered"
    padding = of_bus(bus).pad_coil_bytes
    if padding:
        yield "Data bytes when coils are written", (f"padded to an {padding} number")
    for space, gaps in bus.gaps.items():
        spans = ", ".join(f"{address_text(low)} to {address_text(high)}" for low, high in gaps)
        yield (f"No request may cross ({space})"), spans


def numbers(space: str, address: int) -> Mapping[str, int]:
    """Return an address as PLC and panel tools count: from 1, and with the digit of the space in front."""
    modicon = {"modicon": address + 1}
    return modicon if space == "coil" else {**modicon, "reference": _DIGITS[space] * 100000 + address + 1}


def goes_to_all(function: Code) -> bool:
    """Return True if the protocol allows to broadcast a function."""
    return function.number in BROADCAST


PROTOCOL: dict[str, object] = {
    "functions": {number: [each.name, each.space, each.most] for number, each in FUNCTIONS.items()},
    "exceptions": dict(EXCEPTIONS),
}
"""The functions with name, space and the most items of a request, and the usual names of exceptions."""
