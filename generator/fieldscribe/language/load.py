"""YAML 1.2 text to plain values that remember where they stand: one mapping for each document."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.language.lines import plain_documents

if TYPE_CHECKING:
    from fieldscribe.diagnostics import Report
    from fieldscribe.language.nodes import Map
    from fieldscribe.language.source import SourceFile


def load(source: SourceFile, report: Report) -> list[Map | None]:
    """The mapping of each document; None, with a finding, for a document that is no mapping or cannot be read.

    Empty documents are left out; duplicate keys are left out. Nearly all files are plain; PyYAML reads the others.
    """
    documents = plain_documents(source)
    if documents is not None:
        return [*documents]
    from fieldscribe.language.events import load_any

    return load_any(source, report)
