"""The languages that a device is compiled to.

To add a target: write a folder here with what `Target` lists (`tests/toy_target` is the smallest one), templates if it
needs them, and add a line to `TARGETS`. `text.py` has the names, strings and comments of each language (`pascal`,
`c_comment`); `identifiers.py` has the head of a generated file. Without the head a file is known only by its checksum.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fieldscribe.model import Device
    from fieldscribe.targets.identifiers import Names


class Target:
    """What a target's module says; it leaves out what is as here."""

    SEES_TITLES = False
    """True if it gets titles, notes and sources too; the other targets get names only (code_view.py)."""

    FAMILY_PART = ""
    """The part of a family without which it cannot compile a device; empty if it needs none."""

    BEFORE_POINTS: tuple[str, ...] = ("",)
    """The words that may come between the names of device and point in identifiers: with them a proof replaces
    the comparison of all identifiers. Empty if some identifier of a point lacks its full name.
    """

    WEIGHT: float
    """Its time relative to the others; two processes divide the targets of a large run by it."""

    outputs: Callable[..., Iterable[tuple[str, str]]]
    """Returns the files of a device, from it and `Render`: path below the output folder, and text.

    A target of code leaves out its conformance `tests` for a project that vendors the device.
    """

    def __init__(self, module: ModuleType) -> None:
        vars(self).update(vars(module))

    def runtime(self, _device: Device, **_ways: bool) -> Iterable[tuple[str, str]]:
        """Return the source files beside them: path below the output folder, and path below the templates."""
        return ()

    def identifiers(self, _device: Device) -> Iterable[Names]:
        """Return every name of the device in generated code; none if names cannot clash."""
        return ()

    def device_name_taken(self, _name: str) -> str:
        """Return why no device may have that name, as the rest of a sentence; empty if it may."""
        return ""


TARGETS = (
    "c",
    "python",
    "rust",
    "vectors",
    "typescript",
    "docs",
)
"""All targets by name, in the order in which they are written."""


def target(name: str) -> Target:
    """Return the target of that name; its module is imported on first use."""
    return Target(import_module(f"fieldscribe.targets.{name}"))


def knows(name: str, device: Device) -> bool:
    """Return True if the family of a device has the part that a target needs."""
    from fieldscribe.families import family  # a `generate` with nothing changed starts without it

    part = target(name).FAMILY_PART
    return not part or family(device.family).part(part) is not None
