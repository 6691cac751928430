"""The conformance runner for Python: it passes what is right and fails what is wrong."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from c_device import kitchen, rare_device
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import find_devices, load_device
from fieldscribe.render import render
from fieldscribe.resources import descriptions_dir
from fieldscribe.targets import vectors
from models import kitchen_sink, sample_device
from python_families import can_device, uss_device
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


def with_enums(device: Device) -> Device:
    """The device with the enums that only digits name."""
    enums = {one.name: one for one in (*device.enums, *(point.digits.enum for point in device.points if point.digits))}
    return replace(device, enums=tuple(enums.values()))


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


@pytest.mark.parametrize(
    "device",
    [with_enums(rare_device()), odd_device(), kitchen_sink(), kitchen("kitchen_can"), can_device(), uss_device()],
    ids=lambda device: str(device.id),
)
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


@pytest.mark.parametrize("name", ["kitchen_can", "kitchen_uss"])
def test_kitchens_pass(name: str, tmp_path: Path) -> None:
    device = load_device(Path(__file__).parent / "devices" / name / "device.yaml", Report())
    assert device is not None
    every_vector_passes(device, write_package(device, tmp_path))


def test_every_wrong_vector_fails(folder: Path) -> None:
    code, output = conformance(folder, json.dumps({"vectors": WRONG}))
    assert code == 1
    assert output.splitlines()[-1] == f"total 0 passed, {len(WRONG)} failed"


WRONG_CAN = (
    {"kind": "place", "point": "fault_text", "addresses": [736, 737, 738, 739], "index": None, "telegram": None},
    {"kind": "place", "point": "frequency", "addresses": [0], "index": None, "telegram": "other"},
    {"kind": "fixed", "point": "slow_ramp", "mask": 0xF1, "bits": 0},
    {"kind": "text_decode", "point": "fault_text", "words": [0x4120, 0x2020, 0x2020, 0x2020], "text": "4120"},
    {
        "kind": "text_encode",
        "point": "fault_text",
        "text": "41",
        "status": "ok",
        "words": [0x2020, 0x2020, 0x2020, 0x4120],
    },
    {
        "kind": "text_encode",
        "point": "fault_text",
        "text": "e4",
        "status": "ok",
        "words": [0xE420, 0x2020, 0x2020, 0x2020],
    },
    {"kind": "digits", "point": "delays", "raw": 12345, "digits": [1, 2, 3, 4]},
    {"kind": "digits_encode", "point": "delays", "digits": [1, 1, 1, 3], "status": "ok", "raw": 1113},
    {"kind": "digits_encode", "point": "delays", "digits": [1, 1, 1, 2], "status": "ok", "raw": 2111},
    {
        "kind": "can_build",
        "message": "read_request",
        "unit": 31,
        "address": 1,
        "raw": 0,
        "status": "ok",
        "id": 0x33F,
        "bytes": "",
    },
    {
        "kind": "can_build",
        "message": "read_request",
        "unit": 5,
        "address": 508,
        "raw": 0,
        "status": "ok",
        "id": 0x33E,
        "bytes": "ff0501fc0000fef9",
    },
    {
        "kind": "can_parse",
        "message": "read_answer",
        "unit": 5,
        "id": 0x325,
        "bytes": "ff0501fc0007fef9",
        "status": "ok",
        "address": 508,
        "raw": 7,
    },
    {
        "kind": "can_parse",
        "message": "read_answer",
        "unit": 5,
        "id": 0x325,
        "bytes": "ff0501fc0007fefe",
        "status": "ok",
        "address": 508,
        "raw": 8,
    },
    {
        "kind": "can_telegram",
        "telegram": "measurements",
        "unit": 0,
        "frames": [[0x320, "dd00000100020003"]],
        "taken": [0],
        "point": "frequency",
        "status": "ok",
        "raw": 1,
    },
    {
        "kind": "can_telegram",
        "telegram": "measurements",
        "unit": 0,
        "frames": [[0x320, "dd01000000000001"], [0x320, "dd02000000000000"]],
        "taken": [1, 1],
        "point": "hours",
        "status": "ok",
        "raw": 65536,
    },
)
_LINK = {"pkw": 4, "pzd": 0, "single_first": False, "unit": 3, "task": 1, "parameter": 700, "index": 0}
_SENT = {**_LINK, "width": 0, "value": 0, "words": []}
_FOUND = {**_LINK, "response": 1, "width": 1, "error": 0, "words": []}
WRONG_USS = (
    {"kind": "place", "point": "baud_rate", "addresses": [2010], "index": 0, "telegram": None},
    {"kind": "uss_build", **_SENT, "status": "ok", "bytes": "020a0312bc0000000000000a5"},
    {"kind": "uss_build", **_SENT, "status": "bad_task", "bytes": ""},
    {
        "kind": "uss_broadcast",
        "pkw": 4,
        "pzd": 0,
        "mask": [6, 0, 0, 0],
        "words": [],
        "status": "ok",
        "bytes": "020a2000060000000000002f",
    },
    {"kind": "uss_reply", **_FOUND, "bytes": "020a0312bc000000000005a0", "status": "ok", "value": 6},
    {"kind": "uss_reply", **_FOUND, "bytes": "020a0372bc000000110000d4", "status": "refused", "value": 0, "error": 16},
    {"kind": "uss_printed_build", "frame": "one", **_SENT, "status": "ok", "bytes": ""},
    {"kind": "uss_printed_reply", "frame": "one", **_FOUND, "bytes": "02", "status": "wrong_start", "value": 0},
)


@pytest.mark.parametrize(
    ("device", "wrong"), [(can_device(), WRONG_CAN), (uss_device(), WRONG_USS)], ids=["can", "uss"]
)
def test_every_wrong_vector_of_a_family_fails(
    device: Device, wrong: tuple[dict[str, object], ...], tmp_path: Path
) -> None:
    code, output = conformance(write_package(device, tmp_path), json.dumps({"vectors": wrong}), device.id)
    assert code == 1
    assert output.splitlines()[-1] == f"total 0 passed, {len(wrong)} failed"
