"""What the tests of transports share: the transports of a generated package, and a frame that is none of its device."""

from __future__ import annotations

import importlib
from typing import Any

import can

NOISE = can.Message(arbitration_id=1, is_remote_frame=True, is_extended_id=False)


def transport(name: str) -> Any:
    """Return a module of transports, of the same copy of the runtime as the device."""
    return importlib.import_module(f"fieldscribe_runtime.transports.{name}")


def behind_a_gateway(device: Any) -> Any:
    """Return the class of a drive that speaks RTU as it is reached over TCP, through a gateway."""
    return type("Gateway", (device,), {"PROFILE": device.PROFILE.replaced(framings=("rtu", "tcp"))})
