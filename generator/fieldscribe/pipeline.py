"""The compiler's table of contents: text in, model and files out. Nothing here prints, exits or writes."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.diagnostics import Report, Span
from fieldscribe.safe_files import shown_path

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from fieldscribe.language.files import Files
    from fieldscribe.language.nodes import Map
    from fieldscribe.model import Device
    from fieldscribe.resolve.analysis import Analysis
    from fieldscribe.resolve.point_facts import PointFacts
    from fieldscribe.safe_files import Inputs
    from fieldscribe.targets import Target

DEVICE_FILE = "device.yaml"


class Models(NamedTuple):
    """A whole device, the same as code may know it, and where its version stands."""

    whole: Device
    plain: Device
    version: Span


class TargetError(Exception):
    """A target failed; its name is the argument, what happened is the cause."""


def find_devices(paths: Iterable[Path], report: Report) -> list[Path]:
    """The device.yaml files that the paths mean: such a file, its folder, or a folder of such folders."""
    device_files: dict[Path, None] = {}
    for path in paths:
        if path.is_file():
            candidates = [path]
        elif _may_exist(path / DEVICE_FILE):
            candidates = [path / DEVICE_FILE]
        else:
            candidates = device_files_below(path)
        if not candidates:
            missing = (
                "there is no such file or folder"
                if not path.exists()
                else f"the folder holds no {DEVICE_FILE}, nor do its folders"
            )
            hint = f"name a folder with {DEVICE_FILE}, or a folder of such folders"
            report.error("no-device", missing, Span(shown_path(path), 1, 1), hint)
        device_files.update(dict.fromkeys(candidates))
    return list(device_files)


def device_files_below(folder: Path) -> list[Path]:
    """The device.yaml files one folder below; folders that cannot be read get their finding later."""
    try:
        names = sorted(os.listdir(folder))
    except OSError:
        return []
    return [folder / name / DEVICE_FILE for name in names if _may_exist(folder / name / DEVICE_FILE)]


def _may_exist(path: Path) -> bool:
    """Whether something is there. Where we may not look, it may be: reading it then gives the finding."""
    try:
        os.lstat(path)
    except (FileNotFoundError, NotADirectoryError, ValueError):
        return False
    except OSError:
        return True
    return True


def load_device(device_file: Path, report: Report, inputs: Inputs | None = None) -> Device | None:
    """The model of a description: read, validate, interpret, resolve, check. None and findings when it is wrong."""
    models = load_models(device_file, report, inputs)
    return None if models is None else models.whole


def load_undigested(device_file: Path, report: Report) -> Device | None:
    """As `load_device`, but without the digest, which only files need."""
    analysis = _loaded(device_file, report)
    return None if analysis is None else analysis.devices[0]


def load_models(device_file: Path, report: Report, inputs: Inputs | None = None) -> Models | None:
    """As `load_device`, with the same device as code may know it.

    `inputs` remembers the files that were read, each with a checksum.
    """
    analysis = _loaded(device_file, report, inputs)
    return None if analysis is None else Models(*analysis.models, analysis.scope.header.span("version"))


def _loaded(device_file: Path, report: Report, inputs: Inputs | None = None) -> Analysis | None:
    """The parts of a device without errors, whatever the report holds of others."""
    from fieldscribe.language.files import read_files

    own = Report()
    files = read_files(device_file, own, inputs)
    analysis = None if files is None else _checked(files, own)
    report.extend(own)
    return None if own.has_errors else analysis


def is_new(device: Device, device_file: Path, known: dict[str, Path], report: Report) -> bool:
    """Whether the run has met no description of this device yet; a second one is a finding. `known` is what it met."""
    first = known.setdefault(device.id, device_file)
    if first == device_file:
        return True
    message = f"the device `{device.id}` is described twice in this run, first in {shown_path(first)}"
    hint = f"give one {DEVICE_FILE} another `device`"
    report.error("duplicate-device", message, Span(shown_path(device_file), 1, 1), hint)
    return False


def load_analysis(device_file: Path, report: Report) -> Analysis | None:
    """As `load_device`, but with every fact's place in the text, as checks and the audit need it."""
    from fieldscribe.language.files import read_files

    files = read_files(device_file, report)
    analysis = None if files is None else _checked(files, report)
    return None if report.has_errors else analysis


def load_so_far(device_file: Path, report: Report) -> Analysis | None:
    """As `load_analysis`, but also with errors: then what is sound of it. None where the head lacks too much."""
    from fieldscribe.language.files import read_files

    own = Report()
    files = read_files(device_file, own)
    analysis = None if files is None else _checked(files, own)
    report.extend(own)
    return analysis


def load_outline(device_file: Path, report: Report) -> tuple[Map, list[PointFacts]] | None:
    """The head of a device and its points by name, without what they mean: for lists, and quick."""
    from fieldscribe.language.files import read_files
    from fieldscribe.resolve.expand import expand
    from fieldscribe.resolve.scope import open_scope

    files = read_files(device_file, report)
    if files is None:
        return None
    scope = open_scope(files, report)
    return scope.header, list(expand(scope))


def outputs(device: Device, targets: Iterable[str], plain: Device | None = None) -> Iterator[tuple[str, str, str]]:
    """All files of a device: target, path relative to the output folder, and text; the runtime of each target last.

    `plain` is the device as code may know it, if it is at hand. Raises TargetError for whatever fails inside a target.
    """
    from fieldscribe.plain import for_code
    from fieldscribe.targets import target

    for name in targets:
        try:
            loaded = target(name)
            for path, text in _of_target(loaded, device if loaded.FOR_PEOPLE else (plain := plain or for_code(device))):
                yield name, path, text
        except Exception as error:
            raise TargetError(name) from error


def _of_target(target: Target, device: Device) -> Iterator[tuple[str, str]]:
    from fieldscribe.render import render
    from fieldscribe.resources import templates_dir

    yield from target.outputs(device, render)
    for path, template in target.runtime(device):
        yield path, (templates_dir() / template).read_text("utf-8")


def _checked(files: Files, report: Report) -> Analysis:
    """The parts of a device, resolved and checked; with errors they are not to be compiled."""
    from fieldscribe.checks import run_checks
    from fieldscribe.resolve.analysis import Analysis
    from fieldscribe.resolve.bus import bus_of
    from fieldscribe.resolve.commands import commands_of
    from fieldscribe.resolve.errata import errata_of
    from fieldscribe.resolve.expand import expand
    from fieldscribe.resolve.family_reader import reader_of
    from fieldscribe.resolve.frames import frames_of
    from fieldscribe.resolve.points import resolve_points
    from fieldscribe.resolve.scope import open_scope
    from fieldscribe.resolve.symbols import symbols_of
    from fieldscribe.resolve.telegrams import telegrams_of

    scope = open_scope(files, report)
    drafts = expand(scope)
    index = symbols_of(scope, drafts)
    bus = bus_of(scope)
    messages = reader_of(scope).messages(scope, bus)
    telegrams = telegrams_of(scope, messages)
    resolved, ranges, places = resolve_points(scope, drafts, index, telegrams)
    points = {entry.point.item: entry.point for entry in resolved}
    frames = frames_of(scope, bus, index, points)
    commands, errata = commands_of(scope, bus), errata_of(scope, index, bus)
    analysis = Analysis(scope, index, ranges, places, resolved, bus, messages, commands, frames, errata)
    run_checks(analysis)
    return analysis
