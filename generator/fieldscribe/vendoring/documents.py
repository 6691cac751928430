"""The documentation of a device for a project: the page, the tables as CSV, or a workbook."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device

FORMATS = {
    "csv": "the points and their meanings as tables",
    "markdown": "the reference as a page",
    "xlsx": "the tables, and the errata, as a workbook",
}
"""What documentation can be, and what that is."""


@dataclass(frozen=True, slots=True)
class DocumentsWish:
    """That a project wants documentation in a format; it calls the device by its id."""

    language: str
    name: None = None

    def command(self, device: str) -> tuple[str, ...]:
        """The words of the command that makes the files anew."""
        return "fieldscribe", "docs", device, "--format", self.language

    def as_data(self, device: str) -> dict[str, object]:
        """What a manifest says of it."""
        return {"device": device}

    def contents(self, device: Device) -> Iterator[tuple[str, bytes]]:
        """The files: path below the folder, and bytes. Raises ModuleNotFoundError for a workbook without XlsxWriter."""
        from fieldscribe.render import render
        from fieldscribe.targets.docs import csv_files, markdown_files, xlsx_files
        from fieldscribe.targets.docs.subjects import scope_of

        scope = scope_of(replace(device, asked=self.command(device.id)))
        if self.language == "xlsx":
            yield from xlsx_files(scope)
            return
        texts = csv_files(scope) if self.language == "csv" else markdown_files(scope, render)
        for path, text in texts:
            yield path, text.encode()
