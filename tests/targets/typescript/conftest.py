"""The shipped packages as npm lays them out."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.node_device import installed


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with the generated packages."""
    return installed(tmp_path_factory.mktemp("typescript"))
