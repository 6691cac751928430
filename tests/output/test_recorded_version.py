"""The manifest records the version and a digest of its facts: facts that change under the same version are told."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.cli import main
from support.described import described, write

POINTS = """\
- {name: speed, title: Speed, at: 0, range: 0..4000, scale: value = raw * 0.1, unit: Hz, line: 7}
- {name: mode, at: 1, enum: {0: stopped, 1: running}}
"""
CHANGES = {
    "a comment": ("- {name: mode", "# a comment\n- {name: mode", False),
    "the layout": ("name: mode, at: 1", "name: mode,  at: 0x0001", False),
    "a title": ("title: Speed", "title: Speed of the motor", True),
    "a note": ("at: 1,", "at: 1, note: Said on the panel,", True),
    "a line of the manual": ("line: 7", "line: 8", True),
    "a range": ("0..4000", "0..5000", True),
    "a new point": ("- {name: mode", "- {name: load, at: 9}\n- {name: mode", True),
}
"""What is written for what, and whether facts change."""
CHANGED = "warning[version-not-raised]: `made_up` has changed since its version 1.2.3 was generated\n"


class Project:
    """A description of version 1.2.3 that was generated once, and can be changed."""

    def __init__(self, folder: Path) -> None:
        self.out = folder / "out"
        self.folder = folder / "made_up"
        self.describe()
        assert self.generate() == 0

    def describe(self, old: str = "", new: str = "", version: str = "1.2.3") -> None:
        assert POINTS.count(old)
        write(self.folder, described(POINTS.replace(old, new) if old else POINTS, version=version))

    def generate(self, *more: str) -> int:
        return main(["generate", str(self.folder), "--out", str(self.out), "--target", "vectors", *more])

    @property
    def manifest(self) -> Path:
        return self.out / "manifest/made_up.json"

    @property
    def record(self) -> dict[str, str]:
        loaded: dict[str, Any] = json.loads(self.manifest.read_text("ascii"))
        record: dict[str, str] = loaded["facts"]
        return record


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Project:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    project = Project(tmp_path)
    assert capsys.readouterr().err == ""
    return project


@pytest.mark.parametrize(("old", "new", "changes"), CHANGES.values(), ids=CHANGES)
def test_changed_facts_need_another_version(
    project: Project, old: str, new: str, changes: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    project.describe(old, new)
    assert project.generate() == 0
    warned = capsys.readouterr().err
    assert warned.startswith(CHANGED) if changes else warned == ""
    assert (f"{project.folder / 'device.yaml'}:3:10" in warned) == changes
    assert project.generate("--check") == 0
    assert project.generate("--check", "--strict-version") == changes
    project.describe(old, new, "1.2.4")  # any other version will do: `diff` judges the step
    capsys.readouterr()
    assert project.generate() == 0
    assert project.generate("--check", "--strict-version") == 0
    assert capsys.readouterr().err == ""
    assert project.record["version"] == "1.2.4"


def test_the_warning_is_repeated_until_the_version_changes(
    project: Project, capsys: pytest.CaptureFixture[str]
) -> None:
    first = project.record
    project.describe("at: 1,", "at: 2,")
    for _ in range(2):
        assert project.generate() == 0
        assert capsys.readouterr().err.startswith(CHANGED)
        assert project.record == first
    project.describe()
    assert project.generate() == 0
    assert capsys.readouterr().err == ""


def test_a_version_that_nobody_has_may_change(project: Project, capsys: pytest.CaptureFixture[str]) -> None:
    project.describe("at: 1,", "at: 2,")
    assert project.generate("--unreleased") == 0
    assert project.generate("--check", "--strict-version") == 0
    assert project.generate() == 0
    assert capsys.readouterr().err == ""
    project.describe()
    assert project.generate() == 0
    assert capsys.readouterr().err.startswith(CHANGED)


def test_the_committed_output_is_enough(project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another machine has neither our cache nor the old description."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "another cache"))
    project.out = Path(shutil.move(project.out, tmp_path / "clone"))
    assert project.generate("--check", "--strict-version") == 0
    project.describe("0..4000", "0..5000")
    assert project.generate() == 0
    assert project.generate("--check", "--strict-version") == 1


def test_tools_read_it_as_a_finding(project: Project, capsys: pytest.CaptureFixture[str]) -> None:
    project.describe("0..4000", "0..5000")
    for more, severity in ((("--check",), "warning"), (("--check", "--strict-version"), "error")):
        project.generate(*more, "--format", "json")
        [finding] = json.loads(capsys.readouterr().out)["findings"]
        assert (finding["rule"], finding["severity"], finding["line"]) == ("version-not-raised", severity, 3)


@pytest.mark.parametrize("facts", [None, 5, [], {}, {"version": "1.2.3"}, {"version": 5, "digest": None}], ids=str)
def test_a_manifest_without_a_usable_record_is_stale(project: Project, facts: object) -> None:
    first = project.record
    manifest = json.loads(project.manifest.read_text("ascii"))
    project.manifest.write_text(json.dumps({**manifest, "facts": facts}), "ascii")
    assert project.generate("--check") == 1
    assert project.generate("--force") == 0
    assert project.generate("--check", "--strict-version") == 0
    assert project.record == first


def test_the_facts_file_of_an_earlier_compiler_is_removed(project: Project) -> None:
    """It was a file beside the manifest, which listed it as one of the target `manifest`."""
    from hashlib import sha256

    old = project.out / "manifest/made_up.facts.json"
    old.write_bytes(b'{"format": [1, 5], "device": "made_up"}\n')
    manifest = json.loads(project.manifest.read_text("ascii"))
    del manifest["facts"]
    manifest["targets"]["manifest"] = {"manifest/made_up.facts.json": sha256(old.read_bytes()).hexdigest()}
    project.manifest.write_text(json.dumps(manifest, indent=2) + "\n", "ascii")
    assert project.generate("--check") == 1
    assert project.generate() == 0
    assert not old.exists()
    assert list(json.loads(project.manifest.read_text("ascii"))["targets"]) == ["vectors"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--strict-version"], "--strict-version is for --check"),
        (["--unreleased", "--check"], "--unreleased records facts"),
        (["--check", "--strict-version", "--unreleased"], "--unreleased records facts"),
        (["--list-outputs", "--unreleased"], "--unreleased records facts"),
    ],
)
def test_flags_that_do_not_fit(
    project: Project, arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert project.generate(*arguments) == 2
    assert message in capsys.readouterr().err
