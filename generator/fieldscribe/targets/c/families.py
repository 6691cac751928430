"""What the C target makes of each bus family: one header for the frames, beside the runtime of the family."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fieldscribe.targets.c import can, modbus, uss

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from fieldscribe.model import Device
    from fieldscribe.targets.c.scope import Scope
    from fieldscribe.targets.c.views import DeviceView
    from fieldscribe.targets.identifiers import Named


@dataclass(frozen=True, slots=True)
class Family:
    """The view of the header of frames, and every identifier in it by what it belongs to.

    `adapters` are macros with which points answer conformance vectors that only this family has, by their function.
    """

    view: Callable[[Device, DeviceView, Scope], Any]
    identifiers: Callable[[Device, Any, Scope], Iterator[Named]]
    adapters: Callable[[Any], Iterator[tuple[str, str]]]


FAMILIES: Mapping[str, Family] = {
    "modbus": Family(modbus.modbus_view, modbus.identifiers, modbus.adapters),
    "can": Family(can.can_view, can.identifiers, can.adapters),
    "uss": Family(uss.uss_view, uss.identifiers, uss.adapters),
}
"""A family's template and runtime go by its name: `<name>.h.j2` and `fieldscribe_<name>.h`."""
