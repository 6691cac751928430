"""Plans what writing a device would change in an output folder; carries the plan out; writes dependency files.

A plan reads the folder and writes nothing. Each file is replaced atomically, and at every moment a manifest records
which files are ours. A dependency file says to make and ninja that the outputs depend on inputs and compiler. They
compare times. An unchanged output would stay older than a changed input and be built again each time, so outputs older
than an input are touched. Each input has an empty rule, so that a build continues after an input was removed.
"""

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from errno import EINVAL
from pathlib import Path
from time import time_ns

from fieldscribe.output.files import Contents, Manifests, Targets, contents_of, made_of, manifest_text
from fieldscribe.resources import compiler_files
from fieldscribe.safe_files import (
    State,
    UnfitFileError,
    UnsafePathError,
    inside,
    kind_of,
    read_regular,
    state_at,
    state_of,
)

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


# Carrying it out.

_NEW = ".fieldscribe-new"
_FLAGS = os.O_WRONLY | os.O_CREAT | os.O_EXCL
for _name in ("O_NOFOLLOW", "O_CLOEXEC", "O_BINARY", "O_NOINHERIT"):
    _FLAGS |= getattr(os, _name, 0)

_BREAK = " \\\n  "
"""Between the inputs of a rule."""


def carry_out(out: Path, manifests: Manifests, plan: Plan) -> dict[str, State]:
    """Write and remove files according to the plan; return the final state of each file. Raises OSError."""
    for folder in {(out / path).parent for path in (*plan.unchanged, *plan.write)}:
        (folder / _NEW).unlink(missing_ok=True)  # left by a killed run
    states = dict(plan.unchanged)
    if plan.record in plan.write:
        replace(inside(out, plan.record), (plan.pending,))
    for path, contents in plan.write.items():  # the manifest comes last
        states[path] = replace(inside(out, path), contents.pieces())
    for path in plan.remove:
        inside(out, path).unlink(missing_ok=True)
    manifests.settle(plan.device, plan.targets)
    return states


def replace(place: Path, pieces: Iterable[bytes], temporary: str = _NEW, *, mode: int | None = None) -> State:
    """Replace a file atomically through a temporary file beside it, and return its state. Raises OSError.

    `mode` is the mode of the file; by default the umask decides.
    """
    place.parent.mkdir(parents=True, exist_ok=True)
    new = place.parent / temporary
    new.unlink(missing_ok=True)
    try:
        with open(os.open(new, _FLAGS, 0o666), "wb") as stream:
            stream.writelines(pieces)
        if mode is not None:
            os.chmod(new, mode)
        os.replace(new, place)
    except BaseException as error:
        new.unlink(missing_ok=True)
        if isinstance(error, OSError) and error.filename is None:  # a full disk: the system names no file
            error.filename = str(place)
        raise
    return state_of(os.lstat(place))


def update_depfile(place: Path, outputs: Iterable[Path], inputs: Iterable[Path]) -> None:
    """Write the dependency file at a place, and touch outputs that are older than an input. Raises OSError.

    Outputs keep the paths that the user gave, because a build uses these.
    """
    made = list(outputs)
    sources = [*inputs, *map(Path, compiler_files())]
    needed = [Path(os.path.abspath(source)) for source in sources]  # a build may run in another folder
    write_depfile(place, made, needed)
    newest = max(path.stat().st_mtime_ns for path in needed)
    for path in made:
        if path.stat().st_mtime_ns < newest:
            now = max(newest, time_ns())  # an input may be from the future
            os.utime(path, ns=(now, now))


def write_depfile(place: Path, outputs: Iterable[Path], inputs: Iterable[Path]) -> None:
    """Write a dependency file atomically. Raises OSError."""
    names = list(dict.fromkeys(map(_escaped, inputs)))
    rules = [f"{' '.join(map(_escaped, outputs))}: {_BREAK.join(names)}", *(f"{name}:" for name in names)]
    _put(Path(os.path.realpath(place)), ("\n".join(rules) + "\n").encode("utf-8", "surrogateescape"))


def _escaped(path: Path) -> str:
    """Return the path with blanks, `#` and `$` escaped. Raises UnfitFileError for control characters."""
    text = str(path)
    if any(ord(char) < 0x20 or char == "\x7f" for char in text):
        raise UnfitFileError(EINVAL, f"make cannot name the path {text!a}: rename it")
    return text.replace("\\", "/").replace("$", "$$").replace("#", "\\#").replace(" ", "\\ ")


def _put(place: Path, data: bytes) -> None:
    if place.is_char_device():
        place.write_bytes(data)  # a device such as /dev/null cannot be replaced
        return
    if place.exists() and (kind := kind_of(place.stat())) is not None:
        raise UnfitFileError(EINVAL, kind, str(place))
    replace(place, (data,), f".{place.name}.new")
