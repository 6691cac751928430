"""Folders that all processes of a run share: the first user fills a folder, the others wait."""

from __future__ import annotations

import fcntl
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest


def made_once(factory: pytest.TempPathFactory, name: str, make: Callable[[Path], object]) -> Path:
    """Return the folder of that name, which `make` fills once a run; tests only read it."""
    base = factory.getbasetemp()
    if base.name.startswith("popen-"):  # of one process of xdist: the folder above is that of the run
        base = base.parent
    place, done = base / name, base / f"{name}-is-made"
    with (base / f"{name}-lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not done.exists():
            shutil.rmtree(place, ignore_errors=True)
            place.mkdir()
            make(place)
            done.touch()
    return place
