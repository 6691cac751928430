"""What the family adds to exports: its facts in the limits, and a form of its own, the CAN database."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.can import CanBus, identifier_of, of_bus
from fieldscribe.targets.docs.bus import span

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.model import Bus, Code, Device, Frame


LIMIT_CLASSES = {"bitrate": "wire", "identifier_bits": "wire"}
"""How grave a difference in a fact of `limits` is: a class of `differences`."""

FRAME_CLASSES = {"can_id": "docs"}
"""The same for worked examples."""


def limits(bus: Bus | None) -> dict[str, object]:
    """The family's own facts of a bus; empty values for a bus of another family."""
    can_bus = CanBus() if bus is None else of_bus(bus)
    return {"bitrate": can_bus.bitrate, "identifier_bits": can_bus.identifier_bits}


def frame(frame: Frame | None) -> dict[str, object]:
    """The identifier of a worked example; of a frame of another family what stands for nothing."""
    return {"can_id": None if frame is None else identifier_of(frame)}


def export(form: str, device: Device, unit: int | None) -> bytes:
    """The device in a form that only this family has. Raises ExportError."""
    del form  # the family has only this one
    from fieldscribe.families.can.dbc import export_dbc

    return export_dbc(device, unit).encode("latin-1")


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
