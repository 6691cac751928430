"""Every command: exit codes, what goes to stdout and to stderr, `--format json`, colours, and no traceback."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from argparse import ArgumentParser
from collections.abc import Callable
from importlib import import_module
from io import StringIO
from pathlib import Path

import pytest
from fieldscribe import __version__
from fieldscribe.cli import COMMANDS, command_named, main
from fieldscribe.cli.common import print_json
from fieldscribe.live.snapshots import Held, Snapshot
from fieldscribe.resources import descriptions_dir
from support.described import described, write
from support.small_drive import DEVICE, MAIN, SPEED_50, Output

L200 = str(descriptions_dir() / "hitachi_l200")
PACKAGES = Path(import_module("fieldscribe").__file__ or "").parents[1]

pytestmark = pytest.mark.usefixtures("loads_once")

INIT = ["heat_pump", "--family", "modbus", "--vendor", "Example", "--model", "M", "--title", "Pump"]
NO_LINE = ["--line", "tcp://127.0.0.1:1"]
ENDS: dict[str, dict[int, list[str]]] = {
    "check": {0: ["small_drive"], 1: ["broken"], 2: ["nowhere"]},
    "generate": {
        0: ["small_drive", "--target", "docs", "--out", "out"],
        1: ["small_drive", "--target", "docs", "--check", "--out", "stale"],
        2: ["nowhere"],
    },
    "vendor": {0: ["c", "small_drive", "--out", "own"], 1: ["c", "broken", "--out", "own"], 2: ["c", "nowhere"]},
    "docs": {
        0: ["small_drive", "--format", "csv", "--out", "tables"],
        1: ["broken", "--format", "csv", "--out", "tables"],
        2: ["nowhere", "--format", "csv", "--out", "tables"],
    },
    "export": {0: ["json", "small_drive"], 1: ["json", "broken"], 2: ["xml", "small_drive"]},
    "explain": {0: ["small_drive", "P1"], 1: ["broken", "P1"], 2: ["small_drive", "P9"]},
    "decode": {0: ["small_drive", SPEED_50], 1: ["small_drive", SPEED_50[:-1] + "9"], 2: ["small_drive", "zz"]},
    "listen": {
        0: ["small_drive", "--capture", "line.log"],
        1: ["small_drive=9", "--capture", "line.log"],
        2: ["small_drive", "--capture", "manual.txt"],
    },
    "encode": {0: ["small_drive", "P1", "50"], 1: ["small_drive", "P1", "500"], 2: ["small_drive", "P1", "50 V"]},
    "read": {1: ["broken", "P1", *NO_LINE], 2: ["small_drive", "P1"]},
    "write": {1: ["broken", "P1=1", *NO_LINE], 2: ["small_drive", "P1=1"]},
    "monitor": {1: ["broken", "P1", *NO_LINE], 2: ["small_drive", "P1"]},
    "scan": {1: ["broken", *NO_LINE], 2: []},
    "identify": {1: ["broken", *NO_LINE], 2: []},
    "snapshot": {1: ["broken", "--out", "x.json", *NO_LINE], 2: ["small_drive", "--out", "x.json"]},
    "compare": {0: ["one.json", "one.json"], 1: ["one.json", "two.json"], 2: ["no.json"]},
    "restore": {2: ["one.json", "small_drive"]},
    "audit": {1: ["broken", "--manual", "manual.txt"], 2: ["small_drive", "--manual", "no.txt"]},
    "diff": {0: ["small_drive", "small_drive"], 1: ["other", "small_drive"], 2: ["nowhere", "small_drive"]},
    "list": {0: [], 1: ["--family", "none"], 2: ["nowhere"]},
    "search": {0: ["Speed"], 1: ["zzzzzz"], 2: [" "]},
    "completion": {0: ["bash"], 2: ["tcsh"]},
    "init": {0: INIT, 2: ["heat_pump"]},
    "import": {2: ["table", "no.csv"]},
    "fmt": {0: ["--check", "small_drive"], 1: ["--check", "untidy"], 2: ["--check", "nowhere"]},
    "watch": {2: ["nowhere"]},
    "simulate": {0: ["small_drive", "--for", "0"], 1: ["broken", "--for", "0"], 2: ["nowhere"]},
    "units": {0: ["Hz"], 1: ["furlong"], 2: ["--format", "csv"]},
    "schema": {0: [], 2: ["--colour"]},
}
"""The arguments with which each command ends with an exit code. What runs for ever has no 0."""


@pytest.fixture
def devices(small: Path) -> None:
    """Descriptions beside small_drive: one with an error, one with another range, one that `fmt` would change."""
    texts = {"broken": ("at: 12h", "at: 10h"), "other": ("1..500", "1..400"), "untidy": ("P1, name", "P1,   name")}
    for name, (old, new) in texts.items():
        device = DEVICE.replace("device: small_drive", f"device: {name if name != 'other' else 'small_drive'}")
        write(small.parent / name, device, main=MAIN.replace("TITLE", "Speed").replace(old, new))
    Path("manual.txt").write_text("a manual\n")
    Path("line.log").write_text(f"{SPEED_50}\n")
    for name, raw in (("one", 1), ("two", 2)):
        points = {"speed": Held("P1", raw, "", "", raw, "setting")}
        snapshot = Snapshot("small_drive", "", "", "", 1, "", {}, [], points, {})
        Path(f"{name}.json").write_text(snapshot.as_text(), "utf-8")


@pytest.mark.usefixtures("loads_once")
@pytest.mark.parametrize("command", COMMANDS)
def test_exit_codes_and_streams(command: str, run: Callable[..., Output], devices: None) -> None:
    """0 has a result on stdout, 2 only a message on stderr. JSON is whole, and changes no exit code."""
    parser = ArgumentParser()
    command_named(command).add_arguments(parser)
    formats = next((action.choices for action in parser._actions if action.dest == "format"), None) or ()
    for code, words in ENDS[command].items():
        told = run(command, *words)
        assert told.code == code, (words, told)
        assert told.out if code == 0 else told.err if code == 2 else told.out or told.err, words
        assert not (told.out and code == 2), words
        if "json" in formats and code < 2:
            again = run(command, *words, "--format", "json")
            assert again.code == code, (words, again)
            assert json.loads(again.out) is not None


def test_every_command_is_listed_and_helps(run: Callable[..., Output]) -> None:
    assert set(ENDS) == set(COMMANDS)
    listed = run("--help").out
    for name, does in COMMANDS.items():
        assert does in listed
        shown = run(name, "--help")
        assert shown.code == 0
        for part in (f"fieldscribe {name}", "examples:", "nds with "):
            assert part in shown.out


def test_version_and_usage(run: Callable[..., Output]) -> None:
    assert run("--version") == run("-V") == (0, f"fieldscribe {__version__}\n", "")
    nothing = run()
    assert (nothing.code, nothing.out) == (2, "")
    assert "commands:" in nothing.err
    assert "did you mean `check`?" in run("chekc").err
    assert "did you mean `--format`?" in run("check", "--formt", "json").err
    for words in (("chekc",), ("check", "--colour"), ("explain",), ("--nothing",)):
        assert run(*words).code == 2


def test_json_is_ascii_and_ends_with_its_line(capsys: pytest.CaptureFixture[str]) -> None:
    print_json({"ü": [1]})
    assert capsys.readouterr().out == '{\n  "\\u00fc": [\n    1\n  ]\n}\n'


def test_no_escape_code_reaches_the_terminal(run: Callable[..., Output], small: Path) -> None:
    """Neither from a title that compiles, nor from a line that does not."""
    hostile = MAIN.replace("TITLE", "\\e[31mred\\u202e\\a")
    (small / "main.yaml").write_text(hostile, "utf-8")
    runs = [
        run("check"),
        run("explain", "small_drive", "P1"),
        run("explain", "small_drive", "P1", "--format", "json"),
        run("decode", "small_drive", SPEED_50),
        run("export", "json", "small_drive"),
        run("explain", "small_drive", "\x1b[31m"),
        run("encode", "small_drive", "P1", "\x1b[31m"),
    ]
    (small / "main.yaml").write_text(hostile.replace("at: 12h", "at: \u202e12h"), "utf-8")
    runs.append(run("check"))
    assert runs[-1].code == 1
    for told in runs:
        assert not {"\x1b", "\u202e", "\x07"} & set(told.out + told.err)


class _Screen(StringIO):
    """A terminal to write to."""

    def isatty(self) -> bool:
        """Return True: it is a terminal."""
        return True


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["encode", "small_drive", "P1", "--", "--"], "`--` is no argument"),
        (["explain", "small_drive", "--", "--"], "`--` is no argument"),
        (["import", "table", "--", "--"], "`--` is no argument"),
        (["check", "--", "--"], "`--` is no argument"),
        (["explain", os.devnull, "P1"], f"`{os.devnull}` is neither a folder nor a regular file"),
        (["generate", "small_drive", "--out", "file"], "cannot write to file: it is a file, not a folder"),
        (["vendor", "c", "small_drive", "--out", "file"], "cannot write to file: it is a file, not a folder"),
        (["docs", "small_drive", "--format", "csv", "--out", "file"], "hint: name a folder with --out"),
    ],
)
def test_wrong_calls(words: list[str], message: str, run: Callable[..., Output], small: Path) -> None:
    Path("file").touch()
    printed = run(*words)
    assert (printed.code, printed.out) == (2, "")
    assert message in printed.err


@pytest.mark.parametrize("term", ["xterm", "dumb"])
def test_the_labels_of_all_frames_have_one_column(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, term: str) -> None:
    """As wide as the longest label of the device: that of flags in the upper bits of a word, `Bits 15..12`."""
    screen = _Screen()
    monkeypatch.setenv("NO_COLOR", "")
    monkeypatch.setenv("TERM", term)
    monkeypatch.setattr(sys, "stdout", screen)
    point = "- {name: upper, at: 1, bits: 15..8, access: r, flags: {8: ready, 15..12: {name: mode}}}\n"
    path = write(tmp_path, described(point))
    assert main(["decode", str(path), "01 03 0001 0001 D5CA", "01 03 02 1234 B533"]) == 0
    rows = re.sub(r"\x1b\[[0-9;]*m", "", screen.getvalue()).splitlines()
    assert any(row.startswith("  Bits 15..12  1  mode") for row in rows)
    assert {row[13:15] for row in rows if row.startswith("  ")} == {"  "}


@pytest.mark.parametrize(
    ("no_colour", "term", "coloured"), [("", "xterm", True), ("1", "xterm", False), ("", "dumb", False)]
)
def test_colour_is_for_terminals(
    monkeypatch: pytest.MonkeyPatch, small: Path, no_colour: str, term: str, coloured: bool
) -> None:
    screen = _Screen()
    monkeypatch.setenv("NO_COLOR", no_colour)
    monkeypatch.setenv("TERM", term)
    monkeypatch.setattr(sys, "stdout", screen)
    assert main(["explain", "small_drive", "P1"]) == 0
    (small / "empty").mkdir()
    assert main(["check", str(small / "empty")]) == 1
    assert ("\x1b[" in screen.getvalue()) == coloured
    assert "P1 speed: Speed" in screen.getvalue()
    assert "no-device" in screen.getvalue()


@pytest.mark.parametrize(
    ("error", "code", "message"),
    [
        (KeyboardInterrupt(), 130, ""),
        (PermissionError(13, "Permission denied", "a.yaml"), 2, "Permission denied: a.yaml"),
        (ZeroDivisionError("odd\x1b"), 2, "internal error: ZeroDivisionError: odd\\x1b"),
    ],
)
def test_no_traceback(
    monkeypatch: pytest.MonkeyPatch, run: Callable[..., Output], error: BaseException, code: int, message: str
) -> None:
    def fail(_: object) -> int:
        raise error

    monkeypatch.setattr("fieldscribe.cli.check.run_check", fail)
    monkeypatch.delenv("FIELDSCRIBE_DEBUG", raising=False)
    told = run("check")
    assert told.code == code
    assert message in told.err
    assert "Traceback" not in told.err
    assert told.err.count("\n") <= 1
    monkeypatch.setenv("FIELDSCRIBE_DEBUG", "1")
    assert ("Traceback" in run("check").err) == ("internal" in message)


@pytest.mark.parametrize(
    ("shell", "code", "out"),
    [
        pytest.param(
            "decode {l200} '05 06 10 28 01 F4 0C 91'", 0, "A020 base_frequency = 50 Hz", marks=pytest.mark.full
        ),
        ("export json {l200} | head -c 1", 0, "{{"),  # the reader goes away
        ("decode {l200} '05 06 10 28 01 F4 0C 91' >&-", 0, ""),  # the caller closed stdout
        ("explain {l200} A020 > /dev/full", 2, ""),
    ],
)
def test_as_a_process(shell: str, code: int, out: str) -> None:
    command = f"{sys.executable} -m fieldscribe {shell.format(l200=L200)}"
    environment = {**os.environ, "PYTHONPATH": str(PACKAGES), "PYTHONIOENCODING": "ascii"}
    done = subprocess.run(command, shell=True, capture_output=True, text=True, env=environment, timeout=60, check=False)
    assert (done.returncode, bool(done.stderr)) == (code, code == 2)
    assert out.format() in done.stdout
    assert "\x1b" not in done.stdout
    assert "Exception ignored" not in done.stderr
