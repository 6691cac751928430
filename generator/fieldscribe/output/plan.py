"""Plans what writing a device would change in an output folder; reads the folder and writes nothing."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from fieldscribe.output.files import Contents, Manifests, Targets, contents_of, made_of, manifest_text
from fieldscribe.safe_files import State, UnsafePathError, inside, kind_of, read_regular, state_at

TargetFiles = dict[str, dict[str, Contents]]
"""The contents of files by target, then by path relative to the output folder."""

_MOST_BYTES = 512 << 20
_NOT_OURS = "it was edited, or is somebody else's: it has neither our head nor the recorded checksum"


@dataclass(slots=True)
class Plan:
    """The differences between the expected and the actual contents of the output folder; paths are relative to it."""

    out: Path
    manifests: Manifests
    device: str
    force: bool
    record: str
    """The path of the manifest."""
    targets: Targets
    """The device's files as the manifest will record them."""
    pending: bytes
    """The manifest while files are being written, with old and new digests."""
    write: dict[str, Contents] = field(default_factory=dict)
    remove: list[str] = field(default_factory=list)
    unchanged: dict[str, State] = field(default_factory=dict)
    refused: dict[str, str] = field(default_factory=dict)
    """Foreign files in the way, each with the reason why it may not be replaced."""
    forcible: set[str] = field(default_factory=set)
    """Foreign files that `force` would replace."""
    kept: list[str] = field(default_factory=list)
    """Files that are no longer generated but stay, because they were edited or are not ours."""
    digests: dict[str, str] = field(default_factory=dict)
    """The digests of all expected files, including the manifest."""

    def add(self, path: str, contents: Contents) -> None:
        """Plan a file that should be in the folder."""
        self.digests[path] = contents.digest
        try:
            place = inside(self.out, path)
            state = _same(place, contents)
            reason = None if state else self._in_the_way(path, place)
        except UnsafePathError as error:
            self.refused[path] = str(error)
            return
        except NotADirectoryError:
            self.refused[path] = "part of its path is a file, not a folder"
            return
        if state:
            self.unchanged[path] = state
        elif reason is None or (self.force and _is_replaceable(place)):
            self.write[path] = contents
        else:
            self.refused[path] = reason
            self.forcible.update({path} if _is_replaceable(place) else ())

    def add_left_over(self, files_of_targets: TargetFiles) -> None:
        """Plan to remove files of earlier runs for these targets that are neither generated again nor shared."""
        wanted = {path for files in files_of_targets.values() for path in files}
        known = {path for target in files_of_targets for path in self.manifests.of(self.device).get(target, ())}
        for path in sorted(known - wanted):
            is_shared = self.manifests.is_shared(path, self.device, files_of_targets)
            if not is_shared and os.path.lexists(self.out / path):
                (self.remove if self._may_go(path) else self.kept).append(path)

    def _may_go(self, path: str) -> bool:
        """Return True if the file is ours by name or head: the manifest may have been edited."""
        try:
            place = inside(self.out, path)
            if self._in_the_way(path, place) is not None:
                return False
            named = self.manifests.layout.names(path, self.device)
            return named or made_of(read_regular(place, _MOST_BYTES).data) == self.device
        except (UnsafePathError, OSError):
            return False

    def _in_the_way(self, path: str, place: Path) -> str | None:
        """Return why an existing file must not be replaced; None if it may be, or does not exist."""
        try:
            kind = kind_of(os.lstat(place))
            if kind is not None:
                return kind
            data = read_regular(place, _MOST_BYTES).data
        except FileNotFoundError:
            return None
        except NotADirectoryError:
            raise
        except OSError as error:
            return f"it cannot be read: {error.strerror}"
        device, maker = self.device, made_of(data)
        if maker not in (None, device):
            return f"it was made of the device `{maker}`; the names of the two devices meet, so rename one of them"
        return None if self.manifests.vouch_for(path, device, data) else _NOT_OURS

    def advice(self, path: str) -> str:
        """Return advice about a refused file."""
        other = "replace it with `--force`" if path in self.forcible else "choose another folder or name"
        return f"move it away, or {other}; nothing of {self.device} was written"

    @property
    def stale(self) -> list[str]:
        """All paths that are missing, differ or should be removed."""
        return sorted({*self.write, *self.remove, *self.refused})


def plan_of(
    out: Path, manifests: Manifests, device: str, files_of_targets: TargetFiles, *, force: bool = False
) -> Plan:
    """Return the plan for these targets of a device; `force` allows it to replace foreign files."""
    before = manifests.of(device)
    now: Targets = {
        target: {path: (contents.digest,) for path, contents in files.items()}
        for target, files in files_of_targets.items()
    }
    further_keys = manifests.further_keys(device)
    pending = manifest_text(device, _both(before, now), further_keys).encode()
    plan = Plan(out, manifests, device, force, manifests.layout.manifest(device), {**before, **now}, pending)
    for files in files_of_targets.values():
        for path, contents in files.items():
            plan.add(path, contents)
    plan.add_left_over(files_of_targets)
    plan.add(plan.record, contents_of(manifest_text(device, plan.targets, further_keys).encode()))
    return plan


def changed_since(out: Path, states: Mapping[str, State]) -> list[str]:
    """Return the files that changed after these states were taken."""
    return [path for path, state in states.items() if state_at(out / path) != state]


def _is_replaceable(place: Path) -> bool:
    """Return True if there is something that a file can replace."""
    return os.path.lexists(place) and not os.path.isdir(place)


def _same(place: Path, contents: Contents) -> State | None:
    """Return the state of the file if it has exactly these contents."""
    try:
        if os.stat(place).st_size != contents.size:
            return None
        present = read_regular(place, contents.size)
    except NotADirectoryError:
        raise
    except OSError:
        return None
    return present.state if contents_of(present.data).digest == contents.digest else None


def _both(before: Targets, now: Targets) -> Targets:
    """Return the files with their present and their future digests."""
    merged = {target: dict(files) for target, files in before.items()}
    for target, files in now.items():
        known = merged.setdefault(target, {})
        for path, digests in files.items():
            known[path] = tuple(dict.fromkeys((*known.get(path, ()), *digests)))
    return merged
