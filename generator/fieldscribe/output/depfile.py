"""A rule for make and ninja: the outputs depend on the inputs."""

from __future__ import annotations

import os
import stat
from errno import EINVAL
from pathlib import Path
from typing import TYPE_CHECKING

from fieldscribe.output.writing import replace
from fieldscribe.reading import UnfitFileError, kind_of

if TYPE_CHECKING:
    from collections.abc import Iterable


def write_depfile(place: Path, outputs: Iterable[Path], inputs: Iterable[Path]) -> None:
    """Write the rule atomically. Raises OSError."""
    outputs_escaped = " ".join(map(_escaped, outputs))
    needed = " \\\n  ".join(map(_escaped, inputs))
    _put(Path(os.path.realpath(place)), f"{outputs_escaped}: {needed}\n".encode("utf-8", "surrogateescape"))


def _escaped(path: Path) -> str:
    """The path with blanks, `#` and `$` escaped; a path that could end the line or the rule is refused."""
    text = str(path)
    if any(ord(char) < 0x20 or char == "\x7f" for char in text):
        raise UnfitFileError(EINVAL, f"make cannot name the path {text!a}: rename it")
    return text.replace("\\", "/").replace("$", "$$").replace("#", "\\#").replace(" ", "\\ ")


def _put(place: Path, data: bytes) -> None:
    try:
        status = os.stat(place)
    except FileNotFoundError:
        replace(place, (data,), f".{place.name}.new")
        return
    if stat.S_ISREG(status.st_mode):
        replace(place, (data,), f".{place.name}.new")
    elif stat.S_ISCHR(status.st_mode):
        place.write_bytes(data)  # a device such as /dev/null cannot be replaced
    else:
        raise UnfitFileError(EINVAL, str(kind_of(status)), str(place))
