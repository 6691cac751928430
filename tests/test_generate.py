"""`fieldscribe generate` as a user runs it: in a folder of their own, after a change, with broken descriptions."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path

import pytest
from fieldscribe.cli import main

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with descriptions/hitachi_l200, the working folder, with a cache of its own."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    place = tmp_path / "project"
    shutil.copytree(ROOT / "descriptions/hitachi_l200", place / "descriptions/hitachi_l200")
    monkeypatch.chdir(place)
    return place


def files(folder: Path) -> dict[str, int]:
    return {
        path.relative_to(folder).as_posix(): path.stat().st_mtime_ns for path in folder.rglob("*") if path.is_file()
    }


def test_writes_every_target_once(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["generate"]) == 0
    first = files(project / "generated")
    assert {
        "c/hitachi_l200.h",
        "python/hitachi_l200/__init__.py",
        "docs/hitachi_l200.md",
        "vectors/hitachi_l200.txt",
    } <= first.keys()
    assert main(["generate"]) == 0
    assert files(project / "generated") == first
    assert f"0 written, 0 removed, {len(first)} unchanged" in capsys.readouterr().out


def test_one_target_touches_no_other(project: Path) -> None:
    assert main(["generate", "--target", "docs", "--out", "made"]) == 0
    assert {path.split("/")[0] for path in files(project / "made")} == {"docs", "manifest"}
    assert main(["generate", "--target", "vectors", "--out", "made"]) == 0
    assert {path.split("/")[0] for path in files(project / "made")} == {"docs", "manifest", "vectors"}


@pytest.mark.parametrize("spoil", ["edit", "delete", "same size and time"])
def test_check_sees_a_touched_output_and_writes_nothing(
    project: Path, spoil: str, capsys: pytest.CaptureFixture[str]
) -> None:
    main(["generate", "--target", "docs"])
    assert main(["generate", "--target", "docs", "--check"]) == 0
    place = project / "generated/docs/hitachi_l200.csv"
    before = place.stat()
    if spoil == "delete":
        place.unlink()
    else:
        place.write_bytes(place.read_bytes().replace(b"4136", b"4135", 1))
    if spoil == "same size and time":
        os.utime(place, ns=(before.st_atime_ns, before.st_mtime_ns + 1))
    assert main(["generate", "--target", "docs", "--check"]) == 1
    assert "stale: generated/docs/hitachi_l200.csv" in capsys.readouterr().out
    assert main(["generate", "--target", "docs"]) == 0
    assert main(["generate", "--target", "docs", "--check"]) == 0


def test_a_device_with_errors_writes_nothing_and_the_others_are_written(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copytree(project / "descriptions/hitachi_l200", project / "descriptions/broken")
    place = project / "descriptions/broken/device.yaml"
    place.write_text(place.read_text("utf-8").replace("device: hitachi_l200", "device: broken\nnonsense: 1"), "utf-8")
    assert main(["generate", "--target", "docs"]) == 1
    made = files(project / "generated")
    assert "docs/hitachi_l200.md" in made
    assert not any("broken" in path for path in made)
    assert "descriptions/broken/device.yaml" in capsys.readouterr().err


def test_the_same_device_twice_is_refused(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shutil.copytree(project / "descriptions/hitachi_l200", project / "descriptions/copy")
    assert main(["generate", "--target", "docs"]) == 1
    assert "described twice" in capsys.readouterr().err


def test_depfile_and_list(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["generate", "--target", "docs", "--out", "my out", "--depfile", "docs.d"]) == 0
    rule = (project / "docs.d").read_text("utf-8")
    assert rule.startswith(
        "my\\ out/docs/hitachi_l200.csv my\\ out/docs/hitachi_l200.md my\\ out/manifest/hitachi_l200.json:"
    )
    assert "descriptions/hitachi_l200/standard_a.yaml" in rule
    capsys.readouterr()
    assert main(["generate", "--target", "docs", "--out", "elsewhere", "--list-outputs"]) == 0
    assert capsys.readouterr().out.splitlines()[0] == "elsewhere/docs/hitachi_l200.csv"
    assert not (project / "elsewhere").exists()


def test_json_tells_what_happened(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["generate", "--target", "docs", "--format", "json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert sorted(told["written"]) == ["docs/hitachi_l200.csv", "docs/hitachi_l200.md", "manifest/hitachi_l200.json"]


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (["--target", "cobol"], 2, "cobol"),
        (["--target", ""], 2, "target"),
        (["no/such/folder"], 2, "no such file or folder"),
        (["hitachi_l20"], 2, "did you mean `hitachi_l200`?"),
        (["--out", ""], 2, "the path is empty"),
        (["--out", "descriptions/hitachi_l200/device.yaml"], 2, "cannot write"),
    ],
)
def test_wrong_calls(
    project: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], code: int, says: str
) -> None:
    assert main(["generate", *arguments]) == code
    assert says in capsys.readouterr().err


def test_a_changed_compiler_is_not_mistaken_for_unchanged_input() -> None:
    from fieldscribe.output import stamp

    assert (stamp.PACKAGE / "pipeline.py").is_file()
