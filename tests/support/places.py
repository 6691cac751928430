"""Where things lie that tests use, wherever the tests lie."""

from __future__ import annotations

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TESTS = ROOT / "tests"
PACKAGES = Path(os.environ.get("FIELDSCRIBE_PACKAGES", ROOT / "generated/python"))
"""The generated packages of Python that are tested: the committed ones, or those of a mutant."""
