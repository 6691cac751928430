"""The conformance runner for TypeScript: it passes what is right and fails what is wrong."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.model import Device
from fieldscribe.resources import render
from fieldscribe.targets import vectors
from support import described
from support.conforming import OTHER_MODELS, generated_vectors, write_vectors
from support.models import sample_device
from support.python_families import can_device, uss_device
from support.quick import full_but
from support.toolchains import succeed, tool
from support.typescript_packages import RUNNER, SHIPPED, install, package_name
from support.vector_file import counts_of, spoil


def results_of(folder: Path, package: str, vectors_file: Path) -> dict[str, Any]:
    """How many vectors of each kind pass and fail, and the first that fail."""
    found: dict[str, Any] = json.loads(
        succeed([tool("node"), RUNNER, folder / "node_modules", package, vectors_file], cwd=folder)
    )
    return found


def every_vector_passes(folder: Path, package: str, vectors_file: Path) -> None:
    found = results_of(folder, package, vectors_file)
    assert not found["failed"], found
    expected = counts_of(vectors_file.read_text("utf-8"), "typescript")
    assert found["passed"] == {kind: count for kind, count in expected.items() if count}


@pytest.mark.parametrize("device", full_but(("jumo_controller",), described.SHIPPED))
def test_shipped_devices_pass(device: str, tmp_path: Path) -> None:
    install(tmp_path, [SHIPPED / device])
    every_vector_passes(tmp_path, device.replace("_", "-"), generated_vectors(device))


@pytest.mark.parametrize("device", OTHER_MODELS, ids=lambda device: str(device.id))
def test_other_models_pass(device: Device, tmp_path: Path) -> None:
    install(tmp_path, [device])
    every_vector_passes(tmp_path, package_name(device), write_vectors(device, tmp_path))


@pytest.mark.parametrize(
    "device",
    [sample_device(), *(pytest.param(device, marks=pytest.mark.full) for device in (can_device(), uss_device()))],
    ids=lambda device: str(device.id),
)
def test_every_wrong_vector_fails(device: Device, tmp_path: Path) -> None:
    install(tmp_path, [device])
    text, spoiled = spoil(next(iter(vectors.outputs(device, render)))[1], "typescript")
    (tmp_path / "spoiled.txt").write_text(text, encoding="utf-8")
    found = results_of(tmp_path, package_name(device), tmp_path / "spoiled.txt")
    assert found["failed"] == spoiled, found["passed"]
