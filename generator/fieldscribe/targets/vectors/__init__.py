"""The conformance vectors of a device: the right answers for every language, computed from the model alone.

This target shares no code with the others, so that a mistake in one of them cannot be in its test too.
"""

from __future__ import annotations

from collections.abc import Iterable

from fieldscribe.model import Device
from fieldscribe.resources import Render
from fieldscribe.targets.identifiers import Names

SEES_TITLES = False
NEEDS_FAMILY = False
BEFORE_POINTS = ("",)


def outputs(device: Device, render: Render) -> Iterable[tuple[str, str]]:
    """The one file of this target: its path, and one vector per line. `render` is not needed."""
    from fieldscribe.targets.vectors.collection import collect

    del render
    yield f"vectors/{device.id}.txt", collect(device).text(device.id, device.version, device.digest)


def runtime(device: Device) -> Iterable[tuple[str, str]]:
    """No files are copied beside the vectors."""
    del device
    return ()


def identifiers(device: Device) -> Iterable[Names]:
    """Vectors have the names of the description, which need no check of their own."""
    del device
    return ()


def device_name_taken(name: str) -> str:
    """A file of vectors may have any name."""
    del name
    return ""
