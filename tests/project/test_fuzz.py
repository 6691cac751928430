"""A small sample of what `make fuzz` does, and that it would find something."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest
from fuzz import languages, run
from fuzz.descriptions import mutant
from fuzz.frames import CASES
from support.toolchains import tool

SEED = 20261122
CLANG = ("C (clang)",)
"""Its sanitizers look for all that those of gcc do, and for more; `make fuzz` takes both."""


def test_the_same_seed_makes_the_same_cases() -> None:
    """A case is found again by its seed and its number."""
    assert [mutant(SEED, index) for index in range(20)] == [mutant(SEED, index) for index in range(20)]
    for cases in CASES.values():
        assert list(cases(Random(SEED), 50)) == list(cases(Random(SEED), 50))


@pytest.mark.full(seconds=5)
def test_descriptions_and_words(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Random words end in findings, never in a traceback; test_robust has more of the same mutants."""
    found = run.table(run.everything(SEED, tmp_path, mutants=4, lines=60), SEED)
    assert found == 0, capsys.readouterr().out


@pytest.mark.full(seconds=12)
def test_frames_in_all_languages(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No sanitizer speaks up, and all languages say the same of the same frames."""
    for name in ("clang", "cargo"):
        tool(name)
    monkeypatch.setenv("CARGO_PROFILE_RELEASE_OPT_LEVEL", "0")  # so few cases take less time than an optimizer
    languages.generate(tmp_path)
    for family in CASES:
        for result in languages.fuzz_family(family, 5_000, SEED, tmp_path, CLANG):
            assert result.findings == (), result.what


def test_a_difference_is_told(tmp_path: Path) -> None:
    """With the case and what each language says of it."""
    (tmp_path / "a").write_text("ok 0\nok 1\n", "utf-8")
    (tmp_path / "b").write_text("ok 0\nbad_crc 0\n", "utf-8")
    found = list(languages.differences({"C": tmp_path / "a", "Rust": tmp_path / "b"}, "modbus", SEED, 2))
    assert len(found) == 1
    assert found[0].startswith("case 1 (")
    assert found[0].endswith("C: ok 1; Rust: bad_crc 0")


@pytest.mark.full(seconds=5)
def test_a_parser_that_writes_too_far_is_found(tmp_path: Path) -> None:
    """The sanitizers of C see one value beyond those that were asked for."""
    tool("clang")
    languages.generate(tmp_path)
    header = tmp_path / "c" / "fieldscribe_modbus.h"
    text = header.read_text("utf-8")
    header.write_text(text.replace("at < request->count; ++at", "at <= request->count; ++at"), "utf-8")
    commands = languages.build_c("modbus", tmp_path, CLANG)
    for result in languages.fuzz_programs(commands, "modbus", 200, SEED, tmp_path):
        assert "heap-buffer-overflow" in result.findings[0]
