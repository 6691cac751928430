"""Replaces files of a description: all of them, or none."""

from __future__ import annotations

import stat
from collections.abc import Mapping
from pathlib import Path

from fieldscribe.cli.common import StopError
from fieldscribe.language.source import MOST_BYTES
from fieldscribe.output.writing import replace
from fieldscribe.safe_files import read_regular

_MARK = b"\xef\xbb\xbf"
"""The byte order mark that some editors put before a text in UTF-8."""


def rewrite(texts: Mapping[str, tuple[str, str]]) -> None:
    """Replace the text of each file, given as it was read and as it is to be; modes stay. Raises StopError."""
    before: dict[Path, bytes] = {}
    replaced: list[Path] = []
    try:
        for name, (text, _) in texts.items():
            place = Path(name).resolve()
            before[place] = read_regular(place, MOST_BYTES).data
            if before[place].decode("utf-8-sig", "replace") != text:
                hint = "nothing was changed: run the command again"
                raise StopError(f"`{place.name}` was changed while it was read", hint)
        for name, (_, text) in texts.items():
            place = Path(name).resolve()
            mark = _MARK if before[place].startswith(_MARK) else b""
            mode = stat.S_IMODE(place.stat().st_mode)
            replace(place, (mark, text.encode()), f".{place.name}.fieldscribe-new", mode=mode)
            replaced.append(place)
    except OSError as error:
        for place in replaced:
            place.write_bytes(before[place])
        raise StopError(f"cannot write {error.filename}: {error.strerror}", "nothing was changed") from error
