"""The examples of `--help` run, and none is a wrong call."""

from __future__ import annotations

import re
import shlex
from typing import TYPE_CHECKING

import pytest
from fieldscribe import pipeline
from fieldscribe.cli import command_of, main
from support.described import shipped
from support.places import ROOT

if TYPE_CHECKING:
    from pathlib import Path

    from fieldscribe.model import Device

COMMANDS = ("decode", "list", "search", "completion", "units")


@pytest.mark.full(seconds=6)
@pytest.mark.parametrize("command", COMMANDS)
def test_examples(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def load(device_file: Path, *_more: object) -> Device:
        return shipped(device_file.parent.name)

    monkeypatch.setattr(pipeline, "load_device", load)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "descriptions").symlink_to(ROOT / "descriptions")
    (tmp_path / "candump.log").write_text("(1.5) can0 321#DD010302000007D0\n")
    examples = re.findall(
        r"^  (?:\S+ .*\| )?fieldscribe (.*?)(?: [>|] .*)?$", command_of(command).EXAMPLE, re.MULTILINE
    )
    assert examples
    for example in examples:
        words = shlex.split(re.sub(r" - ", " --log candump.log ", example))
        assert main(words) in (0, 1), example
        assert "fieldscribe: " not in capsys.readouterr().err
