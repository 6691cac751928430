"""The conformance runner for Python: it passes what is right and fails what is wrong."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from c_device import rare_device
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import find_devices, load_device
from fieldscribe.render import render
from fieldscribe.resources import descriptions_dir
from fieldscribe.targets import vectors
from models import kitchen_sink, sample_device
from python_package import write_package
from rust_crates import odd_device

if TYPE_CHECKING:
    from fieldscribe.model import Device

RUNNER = Path(__file__).with_name("conformance.py")


def conformance(folder: Path, text: str, device: str = "sample_drive") -> tuple[int, str]:
    """Runs the runner as users do; its exit code and output."""
    (folder / "vectors.json").write_text(text, encoding="utf-8")
    command = [sys.executable, str(RUNNER), str(folder), device, str(folder / "vectors.json")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_package(sample_device(), tmp_path_factory.mktemp("python"))


def shipped() -> list[Path]:
    """The descriptions that come with the compiler."""
    return find_devices([descriptions_dir()], Report())


@pytest.mark.parametrize("description", shipped(), ids=lambda path: path.parent.name)
def test_shipped_devices_pass(description: Path, tmp_path: Path) -> None:
    device = load_device(description, Report())
    assert device is not None
    every_vector_passes(device, write_package(device, tmp_path))


def test_all_vectors_pass(folder: Path) -> None:
    every_vector_passes(sample_device(), folder)


@pytest.mark.parametrize("device", [rare_device(), odd_device(), kitchen_sink()], ids=lambda device: str(device.id))
def test_other_models_pass(device: Device, tmp_path: Path) -> None:
    every_vector_passes(device, write_package(device, tmp_path))


def every_vector_passes(device: Device, folder: Path) -> None:
    """Runs all vectors of a device and holds the counts against those of the file."""
    text = next(iter(vectors.outputs(device, render)))[1]
    code, output = conformance(folder, text, device.id)
    counts = json.loads(text)["counts"]
    assert code == 0, output
    lines = output.splitlines()
    assert sorted(lines[:-1]) == sorted(f"{kind} {count} passed, 0 failed" for kind, count in counts.items() if count)
    assert lines[-1:] == [
        f"total {sum(counts.values())} passed, 0 failed",
    ]


WRONG = (
    {"kind": "decode", "point": "base_frequency", "raw": 500, "status": "ok", "float": "4049000000000001"},
    {"kind": "encode", "point": "base_frequency", "float": "4049000000000000", "status": "ok", "raw": 501},
    {"kind": "encode", "point": "base_frequency", "float": "7ff8000000000000", "status": "out_of_range"},
    {"kind": "decode_count", "point": "temperature", "raw": 0x7FFF, "status": "ok", "count": 0},
    {"kind": "encode_count", "point": "frequency_source", "count": 7, "status": "out_of_range"},
    {"kind": "check", "point": "upper_limit", "with": {"lower_limit": 60}, "raw": 59, "status": "ok"},
    {"kind": "name", "point": "frequency_source", "raw": 1, "name": "keypad"},
    {"kind": "special", "point": "upper_limit", "special": "inactive", "low": 0, "high": 1},
    {"kind": "flag", "point": "status_word", "raw": 8, "flag": "fault", "number": 0},
    {"kind": "bits", "point": "delay_class", "word": 0xC000, "raw": 3, "replaced": 1, "result": 0x8000},
    {"kind": "words", "point": "swapped_count", "raw": 1, "words": [0, 1]},
    {"kind": "address", "point": "base_frequency", "space": "holding", "address": 0x1029, "words": 1},
    {"kind": "block", "group": "main", "index": 0, "space": "holding", "function": 3, "address": 0x1013, "count": 3},
    {
        "kind": "build",
        "framing": "rtu",
        "unit": 5,
        "transaction": 0,
        "function": 6,
        "address": 0x1028,
        "values": [500],
        "status": "ok",
        "bytes": "0506102801f4a854",
    },
    {
        "kind": "reply",
        "framing": "rtu",
        "unit": 5,
        "transaction": 0,
        "function": 6,
        "address": 0x1028,
        "values": [500],
        "bytes": "0506102801f40c91",
        "status": "bad_crc",
        "values_out": [],
    },
)


def test_every_wrong_vector_fails(folder: Path) -> None:
    code, output = conformance(folder, json.dumps({"vectors": WRONG}))
    assert code == 1
    assert output.splitlines()[-1] == f"total 0 passed, {len(WRONG)} failed"
