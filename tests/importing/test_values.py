"""Values of imported samples in every language, as readers of the corpus have them, which know the files alone."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from corpus.values import compare

SAMPLES = Path(__file__).parent


SUNSPEC = ("model_160.json", "model_63001.json")
"""A model with a repeating block, and the one that has every type; `make corpus` compares all of a collection."""


@pytest.mark.full(seconds=60)
def test_samples_have_the_values_of_their_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for path in (
        *(SAMPLES / "sunspec" / name for name in SUNSPEC),
        *SAMPLES.glob("wb/*_*.jinja"),
        SAMPLES / "engine.dbc",
    ):
        shutil.copy(path, tmp_path)
    for path in (*SAMPLES.glob("wb/heater.json"), *SAMPLES.glob("wb/relays.json.jinja")):
        shutil.copy(path, tmp_path / f"config-{path.name}")
    different = compare(tmp_path, 6_000)
    printed = capsys.readouterr().out
    assert (different, printed.count("| 0 | 0 | 0 |")) == (0, 3), printed
