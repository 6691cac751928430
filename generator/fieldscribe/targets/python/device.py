"""The view of the device module: the two device classes and their variants."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.names import pascal
from fieldscribe.targets.python.families import in_python
from fieldscribe.targets.python.identifiers import Identifiers, parameter, sorted_imports
from fieldscribe.text import python_string

if TYPE_CHECKING:
    from fieldscribe.model import Device


@dataclass(frozen=True, slots=True)
class Axis:
    """One variant axis: its key, the constructor's parameter, the type of its values, and their literals."""

    key: str
    parameter: str
    type: str
    values: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class DeviceClass:
    """One class: its name, the device of the runtime that it is, the transport that this takes, and how to read."""

    name: str
    base: str
    transport: str
    example: str


@dataclass(frozen=True, slots=True)
class DeviceView:
    """The device module: what it takes from where, its classes, their variants, and further settings of the bus."""

    module: str
    imports: tuple[str, ...]
    classes: tuple[DeviceClass, ...]
    axes: tuple[Axis, ...]
    settings: tuple[tuple[str, str], ...]


def device_view(device: Device, names: Identifiers) -> DeviceView:
    """The classes of the device."""
    family = in_python(device)
    axes = tuple(
        Axis(python_string(axis), parameter(axis), f"{pascal(axis)}Choice", tuple(map(python_string, values)))
        for axis, values in device.variants.items()
    )
    blocking, awaiting = family.blocking, family.awaiting
    classes = (
        DeviceClass(names.device_class, blocking.device, blocking.transport, "drive.point.read()"),
        DeviceClass(names.async_class, awaiting.device, awaiting.transport, "await drive.point.read()"),
    )
    used = {blocking.device, awaiting.device}
    if axes:  # only then has the class a constructor of its own
        used |= {blocking.transport, awaiting.transport, *(kind for _, kind in family.settings)}
    return DeviceView(family.module, tuple(sorted_imports(used)), classes, axes, family.settings)
