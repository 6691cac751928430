"""Writes a dependency file for make and ninja: the outputs depend on the inputs and on the compiler itself.

Both tools compare times. An output whose contents did not change would stay older than a changed input, and would be
built again each time; so outputs older than an input are touched. Each input has an empty rule, so that a build goes
on after an input was removed.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Iterable
from errno import EINVAL
from pathlib import Path
from time import time_ns

from fieldscribe.output.writing import replace
from fieldscribe.resources import compiler_files
from fieldscribe.safe_files import UnfitFileError, kind_of

_BREAK = " \\\n  "


def update_depfile(place: Path, outputs: Iterable[Path], inputs: Iterable[Path]) -> None:
    """Write the file, and touch outputs that are older than an input. Raises OSError.

    Outputs keep the paths that the user gave, because a build knows them by these.
    """
    made = list(outputs)
    sources = [*inputs, *map(Path, compiler_files())]
    needed = [Path(os.path.abspath(source)) for source in sources]  # a build may run in another folder
    write_depfile(place, made, needed)
    newest = max(path.stat().st_mtime_ns for path in needed)
    for path in made:
        if path.stat().st_mtime_ns < newest:
            now = max(newest, time_ns())  # an input may be from the future
            os.utime(path, ns=(now, now))


def write_depfile(place: Path, outputs: Iterable[Path], inputs: Iterable[Path]) -> None:
    """Write the file atomically. Raises OSError."""
    names = list(dict.fromkeys(map(_escaped, inputs)))
    rules = [f"{' '.join(map(_escaped, outputs))}: {_BREAK.join(names)}", *(f"{name}:" for name in names)]
    _put(Path(os.path.realpath(place)), ("\n".join(rules) + "\n").encode("utf-8", "surrogateescape"))


def _escaped(path: Path) -> str:
    """Return the path with blanks, `#` and `$` escaped. Raises UnfitFileError for control characters."""
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
