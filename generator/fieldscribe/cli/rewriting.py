"""Replaces files of a description: all of them, or none."""

from __future__ import annotations

import os
import stat
from collections.abc import Mapping
from pathlib import Path

from fieldscribe.cli.common import StopError

_FLAGS = os.O_WRONLY | os.O_CREAT | os.O_EXCL
for _name in ("O_NOFOLLOW", "O_CLOEXEC", "O_BINARY", "O_NOINHERIT"):
    _FLAGS |= getattr(os, _name, 0)
_MARK = b"\xef\xbb\xbf"
"""The byte order mark that some editors put before a text in UTF-8."""


def rewrite(texts: Mapping[str, tuple[str, str]]) -> None:
    """Replace the text of each file, given as it was read and as it is to be. Raises StopError."""
    waiting: list[tuple[Path, Path, bytes]] = []
    try:
        for name, (before, after) in texts.items():
            waiting.append(_staged(Path(name).resolve(), before, after))
        _replace_all(waiting)
    except OSError as error:
        raise StopError(f"cannot write {error.filename}: {error.strerror}", "nothing was changed") from error
    finally:
        for _, new, _ in waiting:
            new.unlink(missing_ok=True)


def _staged(place: Path, before: str, after: str) -> tuple[Path, Path, bytes]:
    """Write the new file beside the old one, with its mode; return both paths and the bytes of the old one."""
    from fieldscribe.language.source import MOST_BYTES
    from fieldscribe.safe_files import read_regular

    data = read_regular(place, MOST_BYTES).data
    if data.decode("utf-8-sig", "replace") != before:
        raise StopError(f"`{place.name}` was changed while it was read", "nothing was changed: run the command again")
    new = place.with_name(f".{place.name}.fieldscribe-new")
    new.unlink(missing_ok=True)
    mode = stat.S_IMODE(place.stat().st_mode)
    with open(os.open(new, _FLAGS, mode & 0o600), "wb") as stream:
        stream.write((_MARK if data.startswith(_MARK) else b"") + after.encode())
    os.chmod(new, mode)
    return place, new, data


def _replace_all(waiting: list[tuple[Path, Path, bytes]]) -> None:
    """Put all new files in place; if that fails for one, restore the others."""
    for number, (place, new, _) in enumerate(waiting):
        try:
            os.replace(new, place)
        except OSError:
            for done, _, data in waiting[:number]:
                done.write_bytes(data)
            raise
