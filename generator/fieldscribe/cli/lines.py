"""The lines of a stream as they come, in constant memory: a capture may last for days."""

from __future__ import annotations

from typing import IO, TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

_CHUNK = 1 << 16
MOST = 1 << 16
"""How many bytes of a line are read; one that is longer ends in dots, and so in a message."""


def lines_of(stream: IO[str] | IO[bytes], before_waiting: Callable[[], object]) -> Iterator[tuple[int, str]]:
    """The lines that are not blank, with their numbers; `before_waiting` is called when all that has come is read."""
    rest, number = b"", 0
    for chunk in _chunks(stream, before_waiting):
        *whole, rest = (rest + chunk).splitlines(keepends=True)
        if rest.endswith(b"\n"):
            whole, rest = [*whole, rest], b""
        rest = rest[: MOST + 1]
        for line in whole:
            number += 1
            if line.strip():
                yield number, _text(line, number)
    if rest.strip():
        yield number + 1, _text(rest, number + 1)


def _text(line: bytes, number: int) -> str:
    text = line[:MOST].decode("utf-8", "replace").strip()
    text = text.removeprefix("\ufeff") if number == 1 else text
    return text if len(line) <= MOST else f"{text}..."


def _chunks(stream: IO[str] | IO[bytes], before_waiting: Callable[[], object]) -> Iterator[bytes]:
    source = getattr(stream, "buffer", stream)
    read = getattr(source, "read1", source.read)
    while chunk := read(_CHUNK):
        yield chunk if isinstance(chunk, bytes) else chunk.encode()
        before_waiting()
