"""From a file to its tables: which reader takes it, and in which encoding its text is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.audit.editions.tables.tables import MOST_BYTES, UnreadableError

if TYPE_CHECKING:
    from pathlib import Path

    from fieldscribe.audit.editions.tables.tables import Table

FORMS = {
    ".csv": "CSV",
    ".tsv": "TSV",
    ".tab": "TSV",
    ".md": "text",
    ".markdown": "text",
    ".txt": "text",
    ".html": "HTML",
    ".htm": "HTML",
    ".xlsx": "XLSX",
}
"""Which reader takes a file, by how its name ends."""


def read_tables(path: Path) -> list[Table]:
    """The tables of the file. Raises OSError, UnreadableError and MissingExtraError."""
    from fieldscribe.audit.editions.tables.sheets import read_delimited, read_workbook
    from fieldscribe.safe_files import read_regular

    form = FORMS[path.suffix.lower()]
    data = read_regular(path, MOST_BYTES).data
    if form == "XLSX":
        return read_workbook(data)
    text = _decoded(data)
    if form == "text":
        from fieldscribe.audit.editions.tables.text_tables import read_text

        return read_text(text)
    if form == "HTML":
        from fieldscribe.audit.editions.tables.web_tables import read_web

        return read_web(text)
    return read_delimited(text, "\t" if form == "TSV" else "")


def _decoded(data: bytes) -> str:
    """The text of a file: UTF-8, UTF-16 with its mark, or what Windows writes in the West."""
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        encoding = "utf-16"
    else:
        try:
            return data.decode("utf-8-sig")
        except UnicodeDecodeError:
            encoding = "cp1252"
    try:
        return data.decode(encoding)
    except UnicodeDecodeError as error:
        raise UnreadableError(
            "this is no text in UTF-8, UTF-16 or Windows-1252", data[: error.start].count(b"\n") + 1
        ) from error
