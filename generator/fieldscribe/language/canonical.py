"""Writes the canonical form of a description: uniform blanks, indentation and quotes.

The order of the pieces, and which of them share a line, stay as the author wrote them. Mappings are indented by two.
The dashes of a list stand below its key, further lines in brackets below the first piece inside. Texts get double
quotes.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

from fieldscribe.language.pieces import Comment, Gap, OddError, Piece, pieces

_INDENT = 2
_OPENING, _CLOSING = frozenset("[{"), frozenset("]}")
_DOCUMENT_MARKS = frozenset({"---", "..."})
_BEFORE_A_VALUE = frozenset(":-")


def canonical(text: str) -> str:
    """Return the canonical form of a valid text, with one kind of line break. Raises OddError."""
    layout = _Layout()
    for piece in _without_last_commas(pieces(text)):
        layout.place(piece)
    return layout.text()


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
        elif piece.kind == "document" and self.within:
            self.within.clear()

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
