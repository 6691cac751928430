"""The first programs of the README, in C and Rust, with a simulated drive at the end of their line."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from fieldscribe.simulation import simulated
from support.places import ROOT
from support.rust_programs import BLOCKS, built_programs
from support.toolchains import succeed, tool

README = (ROOT / "README.md").read_text("utf-8")
NUMBERS = {"base_frequency": 40, "output_frequency": 12.5}
BOARD = Path(__file__).parent / "programs/board.c"


def first(language: str, page: str) -> str:
    """Return the first block of a language on a page."""
    found = re.search(rf"^```{language}\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    assert found is not None
    return found[1]


@pytest.mark.full(seconds=2)
def test_c(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It reads the output frequency, and sets the base frequency to 50 Hz because of it, again and again."""
    page = (ROOT / "descriptions/using/c.md").read_text("utf-8")
    header, program = (
        next(block for block in re.findall(r"^```c\n(.*?)^```$", page, re.MULTILINE | re.DOTALL) if mark in block)
        for mark in ("bool uart_receive(void *context, uint32_t milliseconds, uint8_t *byte);", "int main(void)")
    )
    assert first("c", README) in program
    (tmp_path / "board.h").write_text(header, "utf-8")
    (tmp_path / "main.c").write_text(program, "utf-8")
    flags = ("-std=gnu99", "-Wall", "-Wextra", "-Werror", "-O1", f"-I{tmp_path}", f"-I{ROOT / 'generated/c'}")
    succeed([tool("gcc"), *flags, tmp_path / "main.c", BOARD, "-o", tmp_path / "main"])
    with simulated("hitachi_l200", on="tcp", unit=5, values=NUMBERS) as drive:
        monkeypatch.setenv("PORT", str(drive.port))
        succeed([tmp_path / "main"])
        assert (drive.requests, drive.values["base_frequency"]) == (4, 50)


@pytest.mark.full(seconds=2)
def test_rust(
    tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch
) -> None:
    built = built_programs(tmp_path_factory, request.config)
    assert BLOCKS["rust"][0]["text"] == first("rust", README)
    with simulated("hitachi_l200", on="tcp", values=NUMBERS) as drive:
        monkeypatch.setenv("RTU", f"127.0.0.1:{drive.port}")
        monkeypatch.setenv("PAGE", "0")
        assert succeed([built / "pages"]) == "12.5 Hz\n"
        assert drive.values["base_frequency"] == 50
