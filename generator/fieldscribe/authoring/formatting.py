"""Brings descriptions into their canonical form; a file is written only when it says just what it said before."""

from __future__ import annotations

import os
import re
import stat
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fieldscribe.authoring.starting import is_schema
from fieldscribe.diagnostics import Report
from fieldscribe.language.canonical import canonical
from fieldscribe.language.load import load
from fieldscribe.language.pieces import OddError, comments, unbroken
from fieldscribe.language.source import MOST_BYTES, SourceFile, decoded
from fieldscribe.safe_files import read_regular, shown_path, state_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.safe_files import State

_SCHEMA_LINE = re.compile(r"#[ \t]*yaml-language-server:[ \t]*\$schema=((?:\.\./)*[\w.-]+\.json)[ \t]*")
_ASIDE = ".fieldscribe-new"


class MovedError(Exception):
    """Somebody saved the file meanwhile."""


def formatted(name: str, data: bytes, report: Report) -> bytes | None:
    """The canonical form of a file; None, with a finding, if it cannot be read or has no such form."""
    source = decoded(name, data, report)
    if source is None:
        return None
    text = unbroken(source.text)
    own = Report()
    said = load(SourceFile(name, text), own)
    report.extend(own)
    if own.has_errors:
        return None
    try:
        new = canonical(text)
    except OddError as odd:
        report.error("no-canonical-form", odd.message, source.span(odd.line, odd.column), odd.hint)
        return None
    if not _same(said, load(SourceFile(name, new), own)) or own.has_errors or comments(new) != comments(text):
        message = "internal error: the canonical form would say something else; the file was left as it is"
        report.error("internal-error", message, source.span(1, 1), "this is a bug: please report it with the file")
        return None
    return new.encode()


def _same(before: Any, after: Any) -> bool:
    """Whether two values say the same, in the same order."""
    if type(before) is not type(after):
        return False
    if isinstance(before, dict):
        return list(before) == list(after) and all(_same(before[key], after[key]) for key in before)
    if isinstance(before, list):
        return len(before) == len(after) and all(map(_same, before, after))
    return bool(before == after)


def files_of(path: Path) -> Iterator[Path]:
    """The files of a description, of which the device.yaml is given; any other file stands for itself."""
    from fieldscribe.language.files import parts_of
    from fieldscribe.pipeline import DEVICE_FILE

    yield path
    if path.name == DEVICE_FILE:
        yield from parts_of(path)


class Formatting:
    """One run over some files: which are not as they should be, and which of them were written."""

    def __init__(self, report: Report, *, writes: bool) -> None:
        self.report, self.writes = report, writes
        self.changed: list[Path] = []
        self.kept = 0
        self._seen: set[str] = set()

    def file(self, path: Path) -> None:
        """Bring one file, and the schema that its first line names, into order. Raises OSError, MovedError."""
        real = os.path.realpath(path)
        if real in self._seen:
            return
        self._seen.add(real)
        content = read_regular(path, MOST_BYTES)
        new = formatted(shown_path(path), content.data, self.report)
        if new is not None:
            self._settle(path, content.data, new, content.state)
        self._schema(path, content.data)

    def _schema(self, path: Path, data: bytes) -> None:
        """Bring the schema up to date, if it is one of ours and stands beside the description or above it."""
        from fieldscribe.language.json_schema import schema_text

        line = _SCHEMA_LINE.fullmatch(data[:500].decode("utf-8-sig", "replace").partition("\n")[0].rstrip())
        if line is None:
            return
        place = path.parent / line[1]
        if os.path.realpath(place) in self._seen or not is_schema(place):
            return
        self._seen.add(os.path.realpath(place))
        content = read_regular(place, MOST_BYTES)
        self._settle(place, content.data, schema_text().encode(), content.state)

    def _settle(self, path: Path, old: bytes, new: bytes, state: State) -> None:
        if new == old:
            self.kept += 1
            return
        if self.writes:
            _replace(path, new, state)
        self.changed.append(path)


def _replace(path: Path, data: bytes, state: State) -> None:
    """Replace a file that is still as it was read; a link stays one, and what may be done with the file stays, too."""
    from fieldscribe.output.writing import replace

    place = Path(os.path.realpath(path))
    status = os.stat(place)
    if state_of(status) != state:
        raise MovedError
    replace(place, (data,), f".{place.name}{_ASIDE}", mode=stat.S_IMODE(status.st_mode))
