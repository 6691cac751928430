"""Addresses that count from a base, in C: given numbers, and blocks that are found whatever a device holds."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.c_device import SANITIZING, program, run_program, write_headers
from support.described import made


@pytest.mark.parametrize("way", SANITIZING)
def test_bases(way: str, tmp_path: Path) -> None:
    folder = write_headers(made("kitchen_blocks"), tmp_path) / "c"
    run_program(program("bases"), way, folder, tmp_path, "-Wno-unused-function")
