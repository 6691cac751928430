"""The compiler's table of contents: text in, model and files out. Nothing here prints, exits or writes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from fieldscribe.diagnostics import Report, Span
from fieldscribe.language.source import read_source, shown

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.language.nodes import Map
    from fieldscribe.model import Device

DEVICE_FILE = "device.yaml"
_UNSAFE_NAMES = frozenset({"con", "prn", "aux", "nul", *(f"{port}{n}" for port in ("com", "lpt") for n in range(10))})


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
    own = Report()
    files = _read(device_file, own)
    device = None if files is None else _compile(files, own)
    report.extend(own)
    return None if own.has_errors else device


def description_files(device_file: Path) -> list[Path]:
    """All files that may belong to a description: device.yaml and the YAML files beside it."""
    others = {path for pattern in ("*.yaml", "*.yml") for path in device_file.parent.glob(pattern)}
    return [device_file, *sorted(others - {device_file})]


def outputs(device: Device, target_name: str) -> Iterator[tuple[str, str]]:
    """All files of one device for one target: path relative to the output folder, and text; the runtime last."""
    from fieldscribe.render import render
    from fieldscribe.resources import templates_dir
    from fieldscribe.targets import target

    made = target(target_name)
    yield from made.outputs(device, render)
    for path, template in made.runtime(device):
        yield path, (templates_dir() / template).read_text("utf-8")


def _read(device_file: Path, report: Report) -> tuple[Map, ...] | None:
    header = _file(device_file, "device_file", report)
    if header is None:
        return None
    _safe_name(header, report)
    parts = []
    seen: dict[str, int] = {}
    for index, name in enumerate(header.get("parts", ())):
        span = header["parts"].span(index)
        if name in seen:
            report.error("duplicate-name", f"the part `{name}` is listed twice", span, "remove one of them")
        elif not (device_file.parent / name).is_file():
            report.error(
                "missing-part",
                f"there is no file `{name}` beside {device_file.name}",
                span,
                "create it or take it off the list",
            )
        else:
            parts.append(_file(device_file.parent / name, "part_file", report))
        seen[name] = index
    return (header, *(part for part in parts if part is not None))


def _file(path: Path, kind: str, report: Report) -> Map | None:
    from fieldscribe.language.load import load
    from fieldscribe.language.shape import check_shape

    source = read_source(path, report)
    root = None if source is None else load(source, report)
    return root if root is not None and check_shape(root, kind, report) else None


def _safe_name(header: Map, report: Report) -> None:
    if header["device"] in _UNSAFE_NAMES:
        hint = "name it after vendor and model, such as `hitachi_l200`"
        report.error(
            "unsafe-name",
            f"`{header['device']}` is no safe name for a folder on every system",
            header.span("device"),
            hint,
        )


def _compile(files: tuple[Map, ...], report: Report) -> Device:
    from fieldscribe.checks import run_checks
    from fieldscribe.checks.subject import Subject
    from fieldscribe.resolve.bus import bus_of, commands_of
    from fieldscribe.resolve.device import build_device
    from fieldscribe.resolve.drafts import expand
    from fieldscribe.resolve.errata import errata_of
    from fieldscribe.resolve.frames import frames_of
    from fieldscribe.resolve.names import index_of
    from fieldscribe.resolve.points import resolve_points
    from fieldscribe.resolve.scope import open_scope

    scope = open_scope(files, report)
    drafts = expand(scope)
    index = index_of(scope, drafts)
    resolved, ranges = resolve_points(scope, drafts, index)
    bus = bus_of(scope)
    points = {one.point.item: one.point for one in resolved}
    frames = frames_of(scope, bus, index, points)
    subject = Subject(scope, index, ranges, resolved, bus, commands_of(scope), frames, errata_of(scope, index))
    run_checks(subject)
    return build_device(subject)
