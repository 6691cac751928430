"""Devices from descriptions: those that tests write as text, those made for the tests, and those that are shipped."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from fieldscribe.diagnostics import Diagnostic, Report
from fieldscribe.model import Device
from fieldscribe.pipeline import load_device
from fieldscribe.resources import descriptions_dir

from support.files import write_files
from support.places import TESTS

DEVICES = TESTS / "devices"
SHIPPED = sorted(path.parent.name for path in descriptions_dir().glob("*/device.yaml"))
KITCHENS = sorted(path.parent.name for path in DEVICES.glob("kitchen_*/device.yaml"))
_HEAD = {
    "fieldscribe": "1",
    "device": "made_up",
    "version": "1.0.0",
    "vendor": "Maker",
    "model": "M1",
    "title": "Made up",
    "family": "modbus",
    "documents": "{manual: {title: Manual, language: en}}",
    "bus": "{framings: [rtu], units: 1..247, functions: {03h: read, 06h: write, 10h: write_many}}",
}
_GROUP = {"group": "main", "space": "holding", "source": '{document: manual, section: "1"}'}


def head(**said: str) -> str:
    """Return the document of a Modbus device; a keyword replaces the YAML of a key or adds one."""
    return _mapping({**_HEAD, **said})


def group(points: str, **said: str) -> str:
    """Return the document of a group with these lines of points; keywords as for `head`."""
    return _mapping({**_GROUP, **said}) + f"points:\n{points}"


def _mapping(values: dict[str, str]) -> str:
    return "".join(f"{key}: {value}\n" for key, value in values.items())


def together(*documents: str) -> str:
    """Return the text of one file with several documents."""
    return "---\n".join(documents)


def described(points: str, **said: str) -> str:
    """Return a description with one group of points; keywords change its head."""
    return together(head(**said), group(points))


def write(folder: Path, device: str, **parts: str) -> Path:
    """Write device.yaml and its parts by name; return the path of device.yaml."""
    write_files({f"{name}.yaml": text for name, text in {"device": device, **parts}.items()}, folder)
    return folder / "device.yaml"


def compile_in(folder: Path, device: str, **parts: str) -> tuple[Device | None, tuple[Diagnostic, ...]]:
    """Return the device of these files, and the findings."""
    return compiled(write(folder, device, **parts))


def compiled(file: Path) -> tuple[Device | None, tuple[Diagnostic, ...]]:
    """Return the device of a device.yaml, and the findings."""
    report = Report()
    return load_device(file, report), report.findings


def loaded_in(folder: Path, device: str, **parts: str) -> Device:
    """Return the device of these files, which have no error."""
    return loaded(write(folder, device, **parts))


def loaded(file: Path) -> Device:
    """Return the device of a device.yaml without errors."""
    device, findings = compiled(file)
    assert device is not None, findings
    return device


@cache
def made(name: str) -> Device:
    """Return one of the devices in `devices/`, which has no findings."""
    device, findings = compiled(DEVICES / name / "device.yaml")
    assert findings == ()
    assert device is not None
    return device


def kitchen_sink() -> Device:
    """Return the device that uses every mechanism of the language."""
    return made("kitchen_sink")


@cache
def shipped(name: str) -> Device:
    """Return a device of the shipped descriptions."""
    return loaded(descriptions_dir() / name / "device.yaml")
