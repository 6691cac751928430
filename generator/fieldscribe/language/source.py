"""Text files of a description, with bounds on what a stranger's file may cost."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from fieldscribe.diagnostics import Report, Span

MOST_BYTES = 16 * 1024 * 1024
"""The largest description file that is read: about 50,000 points."""


@dataclass(frozen=True, slots=True)
class SourceFile:
    """A file's text; `name` is its path as shown to people, relative to where they called from if possible."""

    name: str
    text: str

    def span(self, line: int, column: int, width: int = 1) -> Span:
        """A place in this file."""
        return Span(self.name, line, column, width)


def shown(path: Path) -> str:
    """The path as people typed or would type it: relative to the working folder when it lies below."""
    try:
        return path.resolve().relative_to(Path.cwd()).as_posix()
    except ValueError:
        return path.as_posix()


def read_source(path: Path, report: Report) -> SourceFile | None:
    """The file's text, or None and a finding when it is missing, too large, empty or not UTF-8."""
    name = shown(path)
    start = Span(name, 1, 1)
    try:
        with path.open("rb") as stream:
            data = stream.read(MOST_BYTES + 1)
    except OSError as error:
        report.error(
            "file-unreadable", f"cannot read the file: {error.strerror}", start, "check the path and its permissions"
        )
        return None
    if len(data) > MOST_BYTES:
        report.error(
            "file-too-large", f"the file is larger than {MOST_BYTES >> 20} MiB", start, "split it with `parts`"
        )
        return None
    return _decoded(name, data, report)


def _decoded(name: str, data: bytes, report: Report) -> SourceFile | None:
    start = Span(name, 1, 1)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        column = error.start - (data.rfind(b"\n", 0, error.start) + 1) + 1
        hint = "save the file as UTF-8"
        report.error("file-not-utf8", f"byte {data[error.start]:#04x} is not UTF-8", Span(name, line, column), hint)
        return None
    if not text.strip():
        report.error(
            "file-empty", "the file is empty", start, "a description starts with `fieldscribe: 1` and `device: …`"
        )
        return None
    return SourceFile(name, text)
