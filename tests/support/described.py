"""Devices from descriptions: those that tests write as text, those made for the tests, and those that are shipped."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_device
from fieldscribe.resources import descriptions_dir

from support.files import write_files
from support.places import TESTS

if TYPE_CHECKING:
    from pathlib import Path

    from fieldscribe.diagnostics import Diagnostic
    from fieldscribe.model import Device

DEVICES = TESTS / "devices"
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
    """The document of a Modbus device; what is said of a key, as YAML, stands there instead or behind it."""
    return _mapping({**_HEAD, **said})


def group(points: str, **said: str) -> str:
    """The document of a group with these lines of points, said in the same way."""
    return _mapping({**_GROUP, **said}) + f"points:\n{points}"


def _mapping(values: dict[str, str]) -> str:
    return "".join(f"{key}: {value}\n" for key, value in values.items())


def together(*documents: str) -> str:
    """One file of several documents."""
    return "---\n".join(documents)


def described(points: str, **said: str) -> str:
    """A description whose head says that, with one group of points."""
    return together(head(**said), group(points))


def write(folder: Path, device: str, **parts: str) -> Path:
    """Writes the device.yaml, whose path is returned, and its parts by name."""
    write_files({f"{name}.yaml": text for name, text in {"device": device, **parts}.items()}, folder)
    return folder / "device.yaml"


def compile_in(folder: Path, device: str, **parts: str) -> tuple[Device | None, tuple[Diagnostic, ...]]:
    """The device of these files, and the findings."""
    return compiled(write(folder, device, **parts))


def compiled(file: Path) -> tuple[Device | None, tuple[Diagnostic, ...]]:
    """The device of a device.yaml, and the findings."""
    report = Report()
    return load_device(file, report), report.findings


def loaded_in(folder: Path, device: str, **parts: str) -> Device:
    """The device of these files, which have no error."""
    return loaded(write(folder, device, **parts))


def loaded(file: Path) -> Device:
    """The device of a device.yaml without errors."""
    device, findings = compiled(file)
    assert device is not None, findings
    return device


@cache
def made(name: str) -> Device:
    """One of the devices that were made for the tests, which has no findings."""
    device, findings = compiled(DEVICES / name / "device.yaml")
    assert findings == ()
    assert device is not None
    return device


def kitchen_sink() -> Device:
    """The one that uses every mechanism of the language."""
    return made("kitchen_sink")


@cache
def shipped(name: str) -> Device:
    """A device of the shipped descriptions."""
    return loaded(descriptions_dir() / name / "device.yaml")
