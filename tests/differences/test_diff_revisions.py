"""`fieldscribe diff` with revisions of git: what it reads from them, and what it refuses."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from fieldscribe.diagnostics import UnclearError
from fieldscribe.differences.sides import copied
from support.diff_command import EDITED, Diff, commit


def test_a_revision(repository: Diff) -> None:
    changes = repository.changes("v1:old", "old")
    assert (changes[0]["point"], changes[0]["fact"]) == ("speed", "address")
    assert changes[0]["places"] == {"old": "v1:old/device.yaml:15", "new": "old/device.yaml:15"}
    for same in ("HEAD:old/device.yaml", "main:old/", "v1:./old", "v1:old/second.yml"):
        assert repository(same, "v1:old").code == 0
    assert repository.changes("v1:old/device.yaml", "old")[0]["places"]["old"] == "v1:old/device.yaml:15"
    assert {each["device"] for each in repository.changes("v1:new", "v1:old")} == {"made_up"}


@pytest.mark.full(seconds=1)
def test_a_revision_with_findings(repository: Diff) -> None:
    repository.write("old", EDITED.replace("name: ramp", "name: ramp, type: u99"))
    commit("wrong")
    told = repository("v1:old", "HEAD:old")
    assert "HEAD:old/device.yaml:" in told.err
    assert "fieldscribe-" not in told.err + told.out


def test_a_folder_of_a_revision_is_called_as_it_was_asked_for(repository: Diff) -> None:
    (repository.folder / "empty").mkdir()
    (repository.folder / "empty/notes.txt").write_text("nothing", "utf-8")
    commit("empty")
    told = repository("HEAD:empty", "old")
    assert told.code == 1
    assert " --> HEAD:empty" in told.err
    assert "fieldscribe-" not in told.err


NOT_THERE = {
    ":old": "is not a revision",
    "v\n1:old": "is not a revision",
    "v9:old": "git knows no revision `v9`",
    "v1:nothing": "there is no `nothing` in `v1`",
    "v1:../old": "there is no `../old` in `v1`",
    "v1:link": "there is no `link` in `v1`",
}


def test_what_git_does_not_have(repository: Diff) -> None:
    for revision, said in NOT_THERE.items():
        told = repository(revision, "old")
        assert (told.code, told.out) == (2, "")
        assert said in told.err
        assert told.err.startswith("fieldscribe: ")


def test_a_revision_is_never_an_option(repository: Diff) -> None:
    for revision in ("--upload-pack=x", "-h", "--output=x", "-"):
        if revision != "-h":  # Python 3.13 shows the help for `-h:old`
            assert repository(f"{revision}:old", "old")[:2] == (2, "")
            assert repository("--", f"{revision}:old", "old")[:2] == (2, "")
        with pytest.raises(UnclearError, match="is not a revision"):
            copied(revision, "old", repository.folder)
        assert not Path("x").exists()


def test_links_and_deep_folders_of_a_revision_are_not_read(repository: Diff) -> None:
    os.symlink("/etc", "linked")
    Path("old/device.yaml").unlink()
    os.symlink("../new/device.yaml", "old/device.yaml")
    commit("links")
    for path, message in {
        "linked": "`linked` is not a regular file",
        "old": "the folder holds no device.yaml",
        "old/device.yaml": "`old/device.yaml` is not a regular file",
        "linked/hostname": "there is no `linked/hostname`",
        "far": "the folder holds no device.yaml",
    }.items():
        assert message in repository(f"HEAD:{path}", "new").err


def test_outside_of_a_repository(diff: Diff, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(diff.folder.parent))
    assert "this is not a folder of a git repository" in diff("v1:old", "new").err
