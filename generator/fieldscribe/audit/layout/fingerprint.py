"""What is kept of a text that was transcribed: where its pieces stood, one of 64 signs for each.

A word, a number or a sign of punctuation is a piece. Its sign tells it from nearly all others and cannot be turned back
into it, so that a fingerprint is no copy of the manual. Between the signs stands the layout: blanks, cells, breaks.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from hashlib import blake2b
from typing import TYPE_CHECKING
from unicodedata import normalize

from fieldscribe.audit.layout.alignment import Pieces
from fieldscribe.audit.manual import Manual, lines_of

if TYPE_CHECKING:
    from collections.abc import Iterator

_SIGNS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"
_HEAD = "fieldscribe fingerprint 1 sha256:"
_HEAD_LINE = re.compile(rf"{_HEAD}([0-9a-f]{{64}})")
_OPENS = "="
"""Stands before a line that opens a section."""
_LINE = re.compile(rf"{_OPENS}?[{re.escape(_SIGNS)} |\t<#>-]*")
_KEPT_PIECE = re.compile(f"[{re.escape(_SIGNS)}]")
_PIECE = re.compile(r"(?:[0-9A-F](?: [0-9A-F]){1,3} ?|\b[0-9][0-9A-Fa-f]*)[hH](?!\w)|[^\W\d_]+|[0-9]+|[^\w\s|]|_")
"""A hexadecimal number with a blank behind each digit is one, too."""
_TAG = re.compile(r"</?[A-Za-z][^<>|]*>")
_SETTING = re.compile(
    r"</?(?:b|i|u|em|strong|sub|sup|span|font|small)(?:\s[^<>|]*)?/?>|\*\*|[\u00ad\u200b-\u200d\u2060\ufeff]",
    re.IGNORECASE,
)
"""What only sets words; all other tags part them."""
_MARKS = re.compile(r"[\s|>]*(?:(?:#{1,6}|[-*+\u2022\u2013\u25aa](?: +o)?|o)(?=\s)\s*)?")
"""Before the first word: cells, quotes, and what makes a line a heading or an entry of a list."""
_RULE = re.compile(r"[|\s:-]*-[|\s:-]*")
_BLANKS = re.compile("  +")
_ALIKE = str.maketrans(
    {
        **dict.fromkeys("\u2010\u2011\u2012\u2013\u2014\u2015\u2212", "-"),
        **dict.fromkeys("\u201c\u201d\u201e\u201f\u00ab\u00bb", '"'),
        **dict.fromkeys("\u2018\u2019\u201a\u201b\u00b4`", "'"),
        **dict.fromkeys("\u22c5\u2219", "\u00b7"),
        "\u00b5": "\u03bc",
    }
)
_MOST_LINES = 200_000


class FingerprintError(Exception):
    """A file that is no fingerprint; `line` counts from 1."""

    def __init__(self, line: int, message: str) -> None:
        super().__init__(message)
        self.line = line


class Laid(Pieces):
    """A text in pieces, each with its sign, and the layout before it (`gaps`), and at the end of its line (`ends`)."""

    def __init__(self) -> None:
        super().__init__()
        self.signs: list[str] = []
        self.gaps: list[str] = []
        self.ends: list[str] = []

    def _add(self, gap: str, sign: str) -> None:
        self.gaps.append(gap)
        self.signs.append(sign)
        self.line_of.append(len(self.ends) + 1)

    def _end(self, gap: str) -> None:
        self.ends.append(gap)
        self._end_line()

    def _kept(self, line: int) -> str:
        """A line as a fingerprint has it."""
        return "".join(self.gaps[piece] + self.signs[piece] for piece in self.of_line(line)) + self.ends[line - 1]


class Fingerprint(Laid):
    """What is kept of a text: `sections` are the lines that open one."""

    def __init__(self, sha256: str, lines: list[str]) -> None:
        super().__init__()
        self.sha256 = sha256
        self.sections = {number for number, line in enumerate(lines, 1) if line.startswith(_OPENS)}
        for line in lines:
            end = len(_OPENS) if line.startswith(_OPENS) else 0
            for match in _KEPT_PIECE.finditer(line):
                self._add(line[end : match.start()], match[0])
                end = match.end()
            self._end(line[end:])

    @classmethod
    def of(cls, text: str, sha256: str) -> Fingerprint:
        """What is kept of a text. `sha256` is the checksum of the file that it was read from."""
        laid, sections = Text(text), set(Manual(text).headings)
        lines = (_OPENS * (line in sections) + laid._kept(line) for line in range(1, len(laid.written) + 1))
        return cls(sha256, list(lines))

    @classmethod
    def read(cls, text: str) -> Fingerprint:
        """A fingerprint from the text of its file. Raises FingerprintError."""
        head, *lines = text.removesuffix("\n").split("\n")
        match = _HEAD_LINE.fullmatch(head)
        if match is None:
            raise FingerprintError(1, f"a fingerprint begins with `{_HEAD}` and the checksum of its text")
        if len(lines) > _MOST_LINES:
            raise FingerprintError(_MOST_LINES, f"a fingerprint has at most {_MOST_LINES} lines")
        for number, line in enumerate(lines, 2):
            if not _LINE.fullmatch(line):
                raise FingerprintError(number, "no line of a fingerprint")
        return cls(match[1], lines)

    def written(self) -> str:
        """The text of its file: a head, then a line for each line of the manual."""
        lines = (_OPENS * (line in self.sections) + self._kept(line) for line in range(1, len(self.ends) + 1))
        return "\n".join([_HEAD + self.sha256, *lines]) + "\n"


class Text(Laid):
    """A text itself: its lines as they are written, and the column of each piece."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.written = lines_of(text)
        self.columns: list[int] = []
        for line in self.written:
            end = 0
            for match in _pieces(line):
                self._add(_layout(line[end : match.start()], first=not end), _sign(match[0]))
                self.columns.append(match.start() + 1)
                end = match.end()
            self._end(_layout(line[end:], first=not end))

    def at(self, line: int, column: int) -> int:
        """The piece that begins at a place."""
        pieces = self.of_line(line)
        return bisect_left(self.columns, column, pieces.start, pieces.stop)

    def piece(self, piece: int) -> str:
        """A piece as it is written."""
        match = _PIECE.match(self.written[self.line_of[piece] - 1], self.columns[piece] - 1)
        return match[0] if match else ""


def _pieces(line: str) -> Iterator[re.Match[str]]:
    if _RULE.fullmatch(line):
        return iter(())
    plain = _TAG.sub(_blanked, _SETTING.sub(_blanked, line))
    marks = _MARKS.match(plain)
    return _PIECE.finditer(plain, marks.end() if marks else 0)


def _blanked(match: re.Match[str]) -> str:
    return " " * len(match[0])


def _sign(piece: str) -> str:
    plain = normalize("NFC", piece.translate(_ALIKE)).replace(" ", "").casefold()
    return _SIGNS[blake2b(plain.encode(), digest_size=1).digest()[0] % len(_SIGNS)]


def _layout(gap: str, *, first: bool) -> str:
    """What parts two pieces: blanks (two stand for more), cells, tabs, breaks; marks before the first one."""
    plain = _TAG.sub("<", _SETTING.sub("", gap))
    if first:
        plain = re.sub(r"[*+\u2022\u2013\u25aa]", "-", plain)
    kept = "".join(sign for sign in plain if sign in (" |\t<#>-" if first else " |\t<"))
    for sign in "|\t<":
        kept = re.sub(rf" *{re.escape(sign)} *", sign, kept)
    kept = re.sub("<+", "<", kept)
    return _BLANKS.sub("  ", kept)
