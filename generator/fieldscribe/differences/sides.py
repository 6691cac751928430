"""The two sides of a comparison: descriptions, exported models, or one of these in a git revision."""

import json
import os
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from fieldscribe.diagnostics import Report, Span, UnclearError
from fieldscribe.differences.described import Described
from fieldscribe.export import export_model
from fieldscribe.facts.devices import FORMAT, device_table
from fieldscribe.facts.table import Exported
from fieldscribe.families import FAMILIES
from fieldscribe.language.nodes import MOST_BYTES
from fieldscribe.pipeline import find_devices, is_new, load_analysis
from fieldscribe.safe_files import path_text, read_regular

_MOST_MODEL_BYTES = 256 << 20
_MOST_FILES = 10_000
_DEEPEST = 2
"""A description is a folder, or a folder of such folders."""
_REGULAR = ("100644", "100755")
_SECONDS = 60
EXPORT_HINT = "write it with `fieldscribe export json DEVICE`"


class Side(NamedTuple):
    """One device of one side: its exported model, its description (None for an exported model), and its file.

    `name_of` turns the path of a file into the name that messages show; a side from git is `copied`.
    """

    exported: Exported
    described: Described | None
    file: str
    name_of: Callable[[str], str] = str
    copied: bool = False

    @property
    def device(self) -> str:
        """The id of the device."""
        return str(self.exported["device"])

    @property
    def version(self) -> str:
        """The version of its description."""
        return str(self.exported["version"])

    def place(self, names: tuple[tuple[str, str], ...], fact: str) -> str | None:
        """Return the place of a fact as `file:line`; for an exported model only the file."""
        if self.described is None:
            return self.name_of(self.file)
        span: Span | None = self.described.span(names, fact)
        return None if span is None else f"{self.name_of(span.file)}:{span.line}"


@contextmanager
def opened(argument: str, report: Report) -> Iterator[dict[str, Side]]:
    """Yield the devices of one side by id; its files exist as long as the context is open. Raises UnclearError."""
    revision, colon, inside = argument.partition(":")
    if Path(argument).exists() or not colon:
        yield _sides(Path(argument), report, str)
        return
    with TemporaryDirectory(prefix="fieldscribe-") as temporary:
        folder = Path(temporary).resolve()
        copy = copied(revision, inside, folder)
        cut = len(argument) if copy == folder else max(argument.rfind("/"), argument.find(":")) + 1
        name = argument[:cut] if argument[:cut].endswith((":", "/")) else f"{argument[:cut]}/"
        findings, name_of = Report(), _renaming(f"{path_text(folder)}/", name)
        sides = _sides(copy, findings, name_of)
        report.extend(findings.in_files(name_of))
        yield sides


def _renaming(copy: str, name: str) -> Callable[[str], str]:
    """Return a function that names files of the copy as in git: `HEAD~1:descriptions/hitachi_l200/bus.yaml`."""
    return lambda file: name + f"{file}/".removeprefix(copy).rstrip("/") if f"{file}/".startswith(copy) else file


def _sides(path: Path, report: Report, name_of: Callable[[str], str]) -> dict[str, Side]:
    if path.suffix == ".json" and not path.is_dir():
        model = _model(path, name_of(path_text(path)))
        return {str(model["device"]): Side(model, None, path_text(path), name_of, copied=name_of is not str)}
    known: dict[str, Path] = {}
    sides = {}
    for device_file in find_devices([path], report):
        analysis = load_analysis(device_file, report, with_errors=True)
        if analysis is not None and is_new(analysis.device, device_file, known, report):
            described, name = Described(analysis), path_text(device_file)
            side = Side(export_model(described.device), described, name, name_of, copied=name_of is not str)
            sides[side.device] = side
    return sides


def _model(path: Path, name: str) -> Exported:
    """Return an exported model; only its first keys are checked. Raises UnclearError."""
    try:
        model = json.loads(read_regular(path, _MOST_MODEL_BYTES).data)
    except (ValueError, RecursionError) as error:
        raise UnclearError(f"{name}: it is not JSON: {str(error)[:120]}", EXPORT_HINT) from None
    if not isinstance(model, dict) or not {"format", "device"} <= model.keys():
        raise UnclearError(f"{name}: it is not an exported model", EXPORT_HINT)
    if model["format"] != FORMAT:
        wanted = f"its format is not {FORMAT}, the one of this fieldscribe"
        raise UnclearError(f"{name}: {wanted}", f"{EXPORT_HINT} of this version")
    if model.get("family") not in [*FAMILIES]:
        known = f"known: {', '.join(FAMILIES)}"
        raise UnclearError(f"{name}: there is no family `{str(model.get('family', ''))[:60]}`", known)
    for fact in device_table(model["family"]):
        is_list = fact.schema.get("type") == "array"
        if fact.key not in model or is_list != isinstance(model[fact.key], list):
            what = f"`{fact.key}` is missing or {'no' if is_list else 'a'} list"
            raise UnclearError(f"{name}: it is not an exported model: {what}", EXPORT_HINT)
    return model


