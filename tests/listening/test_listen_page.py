"""The page on listening: its commands print what it shows."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from fieldscribe.cli import main
from support.places import ROOT

PAGE = (ROOT / "descriptions/using/listen.md").read_text("utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


@pytest.mark.full(seconds=1)
def test_the_commands_print_what_the_page_shows(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "line.log").write_text(blocks("log")[0], "utf-8")
    monkeypatch.chdir(tmp_path)
    for command, shown in zip(blocks("sh"), blocks("text"), strict=True):
        main(shlex.split(command)[1:])
        assert capsys.readouterr().out.startswith(shown)
