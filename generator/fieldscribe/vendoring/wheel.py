"""Wheels of a package and of its runtime, built by hatchling: the same bytes every time."""

from __future__ import annotations

import os
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping


def wheels_of(texts: Mapping[str, str]) -> Iterator[tuple[str, bytes]]:
    """Names and bytes of the wheels of the projects in these files. Raises ModuleNotFoundError without hatchling."""
    with TemporaryDirectory() as folder:
        root = Path(folder)
        for path, text in texts.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(text, "utf-8", newline="\n")
        for project in sorted(root.glob("*/pyproject.toml")):
            built = _built(project.parent, root)
            yield built.name, built.read_bytes()


def _built(project: Path, out: Path) -> Path:
    """The wheel of a project; hatchling's own date is the same for everybody."""
    from hatchling.builders.wheel import WheelBuilder

    before = os.environ.pop("SOURCE_DATE_EPOCH", None)
    try:
        [built] = WheelBuilder(str(project)).build(directory=str(out), versions=["standard"])
    finally:
        if before is not None:
            os.environ["SOURCE_DATE_EPOCH"] = before
    return Path(built)
