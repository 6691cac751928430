"""The user's cache folder. It holds plain data that can be computed again; nothing in it is executed."""

from __future__ import annotations

import os
from pathlib import Path


def cache_dir(name: str) -> Path | None:
    """The cache folder for one purpose, created if missing; None without a folder that only this user can write to."""
    base = os.environ.get("XDG_CACHE_HOME", "")
    if not os.path.isabs(base):  # the XDG specification: a relative path is to be ignored
        base = os.path.expanduser("~/.cache")
    if not os.path.isabs(base):
        return None  # there is no home folder
    place = Path(base) / "fieldscribe" / name
    try:
        place.mkdir(mode=0o700, parents=True, exist_ok=True)
        status = place.lstat()
    except OSError:
        return None
    # a cache that others wrote could make stale outputs pass for unchanged, but do no more harm
    private = not hasattr(os, "getuid") or (status.st_uid == os.getuid() and not status.st_mode & 0o022)
    return place if private and os.access(place, os.W_OK) else None
