"""What tests of output share: a project with one device."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from support.places import ROOT


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with descriptions/jumo_controller, the working folder, with a cache of its own."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    place = tmp_path / "project"
    shutil.copytree(ROOT / "descriptions/jumo_controller", place / "descriptions/jumo_controller")
    monkeypatch.chdir(place)
    return place
