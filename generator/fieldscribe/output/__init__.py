"""Files on disk: written only if they changed, whole or not at all; removed only if a manifest says they are ours.

A manifest per device (`manifest/<device>.json`) names the files of each target. Nothing outside the output folder is
ever touched, whatever a manifest or a link in the folder says.
"""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

MANIFESTS = "manifest"
_FORMAT = 1


class UnsafePathError(Exception):
    """An output would land outside the output folder."""


@dataclass(slots=True)
class Changes:
    """What differs between what should be in the output folder and what is there; paths relative to it."""

    write: dict[str, bytes] = field(default_factory=dict)
    remove: list[str] = field(default_factory=list)
    unchanged: list[str] = field(default_factory=list)

    @property
    def stale(self) -> list[str]:
        """What is missing, differs or should be gone."""
        return sorted([*self.write, *self.remove])


def compare(out: Path, device: str, target: str, files: Mapping[str, bytes]) -> Changes:
    """What writing these files of one target of a device would change. Raises UnsafePathError."""
    changes = _compared(out, files)
    changes.remove = sorted(_left_over(out, device, target, files))
    return changes


def settle_manifest(out: Path, device: str, made: Mapping[str, list[str]]) -> Changes:
    """What writing the device's manifest would change, now that these files of some targets are made."""
    merged = {**read_manifest(out, device), **made}
    return _compared(out, {f"{MANIFESTS}/{device}.json": _manifest_text(device, merged).encode()})


def _compared(out: Path, files: Mapping[str, bytes]) -> Changes:
    changes = Changes()
    for path, data in files.items():
        place = _inside(out, path)
        if _holds(place, data):
            changes.unchanged.append(path)
        else:
            changes.write[path] = data
    return changes


def apply(out: Path, changes: Changes) -> None:
    """Write and remove what `compare` found. Each file is replaced in one step. Raises OSError."""
    for path, data in changes.write.items():
        _replace(_inside(out, path), data)
    for path in changes.remove:
        _inside(out, path).unlink(missing_ok=True)


def read_manifest(out: Path, device: str) -> dict[str, list[str]]:
    """The files by target that earlier runs wrote for a device; empty when there is no readable manifest."""
    try:
        loaded = json.loads((out / MANIFESTS / f"{device}.json").read_bytes())
        targets = loaded["targets"]
        return {str(name): [str(path) for path in paths] for name, paths in targets.items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return {}


def _manifest_text(device: str, targets: Mapping[str, list[str]]) -> str:
    document = {"format": _FORMAT, "device": device, "targets": dict(sorted(targets.items()))}
    return json.dumps(document, indent=2) + "\n"


def _left_over(out: Path, device: str, target: str, files: Mapping[str, object]) -> Iterable[str]:
    """Files that an earlier run wrote for this target, that nobody wants now and no other target or device shares."""
    known = read_manifest(out, device)
    same = {path for name, paths in known.items() if name != target for path in paths}
    candidates = {path for path in known.get(target, ()) if path not in files and path not in same}
    if not candidates:
        return []
    others = [path.stem for path in (out / MANIFESTS).glob("*.json") if path.stem != device]
    shared = {path for other in others for paths in read_manifest(out, other).values() for path in paths}
    return [path for path in candidates - shared if _is_ours(out, path)]


def _is_ours(out: Path, path: str) -> bool:
    try:
        place = _inside(out, path)
    except UnsafePathError:
        return False
    return place.is_file() and not place.is_symlink()


def _inside(out: Path, path: str) -> Path:
    place = out / path
    if not place.resolve().is_relative_to(out.resolve()):
        raise UnsafePathError(f"{place} leads out of the output folder {out}")
    return place


def _holds(place: Path, data: bytes) -> bool:
    try:
        return place.stat().st_size == len(data) and place.read_bytes() == data
    except OSError:
        return False


def _replace(place: Path, data: bytes) -> None:
    import tempfile

    place.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(prefix=".fieldscribe-", dir=place.parent)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, place)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
