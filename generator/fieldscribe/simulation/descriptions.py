"""Finds descriptions and behaviours by the id of a device or the path of its folder; each is read once."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import TypeVar

from fieldscribe.diagnostics import Report
from fieldscribe.model import Device
from fieldscribe.pipeline import DEVICE_FILE, load_device
from fieldscribe.resources import descriptions_dir
from fieldscribe.simulation.behaviour_file import FILE, find_behaviour, read_behaviour
from fieldscribe.simulation.behaviour_rules import Rules
from fieldscribe.simulation.layout import Layout
from fieldscribe.user_errors import UnclearError

LOCAL = Path("descriptions")
Made = TypeVar("Made")


class BrokenError(UnclearError):
    """A file has errors; `report` has all of them."""

    def __init__(self, report: Report) -> None:
        super().__init__(report.findings[0].message, report.findings[0].hint or "")
        self.report = report


@lru_cache(maxsize=64)
def layout_of(
    name: str, variants: tuple[str, ...] = (), given: tuple[tuple[str, int], ...] = (), folder: Path = LOCAL
) -> Layout:
    """Return the layout of a device. Raises UnclearError."""
    return Layout(_model(name, folder), variants, dict(given))


def has_behaviour(name: str, folder: Path = LOCAL) -> bool:
    """Return True if a behaviour file stands beside a description. Raises UnclearError."""
    return find_behaviour(_file(name, folder)) is not None


@lru_cache(maxsize=16)
def rules_of(name: str, folder: Path = LOCAL) -> Rules:
    """Return the rules of the behaviour beside a description. Raises UnclearError."""
    file, report = _file(name, folder), Report()
    path = find_behaviour(file)
    if path is None:
        raise UnclearError(f"`{name}` has no behaviour", f"write a {FILE} beside {file}")
    return _read(read_behaviour(path, _model(name, folder), report), report)


@lru_cache(maxsize=16)
def _model(name: str, folder: Path) -> Device:
    report = Report()
    return _read(load_device(_file(name, folder), report), report)


def _file(name: str, folder: Path) -> Path:
    paths = [folder / name, Path(name), LOCAL / name, descriptions_dir() / name]
    files = (path if path.is_file() else path / DEVICE_FILE for path in paths)
    file = next((file for file in files if file.is_file()), None)
    if file is None:
        raise UnclearError(f"there is no device `{name[:80]}`", f"give an id, or a folder with a {DEVICE_FILE}")
    return file


def _read(made: Made | None, report: Report) -> Made:
    if made is None:
        raise BrokenError(report)
    return made
