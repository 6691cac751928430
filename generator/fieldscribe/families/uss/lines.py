"""USS lines: serial, with how the telegrams of the device are set."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fieldscribe.families.uss.parts import default_link
from fieldscribe.live.lines import SERIAL_KEYS, LineAddress
from fieldscribe.model import Device

if TYPE_CHECKING:
    from fieldscribe_runtime.uss import UssDevice

SCHEMES: dict[str, tuple[str, ...]] = {"uss": (*SERIAL_KEYS, "pkw", "pzd", "single_first")}
EXAMPLES = ("uss:///dev/ttyUSB0?baud=9600&pkw=4&pzd=2",)


def open_line(line: LineAddress, timeout: dict[str, Any]) -> Any:
    """Return the runtime's transport; `timeout` is empty for its usual one. Raises UnclearError."""
    from fieldscribe_runtime.transports.serial import UssLine

    return UssLine(**line.serial(UssLine.MODE), **timeout)


def arguments(line: LineAddress, device: Device) -> tuple[object, ...]:
    """Return what a device of the runtime takes beside the transport and its unit: how its link is set."""
    from fieldscribe_runtime.uss import Link

    usual = default_link(device.bus)
    single_first = line.choice("single_first", "no", ("no", "yes")) == "yes"
    pkw, pzd = (line.number(key, getattr(usual, key), (0, 127)) for key in ("pkw", "pzd"))
    return (Link(pkw or 0, pzd or 0, single_first),)


UNITS = (0, 31)


def any_device(transport: Any, unit: int) -> UssDevice:
    """Return a device of which only the protocol is known, with a link without parameters and two words."""
    from fieldscribe_runtime import Telegram
    from fieldscribe_runtime.uss import Link, Profile, UssDevice

    reply = Telegram("reply", "response", 2)
    profile = Profile(units=UNITS, pkw=(0,), pzd=(0, 2), tasks={0: (0,)}, telegrams=(reply,))
    made: UssDevice = type("Unknown", (UssDevice,), {"PROFILE": profile})(transport, unit, Link(0, 2))
    return made


def probe(device: UssDevice) -> str:
    """Ask a device for its process data, which commands nothing; return what came. Raises FieldscribeError."""
    return f"word 1 of its process data is {device.read_at('reply', 0)[0]:04X}h"
