"""The conformance vectors of a device: the right answers for every language, computed from the model alone.

This target shares no code with the others, so that a mistake in one of them is not repeated in its test.
"""

from collections.abc import Iterable
from operator import eq

from fieldscribe.code_view import DeviceCache
from fieldscribe.model import Device
from fieldscribe.resources import Render

WEIGHT = 0.9

_last: DeviceCache[str] = DeviceCache(eq)
"""Vectors as text, shared by a page and a file."""


def outputs(device: Device, render: Render) -> Iterable[tuple[str, str]]:
    """Return the one file of this target: its path, and one vector per line. `render` is not needed."""
    del render
    yield f"vectors/{device.id}.txt", text_of(device)


def text_of(device: Device) -> str:
    """Return the vectors of a device as text."""
    from fieldscribe.targets.vectors.collection import collect

    return _last.of(device, lambda device: collect(device).text(device.id, device.version, device.digest))
