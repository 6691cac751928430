"""USS lines: serial lines, with the settings of the device's telegrams.

Received bytes are cut into telegrams by start, length and check byte.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from fieldscribe.families.frame_results import FrameResult
from fieldscribe.families.uss import telegrams
from fieldscribe.families.uss.telegrams import LEAST_BYTES, START, VARIABLE, check_byte, default_link
from fieldscribe.listening.chunks import BYTES, ByteCutter, Chunk, packet, serial_chunks
from fieldscribe.listening.chunks import logged_bytes as chunk_of_text
from fieldscribe.live.lines import SERIAL_KEYS, LineAddress, OpenLine
from fieldscribe.model import Device

if TYPE_CHECKING:
    from fieldscribe_runtime.transports.serial import UssLine
    from fieldscribe_runtime.uss import UssDevice


SCHEMES: dict[str, tuple[str, ...]] = {"uss": (*SERIAL_KEYS, "pkw", "pzd", "single_first")}
EXAMPLES = ("uss:///dev/ttyUSB0?baud=9600&pkw=4&pzd=2",)


def open_line(line: LineAddress, timeout: dict[str, Any]) -> UssLine:
    """Return the runtime's transport; `timeout` is empty for its usual one. Raises UnclearError."""
    from fieldscribe_runtime.transports.serial import UssLine

    return UssLine(**line.serial(UssLine.MODE), **timeout)


def device_on(line: OpenLine, kind: type[Any], model: Device, unit: int, variants: dict[str, str]) -> Any:
    """Return a device of the runtime, with the link of the line."""
    from fieldscribe_runtime.uss import Link

    usual = default_link(model.bus)
    return kind(line.transport, unit, Link(*_link(line, usual.pkw, usual.pzd)), **variants)


def _link(line: OpenLine, pkw: int, pzd: int) -> tuple[int, int, bool]:
    """Return the link of the line, else the given one. Raises UnclearError."""
    address = line.address
    pkw, pzd = (address.number(key, usual, (0, VARIABLE)) for key, usual in (("pkw", pkw), ("pzd", pzd)))
    return pkw, pzd, address.choice("single_first", "no", ("no", "yes")) == "yes"


UNITS = (0, 31)


def any_device(line: OpenLine, unit: int) -> UssDevice:
    """Return a device of which only the protocol is known."""
    from fieldscribe_runtime import Telegram
    from fieldscribe_runtime.uss import Link, Profile, UssDevice

    link = Link(*_link(line, VARIABLE, 2))
    reply = Telegram("reply", "response", link.pzd)
    profile = Profile(units=UNITS, pkw=(link.pkw,), pzd=(0, link.pzd), tasks={0: (0,)}, telegrams=(reply,))
    made: UssDevice = type("Unknown", (UssDevice,), {"PROFILE": profile})(line.transport, unit, link)
    return made


def probe(device: UssDevice) -> str:
    """Send process data that commands nothing; return the answer of the device. Raises FieldscribeError."""
    return f"word 1 of its process data is {device.read_at('reply', 0)[0]:04X}h"


__all__ = ["KINDS", "PORTS", "action", "chunk_of_text", "cutter", "packet", "receive"]

KINDS = (BYTES,)
PORTS: frozenset[int] = frozenset()
_LONGEST = 256


def _size_at(data: bytes, begins: bool) -> int:
    del begins
    if data[0] != START:
        return 0
    size = data[1] + 2 if len(data) > 1 else LEAST_BYTES
    if len(data) < size:
        return -1
    return size if size >= LEAST_BYTES and not check_byte(data[:size]) else 0


def cutter() -> ByteCutter:
    """Return the cutter for chunks of bytes."""
    return ByteCutter(_size_at, _LONGEST, None, 2)


def receive(line: LineAddress) -> Iterator[Chunk]:
    """Yield the chunks received on a line. Raises UnclearError."""
    return serial_chunks(line, "8E1")


def action(result: FrameResult) -> str:
    """Return the action of an exchange in a word."""
    task = result.details.get("task")
    return "process data" if not task else "write" if task in telegrams.TASK_WIDTHS else "read"
