"""`fieldscribe.toml`: what a project takes of which devices, without a flag."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from fieldscribe.cli import main
from support.described import described, write
from support.places import ROOT

pytestmark = pytest.mark.usefixtures("loads_once")

PROJECT = """\
out = "drivers"
targets = ["c"]

[[devices]]
device = "hitachi_l200"
points = ["A001", "status"]

[[devices]]
device = "own/siemens_mm4"     # a description of the project's own
targets = ["c", "python"]
out = "more"
as = "second_drive"
frames = false
"""


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.full(seconds=1)
def test_one_command_leaves_and_checks_all_of_it(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shutil.copytree(ROOT / "descriptions/siemens_mm4", project / "own/siemens_mm4")
    shutil.copy(ROOT / "descriptions/glossary.yaml", project / "own/glossary.yaml")
    (project / "fieldscribe.toml").write_text(PROJECT, "utf-8")
    assert main(["vendor", "--check"]) == 1
    assert main(["vendor"]) == 0
    assert {path.name for path in (project / "drivers").iterdir()} >= {"hitachi_l200.h", "hitachi_l200_modbus.h"}
    assert {path.name for path in (project / "more").iterdir()} >= {"second_drive.h", "second_drive", "fieldscribe.h"}
    manifest = json.loads((project / "more/second_drive.manifest.json").read_text("utf-8"))
    assert sorted(manifest["asked"]) == sorted(manifest["targets"]) == ["c", "python"]
    assert {language: "frames" in asked for language, asked in manifest["asked"].items()} == {
        "c": True,
        "python": False,
    }
    capsys.readouterr()
    assert main(["vendor", "--check"]) == 0
    assert "0 of" in capsys.readouterr().out
    (project / "drivers/hitachi_l200.h").unlink()
    assert main(["vendor", "--check", "--project", str(project / "fieldscribe.toml")]) == 1
    assert "missing: " in capsys.readouterr().out


def test_what_the_project_names_no_more_is_told(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its own files alone: those that another device needs, too, stay wanted."""
    file = project / "fieldscribe.toml"
    file.write_text(f'{TOP}{DEVICE}points = ["A020"]\n{DEVICE}as = "other"\npoints = ["D001"]\n', "utf-8")
    assert main(["vendor"]) == 0
    file.write_text(f'{TOP}{DEVICE}points = ["A020"]\n', "utf-8")
    capsys.readouterr()
    assert main(["vendor"]) == 0
    assert main(["vendor", "--check"]) == 0
    printed = [line for line in capsys.readouterr().out.splitlines() if line.startswith("not in")]
    assert (
        printed[:2]
        == ["not in the project file: d/other.h", "not in the project file: d/other_modbus.h"]
        == printed[2:]
    )
    assert main(["vendor", "--check", "--format", "json"]) == 0
    assert json.loads(capsys.readouterr().out)["not_in_project"] == ["d/other.h", "d/other_modbus.h"]
    for name in ("other.h", "other_modbus.h"):
        (project / "d" / name).unlink()
    assert main(["vendor"]) == 0  # the runtime is smaller now
    capsys.readouterr()
    assert main(["vendor", "--check"]) == 0
    assert "not in" not in capsys.readouterr().out


DEVICE = '[[devices]]\ndevice = "hitachi_l200"\n'
TOP = 'out = "d"\ntargets = ["c"]\n'


