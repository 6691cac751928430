"""How the suite is parted among processes: what takes long comes first, so that short tests fill the end."""

from __future__ import annotations

import gc
import os
from collections.abc import Callable
from itertools import islice
from pathlib import Path
from typing import TypeVar

import pytest
from hypothesis import settings
from support.c_device import Folders
from support.small_drive import Output

EXAMPLES = int(os.environ.get("FIELDSCRIBE_EXAMPLES", "50"))
settings.register_profile("patient", settings.default, deadline=None, max_examples=EXAMPLES)
settings.load_profile("patient")  # a busy machine is no failure
gc.set_threshold(50_000, 50)  # models are large and have few cycles: the usual 700 cost a tenth of the time

T = TypeVar("T")
UNTOLD = 2.0
"""The seconds that a test of the full suite is taken to need when its marker does not tell."""


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Where processes share the work, each begins with its part of the long tests, the longest first."""
    items[:] = dealt(items, seconds, getattr(config, "workerinput", {}).get("workercount", 1))


def pytest_collection_finish() -> None:
    """Keeps what is imported and loaded by now out of every collection of garbage."""
    gc.freeze()


def dealt(items: list[T], seconds: Callable[[T], float], count: int) -> list[T]:
    """The tests in such an order that xdist, which cuts it in equal parts, gives each process its share of long ones.

    Short tests stay beside those of their file, whose fixtures they share.
    """
    long = sorted((item for item in items if seconds(item)), key=seconds, reverse=True)
    short = iter([item for item in items if not seconds(item)])
    order: list[T] = []
    for place in range(count):
        size = (len(items) - len(order)) // (count - place)
        own = long[count - 1 - place :: count]
        order += [*own, *islice(short, size - len(own))]
    return order


def seconds(item: pytest.Item) -> float:
    """What a test of the full suite is expected to take; nothing for a quick one."""
    marker = item.get_closest_marker("full")
    return 0.0 if marker is None else float(marker.kwargs.get("seconds", UNTOLD))


@pytest.fixture(scope="session")
def folders(tmp_path_factory: pytest.TempPathFactory) -> Folders:
    """The generated C of the made devices."""
    from support.c_device import Folders

    return Folders(tmp_path_factory)


@pytest.fixture(scope="session")
def rust_libraries(tmp_path_factory: pytest.TempPathFactory, pytestconfig: pytest.Config) -> Path:
    """The crates of the made devices and of gateways in Rust, with optimization and checked arithmetic."""
    from support.rust_workspace import built_libraries

    return built_libraries(tmp_path_factory, pytestconfig)


@pytest.fixture
def loads_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """So many commands ask for so few devices; how these are read and compiled is tried elsewhere."""
    from fieldscribe import pipeline
    from fieldscribe.cli import listing
    from support.loaded_once import load_analysis, load_device

    monkeypatch.setattr(pipeline, "load_device", load_device)
    monkeypatch.setattr(listing, "load_analysis", load_analysis)


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Callable[..., Output]:
    """Run a command line in this process and return how it ended."""
    from fieldscribe.cli import main
    from support.small_drive import Output

    return lambda *words: Output(main(words), *capsys.readouterr())


@pytest.fixture
def small(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Make a folder with ./descriptions/small_drive the working folder, and return the folder of the device."""
    from support.described import write
    from support.small_drive import DEVICE, MAIN

    folder = tmp_path / "descriptions" / "small_drive"
    write(folder, DEVICE, main=MAIN.replace("TITLE", "Speed"))
    monkeypatch.chdir(tmp_path)
    return folder
