"""Reads the text files of a description; what a stranger's file may cost is bounded."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from errno import EFBIG
from functools import cache
from itertools import accumulate
from typing import TYPE_CHECKING

from fieldscribe.diagnostics import Report, Span
from fieldscribe.safe_files import shown_path

if TYPE_CHECKING:
    from pathlib import Path

    from fieldscribe.safe_files import Content, Inputs

MOST_BYTES = 16 * 1024 * 1024
"""The largest description file that is read: about 100,000 points."""


@cache
def _no_yaml() -> re.Pattern[str]:
    """The characters that YAML forbids. Compiled on first use, for that takes as long as many imports."""
    return re.compile("[^\\t\\n\\r -~\\x85\\xa0-\\ud7ff\\ue000-\\ufefe\\uff00-\\ufffd\\U00010000-\\U0010ffff]")


@dataclass(slots=True, eq=False)
class SourceFile:
    """A file's text; `name` is its path as shown to people, relative to where they called from if possible.

    `lost` collects names in dropped values, so that they are not reported as unknown too. In a `printable` text is no
    character that YAML forbids, or takes for a line break of another kind.
    """

    name: str
    text: str
    lost: set[str] = field(default_factory=set)
    printable: bool = False
    _starts: list[int] = field(default_factory=list, repr=False)

    def __post_init__(self) -> None:
        self.printable = self.text.replace("\n", "").isprintable()

    def span(self, line: int, column: int, width: int = 1) -> Span:
        """A place in this file."""
        return Span(self.name, line, column, width)

    def offset(self, place: tuple[int, int]) -> int:
        """How many characters stand before a line and column."""
        line, column = place
        if not self._starts:
            self._starts.extend(
                accumulate(map(len, self.text.split("\n")), lambda start, width: start + width + 1, initial=0)
            )
        return self._starts[line - 1] + column - 1


def read_source(path: Path, report: Report, inputs: Inputs | None = None) -> SourceFile | None:
    """The file's text, or None and a finding if it is missing, too large, empty, not UTF-8 or holds control codes.

    `inputs` takes note of the bytes that were read.
    """
    name = shown_path(path)
    content = _content(path, Span(name, 1, 1), report)
    if content is None:
        return None
    if inputs is not None:
        inputs.note(path, content)
    return decoded(name, content.data, report)


def _content(path: Path, start: Span, report: Report) -> Content | None:
    from fieldscribe.safe_files import UnfitFileError, read_regular

    try:
        return read_regular(path, MOST_BYTES)
    except UnfitFileError as error:
        if error.errno == EFBIG:
            message = f"the file is larger than {MOST_BYTES >> 20} MiB"
            report.error("file-too-large", message, start, "split it with `parts`")
        else:
            hint = "a description is made of regular files: move this away, or name another"
            report.error("file-unreadable", f"cannot read the file: {error.strerror}", start, hint)
    except OSError as error:
        message = f"cannot read the file: {error.strerror}"
        report.error("file-unreadable", message, start, "check the path and its permissions")
    return None


def decoded(name: str, data: bytes, report: Report) -> SourceFile | None:
    """The text of these bytes, or None and a finding."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        column = error.start - (data.rfind(b"\n", 0, error.start) + 1) + 1
        message = f"byte {data[error.start]:02X}h is not UTF-8"
        report.error("file-not-utf8", message, Span(name, line, column), "save the file as UTF-8")
        return None
    if not text.strip():
        hint = "a description starts with `fieldscribe: 1` and `device: …`"
        report.error("file-empty", "the file is empty", Span(name, 1, 1), hint)
        return None
    source = SourceFile(name, text)
    strange = None if source.printable else _no_yaml().search(text)
    if strange is None:
        return source
    start = strange.start()
    line, column = text.count("\n", 0, start) + 1, start - (text.rfind("\n", 0, start) + 1) + 1
    message = f"the control character U+{ord(strange[0]):04X} is not allowed in YAML"
    report.error(
        "yaml-character", message, source.span(line, column), "remove it: editors show it as a box, or not at all"
    )
    return None
