"""A CAN bus, as python-can names it: an interface and a channel."""

from __future__ import annotations

from typing import Any

from fieldscribe.live.lines import LineAddress
from fieldscribe.model import Device

SCHEMES: dict[str, tuple[str, ...]] = {"can": ("bitrate",)}
EXAMPLES = ("can://socketcan/can0",)

_FASTEST = 1_000_000


def open_line(line: LineAddress, timeout: dict[str, Any]) -> Any:
    """Return the runtime's transport; `timeout` is empty for its usual one. Raises UnclearError."""
    import can
    from fieldscribe_runtime.transports.can import CanLine

    interface, _, channel = line.place.partition("/")
    if not interface or not channel:
        raise line.wrong("it takes an interface and a channel of python-can")
    bitrate = line.number("bitrate", None, (1, _FASTEST))
    settings: Any = {} if bitrate is None else {"bitrate": bitrate}
    try:
        bus = can.Bus(channel, interface=interface, **settings)
    except (can.CanError, OSError, ValueError, ImportError, NotImplementedError) as error:
        raise line.wrong(f"python-can cannot open it: {error}") from error
    return CanLine(bus, **timeout)


def arguments(line: LineAddress, device: Device) -> tuple[object, ...]:
    """Return what a device of the runtime takes beside the transport and its unit."""
    del line, device
    return ()
