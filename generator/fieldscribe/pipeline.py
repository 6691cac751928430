"""The table of contents of the compiler: text in, model and files out. Nothing here prints, exits or writes."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.diagnostics import Report, Span
from fieldscribe.safe_files import Inputs, path_text

if TYPE_CHECKING:
    from fieldscribe.language.files import Files
    from fieldscribe.language.nodes import Map
    from fieldscribe.model import Device
    from fieldscribe.resolve.analysis import Analysis
    from fieldscribe.resolve.point_facts import PointFacts

DEVICE_FILE = "device.yaml"


class Models(NamedTuple):
    """The whole model of a device, its view for generated code, and the place of its version."""

    whole: Device
    plain: Device
    version: Span


class TargetError(Exception):
    """A target failed. The argument is its name, the cause is what happened."""


def find_devices(paths: Iterable[Path], report: Report) -> list[Path]:
    """Return the device.yaml files for paths to such a file, its folder, or a folder of such folders."""
    device_files: dict[Path, None] = {}
    for path in paths:
        if path.is_file():
            candidates = [path]
        elif _may_exist(path / DEVICE_FILE):
            candidates = [path / DEVICE_FILE]
        else:
            candidates = device_files_below(path)
        if not candidates:
            missing = "there is no such file or folder"
            if path.is_dir():
                missing = f"the folder holds no {DEVICE_FILE}, nor do its folders"
            elif path.exists():
                missing = "it is neither a folder nor a regular file"
            hint = f"name a folder with {DEVICE_FILE}, or a folder of such folders"
            report.error("no-device", missing, Span(path_text(path), 1, 1), hint)
        device_files.update(dict.fromkeys(candidates))
    return list(device_files)


def device_files_below(folder: Path) -> list[Path]:
    """Return the device.yaml files one folder below; an unreadable folder is reported later, when it is read."""
    try:
        names = sorted(os.listdir(folder))
    except OSError:
        return []
    return [folder / name / DEVICE_FILE for name in names if _may_exist(folder / name / DEVICE_FILE)]


def _may_exist(path: Path) -> bool:
    """Return False if nothing is there. A place without permission counts as a file: reading it gives the finding."""
    try:
        os.lstat(path)
    except (FileNotFoundError, NotADirectoryError, ValueError):
        return False
    except OSError:
        return True
    return True


def load_device(device_file: Path, report: Report, inputs: Inputs | None = None) -> Device | None:
    """Return the model of a description with its digest; None if the description has errors."""
    models = load_models(device_file, report, inputs)
    return None if models is None else models.whole


def load_models(device_file: Path, report: Report, inputs: Inputs | None = None) -> Models | None:
    """Return both models of a description with their digest; None if the description has errors."""
    analysis = load_analysis(device_file, report, inputs)
    return None if analysis is None else Models(*analysis.digested, analysis.scope.header.span("version"))


def load_analysis(
    device_file: Path, report: Report, inputs: Inputs | None = None, *, with_errors: bool = False
) -> Analysis | None:
    """Read, validate, interpret, resolve and check a description; None if it has errors.

    If `with_errors` is set, return also what could be resolved of a description with errors; None then means that the
    head of the device lacks too much. `inputs` records the files that are read, with a checksum each.
    """
    from fieldscribe.language.files import read_files

    findings = Report()
    files = read_files(device_file, findings, inputs)
    analysis = None
    if files is not None and not findings.full:  # at the limit of findings, shapes are no longer checked
        analysis = _checked(files, findings)
    report.extend(findings)
    return None if findings.has_errors and not with_errors else analysis


def load_outline(device_file: Path, report: Report) -> tuple[Map, list[PointFacts]] | None:
    """Return the head of a device and its points, expanded but not resolved: quick, for lists."""
    from fieldscribe.language.files import read_files
    from fieldscribe.resolve.expand import expand
    from fieldscribe.resolve.scope import open_scope

    findings = Report()
    files = read_files(device_file, findings)
    if files is None or findings.full:
        report.extend(findings)
        return None
    scope = open_scope(files, findings)
    points = list(expand(scope))
    report.extend(findings)
    return scope.header, points


def is_new(device: Device, device_file: Path, known: dict[str, Path], report: Report) -> bool:
    """Return True if no other description of this run has the device's id; `known` collects them by id."""
    first = known.setdefault(device.id, device_file)
    if first == device_file:
        return True
    message = f"the device `{device.id}` is described twice in this run, first in {path_text(first)}"
    hint = f"give one {DEVICE_FILE} another `device`"
    report.error("duplicate-device", message, Span(path_text(device_file), 1, 1), hint)
    return False


def outputs(device: Device, targets: Iterable[str], plain: Device | None = None) -> Iterator[tuple[str, str, str]]:
    """Yield all files of a device as (target, path below the output folder, text), the runtime of each target last.

    `plain` is the view of the device for generated code, if the caller has it. Raises TargetError if a target fails.
    """
    from fieldscribe.code_view import for_code
    from fieldscribe.resources import render, templates_dir
    from fieldscribe.targets import target

    for name in targets:
        try:
            loaded = target(name)
            seen = device if loaded.SEES_TITLES else (plain := plain or for_code(device))
            for path, text in loaded.outputs(seen, render):
                yield name, path, text
                del text  # frees perhaps megabytes before the next one is made
            for path, template in loaded.runtime(seen):
                yield name, path, (templates_dir() / template).read_text("utf-8")
        except Exception as error:
            raise TargetError(name) from error


def _checked(files: Files, report: Report) -> Analysis:
    """Resolve and check a device; if there are errors, it must not be compiled."""
    from fieldscribe.checks import run_checks
    from fieldscribe.resolve.analysis import Analysis
    from fieldscribe.resolve.bases import read_bases
    from fieldscribe.resolve.bus import bus_of, reader_of, telegrams_of
    from fieldscribe.resolve.commands import commands_of, identifications_of
    from fieldscribe.resolve.errata import errata_of
    from fieldscribe.resolve.expand import expand
    from fieldscribe.resolve.frames import frames_of
    from fieldscribe.resolve.points import ResolvedPoint, resolve_points
    from fieldscribe.resolve.scope import open_scope
    from fieldscribe.resolve.symbols import symbols_of

    scope = open_scope(files, report)
    read_bases(scope)
    expanded = expand(scope)
    symbols = symbols_of(scope, expanded)
    bus = bus_of(scope)
    messages = reader_of(scope).messages(scope, bus)
    telegrams = telegrams_of(scope, messages)
    resolved, ranges, places = resolve_points(scope, expanded, symbols, telegrams)
    messages, laid_out = reader_of(scope).lay_out(messages, [entry.point for entry in resolved])
    places.carry(messages)
    resolved = [ResolvedPoint(point, entry.facts) for point, entry in zip(laid_out, resolved, strict=True)]
    points = {entry.point.item: entry.point for entry in resolved}
    frames = frames_of(scope, bus, symbols, points)
    (commands, stepped), errata = commands_of(scope, bus, symbols, points), errata_of(scope, symbols, bus)
    identifications = identifications_of(scope, symbols, points)
    analysis = Analysis(
        *(scope, symbols, ranges, places, resolved, bus, messages, commands, frames, errata, identifications, stepped)
    )
    run_checks(analysis)
    return analysis
