"""The page on simulated devices: its commands, its bench and its programs run as they stand."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from fieldscribe.cli import main
from fieldscribe.simulation.line import KINDS
from fieldscribe.simulation.servers import simulated
from support.help_examples import stops_at_once
from support.places import ROOT
from support.python_package import imported

PAGE = (ROOT / "descriptions/using/simulate.md").read_text("utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


@pytest.mark.full(seconds=1)
def test_the_commands_and_the_bench_run(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    stops_at_once(monkeypatch)
    (command,) = blocks("sh")
    (bench,) = blocks("yaml")
    (tmp_path / "bench.yaml").write_text(bench, "utf-8")
    assert main(shlex.split(command)[1:]) == 0
    assert capsys.readouterr().out.startswith(re.sub(r"\d+\n$", "", blocks("text")[0]))
    assert main(["simulate", "--bench", str(tmp_path / "bench.yaml")]) == 0
    answering = capsys.readouterr().out.splitlines()[:-1]
    assert len(answering) == 23
    assert answering[-1].startswith("jumo_controller answers as unit 1 on /dev/")


def test_the_faults_are_those_that_there_are() -> None:
    rows = re.findall(r"^\| (`[a-z]+(?: N)?`(?:, `[a-z]+`)?) \|", PAGE, re.MULTILINE)
    assert {name for row in rows for name in re.findall(r"`([a-z]+)", row)} == set(KINDS)


@pytest.mark.full(seconds=1)
def test_the_programs_run(capsys: pytest.CaptureFixture[str]) -> None:
    program, fixture = blocks("python")
    for _package in imported(ROOT / "generated/python", "hitachi_l200"):
        exec(compile(program, "page", "exec"), {})
    assert capsys.readouterr().out.split() == ["12.5", "60", "2", "12.5"]
    known: dict[str, object] = {}
    exec(compile(fixture, "page", "exec"), known)
    with simulated("hitachi_l200", values={"output_frequency": 12.5}) as drive:
        known["test_the_frequency_is_read"](lambda *_, **__: drive)  # type: ignore[operator]  # of the page
