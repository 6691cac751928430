"""The conformance vectors of a device: what every language has to answer, computed from the model alone.

Nothing here is shared with the other targets: a wrong rule in one of them cannot repeat itself in its own test.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.model import Device
    from fieldscribe.render import Render
    from fieldscribe.targets.identifiers import Names

FOR_PEOPLE = False
NEEDS_FAMILY = False


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
    """Vectors have the names of the description, as they are."""
    del device
    return ()


def device_name_taken(name: str) -> str:
    """Every name will do for a file of vectors."""
    del name
    return ""
