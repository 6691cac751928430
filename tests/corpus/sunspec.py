"""Models of sunspec/models, each as a device with two elements of what repeats."""

from __future__ import annotations

from pathlib import Path

from fieldscribe.importing.sunspec import draft_models
from fieldscribe.importing.sunspec.models import read_models

from corpus.collection import Collection, Drafted


def _files(folder: Path) -> list[Path]:
    return sorted(folder.rglob("model_*.json"))


def _draft(file: Path) -> Drafted:
    return Drafted(*draft_models(read_models(file, ()), "device", 2, {}))


SUNSPEC = Collection("sunspec", _files, _draft)
