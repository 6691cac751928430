"""A CAN bus, as python-can names it (an interface and a channel), and its messages: each is one frame."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from fieldscribe.diagnostics import UnclearError, can_package
from fieldscribe.families.can.frames import LONGEST, CanFrame
from fieldscribe.families.can.notation import read_frames
from fieldscribe.families.frame_results import FrameResult
from fieldscribe.listening.chunks import BUS_SOCKET, MESSAGE, SILENCE, SILENT, Chunk, Cut, Packet
from fieldscribe.live.lines import LineAddress, OpenLine
from fieldscribe.model import Device
from fieldscribe.pasted_numbers import HexError

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
        hint = f"a path has its own slash: can://{interface}//{channel}" if channel.startswith("dev/") else wrong.hint
        raise UnclearError(wrong.message, can_package(interface, error) or hint) from error


def device_on(line: OpenLine, kind: type[Any], model: Device, unit: int, variants: dict[str, str]) -> Any:
    """Return a device of the runtime; on a busy bus, a given timeout limits its wait all the same."""
    del model
    device = kind(line.transport, unit, **variants)
    if line.timeout is not None:
        device.patience = line.timeout
    return device


KINDS = (MESSAGE,)
PORTS: frozenset[int] = frozenset()
_LONG, _REMOTE, _SHORT = 0x80000000, 0x40000000, 0x7FF
"""The marks of SocketCAN for extended identifiers and remote frames, and the last standard identifier."""


class CanCutter:
    """Makes frames of messages."""

    def take(self, chunk: Chunk) -> tuple[Cut, ...]:
        """Return the frame of a message."""
        frame = CanFrame(chunk.identifier, chunk.data, chunk.remote)
        return (Cut(chunk.time, frame, chunk.data, None),)

    def rest(self) -> tuple[Cut, ...]:
        """Return nothing: each message is whole."""
        return ()


cutter = CanCutter


def packet(cut: Cut) -> Packet:
    """Return a message as a packet of SocketCAN."""
    identifier, data = cut.frame.id, cut.data[:LONGEST]
    head = identifier | (_LONG if identifier > _SHORT else 0) | (_REMOTE if cut.frame.remote else 0)
    return Packet(cut.time, BUS_SOCKET, head.to_bytes(4, "big") + bytes((len(data), 0, 0, 0)) + data)


def receive(line: LineAddress) -> Iterator[Chunk]:
    """Yield the messages on a bus; silence is a message without data. Raises UnclearError."""
    try:
        bus = open_bus(line)
    except ModuleNotFoundError as error:
        raise UnclearError(f"{line.scheme}://: {error}", "pip install 'fieldscribe[live]'") from error
    try:
        while True:
            received = bus.recv(SILENCE)
            if received is None:
                yield Chunk(None, SILENT, b"")
            elif not received.is_error_frame:
                remote, identifier = received.is_remote_frame, received.arbitration_id
                yield Chunk(time.time(), MESSAGE, bytes(received.data), identifier=identifier, remote=remote)
    except OSError as error:
        raise line.wrong(f"it went away: {error}") from error
    finally:
        bus.shutdown()


def action(result: FrameResult) -> str:
    """Return the kind of a message in a word."""
    return str(result.details.get("message", "message"))


def chunk_of_text(text: str) -> Chunk:
    """Return the message in a line of candump. Raises HexError for a line without one."""
    try:
        frame = read_frames([text])[0]
    except (UnclearError, IndexError) as error:
        raise HexError(str(error)) from error
    stamp = frame.stamp.strip("()")
    time = float(stamp) if stamp.count(".") == 1 and len(stamp) > 1 else None
    return Chunk(time, MESSAGE, frame.data, frame.bus, identifier=frame.id, remote=frame.remote)
