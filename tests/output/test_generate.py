"""`fieldscribe generate` as a user runs it: in a folder of their own, after a change, with broken descriptions."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path, PureWindowsPath
from typing import Any

import pytest
from fieldscribe.cli import main
from fieldscribe.diagnostics import Report
from fieldscribe.output.writing import write_depfile
from fieldscribe.pipeline import find_devices, load_models
from fieldscribe.safe_files import UnfitFileError
from support.strange_files import KINDS, put
from support.toolchains import succeed, tool

DOCS = [
    *("docs/jumo_controller.csv", "docs/jumo_controller.html", "docs/jumo_controller.md"),
    "docs/jumo_controller_meanings.csv",
    "manifest/jumo_controller.json",
]


def files(folder: Path) -> dict[str, int]:
    return {
        path.relative_to(folder).as_posix(): path.stat().st_mtime_ns for path in folder.rglob("*") if path.is_file()
    }


def test_writes_every_target_once(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["generate"]) == 0
    first = files(project / "generated")
    assert {
        "c/jumo_controller.h",
        "python/jumo_controller/__init__.py",
        "docs/jumo_controller.md",
        "vectors/jumo_controller.txt",
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
    place = project / "generated/docs/jumo_controller.md"
    before = place.stat()
    if spoil == "delete":
        place.unlink()
    else:
        place.write_bytes(place.read_bytes().replace(b"4294", b"4295", 1))
    if spoil == "same size and time":
        os.utime(place, ns=(before.st_atime_ns, before.st_mtime_ns))
    assert main(["generate", "--target", "docs", "--check"]) == 1
    assert "stale: generated/docs/jumo_controller.md" in capsys.readouterr().out
    assert main(["generate", "--target", "docs"]) == 0
    assert main(["generate", "--target", "docs", "--check"]) == 0


def test_check_asks_no_memory(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    main(["generate", "--target", "docs"])

    def requested(*_: object) -> None:
        raise AssertionError("--check asked its memory")

    monkeypatch.setattr("fieldscribe.output.memory.Memory.outputs", requested)
    monkeypatch.setattr("fieldscribe.output.memory.Memory.__init__", requested)
    assert main(["generate", "--target", "docs", "--check"]) == 0


def test_an_input_that_is_edited_during_a_run_and_put_back_is_not_taken_for_compiled(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from fieldscribe.output import generation

    assert main(["generate", "--target", "docs", "--out", "right"]) == 0
    place = project / "descriptions/jumo_controller/device.yaml"
    text, before, load = place.read_bytes(), place.stat(), load_models

    def meddling(*arguments: Any) -> Any:
        place.write_bytes(text.replace(b"version: 1.0.0", b"version: 6.6.6"))
        try:
            return load(*arguments)
        finally:
            place.write_bytes(text)
            os.utime(place, ns=(before.st_atime_ns, before.st_mtime_ns))

    monkeypatch.setattr(generation, "load_models", meddling)
    assert main(["generate", "--target", "docs"]) == 0
    monkeypatch.setattr(generation, "load_models", load)
    made = project / "generated/docs/jumo_controller.md"
    assert b"6.6.6" in made.read_bytes()
    assert main(["generate", "--target", "docs", "--check"]) == 1
    assert main(["generate", "--target", "docs"]) == 0
    assert made.read_bytes() == (project / "right/docs/jumo_controller.md").read_bytes()


def test_a_foreign_file_is_refused_by_name_and_taken_over_by_force(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    place = project / "made/docs/jumo_controller.csv"
    place.parent.mkdir(parents=True)
    place.write_text("precious")
    assert main(["generate", "--target", "docs", "--out", "made"]) == 1
    shown_text = capsys.readouterr().err
    assert "error[foreign-file]: a file is in the way: " in shown_text
    assert " --> made/docs/jumo_controller.csv:1:1\n" in shown_text
    assert "hint: move it away, or replace it with `--force`; nothing of jumo_controller was written\n" in shown_text
    assert place.read_text() == "precious"
    assert list(files(project / "made")) == ["docs/jumo_controller.csv"]
    assert main(["generate", "--target", "docs", "--out", "made", "--force"]) == 0
    assert main(["generate", "--target", "docs", "--out", "made", "--check"]) == 0


def test_a_folder_in_the_way_is_not_taken_over(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (project / "made/docs/jumo_controller.csv").mkdir(parents=True)
    for force in ([], ["--force"]):
        assert main(["generate", "--target", "docs", "--out", "made", *force]) == 1
        assert (
            "hint: move it away, or choose another folder or name; nothing of jumo_controller was written\n"
            in capsys.readouterr().err
        )


def test_what_is_read_is_opened_so_that_nothing_hangs(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A pipe does not wait for a writer, a terminal does not take over, and no child inherits the file."""
    flags: dict[str, int] = {}
    opened = os.open

    def noting(path: Any, how: int, *more: Any, **named: Any) -> int:
        flags[Path(path).name] = how
        return opened(path, how, *more, **named)

    monkeypatch.setattr(os, "open", noting)
    assert main(["check"]) == 0
    assert flags["device.yaml"] == os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC
    place = project / "descriptions/jumo_controller/process_data.yaml"
    place.unlink()
    os.mkfifo(place)
    flags.clear()
    assert main(["check"]) == 1
    assert place.name not in flags, "what can be seen to be no file is not even opened"


