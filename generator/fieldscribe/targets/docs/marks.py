"""Tables of a device for the HTML page: plain texts, in which marks say what is code, a link, or the end of a cell.

The marks are private characters, which `line` removes from every text of a description. The page makes elements and
text nodes of the text between them, so that no text can become markup.
"""

from collections.abc import Sequence

from fieldscribe.model import Source
from fieldscribe.targets.docs.cells import Form, source_text
from fieldscribe.text import line

_START, _MIDDLE, _END, _CELL, _ROW = "\ue000", "\ue001", "\ue002", "\ue003", "\ue004"
_TARGET = "="
"""Begins the kind of a target of links."""


def _marked(kind: str, text: str) -> str:
    return f"{_START}{kind}{_MIDDLE}{line(text)}{_END}"


def _code(text: str) -> str:
    return _marked("", text)


def _target(kind: str, name: str) -> str:
    return _marked(_TARGET + kind, name)


def _source_cell(source: Source, with_document: bool) -> str:
    return line(source_text(source, with_document))


def _lay_out(rows: Sequence[Sequence[str]]) -> str:
    return _ROW.join(_CELL.join(row) for row in rows)


MARKED = Form(line, line, _code, _marked, _marked, _target, _target, _source_cell, "\n", _lay_out)
