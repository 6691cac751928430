"""The canonical form of a description, for `fmt`: uniform blanks, indentation and quotes.

The text is split into pieces: signs, scalars and marks, each with the comments before it. Their order, and which of
them share a line, stay as the author wrote them. Mappings are indented by two. The dashes of a list stand below its
key, further lines in brackets below the first piece inside. Texts get double quotes.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import yaml

_INDENT = 2
_OPENING, _CLOSING = frozenset("[{"), frozenset("]}")
_DOCUMENT_MARKS = frozenset({"---", "..."})
_BEFORE_A_VALUE = frozenset(":-")
_COMMENT = re.compile(r"(?:^|(?<=[ \t]))#.*", re.MULTILINE)
_PLAIN_BLOCK = re.compile(r"[|>]-?[ \t]*(?:#.*)?\n")
_KINDS: dict[type, str] = {
    yaml.BlockEntryToken: "-",
    yaml.ValueToken: ":",
    yaml.FlowEntryToken: ",",
    yaml.FlowMappingStartToken: "{",
    yaml.FlowSequenceStartToken: "[",
    yaml.FlowMappingEndToken: "}",
    yaml.FlowSequenceEndToken: "]",
    yaml.DocumentStartToken: "document",
    yaml.DocumentEndToken: "document",
    yaml.DirectiveToken: "document",
    yaml.AnchorToken: "property",
    yaml.TagToken: "property",
    yaml.AliasToken: "alias",
    yaml.StreamEndToken: "end",
    yaml.KeyToken: "key",
    yaml.BlockMappingStartToken: "mapping",
    yaml.BlockSequenceStartToken: "sequence",
    yaml.BlockEndToken: "close",
}
_WITHOUT_TEXT = frozenset({"key", "mapping", "sequence", "close"})
_STRANGE_BREAK = re.compile(r"[\x85\u2028\u2029]")


class Comment(NamedTuple):
    """A comment, and the column (from 0) where it stands."""

    text: str
    column: int


class Gap(NamedTuple):
    """The text before a piece: a trailing comment of the previous one, then lines (None for an empty one)."""

    trailing: Comment | None
    blanks: int
    """The blanks before that comment."""
    lines: tuple[Comment | None, ...]
    breaks: bool
    """True if there is a line break."""

    @property
    def has_comment(self) -> bool:
        """True if it has a comment."""
        return self.trailing is not None or any(self.lines)


class OddError(Exception):
    """The text has something without a canonical form: line and column (from 1), what it is, and what to do."""

    def __init__(self, line: int, column: int, message: str, hint: str) -> None:
        super().__init__(message)
        self.line, self.column, self.message, self.hint = line, column, message, hint


class Piece(NamedTuple):
    """A piece: its sign or kind, its text, its line (from 1) and column (from 0), and what stands before it.

    The kinds are the signs `- : , { } [ ]`, and document, property, alias, scalar, block (a block scalar with its
    lines) and end. Pieces without text open and close block mappings and lists (mapping, sequence, close); `key` comes
    before each key.
    """

    kind: str
    text: str
    line: int
    column: int
    gap: Gap


_NO_GAP = Gap(None, 0, (), breaks=False)


def canonical(text: str) -> str:
    """Return the canonical form of a valid text, with one kind of line break. Raises OddError."""
    layout = _Layout()
    for piece in _without_last_commas(pieces(text)):
        layout.place(piece)
    return layout.text()


def comments(text: str) -> list[str]:
    """Return the comments of a text without errors, in order. Raises OddError."""
    texts: list[str] = []
    for piece in pieces(text):
        gap = piece.gap
        texts += [comment.text for comment in (gap.trailing, *gap.lines) if comment is not None]
    return texts


def unbroken(text: str) -> str:
    """Return the text with one kind of line break."""
    return text.replace("\r\n", "\n").replace("\r", "\n")


# A text in pieces.


def pieces(text: str) -> Iterator[Piece]:
    """Yield the pieces of a text without errors, with one kind of line break. Raises OddError."""
    _refuse_strange_breaks(text)
    end = 0
    for token in iter(yaml.CSafeLoader(text).get_token, None):
        kind = _KINDS.get(type(token), "")
        if type(token) is yaml.ScalarToken:
            kind = "block" if token.style in ("|", ">") else "scalar"
        _refuse_odd(token, kind, text)
        mark = token.start_mark
        if kind in _WITHOUT_TEXT:
            yield Piece(kind, "", mark.line + 1, mark.column, _NO_GAP)
        elif kind:
            piece = text[mark.index : token.end_mark.index]
            if kind == "block":  # its end may lie after comments and empty lines that do not belong to it
                piece = piece.rstrip("\n ")
            yield Piece(kind, piece, mark.line + 1, mark.column, _gap(text, end, mark.index))
            end = mark.index + len(piece)


def _refuse_strange_breaks(text: str) -> None:
    strange = _STRANGE_BREAK.search(text)
    if strange is not None:
        start = strange.start()
        line, column = text.count("\n", 0, start) + 1, start - text.rfind("\n", 0, start)
        message = f"the line break U+{ord(strange[0]):04X} has no canonical form"
        raise OddError(line, column, message, "break the line as all others, or write `\\x85` and the like in quotes")


def _refuse_odd(token: Any, kind: str, text: str) -> None:
    mark = token.start_mark
    if kind == "key" and token.end_mark.index > mark.index:
        raise OddError(mark.line + 1, mark.column + 1, "a key after `?` has no canonical form", "write `key: value`")
    if kind == "block" and not _PLAIN_BLOCK.match(text, mark.index):
        message = "a text with signs after `|` or `>` has no canonical form"
        raise OddError(mark.line + 1, mark.column + 1, message, "write the text in quotes")


def _gap(text: str, start: int, end: int) -> Gap:
    first, *rest = text[start:end].split("\n")
    column = start - (text.rfind("\n", 0, start) + 1)
    trailing = _COMMENT.search(first) if first.strip() else None
    comment = None if trailing is None else Comment(trailing[0].rstrip(), column + trailing.start())
    blanks = 0 if trailing is None else trailing.start()
    lines = [_line(line) for line in rest[:-1]]
    if start == 0:  # nothing precedes the first line
        lines = [_line(first), *lines] if rest else []
        comment = None
    return Gap(comment, blanks, tuple(lines), bool(rest) or comment is not None)


def _line(text: str) -> Comment | None:
    stripped = text.strip()
    return Comment(stripped, len(text) - len(text.lstrip())) if stripped else None


# Pieces laid out.


def _without_last_commas(all_pieces: Iterator[Piece]) -> Iterator[Piece]:
    """Yield the pieces without commas before a closing bracket."""
    comma: Piece | None = None
    for piece in all_pieces:
        closes = piece.kind in _CLOSING
        if comma is not None and not closes:
            yield comma
        if piece.kind == ",":
            comma = piece
        else:
            yield piece if comma is None or not closes else piece._replace(gap=_both(comma.gap, piece.gap))
            comma = None


def _both(first: Gap, second: Gap) -> Gap:
    return second if not first.has_comment else first._replace(lines=(*first.lines, *second.lines), breaks=True)


@dataclass(slots=True)
class _Frame:
    """An open mapping or list: its column in the text, and in the canonical form."""

    kind: str
    was: int
    column: int


@dataclass(slots=True)
class _Layout:
    lines: list[str] = field(default_factory=list)
    line: str = ""
    """The line that is being written."""
    within: list[_Frame] = field(default_factory=list)
    last: str = ""
    """The kind of the previous piece; empty at the start of a document."""
    opened: bool = False
    """True if a mapping or list has opened since the previous piece."""
    at_key: bool = False
    """True if a key comes next."""
    anchored: bool = False
    """True if the previous piece is an anchor or a tag."""
    left: dict[int, int] = field(default_factory=dict)
    """The columns of the mapping or list around the previous piece: in the text, and in the canonical form."""

    def text(self) -> str:
        """Return the canonical text."""
        return "\n".join([*self.lines, self.line.rstrip()]).strip("\n") + "\n"

    def place(self, piece: Piece) -> None:
        """Write a piece after the previous one, or on a new line."""
        if not piece.text and piece.kind != "end":
            self._note(piece)
            return
        column = self._column(piece)
        if self._breaks_before(piece):
            self._finish(piece.gap)
            self.line = " " * column
        else:
            self.line += self._blank(piece)
        self._write(piece)
        self.left = self._columns()
        self.anchored = piece.kind == "property"
        if not self.anchored:  # what follows belongs to the piece before it
            self.last = "" if piece.kind == "document" else piece.kind
        self.opened = self.at_key = False

    def _note(self, piece: Piece) -> None:
        """Handle a piece without text: the start or the end of a block mapping or list, or a key."""
        if piece.kind == "key":
            self.at_key = True
        elif piece.kind == "close":
            self.within.pop()
        else:
            self._open(piece)

    def _open(self, piece: Piece) -> None:
        above = self.within[-1].column if self.within else -_INDENT
        below_key = piece.kind == "sequence" and self.last == ":"
        self.within.append(_Frame(piece.kind, piece.column, above if below_key else above + _INDENT))
        self.opened = True

    def _column(self, piece: Piece) -> int:
        """Return the column of a piece that starts a line."""
        if not self.within or piece.kind in ("document", "end"):
            return 0
        frame = self.within[-1]
        starts = frame.kind == "flow" or piece.kind in ("-", ":") or self.at_key
        return frame.column + (0 if starts or self.last not in _BEFORE_A_VALUE else _INDENT)

    def _breaks_before(self, piece: Piece) -> bool:
        """Return True if a piece starts a line: it is the first, or the author broke the line where that is allowed."""
        if not (self.line or self.lines):
            return True
        return piece.gap.breaks and (piece.gap.has_comment or not self._joins(piece))

    def _joins(self, piece: Piece) -> bool:
        """Return True if a piece always stays on the line of the previous one."""
        if self.last in _OPENING or piece.kind in _CLOSING or piece.kind == ",":
            return True
        empty = self.at_key or piece.kind in ("-", "document", "end")
        return self.last == "-" and not self.anchored and (self.opened or not empty)

    def _blank(self, piece: Piece) -> str:
        if self.last in _OPENING or (piece.kind in (*_CLOSING, ",") and self.last != ":"):
            return ""
        return "" if piece.kind == ":" and self.last != "alias" else " "

    def _write(self, piece: Piece) -> None:
        base = next((frame.column for frame in reversed(self.within) if frame.kind != "flow"), -_INDENT)
        if piece.kind == "scalar":
            self._refuse_mark(piece)
            self._write_lines(_quoted(piece.text), " " * (base + _INDENT))
            return
        if piece.kind == "block":
            self._write_lines(_outdented(piece.text), " " * (base + _INDENT), exactly=True)
            return
        if piece.kind in _CLOSING:
            self.within.pop()
        self.line += piece.text
        if piece.kind in _OPENING:
            self.within.append(_Frame("flow", piece.column + 1, len(self.line)))

    def _refuse_mark(self, piece: Piece) -> None:
        """Refuse a key that would be read as a document marker at the start of a line."""
        if not self.line and piece.text[:3] in _DOCUMENT_MARKS:
            message = f"a key that starts with `{piece.text[:3]}` has no canonical form"
            raise OddError(piece.line, piece.column + 1, message, "write the key in quotes")

    def _write_lines(self, text: str, indent: str, *, exactly: bool = False) -> None:
        """Write a scalar with its further lines indented; `exactly` keeps the blanks of a block scalar."""
        first, *rest = text.split("\n")
        self.line += first
        for below in rest:
            self.lines.append(self.line if exactly else _ended(self.line))
            text = below if exactly else _ended(below.lstrip())
            self.line = f"{indent}{text}" if text else ""

    def _finish(self, gap: Gap) -> None:
        """End the line with the comment after it, and write the empty lines and comments below."""
        if self.line or self.lines:
            self.lines.append(_with_comment(self.line.rstrip(), gap))
        columns = self.left | self._columns()
        if gap.trailing is not None:  # a comment that continues below stays aligned
            columns[gap.trailing.column] = len(self.lines[-1]) - len(gap.trailing.text)
        for comment in gap.lines:
            if comment is not None:
                self.lines.append(" " * self._comment_column(comment, gap, columns) + comment.text)
            elif self.lines and self.lines[-1]:
                self.lines.append("")

    def _comment_column(self, comment: Comment, gap: Gap, columns: dict[int, int]) -> int:
        """Return the column of a comment on a line of its own: that of the mapping or list at it or left of it."""
        goes_on = gap.trailing is not None and gap.trailing.column == comment.column
        if self.within and self.within[-1].kind == "flow" and not goes_on:
            return self.within[-1].column
        return columns[max(was for was in columns if was <= comment.column)]

    def _columns(self) -> dict[int, int]:
        return {0: 0} | {frame.was: frame.column for frame in self.within if frame.kind != "flow"}


def _with_comment(line: str, gap: Gap) -> str:
    """Return a line with the comment after it: at its old column if there is room, else after two blanks."""
    if gap.trailing is None:
        return line
    kept = gap.trailing.column if gap.blanks > _INDENT else 0
    return f"{line:<{max(kept, len(line) + _INDENT)}}{gap.trailing.text}"


def _ended(line: str) -> str:
    """Return a line without trailing blanks; a blank after a backslash is escaped, so it stays."""
    ended = line.rstrip()
    escapes = len(ended) - len(ended.rstrip("\\"))
    return f"{ended} " if escapes % 2 and len(line) > len(ended) else ended


def _quoted(text: str) -> str:
    """Return a scalar in double quotes if it is in single quotes and needs no escape in double ones."""
    if text[0] != "'" or '"' in text or "\\" in text:
        return text
    return '"' + text[1:-1].replace("''", "'") + '"'


def _outdented(text: str) -> str:
    """Return a scalar of several lines without their common indentation."""
    first, *rest = text.split("\n")
    filled = next((line for line in rest if line.strip()), "")
    indent = len(filled) - len(filled.lstrip(" "))
    return "\n".join([first, *(line[indent:] for line in rest)])
