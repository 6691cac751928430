"""The generated package of the sample drive, a drive of it, and the peer that answers."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import can
import pytest
from support.models import sample_device
from support.places import PACKAGES
from support.python_package import Slave, imported, write_package


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the package and its runtime."""
    return write_package(sample_device(), tmp_path_factory.mktemp("python"))


@pytest.fixture(scope="module")
def package(folder: Path) -> Iterator[Any]:
    """The package, imported with a runtime of its own for each module of tests."""
    yield from imported(folder, "sample_drive")


@pytest.fixture
def slave() -> Slave:
    """The other end of the line."""
    return Slave()


@pytest.fixture
def drive(package: Any, slave: Slave) -> Any:
    """A drive of one variant on that line."""
    return package.SampleDrive(slave, unit=5, voltage_class="400V")


@pytest.fixture
def l200() -> Iterator[Any]:
    """The generated package of a drive on Modbus."""
    yield from imported(PACKAGES, "hitachi_l200")


@pytest.fixture
def mpu2s() -> Iterator[Any]:
    """The generated package of a device on CAN."""
    yield from imported(PACKAGES, "woodward_mpu2s")


@pytest.fixture
def bus() -> Iterator[tuple[can.BusABC, can.BusABC]]:
    """Both ends of a bus."""
    far = can.Bus("line", interface="virtual")
    yield can.Bus("line", interface="virtual"), far
    far.shutdown()
