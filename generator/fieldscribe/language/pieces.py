"""Splits a YAML text into pieces for `canonical.py`: signs, scalars and marks, each with the comments before it."""

import re
from collections.abc import Iterator
from typing import Any, NamedTuple

import yaml

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


def unbroken(text: str) -> str:
    """Return the text with one kind of line break."""
    return text.replace("\r\n", "\n").replace("\r", "\n")


def comments(text: str) -> list[str]:
    """Return the comments of a text without errors, in order. Raises OddError."""
    texts: list[str] = []
    for piece in pieces(text):
        gap = piece.gap
        texts += [comment.text for comment in (gap.trailing, *gap.lines) if comment is not None]
    return texts


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