def test_a_target_that_fails_leaves_its_device_alone_and_the_others_are_written(
    project: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from fieldscribe.targets import vectors

    shutil.copytree(project / "descriptions/jumo_controller", project / "descriptions/other")
    place = project / "descriptions/other/device.yaml"
    place.write_text(place.read_text("utf-8").replace("device: jumo_controller", "device: other"), "utf-8")
    outputs = vectors.outputs

    def failing(device: Any, render: Any) -> Any:
        if device.id == "other":
            raise ValueError("no \x1b[31m vectors")
        return outputs(device, render)

    monkeypatch.setattr(vectors, "outputs", failing)
    assert main(["generate", "--target", "docs,vectors"]) == 1
    assert sorted(files(project / "generated")) == [*DOCS, "vectors/jumo_controller.txt"]
    shown_text = capsys.readouterr().err
    assert "internal error in target vectors: ValueError: no [31m vectors" in shown_text
    assert "descriptions/other/device.yaml" in shown_text
    assert main(["generate", "--target", "docs,vectors", "--check"]) == 1


def test_a_text_that_no_file_can_hold_is_a_bug_of_its_device(
    project: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from fieldscribe.targets import docs

    monkeypatch.setattr(docs, "outputs", lambda *_: [("docs/jumo_controller.md", "half a pair: \ud800")])
    assert main(["generate", "--target", "docs"]) == 1
    shown_text = " ".join(capsys.readouterr().err.split())
    assert "internal error in a text: UnicodeEncodeError: " in shown_text
    assert "descriptions/jumo_controller/device.yaml:1:1" in shown_text
    assert not (project / "generated/docs").exists()


def test_a_compiler_that_fails_on_one_device_writes_the_others(
    project: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from fieldscribe.output import generation

    shutil.copytree(project / "descriptions/jumo_controller", project / "descriptions/a_broken_one")
    load = load_models

    def failing(device_file: Path, *rest: Any) -> Any:
        if "broken" in str(device_file):
            raise KeyError("x")
        return load(device_file, *rest)

    monkeypatch.setattr(generation, "load_models", failing)
    assert main(["generate", "--target", "docs"]) == 1
    assert "docs/jumo_controller.md" in files(project / "generated")
    assert "internal error in the compiler: KeyError: 'x'" in capsys.readouterr().err


def test_what_lies_beside_a_description_is_not_read(project: Path) -> None:
    for number, kind in enumerate(KINDS):
        put(kind, project / f"descriptions/jumo_controller/.#device_{number}.yaml")
        put(kind, project / f"descriptions/jumo_controller/another_{number}.yaml")
    assert run_bounded(project, "generate", "--target", "docs", "--depfile", "docs.d").returncode == 0
    rule = (project / "docs.d").read_text()
    assert "process_data.yaml" in rule
    assert "jumo_controller/another" not in rule
    assert "jumo_controller/.#device" not in rule


@pytest.mark.parametrize("kind", KINDS[:-1])
@pytest.mark.parametrize("name", ["device.yaml", pytest.param("process_data.yaml", marks=pytest.mark.full)])
def test_what_is_read_has_to_be_a_regular_file_of_sane_size(project: Path, kind: str, name: str) -> None:
    place = project / "descriptions/jumo_controller" / name
    place.unlink()
    put(kind, place)
    done = run_bounded(project, *(["check"] if name == "device.yaml" else ["generate", "--target", "docs"]))
    assert done.returncode == 1
    shown_text = done.stdout + done.stderr
    assert any(rule in shown_text for rule in ("file-unreadable", "file-too-large", "part-outside")), shown_text
    assert f"jumo_controller/{'device.yaml' if 'part-outside' in shown_text else name}" in shown_text


def test_a_part_may_be_a_link_within_its_folder_but_not_out_of_it(project: Path, tmp_path: Path) -> None:
    folder = project / "descriptions/jumo_controller"
    (folder / "process_data.yaml").rename(folder / "somewhere.txt")
    (folder / "process_data.yaml").symlink_to("somewhere.txt")
    assert main(["check"]) == 0
    (folder / "somewhere.txt").rename(tmp_path / "outside.txt")
    (folder / "process_data.yaml").unlink()
    (folder / "process_data.yaml").symlink_to(tmp_path / "outside.txt")
    assert main(["check"]) == 1


@pytest.mark.parametrize(
    ("put", "shown_text"), [("link", "it is a link that leads nowhere"), ("nothing", "there is no file")]
)
def test_a_part_that_is_not_there_is_told_from_a_link_that_leads_nowhere(
    project: Path, put: str, shown_text: str, capsys: pytest.CaptureFixture[str]
) -> None:
    place = project / "descriptions/jumo_controller/process_data.yaml"
    place.unlink()
    if put == "link":
        place.symlink_to("nowhere.yaml")
    assert main(["check"]) == 1
    assert shown_text in capsys.readouterr().out


def test_a_folder_of_links_into_one_place_is_fine(project: Path, tmp_path: Path) -> None:
    farm = tmp_path / "farm/jumo_controller"
    farm.mkdir(parents=True)
    for path in (project / "descriptions/jumo_controller").iterdir():
        (farm / path.name).symlink_to(path)
    assert main(["check", str(farm.parent)]) == 0


def test_a_device_whose_folder_may_not_be_looked_into_is_not_left_out(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lstat = os.lstat

    def denied(path: Any, *arguments: Any, **named: Any) -> os.stat_result:
        if "secret" in str(path) and str(path).endswith("device.yaml"):
            raise PermissionError(13, "Permission denied", str(path))
        return lstat(path, *arguments, **named)

    (project / "descriptions/secret").mkdir()
    monkeypatch.setattr(os, "lstat", denied)
    found = find_devices([project / "descriptions"], Report())
    assert project / "descriptions/secret/device.yaml" in found


def test_a_circle_of_links_is_a_finding(project: Path) -> None:
    place = project / "descriptions/jumo_controller/device.yaml"
    place.unlink()
    place.symlink_to("device.yaml")
    assert main(["check"]) == 1


def test_names_of_files_reach_nobody_raw(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    evil = "made\x1b]0;owned\x07\u202e"
    for command in (
        ["generate", "--target", "docs", "--out", evil, "--check"],
        ["generate", "--target", "docs", "--out", evil, "--list-outputs"],
        ["generate", "--target", "docs", "--out", evil],
        ["generate", "--target", evil],
        ["generate", f"--{evil}"],
        ["generate", "--format", evil],
        ["check", evil],
        ["audit", "jumo_controller", "--manual", evil],
        [evil],
    ):
        main(command)
        shown_text = capsys.readouterr()
        shown = shown_text.out + shown_text.err
        assert shown
        assert "\x1b" not in shown, command
        assert "\u202e" not in shown, command


def test_a_name_that_make_cannot_hold_is_no_rule(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    evil = "made\nall:\n\trm -rf x"
    assert main(["generate", "--target", "docs", "--out", evil, "--depfile", "docs.d"]) == 2
    assert "make cannot name the path" in capsys.readouterr().err
    assert not (project / "docs.d").exists()


def test_make_reads_every_path_of_a_depfile(tmp_path: Path) -> None:
    """Held against make itself, which fails for a path that is not there: blanks, remarks and variables."""
    names = [tmp_path / name for name in ("in a", "in#b", "in$c", "plain", "out 1#$", "out2")]
    for path in names:
        path.touch()
    write_depfile(tmp_path / "made.d", names[4:], names[:4])
    for output in names[4:]:
        succeed([tool("make"), "--question", "--file", tmp_path / "made.d", output])


@pytest.mark.parametrize("char", ["\n", "\t", "\x1f", "\x7f"])
def test_a_path_with_a_control_character_is_refused(char: str, tmp_path: Path) -> None:
    with pytest.raises(UnfitFileError, match="make cannot name the path"):
        write_depfile(tmp_path / "made.d", [Path("out")], [Path(f"a{char}b")])
    assert not (tmp_path / "made.d").exists()


def test_a_depfile_names_the_paths_of_windows_with_slashes(tmp_path: Path) -> None:
    paths: list[Any] = [PureWindowsPath(path) for path in ("c:\\out\\a b.h", "in\\a#.yaml", "in\\b.yaml")]
    (tmp_path / "made.d").write_text("an older rule", "utf-8")
    write_depfile(tmp_path / "made.d", paths[:1], paths[1:])
    assert (tmp_path / "made.d").read_text(
        "utf-8"
    ) == "c:/out/a\\ b.h: in/a\\#.yaml \\\n  in/b.yaml\nin/a\\#.yaml:\nin/b.yaml:\n"


def test_a_depfile_may_be_a_terminal(tmp_path: Path) -> None:
    """A character device such as /dev/stdout is written to: it cannot be replaced."""
    reader, terminal = os.openpty()
    place = os.ttyname(terminal)
    os.set_blocking(reader, False)
    write_depfile(Path(place), [Path("out")], [Path("in")])
    assert os.read(reader, 100).split() == [b"out:", b"in", b"in:"]
    assert os.ttyname(terminal) == place
    for handle in (reader, terminal):
        os.close(handle)


@pytest.mark.parametrize("kind", ["pipe", "folder"])
def test_a_depfile_replaces_only_a_file(project: Path, kind: str, capsys: pytest.CaptureFixture[str]) -> None:
    put(kind, project / "docs.d")
    assert main(["generate", "--target", "docs", "--depfile", "docs.d"]) == 2
    assert f"it is a {kind}" in capsys.readouterr().err


@pytest.mark.parametrize("kind", ["pipe", "device", "huge"])
def test_a_manual_has_to_be_a_regular_file_too(project: Path, kind: str) -> None:
    put(kind, project / "manual.txt")
    done = run_bounded(project, "audit", "jumo_controller", "--manual", "manual.txt")
    assert done.returncode == 2
    assert "it is " in done.stderr


def run_bounded(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """The command as a process: one that waits for a pipe, or fills the memory, fails the test."""
    command = [sys.executable, "-m", "fieldscribe", *words]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=30, check=False)


def test_a_device_with_errors_writes_nothing_and_the_others_are_written(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copytree(project / "descriptions/jumo_controller", project / "descriptions/broken")
    place = project / "descriptions/broken/device.yaml"
    text = place.read_text("utf-8").replace("device: jumo_controller", "device: broken\nnonsense: 1")
    place.write_text(text, "utf-8")
    assert main(["generate", "--target", "docs"]) == 1
    made = files(project / "generated")
    assert "docs/jumo_controller.md" in made
    assert not any("broken" in path for path in made)
    assert "descriptions/broken/device.yaml" in capsys.readouterr().err


def test_where_no_device_is_sound_no_folder_is_made_or_locked(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from fieldscribe.output import generation

    monkeypatch.setattr(generation, "only_run", None)  # whoever called it would fail
    place = project / "descriptions/jumo_controller/device.yaml"
    place.write_text("nonsense: 1\n", "utf-8")
    assert main(["generate", "--target", "docs", "--out", "made"]) == 1
    assert not (project / "made").exists()


def test_the_same_device_twice_is_refused(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shutil.copytree(project / "descriptions/jumo_controller", project / "descriptions/copy")
    assert main(["generate", "--target", "docs"]) == 1
    assert "described twice" in capsys.readouterr().err


def test_depfile_and_list(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["generate", "--target", "docs", "--out", "my out", "--depfile", "docs.d"]) == 0
    rule = (project / "docs.d").read_text("utf-8")
    assert rule.startswith(" ".join(f"my\\ out/{path}" for path in DOCS) + ":")
    assert "descriptions/jumo_controller/process_data.yaml" in rule
    capsys.readouterr()
    assert main(["generate", "--target", "docs", "--out", "elsewhere", "--list-outputs"]) == 0
    assert capsys.readouterr().out.splitlines()[0] == "elsewhere/docs/jumo_controller.csv"
    assert not (project / "elsewhere").exists()


def test_json_tells_what_happened(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["generate", "--target", "docs", "--format", "json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert sorted(printed["written"]) == DOCS


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (["--target", "cobol"], 2, "cobol"),
        (["--target", ""], 2, "target"),
        (["no/such/folder"], 2, "no such file or folder"),
        (["jumo_controlle"], 2, "did you mean `jumo_controller`?"),
        (["--out", ""], 2, "the path is empty"),
        (["--out", "descriptions/jumo_controller/device.yaml"], 2, "cannot write"),
    ],
)
def test_wrong_calls(
    project: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], code: int, says: str
) -> None:
    assert main(["generate", *arguments]) == code
    assert says in capsys.readouterr().err


def test_a_changed_compiler_is_not_mistaken_for_unchanged_input() -> None:
    from fieldscribe.resources import compiler_files

    names = {os.path.basename(path) for path in compiler_files()}
    assert {"pipeline.py", "fieldscribe.h"} <= names
