"""The view of the device module: the two device classes and their variants."""

from __future__ import annotations

from operator import attrgetter

from fieldscribe.model import Device, Point
from fieldscribe.targets.python.families import RUNTIME, in_python
from fieldscribe.targets.python.identifiers import Identifiers, attribute, parameter, sorted_imports
from fieldscribe.targets.python.layout import imported
from fieldscribe.text import pascal, python_doc, python_string


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


def device_context(device: Device, names: Identifiers) -> dict[str, object]:
    """Return the context of the device module: its classes with examples of their use, and the variants' axes."""
    family = in_python(device)
    classes = ((names.device_class, "", ""), (names.async_class, "Async", "await "))
    return {
        "module": family.module,
        "imports": imports_of(device),
        "settings": family.settings,
        "axes": [
            {
                "key": python_string(axis),
                "parameter": parameter(axis),
                "type": f"{pascal(axis)}Choice",
                "choices": [python_string(value) for value in values],
            }
            for axis, values in device.variants.items()
        ],
        "classes": [
            {
                "name": name,
                "base": kind + family.device,
                "transport": kind + family.transport,
                "example": f"{wait}drive.point.read()",
                "uses": uses(device, name, wait),
            }
            for name, kind, wait in classes
        ],
    }


def imports_of(device: Device) -> tuple[str, ...]:
    """Return the lines that import the base classes; and what the constructor names, which only variants need."""
    family = in_python(device)
    used = {family.device, f"Async{family.device}"}
    if device.variants:
        used |= {family.transport, f"Async{family.transport}", *(kind for _, kind in family.settings)}
    return imported(family.module, sorted_imports(used))