class _Blob(NamedTuple):
    """A file of a commit."""

    parts: tuple[str, ...]
    id: str


def copied(revision: str, path: str, folder: Path) -> Path:
    """Copy `path` of a git revision into `folder`; return the path of the copy. Raises UnclearError.

    The work tree is not touched. A file comes with the files beside it: they may be its parts.
    """
    commit = _commit(revision)
    where, kind = _object(commit, revision, path)
    if kind == "tree":
        _write(_blobs(where), folder)
        return folder
    name = path.rpartition("/")[2]
    above = path.removesuffix(name) or "/"
    above_tree, _ = _object(commit, revision, above) if above != "/" else (f"{commit}^{{tree}}", "tree")
    _write((blob for blob in _blobs(above_tree) if len(blob.parts) == 1), folder)
    if not (folder / name).is_file():
        raise UnclearError(f"`{path}` is not a regular file in `{revision}`")
    return folder / name


def _commit(revision: str) -> str:
    """Return the id of a commit. A name that git could take for an option never reaches git."""
    if revision.startswith("-") or not revision.isprintable() or not revision.strip():
        raise UnclearError(f"`{revision}` is not a revision", "name a commit, a tag or a branch: HEAD~1, v1.2.0, main")
    known = _git("rev-parse", "--verify", "--quiet", "--end-of-options", f"{revision}^{{commit}}")
    text = (known or b"").decode("ascii", "replace").strip()
    if not text.isalnum():
        hint = "`git log --oneline` and `git tag` list them"
        if _git("rev-parse", "--git-dir") is None:
            raise UnclearError("this is not a folder of a git repository", "call it inside the repository")
        raise UnclearError(f"git knows no revision `{revision}`", hint)
    return text


def _object(commit: str, revision: str, path: str) -> tuple[str, str]:
    """Return the id of the object at a path, and its type: `tree` or `blob`."""
    known = _git("rev-parse", "--verify", "--quiet", "--end-of-options", f"{commit}:{path.rstrip('/')}")
    text = (known or b"").decode("ascii", "replace").strip()
    kind = (_git("cat-file", "-t", text) or b"").decode("ascii", "replace").strip() if text.isalnum() else ""
    if kind not in ("tree", "blob"):
        hint = "the path counts from the top of the repository; with `./` in front from here"
        raise UnclearError(f"there is no `{path}` in `{revision}`", hint)
    return text, kind


def _blobs(tree: str) -> Iterator[_Blob]:
    """Yield the regular files of a tree to the depth of descriptions; no links, no submodules, no strange names."""
    listed = _git("ls-tree", "--full-tree", "-r", "-z", "-l", tree) or b""
    for entry in listed.split(b"\0")[:_MOST_FILES]:
        facts, _, name = entry.partition(b"\t")
        mode, kind, blob, size = [*os.fsdecode(facts).split(), "", "", "", ""][:4]
        parts = tuple(os.fsdecode(name).split("/"))
        fits = mode in _REGULAR and kind == "blob" and size.isdigit() and int(size) <= MOST_BYTES
        if fits and len(parts) <= _DEEPEST and all(map(_is_plain, parts)):
            yield _Blob(parts, blob)


def _is_plain(name: str) -> bool:
    return name not in ("", ".", "..") and name.isprintable() and not set(name) & set("\\:")


def _write(blobs: Iterator[_Blob], folder: Path) -> None:
    wanted = [blob for blob in blobs if blob.parts[-1].endswith((".yaml", ".yml", ".json"))]
    for blob, data in zip(wanted, _contents([blob.id for blob in wanted]), strict=True):
        place = folder.joinpath(*blob.parts)
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(data)


def _contents(ids: list[str]) -> Iterator[bytes]:
    """Yield the contents of files, by one call of git."""
    answer = _git("cat-file", "--batch", stdin="".join(f"{blob}\n" for blob in ids).encode()) or b"" if ids else b""
    start = 0
    for _ in ids:
        end = answer.index(b"\n", start)
        size = int(answer[start:end].split()[-1])
        yield answer[end + 1 : end + 1 + size]
        start = end + size + 2


def _git(*words: str, stdin: bytes = b"") -> bytes | None:
    """Return the output of git; None if it fails. Git neither prompts, nor fetches, nor runs code of the repository."""
    quiet = {"GIT_TERMINAL_PROMPT": "0", "GIT_NO_LAZY_FETCH": "1", "GIT_OPTIONAL_LOCKS": "0", "LC_ALL": "C"}
    command = ["git", "--no-replace-objects", "--no-pager", *words]
    try:
        done = subprocess.run(  # noqa: S603  # every word is ours, or stands after --end-of-options
            command, input=stdin, capture_output=True, timeout=_SECONDS, env={**os.environ, **quiet}, check=False
        )
    except FileNotFoundError:
        raise UnclearError("git is not installed", "it reads REVISION:PATH") from None
    except subprocess.TimeoutExpired:
        raise UnclearError("git did not answer") from None
    return done.stdout if done.returncode == 0 else None
