"""The page on vendoring is walked as it stands there: its files, its commands, and what they print.

After a change of wording say `FIELDSCRIBE_ACCEPT=1 pytest tests/vendoring/test_vendoring_page.py`, and look at it.
"""

from __future__ import annotations

import os
import re
import shlex
from pathlib import Path

import pytest
from fieldscribe.cli import main
from support.places import ROOT

PAGE = ROOT / "descriptions/using/vendoring.md"
BLOCK = re.compile(r"(?:`(?P<name>[\w./]+)`:\n\n)?^```(?P<kind>\w+)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.mark.full(seconds=2)
def test_the_page_is_walked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)

    def walked(block: re.Match[str]) -> str:
        if block["name"]:
            (tmp_path / block["name"]).write_text(block["text"], "utf-8")
            return block[0]
        assert block["kind"] == "console"
        seen = ""
        for command in re.findall(r"^\$ fieldscribe (.*)$", block["text"], re.MULTILINE):
            assert main(shlex.split(command)) == 0
            seen += f"$ fieldscribe {command}\n{capsys.readouterr().out}"
        return f"```console\n{seen}```"

    seen = BLOCK.sub(walked, PAGE.read_text("utf-8"))
    if os.environ.get("FIELDSCRIBE_ACCEPT"):
        PAGE.write_text(seen, "utf-8")
    assert seen == PAGE.read_text("utf-8")
