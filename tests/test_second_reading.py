"""Each description that was read a second time is held against that reading; see second_reading.py."""

from __future__ import annotations

import pytest
from second_reading import ROOT

READ_TWICE = sorted(path.stem for path in (ROOT / "tests/readings").glob("*.jsonl"))


@pytest.mark.parametrize("name", READ_TWICE)
def test_each_reading_is_compared(name: str) -> None:
    described = (ROOT / "descriptions" / name).is_dir()
    assert (ROOT / f"tests/test_second_reading_{name}.py").is_file() == described
