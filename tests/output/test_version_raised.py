"""A version that was to be raised: `generate` says by which step, until it is."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.cli import main
from fieldscribe.export import export_model
from fieldscribe.output.versions import checksum, model_of, record_of
from support.described import described, made, shipped, write

if TYPE_CHECKING:
    from collections.abc import Callable

POINTS = """\
- {name: speed, title: Speed, at: 0, range: 0..4000, scale: value = raw * 0.1, unit: Hz, line: 7}
- {name: mode, at: 1, enum: {0: stopped, 1: running}}
"""
MODE = "{0: stopped, 1: running}"
CHANGES = {
    "a comment": ("- {name: mode", "# a comment\n- {name: mode", None),
    "the layout": ("name: mode, at: 1", "name: mode,  at: 0x0001", None),
    "a title": ("title: Speed", "title: Speed of the motor", "patch"),
    "a note": ("at: 1,", "at: 1, note: Said on the panel,", "patch"),
    "a range": ("0..4000", "0..5000", "minor"),
    "a new point": ("- {name: mode", "- {name: load, at: 9}\n- {name: mode", "minor"),
    "an entry": (MODE, "{0: stopped, 1: running, 2: tripped}", "minor"),
    "an address": ("at: 1,", "at: 2,", "major"),
    "a scale": ("raw * 0.1", "raw * 0.01", "major"),
    "a name": ("name: mode", "name: state", "major"),
    "no point": (f"- {{name: mode, at: 1, enum: {MODE}}}\n", "", "major"),
}
"""What is written for what, and the step that it asks for."""

LEAST = {"patch": "1.2.4", "minor": "1.3.0", "major": "2.0.0"}


class Project:
    """A description of version 1.2.3 that was generated once, and can be changed."""

    def __init__(self, folder: Path) -> None:
        self.out = folder / "out"
        self.folder = folder / "made_up"
        self.say()
        assert self.generate() == 0

    def say(self, old: str = "", new: str = "", version: str = "1.2.3") -> None:
        assert POINTS.count(old)
        write(self.folder, described(POINTS.replace(old, new) if old else POINTS, version=version))

    def generate(self, *more: str) -> int:
        return main(["generate", str(self.folder), "--out", str(self.out), "--target", "vectors", *more])

    @property
    def facts(self) -> str:
        return (self.out / "manifest/made_up.facts.json").read_text("ascii")


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Project:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    project = Project(tmp_path)
    assert capsys.readouterr().err == ""
    return project


@pytest.mark.parametrize(("old", "new", "step"), CHANGES.values(), ids=CHANGES)
def test_a_change_asks_for_a_step(
    project: Project, old: str, new: str, step: str | None, capsys: pytest.CaptureFixture[str]
) -> None:
    project.say(old, new)
    assert project.generate() == 0
    said = capsys.readouterr().err
    assert project.generate("--check", "--strict-version") == (step is not None)
    if step is None:
        assert said == ""
        return
    asked = f"since its version 1.2.3 was generated, and the changes ask for a {step} step, to {LEAST[step]}"
    assert said.startswith(f"warning[version-not-raised]: `made_up` has changed {asked}\n")
    assert f"{project.folder / 'device.yaml'}:3:10" in said
    project.say(old, new, LEAST[step])
    capsys.readouterr()
    assert project.generate() == 0
    assert project.generate("--check", "--strict-version") == 0
    assert capsys.readouterr().err == ""


def test_it_is_said_until_the_version_is_raised(project: Project, capsys: pytest.CaptureFixture[str]) -> None:
    first = project.facts
    for version in ("1.2.3", "1.2.3", "1.2.4", "1.99.0"):
        project.say("at: 1,", "at: 2,", version)
        assert project.generate() == 0
        assert "ask for a major step, to 2.0.0\n" in capsys.readouterr().err
        assert project.facts == first
    project.say("at: 1,", "at: 2,", "2.1.0")
    assert project.generate() == 0
    assert capsys.readouterr().err == ""
    assert '"version": "2.1.0"' in project.facts


def test_who_takes_the_change_back_owes_nothing(project: Project, capsys: pytest.CaptureFixture[str]) -> None:
    project.say("at: 1,", "at: 2,")
    assert project.generate() == 0
    capsys.readouterr()
    project.say()
    assert project.generate() == 0
    assert capsys.readouterr().err == ""


def test_a_version_that_nobody_has_may_change(project: Project, capsys: pytest.CaptureFixture[str]) -> None:
    project.say("at: 1,", "at: 2,")
    assert project.generate("--unreleased") == 0
    assert project.generate("--check", "--strict-version") == 0
    assert capsys.readouterr().err == ""


def test_the_committed_output_is_enough(project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another machine has neither our cache nor the old description."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "another cache"))
    project.out = Path(shutil.move(project.out, tmp_path / "clone"))
    assert project.generate("--check", "--strict-version") == 0
    project.say("0..4000", "0..5000")
    assert project.generate() == 0
    assert project.generate("--check") == 0
    assert project.generate("--check", "--strict-version") == 1


def test_tools_read_it_as_a_finding(project: Project, capsys: pytest.CaptureFixture[str]) -> None:
    project.say("0..4000", "0..5000")
    for more, severity in ((("--check",), "warning"), (("--check", "--strict-version"), "error")):
        project.generate(*more, "--format", "json")
        [finding] = json.loads(capsys.readouterr().out)["findings"]
        assert (finding["rule"], finding["severity"], finding["line"]) == ("version-not-raised", severity, 3)


@pytest.mark.parametrize(
    "spoil",
    [
        lambda text: text.replace("4000", "3000"),
        lambda text: text[:40],
        lambda _: "",
        lambda text: text.replace('"most"', '"least"'),
    ],
    ids=["edited", "cut", "empty", "garbled"],
)
def test_an_edited_record_is_stale(project: Project, spoil: Callable[[str], str]) -> None:
    place = project.out / "manifest/made_up.facts.json"
    place.write_text(spoil(project.facts), "ascii")
    assert project.generate("--check") == 1
    assert project.generate() == 1  # somebody else's file is in the way
    assert project.generate("--force") == 0
    assert project.generate("--check", "--strict-version") == 0


def test_a_record_with_its_checksum_forged_is_no_traceback(project: Project) -> None:
    from hashlib import sha256

    place, manifest = project.out / "manifest/made_up.facts.json", project.out / "manifest/made_up.json"
    known = sha256(place.read_bytes()).hexdigest()
    place.write_text(project.facts.replace('"most"', '"least"'), "ascii")
    manifest.write_text(manifest.read_text("ascii").replace(known, sha256(place.read_bytes()).hexdigest()), "ascii")
    project.say("0..4000", "0..5000")
    assert project.generate() == 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--strict-version"], "--strict-version is for --check"),
        (["--check", "--unreleased"], "--unreleased writes what versions say"),
        (["--list-outputs", "--unreleased"], "--unreleased writes what versions say"),
    ],
)
def test_flags_that_do_not_fit(
    project: Project, arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert project.generate(*arguments) == 2
    assert message in capsys.readouterr().err


def test_the_record_is_among_the_outputs(project: Project, capsys: pytest.CaptureFixture[str]) -> None:
    capsys.readouterr()
    assert project.generate("--list-outputs") == 0
    assert str(project.out / "manifest/made_up.facts.json") in capsys.readouterr().out


@pytest.mark.parametrize("name", ["kitchen_sink", "kitchen_can", "kitchen_uss", "hitachi_l200"])
def test_a_record_holds_the_whole_model(name: str) -> None:
    device = shipped(name) if name == "hitachi_l200" else made(name)
    record = record_of(device)
    exported: dict[str, Any] = json.loads(json.dumps(export_model(device)))
    assert model_of(record) == exported
    assert record.checksum == checksum(device)
