"""What a bus family says of itself to the Python target."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families import family
from fieldscribe.targets.python.layout import Node, call
from fieldscribe.text import python_string

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from fieldscribe.model import Device, Point, Telegram
    from fieldscribe.targets.python.scope import PackageScope

RUNTIME = "fieldscribe_runtime"
"""The package that all generated devices share."""

_MAKERS = {"r": "ReadOnly", "w": "WriteOnly", "rw": "ReadWrite"}


@dataclass(frozen=True, slots=True)
class Flavour:
    """A device class of the runtime and the transport that it takes."""

    device: str
    transport: str


@dataclass(frozen=True, slots=True)
class PythonFamily:
    """What generated modules take from the runtime, and what a device says of its bus.

    `module` holds the names in `exports` and those of the flavours. `settings` are further parameters of a device's
    constructor, name and class. `maker` names what makes a point's attribute.
    """

    module: str
    exports: frozenset[str]
    blocking: Flavour
    awaiting: Flavour
    settings: tuple[tuple[str, str], ...]
    profile: Callable[[Device, PackageScope], Node]
    blocks: Callable[[Device, PackageScope], Node | None]
    maker: Callable[[Point], str]


def in_python(device: Device) -> PythonFamily:
    """What the device's family says of itself, in its part `targets.python`."""
    said: PythonFamily = family(device.family).part("targets.python").IN_PYTHON
    return said


def usual_maker(point: Point) -> str:
    """What makes the attribute of a point that says no more than whether it is read and written."""
    return _MAKERS["".join(letter for letter in "rw" if letter in point.access)]


def no_blocks(device: Device, scope: PackageScope) -> None:
    """For families whose reads are not planned."""
    del device, scope


def telegrams(made: Iterable[Telegram], scope: PackageScope) -> tuple[Node, ...]:
    """The telegrams of a device."""
    found = []
    for one in made:
        scope.used.add("Telegram")
        message = () if one.message is None else (python_string(one.message),)
        found.append(
            call("Telegram", (python_string(one.name), python_string(one.direction), str(one.words), *message))
        )
    return tuple(found)
