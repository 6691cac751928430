"""The page on working does what it says, in the order of the page."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from fieldscribe.cli import main
from support.places import ROOT

PAGE = ROOT / "descriptions/language/working.md"
COMMAND = re.compile(r"^\$ fieldscribe (.*)\n((?:(?!\$ |```).*\n)*)", re.MULTILINE)


def test_every_command_prints_what_the_page_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    commands = COMMAND.findall(PAGE.read_text("utf-8"))
    for command, printed in commands:
        assert main(shlex.split(command)) == 0, command
        assert capsys.readouterr() == (printed, ""), command
    assert len(commands) == 4
