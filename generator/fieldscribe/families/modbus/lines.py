"""Modbus lines: TCP, serial, and RTU frames over TCP.

Received bytes are cut into frames by length and CRC on a serial line, by the header on TCP.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from fieldscribe.diagnostics import UnclearError
from fieldscribe.families.frame_results import FrameResult
from fieldscribe.families.modbus import FUNCTIONS, SPACES
from fieldscribe.families.modbus.frames import reply_length, request_length, unwrap
from fieldscribe.listening.chunks import BYTES, STREAM, ByteCutter, Chunk, Cut, logged_bytes, packet, serial_chunks
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
    """Return a device of the runtime. A serial device at `tcp://` is behind a gateway that translates."""
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
    """Send a harmless request to any device; return its answer. Raises FieldscribeError."""
    return f"holding register 0 is {device.read_at('holding', 0)[0]}"


__all__ = ["KINDS", "PORTS", "action", "chunk_of_text", "cutter", "packet", "receive"]

KINDS = (BYTES, STREAM)
PORTS = frozenset({502})
_LONGEST, _LONGEST_TCP, _LEAST_TCP = 256, 260, 8
_MOST_STREAMS = 2048
_COUNTED = frozenset(number for number, function in FUNCTIONS.items() if function.does == "write_many")
"""Functions whose requests contain their length."""


class ModbusCutter:
    """Cuts the bytes of serial lines and of connections into frames."""

    def __init__(self) -> None:
        self._serial = ByteCutter(_size_at, _LONGEST, "rtu", 0)
        self._streams: OrderedDict[tuple[str, bool | None], bytes] = OrderedDict()

    def take(self, chunk: Chunk) -> Iterator[Cut]:
        """Return the frames that this chunk completes; a connection may also carry RTU frames."""
        if chunk.kind == BYTES:
            yield from self._serial.take(chunk)
            return
        key = chunk.place, chunk.sent
        data = (b"" if chunk.fresh else self._streams.pop(key, b"")) + chunk.data
        while len(data) >= _LEAST_TCP:
            size = 6 + int.from_bytes(data[4:6], "big")
            if data[2:4] != b"\0\0" or not _LEAST_TCP <= size <= _LONGEST_TCP:
                yield from self._without_header(chunk, data)
                data = b""
            elif len(data) < size:
                break
            else:
                yield _framed(chunk, data[:size])
                data = data[size:]
        if data:
            self._streams[key] = data
            if len(self._streams) > _MOST_STREAMS:
                self._streams.popitem(last=False)

    def rest(self) -> Iterator[Cut]:
        """Return what is left at the end."""
        yield from self._serial.rest()
        for (place, sent), data in self._streams.items():
            yield Cut(None, data, data, "tcp", None, place, None, sent)

    def _without_header(self, chunk: Chunk, data: bytes) -> Iterator[Cut]:
        if unwrap("rtu", data).flaw is None:
            yield Cut(chunk.time, data, data, "rtu", data[0], chunk.place, None, chunk.sent)
        else:
            yield Cut(chunk.time, data[:_LONGEST_TCP], data[:_LONGEST_TCP], "tcp", None, chunk.place, None, chunk.sent)


def _framed(chunk: Chunk, data: bytes) -> Cut:
    """Return a frame of a connection. Its number moves to the exchange, so that equal frames have equal bytes."""
    return Cut(chunk.time, b"\0\0" + data[2:], data, "tcp", data[6], chunk.place, data[:2], chunk.sent)


def _size_at(data: bytes, begins: bool) -> int:
    pdu = data[1:]
    if len(pdu) < 2:
        return -1
    sizes = {size + 3 for size in (request_length(pdu), reply_length(pdu)) if 0 < size <= _LONGEST - 3}
    for size in sorted(sizes, key=lambda size: (size != len(data), size)):
        if size <= len(data) and unwrap("rtu", data[:size]).flaw is None:
            return size
    if any(size > len(data) for size in sizes) or (len(pdu) < 6 and pdu[0] in _COUNTED):
        return -1
    return len(data) if begins and unwrap("rtu", data).flaw is None else 0


cutter = ModbusCutter


def chunk_of_text(text: str) -> Chunk:
    """Return the bytes in a line of a log, which may be a TCP frame. Raises HexError for a line without any."""
    chunk = logged_bytes(text)
    if unwrap("rtu", chunk.data).flaw is None or unwrap("tcp", chunk.data).flaw is not None:
        return chunk
    return chunk._replace(kind=STREAM)


def receive(line: LineAddress) -> Iterator[Chunk]:
    """Yield the chunks received on a line. Raises UnclearError."""
    if line.scheme == "tcp":
        message = "a network does not bring what others say"
        raise UnclearError(message, "capture it where it passes, as with tcpdump -w FILE, and give --capture FILE")
    return serial_chunks(line, "8N1")


def action(result: FrameResult) -> str:
    """Return the action of an exchange in a word."""
    function = FUNCTIONS.get((result.function or 0) & 0x7F)
    return "function" if function is None else function.does.partition("_")[0]
