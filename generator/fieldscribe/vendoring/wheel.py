"""A wheel of a package and its runtime, built by hatchling: the same bytes every time."""

from __future__ import annotations

import os
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

_RUNTIME = "fieldscribe_runtime"


def wheel_of(texts: Mapping[str, str], package: str) -> tuple[str, bytes]:
    """The name and the bytes of the wheel of these files. Raises ModuleNotFoundError where hatchling is missing."""
    from hatchling.builders.wheel import WheelBuilder

    with TemporaryDirectory() as folder:
        root = Path(folder)
        for path, text in texts.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(text, "utf-8", newline="\n")
        project = _project(texts[f"{package}/pyproject.toml"], package)
        (root / "pyproject.toml").write_text(project, "utf-8")
        before = os.environ.get("SOURCE_DATE_EPOCH")
        os.environ.pop("SOURCE_DATE_EPOCH", None)  # hatchling's own date is the same for everybody
        try:
            [built] = WheelBuilder(folder).build(directory=folder, versions=["standard"])
        finally:
            if before is not None:
                os.environ["SOURCE_DATE_EPOCH"] = before
        place = Path(built)
        return place.name, place.read_bytes()


def _project(text: str, package: str) -> str:
    """The project file of both: that of the device, which needs no other package."""
    kept = [
        line for line in text.split("[tool.hatch", maxsplit=1)[0].splitlines() if not line.startswith("dependencies = ")
    ]
    packages = f'packages = ["{package}", "{_RUNTIME}"]'
    return "\n".join([*kept, "[tool.hatch.build.targets.wheel]", packages, 'exclude = ["pyproject.toml"]', ""])
