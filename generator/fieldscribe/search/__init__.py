"""Lists and searches descriptions. This module: summaries, read quickly because no point is resolved.

`entries` collects everything that has a name, `matching` searches words in it.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_outline
from fieldscribe.resolve.scope import titles
from fieldscribe.text import line


@dataclass(frozen=True, slots=True)
class Summary:
    """A device in a list; `points` is their number, `names` are their names and codes."""

    device: str
    vendor: str
    model: str
    title: dict[str, str]
    family: str
    version: str
    points: int
    names: tuple[str, ...]

    def as_data(self) -> dict[str, Any]:
        """Return the summary for JSON."""
        return {key: value for key, value in asdict(self).items() if key != "names"}


def summary_of(device_file: Path) -> Summary | None:
    """Return the summary of a description; None if it cannot be read."""
    outline = load_outline(device_file, Report())
    if outline is None:
        return None
    header, drafts = outline
    texts = [line(str(header.get(key, ""))) for key in ("device", "vendor", "model", "family", "version")]
    device, vendor, model, family, version = texts
    title = {str(key): line(str(text)) for key, text in titles(header.get("title")).items()}
    names = dict.fromkeys(line(name) for draft in drafts for name in (draft.item, draft.code) if name)
    return Summary(device, vendor, model, title, family, version, len(drafts), tuple(names))
