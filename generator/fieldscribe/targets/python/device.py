"""The view of the device module: the two device classes and their variants."""

from __future__ import annotations

from dataclasses import dataclass
from operator import attrgetter
from typing import TYPE_CHECKING

from fieldscribe.names import pascal
from fieldscribe.targets.python.families import RUNTIME, in_python
from fieldscribe.targets.python.identifiers import Identifiers, attribute, parameter, sorted_imports
from fieldscribe.targets.python.layout import imported
from fieldscribe.text import python_doc, python_string

if TYPE_CHECKING:
    from fieldscribe.model import Device, Point


@dataclass(frozen=True, slots=True)
class Axis:
    """One variant axis: its key, the constructor's parameter, the type of its values, and their literals."""

    key: str
    parameter: str
    type: str
    values: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class DeviceClass:
    """A device class: its name, its base class in the runtime, its transport, and an example of its use."""

    name: str
    base: str
    transport: str
    example: str
    uses: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class DeviceModule:
    """The device module: the lines of its imports, its classes, their variants, and further settings of the bus."""

    module: str
    imports: tuple[str, ...]
    classes: tuple[DeviceClass, ...]
    axes: tuple[Axis, ...]
    settings: tuple[tuple[str, str], ...]


def uses(device: Device, name: str, wait: str) -> tuple[str, ...]:
    """Return the lines of an example that uses the class with points of the device."""
    point = _example(device)
    if point is None:
        return ()
    family, name_of_point = in_python(device), attribute(point.item)
    line = family.line(device)
    settings = "".join([f", {setting}" for setting in line.settings])
    variants = "".join([f", {parameter(axis)}={python_string(values[0])}" for axis, values in device.variants.items()])
    inside = [f"drive = {name}(line, 1{settings}{variants})", f"print({wait}drive.{name_of_point}.read())"]
    if point.writable:
        inside.append(f"{wait}drive.{name_of_point}.write(value)")
    inside.append(f"{wait}drive.read_many({python_string(point.group)})")
    opened = f"async with {line.awaiting} as line:" if wait else f"with {line.blocking} as line:"
    names = ", ".join(line.imports(wait))
    lines = [
        *line.first,
        f"from {RUNTIME}.transports.{line.module} import {names}",
        "",
        opened,
        *(f"    {text}" for text in inside),
    ]
    lines += [f"{name}.{name_of_point}.decode(raw)", f"help({name}.{name_of_point})"]
    return tuple([text and " " * (len(text) - len(text.lstrip())) + python_doc(text.lstrip()) for text in lines])


def _example(device: Device) -> Point | None:
    """Return the point for the example: one to read and write, else one to read; of these one that is a quantity."""
    for is_fit in (_is_settable, _is_usual):
        fitting = list(filter(is_fit, device.points))
        if fitting:
            return min(filter(_is_quantity, fitting), key=_RANK, default=None) or min(fitting, key=_RANK)
    return None


_RANK = attrgetter("rank")


def _is_usual(point: Point) -> bool:
    return point.generated and point.readable and point.variant is None and point.when is None


def _is_settable(point: Point) -> bool:
    return point.writable and _is_usual(point)


def _is_quantity(point: Point) -> bool:
    return point.form in ("scaled", "float") and not point.specials


def device_view(device: Device, names: Identifiers) -> DeviceModule:
    """Return the classes of the device."""
    family = in_python(device)
    axes = tuple(
        Axis(python_string(axis), parameter(axis), f"{pascal(axis)}Choice", tuple(map(python_string, values)))
        for axis, values in device.variants.items()
    )
    blocking, awaiting = family.blocking, family.awaiting
    classes = tuple(
        DeviceClass(name, flavour.device, flavour.transport, f"{wait}drive.point.read()", uses(device, name, wait))
        for name, flavour, wait in ((names.device_class, blocking, ""), (names.async_class, awaiting, "await "))
    )
    used = {blocking.device, awaiting.device}
    if axes:  # only then does the class have a constructor of its own
        used |= {blocking.transport, awaiting.transport, *(kind for _, kind in family.settings)}
    return DeviceModule(family.module, imported(family.module, sorted_imports(used)), classes, axes, family.settings)
