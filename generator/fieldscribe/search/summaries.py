"""What a description says of itself, and the names of its points: read without working them out, so it is quick."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_outline
from fieldscribe.resolve.scope import titles
from fieldscribe.text import line

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path


@dataclass(frozen=True, slots=True)
class Outline:
    """One device in a list; `names` are the names and codes of its points, `points` how many there are."""

    id: str
    vendor: str
    model: str
    title: dict[str, str]
    family: str
    version: str
    points: int
    names: tuple[str, ...]

    def as_data(self) -> dict[str, object]:
        """The same for JSON."""
        return {
            "device": self.id,
            "vendor": self.vendor,
            "model": self.model,
            "title": self.title,
            "family": self.family,
            "version": self.version,
            "points": self.points,
        }


def outline_of(device_file: Path) -> Outline | None:
    """What a description says of itself; None where it cannot be read."""
    outline = load_outline(device_file, Report())
    if outline is None:
        return None
    header, drafts = outline
    words = {key: line(str(header.get(key, ""))) for key in ("device", "vendor", "model", "family", "version")}
    title = {str(key): line(str(text)) for key, text in titles(header.get("title")).items()}
    names = dict.fromkeys(name for draft in drafts for name in (draft.item, draft.code) if name)
    return Outline(
        words["device"],
        words["vendor"],
        words["model"],
        title,
        words["family"],
        words["version"],
        len(drafts),
        tuple(line(name) for name in names),
    )


def outlines_of(device_files: Iterable[Path]) -> list[Outline]:
    """Those that can be read, in the order given."""
    return [outline for file in device_files if (outline := outline_of(file)) is not None]
