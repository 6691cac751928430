"""The contents of the files of one device until all are made: large ones wait on disk and not in memory."""

from __future__ import annotations

from hashlib import sha256
from os import SEEK_END
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import IO, Self

_LARGE = 1 << 20


class Kept(NamedTuple):
    """The contents of a file: checksum, size, and the bytes, or where they wait."""

    digest: str
    size: int
    data: bytes
    spool: IO[bytes] | None = None
    start: int = 0

    def pieces(self) -> Iterator[bytes]:
        """All bytes, a piece after the other."""
        if self.spool is None:
            yield self.data
            return
        self.spool.seek(self.start)
        for at in range(0, self.size, _LARGE):
            yield self.spool.read(min(_LARGE, self.size - at))


def kept(data: bytes) -> Kept:
    """Bytes that stay in memory."""
    return Kept(sha256(data).hexdigest(), len(data), data)


class Spool:
    """A nameless temporary file, made for the first large contents; it is gone when the run ends, however it ends."""

    def __init__(self) -> None:
        self._file: IO[bytes] | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        if self._file is not None:
            self._file.close()

    def keep(self, text: str) -> Kept:
        """Keep this text. Raises UnicodeEncodeError."""
        if len(text) < _LARGE:
            return kept(text.encode())
        spool, digest, size = self._opened(), sha256(), 0
        start = spool.seek(0, SEEK_END)
        for at in range(0, len(text), _LARGE):
            data = text[at : at + _LARGE].encode()
            digest.update(data)
            size += spool.write(data)
        return Kept(digest.hexdigest(), size, b"", spool, start)

    def _opened(self) -> IO[bytes]:
        if self._file is None:
            from tempfile import TemporaryFile

            self._file = TemporaryFile()  # noqa: SIM115 - closed with the spool
        return self._file
