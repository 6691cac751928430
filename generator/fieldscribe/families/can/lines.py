"""A CAN bus, as python-can names it: an interface and a channel."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fieldscribe.live.lines import LineAddress, OpenLine
from fieldscribe.model import Device
from fieldscribe.user_errors import UnclearError, can_package

if TYPE_CHECKING:
    import can
    from fieldscribe_runtime.transports.can import CanLine

SCHEMES: dict[str, tuple[str, ...]] = {"can": ("bitrate",)}
EXAMPLES = ("can://socketcan/can0",)

_FASTEST = 1_000_000


def open_line(line: LineAddress, timeout: dict[str, Any]) -> CanLine:
    """Return the runtime's transport; `timeout` is empty for its usual one. Raises UnclearError."""
    from fieldscribe_runtime.transports.can import CanLine

    return CanLine(open_bus(line), **timeout)


def open_bus(line: LineAddress) -> can.BusABC:
    """Return the bus of python-can. Raises UnclearError."""
    import can

    interface, _, channel = line.place.partition("/")
    if not interface or not channel:
        raise line.wrong("it takes an interface and a channel of python-can")
    settings: Any = {key: line.number(key, 0, (1, _FASTEST)) for key in line.settings}
    try:
        return can.Bus(channel, interface=interface, **settings)
    except (can.CanError, OSError, ValueError, ImportError, NotImplementedError) as error:
        wrong = line.wrong(f"python-can cannot open it: {error}")
        raise UnclearError(wrong.message, can_package(interface, error) or wrong.hint) from error


def device_on(line: OpenLine, kind: type[Any], model: Device, unit: int, variants: dict[str, str]) -> Any:
    """Return a device of the runtime; others on a busy bus do not make it wait longer than a timeout that is given."""
    del model
    device = kind(line.transport, unit, **variants)
    if line.timeout is not None:
        device.patience = line.timeout
    return device
