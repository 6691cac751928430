"""Keeps the contents of a device's files until all are made: large ones on disk, not in memory."""

from collections.abc import Iterator
from hashlib import sha256
from os import SEEK_END
from typing import IO, NamedTuple, Self

_LARGE = 1 << 20


class Contents(NamedTuple):
    """The contents of a file: digest, size, and the bytes or their place in a spool."""

    digest: str
    size: int
    data: bytes
    spool: IO[bytes] | None = None
    start: int = 0

    def pieces(self) -> Iterator[bytes]:
        """Yield all bytes, piece by piece."""
        if self.spool is None:
            yield self.data
            return
        self.spool.seek(self.start)
        for at in range(0, self.size, _LARGE):
            yield self.spool.read(min(_LARGE, self.size - at))


def contents_of(data: bytes) -> Contents:
    """Return the contents for bytes that stay in memory."""
    return Contents(sha256(data).hexdigest(), len(data), data)


class Spool:
    """An unnamed temporary file, created for the first large text; it disappears when the run ends, in any way.

    A child process that shares the file uses `keep_apart`: such contents travel without the file.
    """

    def __init__(self) -> None:
        self._file: IO[bytes] | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        if self._file is not None:
            self._file.close()

    def keep(self, text: str) -> Contents:
        """Return the contents for a text; a large one goes to the file. Raises UnicodeEncodeError."""
        if len(text) < _LARGE:
            return contents_of(text.encode())
        spool, digest, size = self._opened(), sha256(), 0
        start = spool.seek(0, SEEK_END)
        for at in range(0, len(text), _LARGE):
            data = text[at : at + _LARGE].encode()
            digest.update(data)
            size += spool.write(data)
        return Contents(digest.hexdigest(), size, b"", spool, start)

    def keep_apart(self, text: str) -> Contents:
        """Return the contents for a text, in a child process. Raises UnicodeEncodeError."""
        return self.keep(text)._replace(spool=None)

    def joined(self, contents: Contents) -> Contents:
        """Return contents from `keep_apart`, joined with the file that has them."""
        return contents if len(contents.data) == contents.size else contents._replace(spool=self._opened())

    def share(self) -> Self:
        """Return the spool with its file, flushed, so that a child process can share it."""
        self._opened().flush()
        return self

    def _opened(self) -> IO[bytes]:
        if self._file is None:
            from tempfile import TemporaryFile

            self._file = TemporaryFile()  # noqa: SIM115 - closed with the spool
        return self._file
