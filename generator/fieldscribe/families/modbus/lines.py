"""Modbus lines: in a network, on a serial line, and RTU frames through a network."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fieldscribe.families.modbus import SPACES
from fieldscribe.live.lines import SERIAL_KEYS, LineAddress, OpenLine
from fieldscribe.model import Device

if TYPE_CHECKING:
    from fieldscribe_runtime.modbus import ModbusDevice
    from fieldscribe_runtime.transports.serial import SerialLine
    from fieldscribe_runtime.transports.tcp import TcpLine

SCHEMES: dict[str, tuple[str, ...]] = {"tcp": (), "rtu": SERIAL_KEYS, "rtu+tcp": ()}
EXAMPLES = ("tcp://192.168.0.20:502", "rtu:///dev/ttyUSB0?baud=9600&parity=even", "rtu+tcp://192.168.0.20:4001")

_PORT = 502


def open_line(line: LineAddress, timeout: dict[str, Any]) -> SerialLine | TcpLine:
    """Return the runtime's transport; `timeout` is empty for its usual one. Raises UnclearError."""
    if line.scheme == "rtu":
        from fieldscribe_runtime.transports.serial import SerialLine

        return SerialLine(**line.serial(SerialLine.MODE), **timeout)
    from fieldscribe_runtime.transports.tcp import TcpLine

    framing = "rtu" if line.scheme == "rtu+tcp" else "tcp"
    host, port = line.host_and_port(_PORT if framing == "tcp" else None)
    return TcpLine(host, port, framing=framing, **timeout)


def device_on(line: OpenLine, kind: type[Any], model: Device, unit: int, variants: dict[str, str]) -> Any:
    """Return a device of the runtime. Behind `tcp://` a serial one has a gateway that translates."""
    del model
    framings = kind.PROFILE.framings
    if line.address.scheme == "tcp" and "tcp" not in framings:
        kind = type(kind.__name__, (kind,), {"PROFILE": kind.PROFILE.replaced(framings=(*framings, "tcp"))})
    return kind(line.transport, unit, **variants)


UNITS = (1, 247)


def any_device(line: OpenLine, unit: int) -> ModbusDevice:
    """Return a device of which only the protocol is known."""
    from fieldscribe_runtime.modbus import ModbusDevice, Profile

    profile = Profile(functions={SPACES["holding"].read: 1}, units=UNITS, broadcast=None)
    made: ModbusDevice = type("Unknown", (ModbusDevice,), {"PROFILE": profile})(line.transport, unit)
    return made


def probe(device: ModbusDevice) -> str:
    """Ask a device for something harmless, whatever it is; return what came. Raises FieldscribeError."""
    return f"holding register 0 is {device.read_at('holding', 0)[0]}"
