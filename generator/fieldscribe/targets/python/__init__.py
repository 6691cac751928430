"""The Python target: a typed package per device with all its identifiers, and the runtime that all of them share."""

import sys
from collections.abc import Iterable, Iterator
from keyword import iskeyword

from fieldscribe import __version__
from fieldscribe.model import Device, Flag
from fieldscribe.resources import Render, runtime_files
from fieldscribe.targets.identifiers import Names, Owner, head_lines
from fieldscribe.targets.python.device import imports_of, in_python
from fieldscribe.targets.python.syntax import Identifiers, attribute, comment, parameter, word_attribute, wrapped
from fieldscribe.targets.runtime_calls.scope import shared_identifiers
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


_RUNTIME = "fieldscribe_runtime"

FAMILY_PART = "targets.calls"
WEIGHT = 0.4


def outputs(device: Device, render: Render, *, tests: bool = True) -> Iterable[tuple[str, str]]:
    """Yield the files of the device's package, as paths below the output folder and their text."""
    from fieldscribe.targets.python.device import device_context, uses
    from fieldscribe.targets.python.views import enums_context, points_context

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
