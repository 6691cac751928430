"""A folder in which every example of `--help` can be run as it stands, and what runs one."""

from __future__ import annotations

import asyncio
import io
import re
import shlex
import shutil
import subprocess
import sys
import threading
from collections.abc import Coroutine
from contextlib import chdir
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from fieldscribe.cli import main
from fieldscribe.simulation import servers

from support.captured import classic, segment
from support.places import ROOT, TESTS

_EXAMPLE = re.compile(
    r"^  (?P<before>\S.* \| |source <\()?fieldscribe(?P<words> .*?)"
    r"(?: (?P<sign>[<>|]) (?P<file>.*?))?\)?(?P<remark> {3,}\(.*\))?$",
    re.MULTILINE,
)
_AUDITED = TESTS / "transcripts/audit/drive"
_REGISTERS = "code;address;name;type;range;unit\nA001;1;Speed;u16;0..400;Hz\nA002;2;Torque;s16;-100..100;%\n"
_TEXT = """\
| Code | Address | Name | Type | Range |
| --- | --- | --- | --- | --- |
| A001 | 1 | Speed | u16 | 0..400 |
| A002 | 2 | Torque | u16 | 0..100 |
"""
_STATUS = "group: status\ntitle: Status\npoints:\n- { name: speed,   at: 1 }\n"

_BENCH = """\
lines:
- tcp: 5020
  devices: [{device: hitachi_l200, units: 10..12}]
- serial:
  devices: [{device: eastron_sdm630, values: {phase_1_voltage: 231.5}}]
"""


class Example(NamedTuple):
    """An example as `--help` prints it: the words behind `fieldscribe`, and the file it reads or writes."""

    printed: str
    words: str
    sign: str
    file: str


class Ran(NamedTuple):
    """The result of an example."""

    code: int
    said: str
    told: str


def examples_of(epilog: str) -> list[Example]:
    """All examples in the text below the options of a command."""
    return [
        Example(
            (match[0].removesuffix(match["remark"] or "")).strip(),
            match["words"].strip(),
            "|" if (match["before"] or "").endswith("| ") else match["sign"] or "",
            match["file"] or "",
        )
        for match in _EXAMPLE.finditer(epilog)
    ]


def workplace(folder: Path, *, changes: bool) -> Path:
    """The descriptions, copied if the command changes them, and the files that examples name."""
    if changes:
        shutil.copytree(ROOT / "descriptions", folder / "descriptions")
    else:
        (folder / "descriptions").symlink_to(ROOT / "descriptions")
    shutil.copytree(TESTS / "importing/sunspec", folder / "models")
    shutil.copy(TESTS / "importing/wb/heater.json", folder / "config-heater.json")
    for name, text in {
        "candump.log": "(1.5) can0 321#DD010302000007D0\n(1.6) can0 321#DD00051513880064\n",
        "gateway.log": "DEBUG:fieldscribe:unit 1 -> 01 03 10 28 00 01 00 C2 (A020 base_frequency)\n",
        "registers.csv": _REGISTERS,
        "list.csv": "1;x;Speed;y;z;0..400\nA001;x;1;y;z;0..400\n",
        "manual.txt": "\n" * 700 + _TEXT,
        "status.yaml": _STATUS,
        "bench.yaml": _BENCH,
        "points.txt": "A020\nd001\n",
    }.items():
        (folder / name).write_text(text, "utf-8")
    asked, came = bytes.fromhex("0001 0000 0006 01 03 1001 0001"), bytes.fromhex("0001 0000 0005 01 03 02 01F4")
    (folder / "plant.pcapng").write_bytes(classic([segment(1, asked), segment(1, came, back=True)]))
    return folder


def committed(folder: Path) -> None:
    """Make a repository of the folder, with two commits."""
    source = folder / "descriptions/hitachi_l200/standard_a.yaml"
    git = ("git", "-c", "user.name=x", "-c", "user.email=x@example.org", "-c", "commit.gpgsign=false")
    now = source.read_text("utf-8")
    source.write_text(now.replace("name: run_key,", "name: run_button,"), "utf-8")
    for words in (("init", "-q"), ("add", "."), ("commit", "-qm", "first"), ("tag", "v1.2.0")):
        subprocess.run([*git, *words], cwd=folder, check=True)
    source.write_text(now, "utf-8")
    subprocess.run([*git, "commit", "-qam", "second"], cwd=folder, check=True)


def with_one_device(folder: Path) -> None:
    """Leave one description: what commands do with all of them takes as much longer."""
    for device in (folder / "descriptions").glob("*/device.yaml"):
        if device.parent.name != "hitachi_l200":
            shutil.rmtree(device.parent)


def ran(example: Example, folder: Path, capsys: pytest.CaptureFixture[str], patch: pytest.MonkeyPatch) -> Ran:
    """Run an example in the folder: without its pipe, and with a log of candump as its input."""
    read = folder / (example.file if example.sign == "<" else "candump.log")
    buffer = io.BufferedReader(io.BytesIO(read.read_bytes()))  # as standard input has it, with `peek`
    patch.setattr(sys, "stdin", io.TextIOWrapper(buffer, encoding="utf-8"))
    with chdir(folder):
        code = main(shlex.split(example.words))
    said, told = capsys.readouterr()
    return Ran(code, said, told)


def audited(folder: Path) -> None:
    """The device of the examples is one whose manual is here; in its next edition all lines moved."""
    device = folder / "descriptions/hitachi_l200"
    shutil.rmtree(device)
    device.mkdir()
    shutil.copy(_AUDITED / "device.yaml", device)
    manual = (_AUDITED / "manual.txt").read_text("utf-8")
    (folder / "hitachi_l200_modbus.txt").write_text(manual, "utf-8")
    (folder / "new.txt").write_text("\n" + manual, "utf-8")


def drafted(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A description of one's own with what it was before, and a device as it was released."""
    words = ("--family", "modbus", "--vendor", "Example", "--model", "M", "--title", "Mine")
    with chdir(folder):
        for name in ("heat_pump", "my_drive"):
            assert main(["init", name, *words]) == 0
            shutil.move(f"descriptions/{name}", name)
        shutil.copytree("my_drive", "old/my_drive")
        capsys.readouterr()
        assert main(["export", "json", "hitachi_l200"]) == 0
    (folder / "released.json").write_text(capsys.readouterr().out, "utf-8")


def asked_for(folder: Path) -> None:
    """A project that asks for a device which is not there yet."""
    asked = 'out = "vendored"\ntargets = ["c"]\n\n[[devices]]\ndevice = "hitachi_l200"\n'
    (folder / "fieldscribe.toml").write_text(asked, "utf-8")


def stops_at_once(patch: pytest.MonkeyPatch) -> None:
    """Let commands that run for ever end after their first round."""
    patch.setattr(threading.Event, "wait", lambda _event, _seconds=None: True)

    async def wait_for(work: Coroutine[Any, Any, Any], _seconds: float | None) -> None:
        work.close()
        raise TimeoutError

    patch.setattr(asyncio, "wait_for", wait_for)
    serve_tcp = servers.serve_tcp
    patch.setattr(servers, "serve_tcp", lambda line, host, _port: serve_tcp(line, host))  # 5020 may be taken
