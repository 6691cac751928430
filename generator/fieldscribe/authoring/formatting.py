"""Formats descriptions, if their meaning and comments stay the same; replaces all files of a description or none."""

import os
import re
import stat
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from fieldscribe.authoring.starting import is_schema
from fieldscribe.diagnostics import Report, UnclearError
from fieldscribe.language.canonical import OddError, canonical, comments, unbroken
from fieldscribe.language.files import parts_of
from fieldscribe.language.key_tables import schema_text
from fieldscribe.language.load import load
from fieldscribe.language.nodes import MOST_BYTES, SourceFile, decoded
from fieldscribe.output.writing import replace
from fieldscribe.pipeline import DEVICE_FILE
from fieldscribe.safe_files import State, path_text, read_regular, state_of

_SCHEMA_LINE = re.compile(r"#[ \t]*yaml-language-server:[ \t]*\$schema=((?:\.\./)*[\w.-]+\.json)[ \t]*")
_SUFFIX = ".fieldscribe-new"


def formatted(name: str, data: bytes, report: Report) -> bytes | None:
    """Return the canonical form of a file; None, with a finding, if it cannot be read or has no such form."""
    source = decoded(name, data, report)
    if source is None:
        return None
    text = unbroken(source.text)
    faults = Report()
    before = load(SourceFile(name, text), faults)
    report.extend(faults)
    if faults.has_errors:
        return None
    try:
        new = canonical(text)
    except OddError as odd:
        report.error("no-canonical-form", odd.message, source.span(odd.line, odd.column), odd.hint)
        return None
    if not _same(before, load(SourceFile(name, new), faults)) or faults.has_errors or comments(new) != comments(text):
        message = "internal error: the canonical form would say something else; the file was left as it is"
        report.error("internal-error", message, source.span(1, 1), "this is a bug: please report it with the file")
        return None
    return new.encode()


def _same(before: Any, after: Any) -> bool:
    """Return True if two values are equal, in the same order."""
    if type(before) is not type(after):
        return False
    if isinstance(before, dict):
        return list(before) == list(after) and all(_same(before[key], after[key]) for key in before)
    if isinstance(before, list):
        return len(before) == len(after) and all(map(_same, before, after))
    return bool(before == after)


def files_of(path: Path) -> Iterator[Path]:
    """Yield the file, and the parts of a device.yaml."""
    yield path
    if path.name == DEVICE_FILE:
        yield from parts_of(path)


class Formatting:
    """Formats files, and records those that were not in canonical form."""

    def __init__(self, report: Report, *, writes: bool) -> None:
        self.report, self.writes = report, writes
        self.changed: list[Path] = []
        self.kept = 0
        self._seen: set[str] = set()

    def file(self, path: Path) -> None:
        """Format a file, and update the schema that its first line names. Raises OSError and UnclearError."""
        real = os.path.realpath(path)
        if real in self._seen:
            return
        self._seen.add(real)
        content = read_regular(path, MOST_BYTES)
        new = formatted(path_text(path), content.data, self.report)
        if new is not None:
            self._settle(path, content.data, new, content.state)
        self._schema(path, content.data)

    def _schema(self, path: Path, data: bytes) -> None:
        """Update the schema if it is ours and lies beside the description or above it."""
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
            place = Path(os.path.realpath(path))  # a link stays a link
            status = os.stat(place)
            if state_of(status) != state:
                raise UnclearError(f"`{path}` was saved while it was formatted: it stays as it is", "run again")
            replace(place, (new,), f".{place.name}{_SUFFIX}", mode=stat.S_IMODE(status.st_mode))
        self.changed.append(path)


_MARK = b"\xef\xbb\xbf"
"""The byte order mark that some editors put before a text in UTF-8."""


def rewrite(texts: Mapping[str, tuple[str, str]]) -> None:
    """Replace the text of each file, given as old and new text; modes stay. Raises UnclearError."""
    before: dict[Path, bytes] = {}
    replaced: list[Path] = []
    try:
        for name, (text, _) in texts.items():
            place = Path(name).resolve()
            before[place] = read_regular(place, MOST_BYTES).data
            if before[place].decode("utf-8-sig", "replace") != text:
                hint = "nothing was changed: run the command again"
                raise UnclearError(f"`{place.name}` was changed while it was read", hint)
        for name, (_, text) in texts.items():
            place = Path(name).resolve()
            mark = _MARK if before[place].startswith(_MARK) else b""
            mode = stat.S_IMODE(place.stat().st_mode)
            replace(place, (mark, text.encode()), f".{place.name}{_SUFFIX}", mode=mode)
            replaced.append(place)
    except OSError as error:
        for place in replaced:
            place.write_bytes(before[place])
        raise UnclearError(f"cannot write {error.filename}: {error.strerror}", "nothing was changed") from error
