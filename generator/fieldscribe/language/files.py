"""All files of one description: device.yaml and the parts that it lists, each held against the table of keys."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.diagnostics import Span
from fieldscribe.language.hints import nearest
from fieldscribe.language.keys.places import DEVICE, PART
from fieldscribe.language.load import load
from fieldscribe.language.shape import check_shape
from fieldscribe.language.source import read_source, shown

if TYPE_CHECKING:
    from pathlib import Path

    from fieldscribe.diagnostics import Report
    from fieldscribe.language.nodes import Map
    from fieldscribe.reading import Inputs

_PART_KEYS = frozenset({"group", "points"})
_NEEDED = ("device", "family", "documents")


@dataclass(frozen=True, slots=True)
class Files:
    """The mappings of a description, device.yaml first. Not `complete` if a part is missing or could not be read."""

    maps: tuple[Map, ...]
    complete: bool


def read_files(device_file: Path, report: Report, inputs: Inputs | None = None) -> Files | None:
    """What the files say; None when device.yaml says too little to go on. Findings go to the report.

    Nothing else of the folder is read: whatever an editor or a stranger leaves there.
    """
    source = read_source(device_file, report, inputs)
    header = None if source is None else load(source, report)
    if header is None or _is_part(header, device_file, report):
        return None
    fine = check_shape(header, DEVICE, report)
    parts = [_file(path, report, inputs) for path in _parts(device_file, header, report)]
    if not all(key in header for key in _NEEDED):
        return None
    listed = "parts" not in header.broken and len(parts) == len(header.get("parts", ()))
    complete = fine and listed and all(part_fine for _, part_fine in parts)
    return Files((header, *(part for part, _ in parts if part is not None)), complete)


def _file(path: Path, report: Report, inputs: Inputs | None) -> tuple[Map | None, bool]:
    """The file's mapping, and whether it is whole."""
    source = read_source(path, report, inputs)
    root = None if source is None else load(source, report)
    return root, root is not None and check_shape(root, PART, report)


def _is_part(header: Map, file: Path, report: Report) -> bool:
    """Whether a file has no key of a device, but those of a part: one finding in place of one for each key."""
    if any(key in header for key in ("device", "family", "vendor", "model")) or not _PART_KEYS & set(header):
        return False
    whole = file.parent / "device.yaml"
    message = f"`{file.name}` is a part of a description and no device file"
    hint = f"name {whole.name} beside it" if whole.exists() else "name the device.yaml that lists it under `parts`"
    report.error("no-device", message, Span(shown(file), 1, 1), hint)
    return True


def _parts(device_file: Path, header: Map, report: Report) -> list[Path]:
    found: dict[str, Path] = {}
    for index, name in enumerate(header.get("parts", ())):
        span = header["parts"].span(index)
        path = device_file.parent / name
        if name in found:
            first = (header["parts"].span(list(header["parts"]).index(name)), "first listed here")
            report.error("duplicate-name", f"the part `{name}` is listed twice", span, "remove one of them", [first])
        elif name == device_file.name:
            report.error("missing-part", f"`{name}` cannot be a part of itself", span, "take it off the list")
        elif not os.path.lexists(path):
            others = tuple(sorted(one.name for one in device_file.parent.glob("*.y*ml") if one != device_file))
            near = nearest(name, others)
            hint = f"did you mean `{near}`?" if near else "create it or take it off the list"
            report.error("missing-part", f"there is no file `{name}` beside {device_file.name}", span, hint)
        elif path.is_symlink() and not _leads_beside(path, device_file):
            hint = "parts stand beside device.yaml: copy the file, or link the whole folder"
            report.error("part-outside", f"`{name}` is a link that leads out of the folder", span, hint)
        else:
            found[name] = path
    return list(found.values())


def _leads_beside(link: Path, device_file: Path) -> bool:
    """Whether a link ends in the folder of the description, or of what its device.yaml is a link to itself."""
    folder = os.path.dirname(os.path.realpath(link))
    return folder in (os.path.realpath(device_file.parent), os.path.dirname(os.path.realpath(device_file)))