@pytest.mark.parametrize(
    ("text", "place", "output"),
    [
        ("out = ", "1:6", "this is no TOML"),
        ("out = 1\nout 2\n", "2:5", "this is no TOML"),
        ("", "1:1", "names no devices"),
        ('devices = "hitachi_l200"\n', "1:1", "names no devices"),
        (f'{DEVICE}out = "d"\n', "1:1", "`targets` is missing"),
        (f'targets = ["c"]\n{DEVICE}', "2:1", "`out` is missing"),
        (f'{TOP}{DEVICE}[[devices]]\npoints = ["A001"]\n', "5:1", "`device` is missing"),
        (f'{TOP}{DEVICE}point = ["A001"]\n', "5:1", "did you mean `points`"),
        (f'{TOP}devices = [{{device = "hitachi_l200", point = ["A001"]}}]\n', "1:1", "did you mean `points`"),
        (f'{TOP}[[devices]] # no device\npoints = ["A001"]\n{DEVICE}', "3:1", "`device` is missing"),
        (f'{TOP}{DEVICE}"points" = "A001"\n', "5:2", "`points` is a list of words"),
        (f'{TOP}{DEVICE}as = "a\\u0000"\n', "5:1", "`as` is a text"),
        (f'{TOP}{DEVICE}points = "A001"\n', "5:1", "`points` is a list of words"),
        (f"{TOP}{DEVICE}single_file = 1\n", "5:1", "`single_file` is true or false"),
        (f'{TOP}{DEVICE}targets = ["c", "go"]\n', "5:1", "`go` is not a language"),
        (f'{TOP}{DEVICE}  out = "../elsewhere"\n', "5:3", "leads out of the folder"),
        (f'out = "/"\ntargets = ["c"]\n{DEVICE}', "1:1", "leads out of the folder"),
        (f'{TOP}[[devices]]\n\ndevice = "hitachi_l2000"\n', "5:1", "did you mean `hitachi_l200`"),
        (f'{TOP}{DEVICE}points = ["A0Z9"]\n', "4:1", "no point, group or command `A0Z9`"),
        (f'{TOP}{DEVICE}as = "Drive 1"\n', "4:1", "`Drive 1` is no name"),
        (f"{TOP}{DEVICE}wheel = true\n", "5:1", "`wheel` is for python"),
        (f'{TOP}{DEVICE}frames = false\ntargets = ["rust"]\n', "5:1", "`frames` is for c"),
        (f'{TOP}{DEVICE}targets = ["python"]\nsingle_file = true\n', "6:1", "`single_file` is for c"),
        (f'{TOP}[[devices]]\ndevice = "/elsewhere/hitachi_l200"\n', "4:1", "leads out of the folder"),
        (f'{TOP}[[devices]]\ndevice = "../hitachi_l200"\n', "4:1", "leads out of the folder"),
        (f"a = {'[' * 600}{']' * 600}\n", "1:1", "nested too deeply"),
        (f"a = {'9' * 5000}\n", "1:", "this is no TOML"),
        ('title = "x"\n' + TOP + DEVICE, "1:1", "there is no key `title` here"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(
    text: str, place: str, output: str, project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (project / "fieldscribe.toml").write_text(text, "utf-8")
    assert main(["vendor"]) == 1
    printed = capsys.readouterr().err
    assert f"fieldscribe.toml:{place}" in printed
    assert output in printed
    assert "internal error" not in printed
    assert [path.name for path in project.iterdir()] == ["fieldscribe.toml"]


def test_the_same_files_twice_are_refused(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (project / "fieldscribe.toml").write_text(TOP + DEVICE + DEVICE, "utf-8")
    assert main(["vendor"]) == 2
    assert "requested twice" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("make", "output"), [("mkdir", "it is a folder"), ("fifo", "a pipe"), ("link", "leads nowhere")]
)
def test_what_is_no_file_is_called_by_its_kind(
    make: str, output: str, project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    place = project / "fieldscribe.toml"
    if make == "mkdir":
        place.mkdir()
    elif make == "fifo":
        os.mkfifo(place)
    else:
        place.symlink_to("nothing")
    assert main(["vendor"]) == 2
    assert output in capsys.readouterr().err


@pytest.mark.parametrize("form", ["text", "json"])
def test_what_was_done_is_told_when_the_next_fails(
    form: str, project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The second folder is a file."""
    (project / "taken").write_text("", "utf-8")
    text = f'{TOP}{DEVICE}points = ["A020"]\n{DEVICE}points = ["A020"]\nout = "taken"\n'
    (project / "fieldscribe.toml").write_text(text, "utf-8")
    assert main(["vendor", "--format", form]) == 2
    printed = capsys.readouterr()
    assert "taken" in printed.err
    if form == "json":
        [delivery] = json.loads(printed.out)["deliveries"]
        assert len(delivery["written"]) == 7
    else:
        assert "7 written" in printed.out


def test_a_device_with_errors_is_no_success(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(project / "made_up", described("- {name: odd_one, at: 99999999}\n"))
    (project / "fieldscribe.toml").write_text(f'{TOP}[[devices]]\ndevice = "made_up"\n{DEVICE}', "utf-8")
    assert main(["vendor"]) == 1
    assert "1 error" in capsys.readouterr().err


def test_a_path_is_that_of_the_project_file(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Not of where the command runs; a folder of the same name without a description hides no device."""
    write(project / "sub/own/made_up", described("- {name: odd_one, at: 1}\n"))
    (project / "sub/hitachi_l200").mkdir()
    text = f'{TOP}[[devices]]\ndevice = "own/made_up"\n{DEVICE}points = ["A020"]\n'
    (project / "sub/fieldscribe.toml").write_text(text, "utf-8")
    order = ["vendor", "--project", "sub/fieldscribe.toml"]
    assert main(order) == 0
    assert main([*order, "--check", "--descriptions", str(ROOT / "descriptions")]) == 0


def test_vendored_python_needs_no_compiler(project: Path) -> None:
    assert main(["vendor", "python", "hitachi_l200", "--out", "tools", "--points", "A020,D001,status"]) == 0
    program = "from hitachi_l200 import HitachiL200 as D; print(D.base_frequency.decode(500), D.inverter_status)"
    done = subprocess.run(
        [sys.executable, "-I", "-c", f"import sys; sys.path.insert(0, 'tools'); {program}"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout.startswith("50.0 "), done.stderr


WHEELS = ["vendor", "python", "hitachi_l200", "--out", "wheels", "--wheel", "--points"]


def test_wheels_are_the_same_every_time(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*WHEELS, "A020"]) == 0
    runtime, wheel = sorted((project / "wheels").glob("*.whl"))
    assert re.fullmatch(r"fieldscribe_runtime-[\d.]+-py3-none-any.whl", runtime.name)
    assert re.fullmatch(r"hitachi_l200-1\.0\.0\+[0-9a-f]{8}-py3-none-any.whl", wheel.name)
    names = {device: zipfile.ZipFile(device).namelist() for device in (wheel, runtime)}
    assert not {path for path in names[wheel] if path in names[runtime]}, "each can be uninstalled without the other"
    metadata = zipfile.ZipFile(wheel).read(next(path for path in names[wheel] if path.endswith("METADATA"))).decode()
    for extra in ("serial", "pymodbus", "can"):
        assert f"Requires-Dist: fieldscribe-runtime[{extra}]" in metadata
    assert main([*WHEELS, "A020", "--check"]) == 0, capsys.readouterr().out
    assert main([*WHEELS, "A020,D001"]) == 0
    [other] = (project / "wheels").glob("hitachi_l200-*.whl")
    assert other.name != wheel.name, "pip takes other points for another version"
    assert main(["vendor", "c", "hitachi_l200", "--out", "x", "--wheel"]) == 2


@pytest.mark.full(seconds=3)
def test_wheels_install(project: Path) -> None:
    assert main([*WHEELS, "A020"]) == 0
    pip = (sys.executable, "-m", "pip", "install", "-q", "--no-index")
    install = [*pip, "--target", "site", "--find-links", "wheels", "hitachi_l200"]
    subprocess.run(install, check=True, capture_output=True)
    assert not (project / "site/hitachi_l200/pyproject.toml").exists()
    program = "from hitachi_l200 import HitachiL200 as D; print(D.base_frequency.decode(500))"
    command = [sys.executable, "-I", "-c", f"import sys; sys.path.insert(0, 'site'); {program}"]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "50.0\n"


def test_a_wheel_needs_hatchling(
    project: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "hatchling.builders.wheel", None)
    assert main(["vendor", "python", "hitachi_l200", "--out", "wheels", "--wheel"]) == 2
    assert 'pip install "fieldscribe[wheel]"' in capsys.readouterr().err
    assert list(project.iterdir()) == []
