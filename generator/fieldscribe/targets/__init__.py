"""The languages that a device is compiled to. A target is a folder here, a folder of templates and a line below."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from fieldscribe.families import family

if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Protocol

    from fieldscribe.model import Device
    from fieldscribe.render import Render
    from fieldscribe.targets.identifiers import Names

    class Target(Protocol):
        """What a target's module offers."""

        SEES_TITLES: bool
        """Whether it also sees titles, notes and sources; the others see names only (code_view.py)."""

        NEEDS_FAMILY: bool
        """Whether it can say only devices whose family has a part for it."""

        NAMES_CONTAIN_POINT: bool
        """Whether what it calls a thing of a point holds the point's name whole: checks need not list all of them."""

        def outputs(self, device: Device, render: Render) -> Iterable[tuple[str, str]]:
            """The files of a device: path relative to the output folder, and text."""

        def runtime(self, device: Device) -> Iterable[tuple[str, str]]:
            """Real source that goes beside them: path below the output folder, and path below the templates folder."""

        def vendored(self, device: Device, render: Render) -> Iterable[tuple[str, str]]:
            """What a project needs to use the device, without tests: path below the project's folder, and text."""

        def vendored_runtime(self, device: Device) -> Iterable[tuple[str, str]]:
            """Real source that goes beside it: path below the project's folder, and path below the templates."""

        def identifiers(self, device: Device) -> Iterable[Names]:
            """Every name that the device gets in generated code; none where names cannot meet."""

        def device_name_taken(self, name: str) -> str:
            """Why no device may have that name, as a sentence goes on behind it; empty where it may."""


TARGETS = (
    "c",
    "python",
    "rust",
    "docs",
    "vectors",
)
"""All targets by name, in the order in which they are written."""


def target(name: str) -> Target:
    """The target of that name; its module is imported when first asked for."""
    module: Any = import_module(f"fieldscribe.targets.{name}")
    target_module: Target = module
    return target_module


def knows(name: str, device: Device) -> bool:
    """Whether a target can be generated for a device: whether its family has the part that the target needs."""
    return not target(name).NEEDS_FAMILY or family(device.family).part(f"targets.{name}") is not None
