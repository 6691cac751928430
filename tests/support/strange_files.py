"""Things that can lie in place of a file: links, pipes, folders."""

from __future__ import annotations

import os
from pathlib import Path

KINDS = ("lock link", "folder", "pipe", "device", "huge", "unreadable")


def put(kind: str, place: Path) -> None:
    """Put one of them in that place."""
    if kind == "lock link":
        place.symlink_to("someone@host.4711:1700000000")  # as an editor does
    elif kind == "folder":
        place.mkdir()
    elif kind == "pipe":
        os.mkfifo(place)
    elif kind == "device":
        place.symlink_to("/dev/zero")
    elif kind == "huge":
        place.touch()
        os.truncate(place, 3 << 30)
    else:
        place.write_text("x")
        place.chmod(0)
