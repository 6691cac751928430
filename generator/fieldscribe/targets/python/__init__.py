"""The Python target: a typed package per device with all its identifiers, and the runtime that all of them share."""

import sys
from collections.abc import Iterable, Iterator
from keyword import iskeyword
from operator import attrgetter

from fieldscribe import __version__
from fieldscribe.model import Device, Flag, Point
from fieldscribe.resources import Render, runtime_files
from fieldscribe.targets.identifiers import Names, Owner, head_lines
from fieldscribe.targets.python.syntax import (
    RUNTIME,
    Identifiers,
    attribute,
    comment,
    imported,
    in_python,
    parameter,
    sorted_imports,
    word_attribute,
    wrapped,
)
from fieldscribe.targets.runtime_calls import shared_identifiers
from fieldscribe.text import pascal, python_doc, python_string, toml_string, upper
from fieldscribe.wording import open_texts

LIBRARIES = frozenset({"can", "pymodbus", "serial", "typing_extensions"})
"""The packages that transports of the runtime import if a project uses them."""

_OWN = Owner("target", "what the package needs")
_SPACES = "Python, the points", "Python, the classes of numbers and flags"


def device_name_taken(name: str) -> str:
    """Return why no package may have that name; empty if it may."""
    if iskeyword(name):
        return "is a word that Python reserves, so that no program could name its package"
    if name in sys.stdlib_module_names:
        return "is a module of Python's own, which the generated package would hide"
    if name in LIBRARIES:
        return "is a library that the runtime's transports import, which the generated package would hide"
    return ""


def identifiers(device: Device) -> Iterator[Names]:
    """Yield every name that depends on the description, and the fixed names in the same namespaces."""
    names = Identifiers(device)
    yield from _of_device(device, names)
    yield from shared_identifiers(device, names, _SPACES, attribute, _flag_attributes)


def _flag_attributes(flag: Flag) -> tuple[str, str]:
    """Return the member of a flag, and its reader."""
    return upper(flag.name), word_attribute(flag.name)


def _of_device(device: Device, names: Identifiers) -> Iterator[Names]:
    """Yield the names in the device module, in the constructor of its classes, and in the exports of the package."""
    module, constructor = "Python, the device module", "Python, the constructor"
    yield Names(module, _OWN, ("Literal", "Points", *imports_of(device)))
    yield Names(module, Owner("device", device.id), (names.device_class, names.async_class))
    yield Names(constructor, _OWN, ("transport", "unit", "self", *(name for name, _ in in_python(device).settings)))
    for axis in device.variants:
        yield Names(module, Owner("variant", axis), (f"{pascal(axis)}Choice",))
        yield Names(constructor, Owner("variant", axis), (parameter(axis),))


FAMILY_PART = "targets.calls"
WEIGHT = 0.4


def outputs(device: Device, render: Render, *, tests: bool = True) -> Iterable[tuple[str, str]]:
    """Yield the files of the device's package, as paths below the output folder and their text."""
    from fieldscribe.targets.python.views import enums_context, points_context

    del tests  # they are not generated
    names = Identifiers(device)
    lines = head_lines(device, "python", comment, "To regenerate")
    head = {"head": lines, "product": python_doc(f"{device.vendor} {device.model}")}
    enums = enums_context(names, render)
    folder = f"python/{names.package}"
    facts = {
        "uses": uses(device, names.device_class, ""),
        "doubts": [wrapped(python_doc(f"- {text}")) for text in open_texts(device.doubts)],
        "version": python_string(device.version),
        "digest": python_string(device.digest),
    }
    yield f"{folder}/__init__.py", render("python/init.py.j2", {**head, **facts, "view": names})
    yield f"{folder}/py.typed", ""
    project = {
        "name": toml_string(names.package.replace("_", "-")),
        "package": toml_string(names.package),
        "version": toml_string(device.version + (f"+{device.digest[:8]}" if device.command else "")),
        "description": toml_string(f"{device.vendor} {device.model}"),
        "runtime": __version__,
    }
    yield f"{folder}/pyproject.toml", render("python/pyproject.toml.j2", {**head, **project})
    if enums["classes"]:
        yield f"{folder}/enums.py", render("python/enums.py.j2", {**head, "view": enums})
    yield f"{folder}/points.py", render("python/points.py.j2", {**head, "view": points_context(device, names, render)})
    yield f"{folder}/device.py", render("python/device.py.j2", {**head, "view": device_context(device, names)})


def runtime(device: Device, *, tests: bool = True) -> Iterable[tuple[str, str]]:
    """Yield the files copied beside the package: output path, and path under the templates folder.

    It is the same for all families: devices of several share one copy.
    """
    del device, tests  # its tests are not generated
    for name in runtime_files(f"python/runtime/{RUNTIME}"):
        yield f"python/{RUNTIME}/{name}", f"python/runtime/{RUNTIME}/{name}"


# The device module.


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
