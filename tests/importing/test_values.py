"""Values of imported samples in C and Python, as readers of the corpus have them, which know the files alone."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from corpus.values import compare

SAMPLES = Path(__file__).parent
SUNSPEC = SAMPLES / "sunspec/model_63001.json"
"""The model that has every type; test_sunspec_values.py compares all of them.

`make corpus` compares Rust, too, which takes long to build: the vectors of all devices say that it decodes as C does.
"""


@pytest.mark.full(seconds=10)
def test_samples_have_the_values_of_their_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for path in (SUNSPEC, *SAMPLES.glob("wb/*_*.jinja"), SAMPLES / "engine.dbc"):
        shutil.copy(path, tmp_path)
    for path in (*SAMPLES.glob("wb/heater.json"), *SAMPLES.glob("wb/relays.json.jinja")):
        shutil.copy(path, tmp_path / f"config-{path.name}")
    different = compare(tmp_path, 2_000, languages=("c", "python"))
    printed = capsys.readouterr().out
    assert (different, printed.count("| 0 | 0 |\n")) == (0, 3), printed
