"""The conformance runner for TypeScript: it passes what is right and fails what is wrong."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.model import Device
from fieldscribe.resources import render
from fieldscribe.targets import vectors
from support.c_device import rare_device
from support.described import kitchen_sink, made
from support.models import sample_device
from support.places import ROOT
from support.python_families import can_device, uss_device
from support.rust_crates import odd_device
from support.toolchains import succeed, tool
from support.typescript_packages import RUNNER, SHIPPED, install, package_name
from support.vector_file import counts_of, spoil

QUICK = ("jumo_controller",)


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


def vectors_of(device: Device, folder: Path) -> Path:
    path = folder / "vectors.txt"
    path.write_text(next(iter(vectors.outputs(device, render)))[1], encoding="utf-8")
    return path


def with_enums(device: Device) -> Device:
    """The device with the enums that only digits name."""
    enums = {one.name: one for one in (*device.enums, *(point.digits.enum for point in device.points if point.digits))}
    return replace(device, enums=tuple(enums.values()))


@pytest.mark.parametrize(
    "vectors_file",
    [
        pytest.param(path, id=path.stem, marks=() if path.stem in QUICK else pytest.mark.full)
        for path in sorted((ROOT / "generated/vectors").glob("*.txt"))
    ],
)
def test_shipped_devices_pass(vectors_file: Path, tmp_path: Path) -> None:
    """As they lie in `generated/`, which is held current elsewhere."""
    install(tmp_path, [SHIPPED / vectors_file.stem])
    every_vector_passes(tmp_path, vectors_file.stem.replace("_", "-"), vectors_file)


@pytest.mark.parametrize(
    "device",
    [
        with_enums(rare_device()),
        made("kitchen_blocks"),
        *(
            pytest.param(device, marks=pytest.mark.full)
            for device in (
                made("kitchen_can"),
                made("kitchen_uss"),
                odd_device(),
                kitchen_sink(),
                made("kitchen_codes"),
                can_device(),
                uss_device(),
            )
        ),
    ],
    ids=lambda device: str(device.id),
)
def test_other_models_pass(device: Device, tmp_path: Path) -> None:
    install(tmp_path, [device])
    every_vector_passes(tmp_path, package_name(device), vectors_of(device, tmp_path))


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
