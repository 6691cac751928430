"""The async class of a device, made from the model as `live` makes the other one."""

from importlib import import_module
from typing import Any

from fieldscribe.live.connection import constructor, device_class
from fieldscribe.model import Device
from fieldscribe.targets.python.syntax import Identifiers, in_python


def async_device_class(device: Device, live: Any = None) -> Any:
    """Return the async class, with the points of the class `live` if that is there."""
    bus = in_python(device)
    base = getattr(import_module(bus.module), f"Async{bus.device}")
    points = (live or device_class(device)).__bases__[0]
    return type(Identifiers(device).async_class, (points, base), {"__init__": constructor(device, base)})
