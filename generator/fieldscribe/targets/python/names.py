"""All identifiers of a generated package by namespace."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.names import pascal, upper
from fieldscribe.targets.identifiers import Identifier, Owner
from fieldscribe.targets.python.device import device_view
from fieldscribe.targets.python.identifiers import Identifiers, attribute, parameter, word_attribute

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device, Point

OWN = Owner("target", "what the package needs")


def identifiers(device: Device) -> Iterator[Identifier]:
    """Every name that the description decides, and those that the package needs beside them."""
    names = Identifiers(device)
    yield from _of_device(device, names)
    for enum in device.enums:
        owner = Owner("enum", enum.name)
        for entry in enum.entries:
            space = f"Python, enums.{names.enum_class(enum.name)}"
            yield Identifier(space, upper(entry.name), owner._replace(part=f"entry {entry.name}"))
    for point in device.points:
        if point.generated:
            yield from _of_point(point)
    yield from _commands(device)


def _of_device(device: Device, names: Identifiers) -> Iterator[Identifier]:
    """The device module, the constructor of its classes, and what the package exports."""
    module, view = "Python, the device module", device_view(device, names)
    for name in ("Literal", "Points", *view.imports):
        yield Identifier(module, name, OWN)
    for name in (names.device_class, names.async_class):
        yield Identifier(module, name, Owner("device", device.id, f"class {name}"))
    for axis in device.variants:
        yield Identifier(module, f"{pascal(axis)}Choice", Owner("variant", axis))
    for name in ("transport", "unit", "self", *(name for name, _ in view.settings)):
        yield Identifier("Python, the constructor", name, OWN)
    for axis in device.variants:
        yield Identifier("Python, the constructor", parameter(axis), Owner("variant", axis))


def _of_point(point: Point) -> Iterator[Identifier]:
    owner, space = Owner("point", point.item), "Python, the points"
    yield Identifier(space, attribute(point.item), owner)
    if point.variant is not None:
        yield Identifier(space, attribute(point.name), Owner("point", point.name))
    for old in point.was:
        yield Identifier(space, attribute(old), Owner("point", point.name, f"old name {old}"))
    for flag in point.flags:
        named = owner._replace(part=f"flag {flag.name}")
        for name in (upper(flag.name), word_attribute(flag.name)):
            yield Identifier(f"Python, the flags of {point.item}", name, named)


def _commands(device: Device) -> Iterator[Identifier]:
    points = {name for point in device.points for name in (point.item, point.name)}
    for command in device.commands:
        name = f"{command.name}_command" if command.name in points else command.name
        yield Identifier("Python, the points", attribute(name), Owner("command", command.name))
