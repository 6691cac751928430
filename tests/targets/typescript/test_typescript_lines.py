"""Generated TypeScript over real lines: every point of simulated devices, and faults that the next request survives."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.simulation import Simulated, simulated
from fieldscribe.text import camel
from support.node_device import NodeDevice, bridged, installed, node_device

RTU, TCP, USS = ("tcp", "rtu"), ("tcp", "tcp"), ("tcp", "uss")
VARIANTS = {
    "hitachi_l200": {"voltage_class": "400V"},
    "siemens_mm4": {"model": "mm440", "interface": "rs485"},
    "woodward_mpu2s": {"voltage": "400V"},
}
LINK = {"siemens_mm4": {"link": {"pkw": 127, "pzd": 4}}}
GIVEN: dict[str, dict[str, int]] = {}
LINES = [
    ("eastron_sdm630", "tcp", "rtu", "tcp"),
    ("fronius_datamanager", "tcp", "tcp", "tcp"),
    ("hitachi_l200", "tcp", "rtu", "tcp"),
    ("jumo_controller", "tcp", "rtu", "tcp"),
    ("nord_sk5xxe", "tcp", "rtu", "tcp"),
    ("siemens_mm4", "tcp", "uss", "tcp"),
    ("woodward_mpu2s", "can", "", "can"),
    ("hitachi_l200", "serial", "rtu", "serial"),
    ("siemens_mm4", "serial", "uss", "serial"),
    ("hitachi_l200", "serial", "rtu", "modbus-serial"),
    ("fronius_datamanager", "tcp", "tcp", "modbus-serial"),
]
"""Device, where it answers, the framing, and the line of the runtime."""


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with the generated packages."""
    return installed(tmp_path_factory.mktemp("typescript"))


@contextmanager
def connected(
    folder: Path, device: str, on: str, framing: str, kind: str, **settings: Any
) -> Iterator[tuple[Simulated, NodeDevice]]:
    """Yield a simulated device, and the generated one in node that talks to it."""
    variants = VARIANTS.get(device, {})
    made = [f"{axis}={value}" for axis, value in variants.items()]
    settings |= {"framing": framing} if framing else {}
    with simulated(device, on=on, variants=made, given=GIVEN.get(device, {}), **settings) as drive:
        options = {camel(axis): value for axis, value in variants.items()} | LINK.get(device, {})
        with (
            _line(drive, on, kind) as line,
            node_device(folder, device, line | {"framing": framing}, unit=drive.unit, **options) as node,
        ):
            yield drive, node


@contextmanager
def _line(drive: Simulated, on: str, kind: str) -> Iterator[dict[str, Any]]:
    if on != "can":
        yield {"kind": kind, "path": drive.path} if on == "serial" else {"kind": kind, "port": drive.port}
        return
    with bridged(drive.url.rpartition("/")[2]) as port:
        yield {"kind": kind, "port": port}
