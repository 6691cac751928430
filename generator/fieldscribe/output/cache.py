"""The folder of the user's own cache. It holds plain data that can be computed again, and nothing that is executed."""

from __future__ import annotations

import os
from pathlib import Path


def cache_dir(name: str) -> Path | None:
    """A folder for that purpose, made if need be; None where there is no place that only this user can write to."""
    base = os.environ.get("XDG_CACHE_HOME", "")
    if not os.path.isabs(base):  # as the XDG specification asks: a relative one is none
        base = os.path.expanduser("~/.cache")
    if not os.path.isabs(base):
        return None  # nobody's home
    place = Path(base) / "fieldscribe" / name
    try:
        place.mkdir(mode=0o700, parents=True, exist_ok=True)
        status = place.lstat()
    except (OSError, ValueError):
        return None
    # what others wrote here could call stale outputs unchanged; it could do nothing else
    private = not hasattr(os, "getuid") or (status.st_uid == os.getuid() and not status.st_mode & 0o022)
    return place if private and os.access(place, os.W_OK) else None
