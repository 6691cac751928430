"""The headers of made devices, which many programs of the tests include."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.c_device import write_headers
from support.described import made
from support.made_once import made_once


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with the headers of one kitchen of each family."""

    def make(out: Path) -> None:
        for name in ("kitchen_sink", "kitchen_can", "kitchen_uss"):
            write_headers(made(name), out)

    return made_once(tmp_path_factory, "kitchens", make) / "c"
