"""The languages that a device is compiled to.

To add a target: write a folder here with what `Target` lists (`tests/toy_target` is the smallest one), templates if it
needs them, and add a line to `TARGETS`. `text.py` has the names, strings and comments of each language (`pascal`,
`c_comment`); `identifiers.py` has the head of a generated file. Without the head a file is known only by its checksum.
"""

from __future__ import annotations

from collections.abc import Iterable
from importlib import import_module
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from fieldscribe.model import Device
    from fieldscribe.resources import Render
    from fieldscribe.targets.identifiers import Names

    class Target(Protocol):
        """The interface of a target's module."""

        SEES_TITLES: bool
        """True if it gets titles, notes and sources too; the other targets get names only (code_view.py)."""

        FAMILY_PART: str
        """The part of a family without which it cannot compile a device; empty if it needs none."""

        BEFORE_POINTS: tuple[str, ...]
        """The words that may come between the names of device and point in identifiers: with them a proof replaces
        the comparison of all identifiers. Empty if some identifier of a point lacks its full name.
        """

        WEIGHT: float
        """Its time relative to the others; two processes divide the targets of a large run by it."""

        def outputs(self, device: Device, render: Render, *, tests: bool = True) -> Iterable[tuple[str, str]]:
            """Return the files of a device: path below the output folder, and text.

            A target of code leaves out its conformance `tests` for a project that vendors the device.
            """

        def runtime(self, device: Device, *, tests: bool = True) -> Iterable[tuple[str, str]]:
            """Return the source files beside them: path below the output folder, and path below the templates."""

        def identifiers(self, device: Device) -> Iterable[Names]:
            """Return every name of the device in generated code; none if names cannot clash."""

        def device_name_taken(self, name: str) -> str:
            """Return why no device may have that name, as the rest of a sentence; empty if it may."""


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
    module: Any = import_module(f"fieldscribe.targets.{name}")
    target_module: Target = module
    return target_module


def knows(name: str, device: Device) -> bool:
    """Return True if the family of a device has the part that a target needs."""
    from fieldscribe.families import family  # a `generate` with nothing changed starts without it

    part = target(name).FAMILY_PART
    return not part or family(device.family).part(part) is not None
