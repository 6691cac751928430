"""The page about importing says what happens."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from fieldscribe.cli import main
from fieldscribe.importing.headings import ROLES
from support.places import ROOT

PAGE = ROOT / "descriptions" / "language" / "tables.md"
COMMAND = re.compile(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", re.MULTILINE)


def test_the_page_about_tables(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```(\w+)\n(.*?)^```$", PAGE.read_text("utf-8"), re.MULTILINE | re.DOTALL)
    for kind, text in blocks:
        if kind == "csv":
            (tmp_path / "registers.csv").write_text(text, "utf-8")
        for command, printed in COMMAND.findall(text) if kind == "console" else ():
            assert main(shlex.split(command)[1:]) == 0
            assert capsys.readouterr().out == printed
    assert {kind for kind, _ in blocks} == {"csv", "console"}


def test_the_page_names_what_columns_may_hold() -> None:
    text = PAGE.read_text("utf-8")
    assert [role for role in ROLES if f"`{role}`" not in text] == []
