"""The folder of the user's own cache, where what can be computed again is kept between runs."""

from __future__ import annotations

import os
from pathlib import Path


def cache_dir(name: str) -> Path | None:
    """A folder for that purpose, made if need be; None where there is no place that only this user can write to."""
    base = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    place = Path(base) / "fieldscribe" / name
    try:
        place.mkdir(mode=0o700, parents=True, exist_ok=True)
        status = place.stat()
    except OSError:
        return None
    # what is loaded from here is trusted, so nobody else may have written it
    private = not hasattr(os, "getuid") or (status.st_uid == os.getuid() and not status.st_mode & 0o022)
    return place if private and os.access(place, os.W_OK) else None
