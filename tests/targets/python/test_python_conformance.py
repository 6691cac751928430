"""The conformance runner for Python: it passes what is right and fails what is wrong."""

from __future__ import annotations

import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest
from conformance import running
from conformance.runtime import CHECKS
from fieldscribe.model import Device
from fieldscribe.resources import render
from fieldscribe.targets import vectors
from support.conforming import OTHER_MODELS, generated_vectors, write_vectors
from support.described import SHIPPED
from support.models import sample_device
from support.places import ROOT, TESTS
from support.python_families import can_device, uss_device
from support.python_package import imported, write_package
from support.quick import full_but
from support.vector_file import counts_of, spoil

GENERATED = ROOT / "generated"
RUNNER = TESTS / "conformance"
PROMISES = 1 + len(CHECKS)
"""What the runner holds beside the vectors: the widths of flags, and what the runtime promises for any device."""


def conformance(folder: Path, text: str, device: str = "sample_drive") -> tuple[int, str]:
    """Runs the runner as users do; its exit code and output."""
    (folder / "vectors.txt").write_text(text, encoding="utf-8")
    command = [sys.executable, str(RUNNER), str(folder), device, str(folder / "vectors.txt")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


@pytest.mark.parametrize("device", full_but(("siemens_mm4",), SHIPPED))
def test_shipped_devices_pass(device: str) -> None:
    every_vector_passes(device, GENERATED / "python", generated_vectors(device))


@pytest.mark.parametrize("device", OTHER_MODELS, ids=lambda device: str(device.id))
def test_other_models_pass(device: Device, tmp_path: Path) -> None:
    every_vector_passes(device.id, write_package(device, tmp_path), write_vectors(device, tmp_path))


def every_vector_passes(device: str, folder: Path, vectors_file: Path) -> None:
    """Run all vectors of a device in this process and hold the counts against those of the file."""
    with contextmanager(imported)(folder, device):
        passed, failed, shown = running.run(folder, device, vectors_file, show=20)
        sys.path.remove(str(folder))  # the runner leaves it there
    assert not failed, shown
    expected = counts_of(vectors_file.read_text("utf-8")) | {"runtime": PROMISES}
    assert passed == {kind: count for kind, count in expected.items() if count}


def test_the_command_passes_what_is_right(folder: Path) -> None:
    device = sample_device()
    text = next(iter(vectors.outputs(device, render)))[1]
    code, output = conformance(folder, text, device.id)
    counts = counts_of(text)
    assert code == 0, output
    lines = output.splitlines()
    counts["runtime"] = PROMISES
    assert sorted(lines[:-1]) == sorted(f"{kind} {count} passed, 0 failed" for kind, count in counts.items() if count)
    assert lines[-1:] == [f"total {sum(counts.values())} passed, 0 failed"]


@pytest.mark.parametrize(
    "device",
    [sample_device(), *(pytest.param(device, marks=pytest.mark.full) for device in (can_device(), uss_device()))],
    ids=lambda device: str(device.id),
)
def test_every_wrong_vector_fails(device: Device, tmp_path: Path) -> None:
    text, spoiled = spoil(next(iter(vectors.outputs(device, render)))[1])
    code, output = conformance(write_package(device, tmp_path), text, device.id)
    failed = {row[0]: int(row[3]) for row in map(str.split, output.splitlines()) if row[0] != "runtime"}
    assert code == 1
    assert failed == {**spoiled, "total": sum(spoiled.values())}
