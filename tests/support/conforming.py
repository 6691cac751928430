"""The devices whose vectors the runners of Python and TypeScript pass."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from fieldscribe.model import Device
from fieldscribe.resources import render
from fieldscribe.targets import vectors

from support.c_device import rare_device
from support.described import kitchen_sink, made
from support.places import ROOT
from support.python_families import can_device, uss_device
from support.rust_crates import odd_device


def with_enums(device: Device) -> Device:
    """Return the device with the enums that only digits name."""
    enums = {one.name: one for one in (*device.enums, *(point.digits.enum for point in device.points if point.digits))}
    return replace(device, enums=tuple(enums.values()))


OTHER_MODELS = [
    made("kitchen_blocks"),
    *(
        pytest.param(device, marks=pytest.mark.full)
        for device in (
            with_enums(rare_device()),
            made("kitchen_can"),
            made("kitchen_uss"),
            odd_device(),
            kitchen_sink(),
            made("kitchen_codes"),
            can_device(),
            uss_device(),
        )
    ),
]


def generated_vectors(device: str) -> Path:
    """Return the vectors as they lie in `generated/`, which is held current elsewhere."""
    return ROOT / f"generated/vectors/{device}.txt"


def write_vectors(device: Device, folder: Path) -> Path:
    """Write the vectors of a device and return their file."""
    path = folder / "vectors.txt"
    path.write_text(next(iter(vectors.outputs(device, render)))[1], encoding="utf-8")
    return path
