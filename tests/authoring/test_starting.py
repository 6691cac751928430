"""`init`: what it makes compiles at once for every target, and what it refuses leaves nothing behind."""

from __future__ import annotations

import os
import pty
import select
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from fieldscribe.authoring.starting import startable
from fieldscribe.cli import main
from fieldscribe.families import FAMILIES
from fieldscribe.language.canonical import canonical
from fieldscribe.language.key_tables import schema_text
from support.described import loaded

GIVEN = ("--vendor", "Example", "--model", "HP 12", "--title", "Heat pump")
ANSWERS = ["heat_pump", "modbus", "Example", "HP 12", "Heat pump", "", ""]
"""To the questions, in their order; nothing said takes what is usual."""


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def init(*words: str) -> int:
    return main(["init", *words])


@pytest.mark.parametrize("family", FAMILIES)
def test_every_family_starts_with_a_sound_description(
    family: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert init("heat_pump", "--family", family, *GIVEN) == 0
    output = capsys.readouterr()
    assert output.out.splitlines()[:3] == [
        "made heat_pump/device.yaml and heat_pump/main.yaml and heat_pump/schema.json",
        "next:",
        "  fieldscribe check heat_pump",
    ]
    assert main(["check", "heat_pump"]) == 0
    output = capsys.readouterr()
    assert (output.out, output.err) == ("heat_pump: 1 point (1 generated) in 1 group, 0 errata, 2 printed frames\n", "")
    assert main(["generate", "heat_pump"]) == 0
    for file in ("device.yaml", "main.yaml"):
        text = (tmp_path / "heat_pump" / file).read_text("utf-8")
        assert text.startswith("# yaml-language-server: $schema=schema.json\n")
        assert canonical(text) == text


def test_families_are_told_apart_by_what_they_serve() -> None:
    assert list(startable()) == list(FAMILIES)
    assert all(startable().values())


def test_texts_arrive_as_they_were_said(tmp_path: Path) -> None:
    vendor, model, title, manual = 'A: "B" & c', "12", "{odd}, # really", "C:\\new\\x"
    words = ("--vendor", vendor, "--model", model, "--title", title, "--manual", manual, "--language", "de")
    assert init("odd_device", "--family", "can", *words) == 0
    device = loaded(tmp_path / "odd_device/device.yaml")
    (document,) = device.documents
    assert (device.vendor, device.model, device.title) == (vendor, model, {"en": title})
    assert (document.title, document.language) == (manual, "de")


def test_descriptions_share_the_schema_above(tmp_path: Path) -> None:
    (tmp_path / "descriptions").mkdir()
    (tmp_path / "descriptions/schema.json").write_text(schema_text(), "utf-8")
    assert init("heat_pump", "--family", "modbus", *GIVEN) == 0
    made = tmp_path / "descriptions/heat_pump"
    assert sorted(os.listdir(made)) == ["device.yaml", "main.yaml"]
    assert (made / "main.yaml").read_text("utf-8").startswith("# yaml-language-server: $schema=../schema.json\n")


def test_another_schema_above_is_none_of_ours(tmp_path: Path) -> None:
    (tmp_path / "schema.json").write_text("{}", "utf-8")
    assert init("heat_pump", "--family", "modbus", *GIVEN) == 0
    assert (tmp_path / "heat_pump/schema.json").read_text("utf-8") == schema_text()


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        (["../pump", "--family", "can", *GIVEN], 2, "DEVICE: `../pump` is not a name in snake_case"),
        (["a/b", "--family", "can", *GIVEN], 2, "DEVICE: `a/b` is not a name in snake_case"),
        (["..", "--family", "can", *GIVEN], 2, "DEVICE: `..` is not a name in snake_case"),
        (["", "--family", "can", *GIVEN], 2, "DEVICE: `device` is empty"),
        (["a" * 81, "--family", "can", *GIVEN], 2, "DEVICE: the text has 81 characters, at most 80 are allowed"),
        (["pump\n", "--family", "can", *GIVEN], 2, "DEVICE: `device` is no line of text"),
        (["pump", "--family", "bell", *GIVEN], 2, "--family: there is no family `bell` to start with"),
        (["pump", "--family", "can", *GIVEN, "--language", "deu"], 2, "--language: `deu` is not a language"),
        (["pump", "--family", "can", *GIVEN, "--manual", "a\x1b[0m"], 2, "--manual: `manual` is no line of text"),
        (["con", "--family", "can", *GIVEN], 2, "`con` is no safe name for a folder"),
        (["serial", "--family", "can", *GIVEN], 2, "`serial` is a library that the runtime's transports import"),
        (["pump", "--family", "can", *GIVEN, "--in", "x" * 300], 2, "File name too long"),
        (["match", "--family", "can", *GIVEN], 2, "`match` is a word that Rust reserves"),
        (["pump", "--family", "can"], 2, "missing: --vendor, --model, --title"),
        ([], 2, "missing: DEVICE, --family, --vendor, --model, --title"),
        (["pump", "--family", "can", *GIVEN, "--in", "nowhere"], 2, "there is no folder `nowhere`"),
    ],
)
def test_what_is_wrong_leaves_nothing(
    words: list[str], code: int, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert init(*words) == code
    assert capsys.readouterr().err.startswith(f"fieldscribe: {message}")
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("kind", ["file", "folder", "link"])
def test_nothing_is_overwritten(kind: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    there = tmp_path / "heat_pump"
    if kind == "file":
        there.write_text("mine", "utf-8")
    elif kind == "folder":
        there.mkdir()
    else:
        there.symlink_to(tmp_path / "nowhere")
    assert init("heat_pump", "--family", "modbus", *GIVEN) == 2
    assert "there is already `heat_pump`: nothing was written" in capsys.readouterr().err
    assert os.listdir(tmp_path) == ["heat_pump"]
    assert kind != "folder" or os.listdir(there) == []


def _hear_interrupts() -> None:
    """A shell that starts its jobs in the background has them ignore Ctrl-C; a person at a terminal does not."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class Terminal:
    """`init` on a terminal of its own."""

    def __init__(self, folder: Path, *words: str) -> None:
        self.shown = ""
        self.ours, theirs = pty.openpty()
        command = [sys.executable, "-m", "fieldscribe", "init", *words]
        environment = {**os.environ, "NO_COLOR": "1"}
        self.process = subprocess.Popen(
            command,
            cwd=folder,
            env=environment,
            stdin=theirs,
            stdout=theirs,
            stderr=theirs,
            start_new_session=True,
            preexec_fn=_hear_interrupts,  # noqa: PLW1509 - no thread of ours runs between fork and exec
        )
        os.close(theirs)

    def until(self, text: str) -> None:
        """Wait until it has shown that."""
        while text not in self.shown:
            self._more()

    def type(self, keys: str) -> None:
        os.write(self.ours, keys.encode())

    def end(self) -> int:
        """Its exit code, when it has shown all."""
        while self._more():
            pass
        os.close(self.ours)
        return self.process.wait(20)

    def _more(self) -> bool:
        assert select.select([self.ours], [], [], 20)[0], f"nothing came after {self.shown!r}"
        try:
            data = os.read(self.ours, 4096)
        except OSError:
            data = b""
        self.shown += data.decode("utf-8", "replace")
        return bool(data)


def test_a_terminal_is_asked_again_until_the_answer_is_right(tmp_path: Path) -> None:
    terminal = Terminal(tmp_path)
    terminal.until("generated names: ")
    terminal.type("../pump\n")
    terminal.until("`../pump` is not a name in snake_case; write `pump`")
    for answer in ANSWERS:
        terminal.type(f"{answer}\n")
    assert terminal.end() == 0, terminal.shown
    assert "modbus  registers and coils, over RTU or TCP" in terminal.shown
    assert "the title of its manual [Example HP 12]: " in terminal.shown
    device = loaded(tmp_path / "heat_pump/device.yaml")
    assert [document.title for document in device.documents] == ["Example HP 12"]


@pytest.mark.parametrize("stop", ["end of text", "interrupt"])
def test_a_terminal_may_say_no(stop: str, tmp_path: Path) -> None:
    terminal = Terminal(tmp_path, "heat_pump", "--family", "modbus")
    terminal.until("who makes it: ")
    if stop == "end of text":
        terminal.type("\x04")
    else:
        for _ in range(40):  # one that comes just before Python waits for a line is not seen until the next
            terminal.process.send_signal(signal.SIGINT)
            if select.select([terminal.ours], [], [], 0.5)[0]:
                break
    assert terminal.end() == (2 if stop == "end of text" else 130)
    assert ("stopped: nothing was written" in terminal.shown) == (stop == "end of text")
    assert os.listdir(tmp_path) == []
