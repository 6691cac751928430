"""The view of the device module: the two device classes and their variants."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.names import pascal
from fieldscribe.targets.python.identifiers import Identifiers, parameter
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
class DeviceView:
    """The device module."""

    name: str
    async_name: str
    axes: tuple[Axis, ...]


def device_view(device: Device, names: Identifiers) -> DeviceView:
    """The classes of the device."""
    axes = tuple(
        Axis(python_string(axis), parameter(axis), f"{pascal(axis)}Choice", tuple(map(python_string, values)))
        for axis, values in device.variants.items()
    )
    return DeviceView(names.device_class, names.async_class, axes)
