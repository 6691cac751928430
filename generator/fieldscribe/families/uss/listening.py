"""Cuts what is heard of USS into telegrams: by their start, length and check byte."""

from __future__ import annotations

from collections.abc import Iterator

from fieldscribe.families.frame_results import FrameResult
from fieldscribe.families.uss import parts
from fieldscribe.families.uss.telegrams import LEAST_BYTES, START, check_byte
from fieldscribe.listening.chunks import BYTES, Chunk
from fieldscribe.listening.cutting import ByteCutter, packet
from fieldscribe.listening.lines import serial_chunks
from fieldscribe.listening.logs import logged_bytes as chunk_of_text
from fieldscribe.live.lines import LineAddress

__all__ = ["KINDS", "PORTS", "action", "chunk_of_text", "cutter", "hear", "packet"]

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
    """Return what cuts chunks into telegrams."""
    return ByteCutter(_size_at, _LONGEST, None, 2)


def hear(line: LineAddress) -> Iterator[Chunk]:
    """Yield what comes on a line. Raises UnclearError."""
    return serial_chunks(line, "8E1")


def action(result: FrameResult) -> str:
    """Return what an exchange does, in a word."""
    task = result.details.get("task")
    return "process data" if not task else "write" if task in parts.TASK_WIDTHS else "read"
