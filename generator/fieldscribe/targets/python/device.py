"""The view of the device module, with its two device classes, and what a family offers the Python target."""

from collections.abc import Callable
from operator import attrgetter
from typing import NamedTuple

from fieldscribe.families import family
from fieldscribe.model import Device, Point
from fieldscribe.targets.python.syntax import Identifiers, attribute, imported, parameter, sorted_imports
from fieldscribe.text import pascal, python_doc, python_string

RUNTIME = "fieldscribe_runtime"
"""The package that all generated devices share."""


class Line(NamedTuple):
    """A transport of the runtime for examples: its module, and expressions that open it, for both kinds of devices."""

    module: str
    blocking: str
    awaiting: str
    first: tuple[str, ...] = ()
    """Further lines of import that the expressions need."""
    settings: tuple[str, ...] = ()
    """Further arguments of the device after the line and the unit."""

    def imports(self, wait: str) -> tuple[str, ...]:
        """Return the classes that the expression names, in order."""
        classes = [part.partition("(")[0] for part in (self.blocking, self.awaiting)]
        if not wait:
            return (classes[0],)
        return (classes[1], classes[0]) if f"({classes[0]}(" in self.awaiting else (classes[1],)


class PythonFamily(NamedTuple):
    """What generated modules import for a family.

    `module` of the runtime has the names in `exports`, the class `device` and its `transport`, and both with `Async`
    before their names. `line` returns the usual transport. `settings` are further parameters of a
    device's constructor (name, class).
    """

    module: str
    exports: frozenset[str]
    device: str
    transport: str
    line: Callable[[Device], Line]
    settings: tuple[tuple[str, str], ...] = ()


def in_python(device: Device) -> PythonFamily:
    """Return the part `targets.calls` of the device's family."""
    part: PythonFamily = family(device.family).part("targets.calls").IN_PYTHON
    return part


def uses(device: Device, name: str, wait: str) -> tuple[str, ...]:
    """Return the lines of an example that uses the class with points of the device."""
    point = _example(device)
    if point is None:
        return ()
    name_of_point, line = attribute(point.item), in_python(device).line(device)
    settings = "".join([f", {setting}" for setting in line.settings])
    variants = "".join([f", {parameter(axis)}={python_string(values[0])}" for axis, values in device.variants.items()])
    variants += "".join([f", {parameter(given.name)}={given.low}" for given in device.given])
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
    usual = list(filter(_is_usual, device.points))
    fitting = [point for point in usual if point.writable] or usual
    return min(list(filter(_is_quantity, fitting)) or fitting, key=_RANK, default=None)


_RANK = attrgetter("rank")


def _is_usual(point: Point) -> bool:
    return point.generated and point.readable and point.variant is None and point.when is None


def _is_quantity(point: Point) -> bool:
    return point.form in ("scaled", "float") and not point.specials


def device_context(device: Device, names: Identifiers) -> dict[str, object]:
    """Return the context of the device module: its classes with examples, the variants' axes, given numbers."""
    bus = in_python(device)
    classes = ((names.device_class, "", ""), (names.async_class, "Async", "await "))
    return {
        "module": bus.module,
        "imports": imports_of(device),
        "settings": bus.settings,
        "axes": [
            {
                "key": python_string(axis),
                "parameter": parameter(axis),
                "type": f"{pascal(axis)}Choice",
                "choices": [python_string(value) for value in values],
            }
            for axis, values in device.variants.items()
        ],
        "given": [(each.name, parameter(each.name)) for each in device.given],
        "classes": [
            {
                "name": name,
                "base": kind + bus.device,
                "transport": kind + bus.transport,
                "example": f"{wait}drive.point.read()",
                "uses": uses(device, name, wait),
            }
            for name, kind, wait in classes
        ],
    }


def imports_of(device: Device) -> tuple[str, ...]:
    """Return the lines that import the base classes, and names that only a constructor with variants needs."""
    bus = in_python(device)
    used = {bus.device, f"Async{bus.device}"}
    if device.variants or device.given:
        used |= {bus.transport, f"Async{bus.transport}", *(kind for _, kind in bus.settings)}
    return imported(bus.module, sorted_imports(used))
