"""Large runs render half of the targets in a child process; what is written is the same."""

from __future__ import annotations

import os
import shutil
import signal
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.cli import main
from fieldscribe.output import generation
from fieldscribe.output.generation import halves
from fieldscribe.targets import docs

pytestmark = [
    pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning"),  # of tests that run in threads
    pytest.mark.skipif(not hasattr(os, "fork"), reason="needs a system that forks"),
]
TARGETS = "python,docs,vectors"
SIX = ("docs", "typescript", "vectors", "rust", "python", "c")


def in_children(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(generation, "MANY_POINTS", 1)
    monkeypatch.setattr(generation, "may_have_children", lambda: True)


def contents(out: Path) -> dict[str, bytes]:
    return {str(path.relative_to(out)): path.read_bytes() for path in out.rglob("*") if path.is_file()}


@pytest.mark.parametrize(
    ("targets", "expected"),
    [
        (SIX, (("c", "python", "rust", "vectors"), ("typescript", "docs"))),
        (("rust", "python", "c"), (("c",), ("python", "rust"))),
        (("docs",), (("docs",), ())),
    ],
)
def test_halves_take_about_as_long(targets: Iterable[str], expected: tuple[tuple[str, ...], tuple[str, ...]]) -> None:
    """In any order; the page of a device stays with the package whose scripts it has."""
    assert halves(tuple(targets)) == expected


def test_the_same_files_are_written(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(project / "descriptions/jumo_controller", project / "descriptions/other")
    place = project / "descriptions/other/device.yaml"
    place.write_text(place.read_text("utf-8").replace("device: jumo_controller", "device: other"), "utf-8")
    assert main(["generate", "--target", TARGETS]) == 0
    parent = os.getpid()
    outputs = docs.outputs

    def elsewhere(device: Any, render: Any) -> Any:
        assert os.getpid() != parent
        return outputs(device, render)

    in_children(monkeypatch)
    monkeypatch.setattr(docs, "outputs", elsewhere)
    assert main(["generate", "--target", TARGETS, "--out", "apart"]) == 0
    assert contents(project / "apart") == contents(project / "generated")


def test_a_target_that_fails_in_a_child_leaves_its_device_alone(
    project: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def failing(*_: Any) -> Any:
        raise ValueError("no page")

    in_children(monkeypatch)
    monkeypatch.setattr(docs, "outputs", failing)
    assert main(["generate", "--target", TARGETS]) == 1
    assert "internal error in target docs: ValueError: no page" in " ".join(capsys.readouterr().err.split())
    assert not (project / "generated/vectors").exists()


def test_a_child_that_is_killed_ends_the_run(
    project: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """As by a system that has no memory left."""
    in_children(monkeypatch)
    monkeypatch.setattr(docs, "outputs", lambda *_: os.kill(os.getpid(), signal.SIGKILL))
    assert main(["generate", "--target", TARGETS]) == 2
    assert "a process that made files broke off: is there enough memory, and room for temporary files?" in " ".join(
        capsys.readouterr().err.split()
    )
    assert not (project / "generated/vectors").exists()
