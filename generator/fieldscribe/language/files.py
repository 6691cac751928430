"""Reads the files of a description and checks their shape: device.yaml, then its parts."""

import os
from pathlib import Path
from typing import NamedTuple

from fieldscribe.diagnostics import Report, Span
from fieldscribe.language.hints import nearest
from fieldscribe.language.keys.places import DEVICE, PART
from fieldscribe.language.load import load
from fieldscribe.language.nodes import Map, read_source
from fieldscribe.language.shape import check_shape
from fieldscribe.safe_files import Inputs, path_text

_PART_KEYS = frozenset({"group", "points"})
_NEEDED = ("device", "family", "documents")


class Files(NamedTuple):
    """The mappings of a description, the head first; not `complete` if a part is missing or could not be read."""

    maps: tuple[Map, ...]
    complete: bool


def read_files(device_file: Path, report: Report, inputs: Inputs | None = None) -> Files | None:
    """Return all files of a description; None if device.yaml lacks too much to go on. Findings go to the report.

    Other files in the folder are never read.
    """
    header, *below = _documents(device_file, report, inputs)
    if header is None or _is_part(header, device_file, report):
        return None
    whole = [check_shape(header, DEVICE, report)]
    paths = _parts(device_file, header, report)
    parts = [*below, *(document for path in paths for document in _documents(path, report, inputs))]
    whole += [part is not None and check_shape(part, PART, report) for part in parts]
    if not all(key in header for key in _NEEDED):
        return None
    listed = "parts" not in header.broken and len(paths) == len(header.get("parts", ()))
    return Files((header, *(part for part in parts if part is not None)), listed and all(whole))


def parts_of(device_file: Path) -> list[Path]:
    """Return the parts that a device.yaml lists and that exist, as far as it can be read."""
    report = Report()
    header, *_ = _documents(device_file, report, None)
    if header is None:
        return []
    check_shape(header, DEVICE, report)
    return _parts(device_file, header, report)


def _documents(path: Path, report: Report, inputs: Inputs | None) -> list[Map | None]:
    """Return the documents of a file, at least one; None for a document that could not be read."""
    source = read_source(path, report, inputs)
    return [None] if source is None else load(source, report)


def _is_part(header: Map, file: Path, report: Report) -> bool:
    """Report a part that was given as device.yaml: one finding instead of one for each key."""
    if any(key in header for key in ("device", "family", "vendor", "model")) or not _PART_KEYS & set(header):
        return False
    whole = file.parent / "device.yaml"
    message = f"`{file.name}` is a part of a description and no device file"
    hint = f"name {whole.name} beside it" if whole.exists() else "name the device.yaml that lists it under `parts`"
    report.error("no-device", message, Span(path_text(file), 1, 1), hint)
    return True


def _parts(device_file: Path, header: Map, report: Report) -> list[Path]:
    paths: dict[str, Path] = {}
    for index, name in enumerate(header.get("parts", ())):
        span = header["parts"].span(index)
        path = device_file.parent / name
        if name in paths:
            first = (header["parts"].span(list(header["parts"]).index(name)), "first listed here")
            report.error("duplicate-name", f"the part `{name}` is listed twice", span, "remove one of them", [first])
        elif name == device_file.name:
            report.error("missing-part", f"`{name}` cannot be a part of itself", span, "take it off the list")
        elif not os.path.lexists(path):
            others = tuple(sorted(path.name for path in device_file.parent.glob("*.y*ml") if path != device_file))
            near = nearest(name, others)
            hint = f"did you mean `{near}`?" if near else "create it or take it off the list"
            report.error("missing-part", f"there is no file `{name}` beside {device_file.name}", span, hint)
        elif path.is_symlink() and not _stays_in_folder(path, device_file):
            hint = "parts stand beside device.yaml: copy the file, or link the whole folder"
            report.error("part-outside", f"`{name}` is a link that leads out of the folder", span, hint)
        else:
            paths[name] = path
    return list(paths.values())


def _stays_in_folder(link: Path, device_file: Path) -> bool:
    """Return True if a link leads into the folder of the description, or of the file that device.yaml links to."""
    folder = os.path.dirname(os.path.realpath(link))
    return folder in (os.path.realpath(device_file.parent), os.path.dirname(os.path.realpath(device_file)))
