"""The compiler's table of contents: text in, model and files out. Nothing here prints, exits or writes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.diagnostics import Report, Span
from fieldscribe.language.source import shown

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from fieldscribe.checks.subject import Subject
    from fieldscribe.language.files import Files
    from fieldscribe.model import Device

DEVICE_FILE = "device.yaml"


def find_devices(paths: Iterable[Path], report: Report) -> list[Path]:
    """The device.yaml files that the paths mean: such a file, its folder, or a folder of such folders."""
    found: dict[Path, None] = {}
    for path in paths:
        if path.is_file():
            candidates = [path]
        elif (path / DEVICE_FILE).is_file():
            candidates = [path / DEVICE_FILE]
        else:
            candidates = sorted(path.glob(f"*/{DEVICE_FILE}"))
        if not candidates:
            missing = (
                "there is no such file or folder"
                if not path.exists()
                else f"the folder holds no {DEVICE_FILE}, nor do its folders"
            )
            hint = f"name a folder with {DEVICE_FILE}, or a folder of such folders"
            report.error("no-device", missing, Span(shown(path), 1, 1), hint)
        found.update(dict.fromkeys(candidates))
    return list(found)


def load_device(device_file: Path, report: Report) -> Device | None:
    """The model of a description: read, validate, interpret, resolve, check. None and findings when it is wrong."""
    from fieldscribe.language.files import read_files

    own = Report()
    files = read_files(device_file, own)
    subject = None if files is None else _checked(files, own)
    report.extend(own)
    return None if subject is None else subject.device


def load_subject(device_file: Path, report: Report) -> Subject | None:
    """As `load_device`, but with every fact's place in the text, as checks and the audit need it."""
    from fieldscribe.language.files import read_files

    files = read_files(device_file, report)
    return None if files is None else _checked(files, report)


def description_files(device_file: Path) -> list[Path]:
    """All files that may belong to a description: device.yaml and the YAML files beside it."""
    others = {path for pattern in ("*.yaml", "*.yml") for path in device_file.parent.glob(pattern)}
    return [device_file, *sorted(others - {device_file})]


def outputs(device: Device, targets: Iterable[str]) -> Iterator[tuple[str, str, str]]:
    """All files of a device: target, path relative to the output folder, and text; the runtime of each target last."""
    from fieldscribe.plain import for_code
    from fieldscribe.render import render
    from fieldscribe.resources import templates_dir
    from fieldscribe.targets import FOR_PEOPLE, target

    plain: Device | None = None
    for name in targets:
        made = target(name)
        if name not in FOR_PEOPLE:
            plain = plain or for_code(device)
        seen = device if name in FOR_PEOPLE or plain is None else plain
        for path, text in made.outputs(seen, render):
            yield name, path, text
        for path, template in made.runtime(seen):
            yield name, path, (templates_dir() / template).read_text("utf-8")


def _checked(files: Files, report: Report) -> Subject | None:
    from fieldscribe.checks import run_checks
    from fieldscribe.checks.subject import Subject
    from fieldscribe.resolve.bus import bus_of
    from fieldscribe.resolve.commands import commands_of
    from fieldscribe.resolve.errata import errata_of
    from fieldscribe.resolve.expand import expand
    from fieldscribe.resolve.frames import frames_of
    from fieldscribe.resolve.messages import messages_of
    from fieldscribe.resolve.names import index_of
    from fieldscribe.resolve.points import resolve_points
    from fieldscribe.resolve.scope import open_scope
    from fieldscribe.resolve.telegrams import telegrams_of

    scope = open_scope(files, report)
    drafts = expand(scope)
    index = index_of(scope, drafts)
    bus = bus_of(scope)
    messages = messages_of(scope, bus)
    telegrams = telegrams_of(scope, messages)
    resolved, ranges, places = resolve_points(scope, drafts, index, telegrams)
    points = {one.point.item: one.point for one in resolved}
    frames = frames_of(scope, bus, index, points)
    commands, errata = commands_of(scope, bus), errata_of(scope, index, bus)
    subject = Subject(scope, index, ranges, places, resolved, bus, messages, commands, frames, errata)
    run_checks(subject)
    return None if report.has_errors else subject
