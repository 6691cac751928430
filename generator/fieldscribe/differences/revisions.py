"""A description as git has it: `REVISION:PATH`, copied into a temporary folder. No work tree is touched."""

from __future__ import annotations

import os
import subprocess
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.differences.table import UnfitError
from fieldscribe.language.source import MOST_BYTES

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

_MOST_FILES = 10_000
_DEEPEST = 2
"""A description is a folder, or a folder of such folders."""
_REGULAR = ("100644", "100755")
_SECONDS = 60


class _Blob(NamedTuple):
    """A file of a commit."""

    parts: tuple[str, ...]
    id: str


def copied(revision: str, path: str, folder: Path) -> Path:
    """Copy what stands at `path` in that revision below `folder`; the copy of the path itself. Raises UnfitError.

    A file comes with the files beside it: they may be its parts.
    """
    commit = _commit(revision)
    where, kind = _thing(commit, revision, path)
    if kind == "tree":
        _write(_blobs(where), folder)
        return folder
    name = path.rpartition("/")[2]
    above = path.removesuffix(name) or "/"
    beside, _ = _thing(commit, revision, above) if above != "/" else (f"{commit}^{{tree}}", "tree")
    _write((blob for blob in _blobs(beside) if len(blob.parts) == 1), folder)
    if not (folder / name).is_file():
        raise UnfitError(f"`{path}` is no regular file in `{revision}`")
    return folder / name


def _commit(revision: str) -> str:
    """The id of a commit. A name that git could take for an option never gets there."""
    if revision.startswith("-") or not revision.isprintable() or not revision.strip():
        raise UnfitError(f"`{revision}` is no revision", "name a commit, a tag or a branch: HEAD~1, v1.2.0, main")
    known = _git("rev-parse", "--verify", "--quiet", "--end-of-options", f"{revision}^{{commit}}")
    text = (known or b"").decode("ascii", "replace").strip()
    if not text.isalnum():
        hint = "`git log --oneline` and `git tag` list them"
        if _git("rev-parse", "--git-dir") is None:
            raise UnfitError("this is no folder of a git repository", "call it inside the repository")
        raise UnfitError(f"git knows no revision `{revision}`", hint)
    return text


def _thing(commit: str, revision: str, path: str) -> tuple[str, str]:
    """The id of what stands at a path, and whether it is a `tree` or a `blob`."""
    known = _git("rev-parse", "--verify", "--quiet", "--end-of-options", f"{commit}:{path.rstrip('/')}")
    text = (known or b"").decode("ascii", "replace").strip()
    kind = (_git("cat-file", "-t", text) or b"").decode("ascii", "replace").strip() if text.isalnum() else ""
    if kind not in ("tree", "blob"):
        hint = "the path counts from the top of the repository; with `./` in front from here"
        raise UnfitError(f"there is no `{path}` in `{revision}`", hint)
    return text, kind


def _blobs(tree: str) -> Iterator[_Blob]:
    """The regular files of a tree, as deep as descriptions lie; links, modules and strange names are left out."""
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
    """The contents of files, by one call of git."""
    answer = _git("cat-file", "--batch", given="".join(f"{blob}\n" for blob in ids).encode()) or b"" if ids else b""
    start = 0
    for _ in ids:
        end = answer.index(b"\n", start)
        size = int(answer[start:end].split()[-1])
        yield answer[end + 1 : end + 1 + size]
        start = end + size + 2


def _git(*words: str, given: bytes | None = None) -> bytes | None:
    """What git says; None where it fails. It asks nobody, fetches nothing and runs nothing of the repository."""
    quiet = {"GIT_TERMINAL_PROMPT": "0", "GIT_NO_LAZY_FETCH": "1", "GIT_OPTIONAL_LOCKS": "0", "LC_ALL": "C"}
    command = ["git", "--no-replace-objects", "--no-pager", *words]
    try:
        done = subprocess.run(  # noqa: S603  # every word is ours, or stands behind --end-of-options
            command, input=given or b"", capture_output=True, timeout=_SECONDS, env={**os.environ, **quiet}, check=False
        )
    except FileNotFoundError:
        raise UnfitError("git is not installed", "it reads REVISION:PATH") from None
    except subprocess.TimeoutExpired:
        raise UnfitError("git did not answer") from None
    return done.stdout if done.returncode == 0 else None
