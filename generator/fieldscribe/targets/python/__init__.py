"""The Python target: a typed package per device with all its identifiers, and the runtime that all of them share."""

import sys
from collections.abc import Iterable, Iterator
from keyword import iskeyword

from fieldscribe import __version__
from fieldscribe.model import Device, Point
from fieldscribe.resources import Render, runtime_files
from fieldscribe.targets.identifiers import Names, Owner, head_lines
from fieldscribe.targets.python.device import imports_of, in_python
from fieldscribe.targets.python.identifiers import Identifiers, attribute, parameter, word_attribute
from fieldscribe.targets.python.layout import comment, wrapped
from fieldscribe.targets.runtime_calls.scope import command_attributes
from fieldscribe.text import pascal, python_doc, python_string, toml_string, upper
from fieldscribe.wording import open_texts

LIBRARIES = frozenset({"can", "pymodbus", "serial"})
"""The packages that transports of the runtime import if a project uses them."""

_OWN = Owner("target", "what the package needs")
_POINTS = "Python, the points"
_CLASSES = "Python, the classes of numbers and flags"


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
    yield from _classes(device, names)
    for enum in device.enums:
        owner, space = Owner("enum", enum.name), f"Python, the enum `{enum.name}`"
        for entry in enum.entries:
            yield Names(space, Owner("entry", entry.name, owner), (upper(entry.name),))
    for point in device.points:
        if point.generated:
            yield from _of_point(point)
    for command, name in command_attributes(device, attribute).items():
        yield Names(_POINTS, Owner("command", command), (name,))


def _of_device(device: Device, names: Identifiers) -> Iterator[Names]:
    """Yield the names in the device module, in the constructor of its classes, and in the exports of the package."""
    module, constructor = "Python, the device module", "Python, the constructor"
    yield Names(module, _OWN, ("Literal", "Points", *imports_of(device)))
    yield Names(module, Owner("device", device.id), (names.device_class, names.async_class))
    yield Names(constructor, _OWN, ("transport", "unit", "self", *(name for name, _ in in_python(device).settings)))
    for axis in device.variants:
        yield Names(module, Owner("variant", axis), (f"{pascal(axis)}Choice",))
        yield Names(constructor, Owner("variant", axis), (parameter(axis),))


def _classes(device: Device, names: Identifiers) -> Iterator[Names]:
    """Yield the classes of the enums module."""
    for enum in device.enums:
        yield Names(_CLASSES, Owner("enum", enum.name), (names.enum_class(enum.name),))
    for point in device.points:
        owner, word = Owner("point", point.item), names.word_class(point)
        if word:
            yield Names(_CLASSES, owner, (word,))
        for flag in point.flags if word else ():
            if (name := names.field_class(point, flag.name)) is not None:
                yield Names(
                    _CLASSES, Owner("enum", flag.enum) if flag.enum else Owner("flag", flag.name, owner), (name,)
                )


def _of_point(point: Point) -> Iterator[Names]:
    owner = Owner("point", point.item)
    yield Names(_POINTS, owner, (attribute(point.item),))
    if point.variant is not None:
        yield Names(_POINTS, Owner("point", point.name), (attribute(point.name),))
    for old in point.was:
        yield Names(_POINTS, Owner("old name", old, Owner("point", point.name)), (attribute(old),))
    for flag in point.flags if point.form == "flags" else ():
        space = f"Python, the flags of `{point.item}`"
        yield Names(space, Owner("flag", flag.name, owner), (upper(flag.name), word_attribute(flag.name)))


SEES_TITLES = False
_RUNTIME = "fieldscribe_runtime"

FAMILY_PART = "targets.calls"
WEIGHT = 0.4
BEFORE_POINTS = ("",)


def outputs(device: Device, render: Render, *, tests: bool = True) -> Iterable[tuple[str, str]]:
    """Yield the files of the device's package, as paths below the output folder and their text."""
    from fieldscribe.targets.python.device import device_context, uses
    from fieldscribe.targets.python.enums import enums_context
    from fieldscribe.targets.python.points_module import points_context

    del tests  # they are not generated
    names = Identifiers(device)
    lines = head_lines(device, "python", comment, "To regenerate")
    head = {"head": lines, "product": python_doc(f"{device.vendor} {device.model}")}
    enums = enums_context(device, names, render)
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
    for name in runtime_files(f"python/runtime/{_RUNTIME}"):
        yield f"python/{_RUNTIME}/{name}", f"python/runtime/{_RUNTIME}/{name}"


__all__ = ["SEES_TITLES", "device_name_taken", "identifiers", "outputs", "runtime"]
