"""The device of an id is the one beside the user, for every command: here, in ./descriptions, then what is shipped."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest
from fieldscribe.cli import main
from support.described import write

if TYPE_CHECKING:
    from pathlib import Path

OWN = """fieldscribe: 1
device: hitachi_l200
version: 7.0.0
vendor: Example
model: Own
title: Own
family: modbus
documents: {manual: {title: Own, language: en}}
bus: {framings: [rtu], units: 1..247, functions: {03h: read_holding_registers}}
---
group: main
access: r
space: holding
source: {document: manual, section: "1"}
points:
- {name: own, at: 1}
"""
COMMANDS = (
    "explain hitachi_l200 own",
    "export json hitachi_l200",
    "generate hitachi_l200 --list-outputs --target docs",
    "check hitachi_l200",
    "list hitachi_l200",
    "search Own --device hitachi_l200",
)


@pytest.mark.parametrize("folder", ["hitachi_l200", "descriptions/hitachi_l200"])
def test_what_is_here_is_not_passed_over(
    folder: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    write(tmp_path / folder, OWN)
    monkeypatch.chdir(tmp_path)
    for command in COMMANDS:
        assert main(command.split()) == 0, command
    printed = capsys.readouterr()
    assert "Frequenzumrichter" not in printed.out + printed.err
    assert main(["export", "json", "hitachi_l200"]) == 0
    assert json.loads(capsys.readouterr().out)["version"] == "7.0.0"
    assert main(["diff", "hitachi_l200", folder]) == 0
    assert main(["list"]) == 0
    assert "7.0.0" in capsys.readouterr().out


def test_a_folder_without_a_description_hides_no_device(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "hitachi_l200").mkdir()
    monkeypatch.chdir(tmp_path)
    for command in ("check hitachi_l200", "explain hitachi_l200 A020"):
        assert main(command.split()) == 0, capsys.readouterr()
