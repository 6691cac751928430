"""What may change in a description without touching code: titles, notes and sources are for people."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from fieldscribe.pipeline import outputs
from support.described import loaded
from support.places import ROOT

CODE = ("c", "python", "rust", "typescript")


def compiled(folder: Path) -> dict[str, str]:
    return {path: text for _, path, text in outputs(loaded(folder / "device.yaml"), CODE)}


@pytest.mark.full(seconds=1)
@pytest.mark.parametrize(
    "change",
    [
        lambda text: re.sub(r"\ben: [A-Z]\w+", "en: Something", re.sub(r"\bde: [A-Z]\w+", "de: Anderes", text)),
        lambda text: "# a comment\n" + re.sub(r"line: (\d+)", lambda found: f"line: {int(found[1]) + 7}", text),
    ],
    ids=["titles", "lines and comments"],
)
def test_what_is_for_people_does_not_reach_code(tmp_path: Path, change: Callable[[str], str]) -> None:
    folder = tmp_path / "hitachi_l200"
    shutil.copytree(ROOT / "descriptions/hitachi_l200", folder)
    for path in folder.glob("*.yaml"):
        path.write_text(change(path.read_text("utf-8")), "utf-8")
    assert compiled(folder) == unchanged()


@cache
def unchanged() -> dict[str, str]:
    return compiled(ROOT / "descriptions/hitachi_l200")
