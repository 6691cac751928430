"""Where things lie that tests use, wherever the tests lie."""

from __future__ import annotations

import os
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TESTS = ROOT / "tests"
PACKAGES = Path(os.environ.get("FIELDSCRIBE_PACKAGES", ROOT / "generated/python"))
"""The generated packages of Python that are tested: the committed ones, or those of a mutant."""


def has_text(device: str, manuals: Path) -> bool:
    """Whether a folder has the text of a device's manual."""
    head = (ROOT / "descriptions" / device / "device.yaml").read_text("utf-8")
    return any((manuals / name).is_file() for name in re.findall(r"(?m)^    file: (.+)$", head))
