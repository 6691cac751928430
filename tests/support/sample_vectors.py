"""The vectors of the sample device, as a runner in Python reads them."""

from __future__ import annotations

from fieldscribe.model import Device
from fieldscribe.resources import render
from fieldscribe.targets.vectors import outputs

from support.models import sample_device
from support.vector_file import Vector, counts_of, plain, vectors_of


def text_of(device: Device) -> str:
    """The one file."""
    [(path, text)] = outputs(device, render)
    assert path == f"vectors/{device.id}.txt"
    return text


def vectors(device: Device) -> list[Vector]:
    """The vectors of a device that are not for other languages alone, without what is absent."""
    text = text_of(device)
    kinds = counts_of(text)
    return [plain(vector) for vector in vectors_of(text) if vector["kind"] in kinds]


SAMPLE = sample_device()
VECTORS = vectors(SAMPLE)
