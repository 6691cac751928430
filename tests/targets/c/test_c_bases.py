"""Addresses that count from a base, in C: given numbers, and blocks that are found whatever a device holds."""

from __future__ import annotations

from pathlib import Path

import pytest
from fieldscribe.resources import render
from fieldscribe.targets.c import outputs
from support.c_device import SANITIZING, program, run_program, write_headers
from support.described import made


@pytest.mark.parametrize("way", SANITIZING)
def test_bases(way: str, tmp_path: Path) -> None:
    device = made("kitchen_blocks")
    folder = write_headers(device, tmp_path) / "c"
    for path, text in outputs(device, render, tests=False, rows=True):
        (folder / Path(path).name).write_text(text, "utf-8")
    run_program(program("bases"), way, folder, tmp_path, "-Wno-unused-function")
