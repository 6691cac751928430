"""The Python target: a typed package per device, and the runtime that all of them share."""

from __future__ import annotations

from collections.abc import Iterable

from fieldscribe import __version__
from fieldscribe.model import Device
from fieldscribe.resources import Render, runtime_files
from fieldscribe.targets.identifiers import head_lines
from fieldscribe.targets.python.identifiers import Identifiers
from fieldscribe.targets.python.layout import comment, wrapped
from fieldscribe.targets.python.namespaces import device_name_taken, identifiers
from fieldscribe.text import python_doc, python_string, toml_string
from fieldscribe.wording import open_texts

SEES_TITLES = False
_RUNTIME = "fieldscribe_runtime"

NEEDS_FAMILY = True
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

    All devices share one runtime, so it is the same whatever the family: devices of several lie beside one copy.
    """
    del device, tests  # its tests are not generated
    for name in runtime_files(f"python/runtime/{_RUNTIME}"):
        yield f"python/{_RUNTIME}/{name}", f"python/runtime/{_RUNTIME}/{name}"


__all__ = ["SEES_TITLES", "device_name_taken", "identifiers", "outputs", "runtime"]
