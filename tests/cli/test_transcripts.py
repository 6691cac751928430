"""What the commands say to people, word by word: each file in tests/transcripts holds commands and what they print.

A line `$ fieldscribe ...` is a command. Below it stands what goes to standard output, then, behind `! `, what goes to
standard error, then, in brackets, the exit code if it is not 0. The escape of a terminal's colours is written `\\e`.

After a change of wording, look at what `FIELDSCRIBE_ACCEPT=1 pytest tests/cli/test_transcripts.py` makes of them.
"""

from __future__ import annotations

import os
import shlex
import sys
from pathlib import Path

import pytest
from fieldscribe.cli import main
from support.places import ROOT, TESTS

FOLDER = TESTS / "transcripts"
TRANSCRIPTS = sorted(FOLDER.glob("*/*.txt"))

pytestmark = pytest.mark.usefixtures("loads_once")

PROMPT = "$ fieldscribe "


def commands_of(transcript: Path) -> list[str]:
    """The commands of a transcript, in their order; lines above the first are remarks."""
    lines = transcript.read_text("utf-8").splitlines()
    return [line.removeprefix(PROMPT) for line in lines if line.startswith(PROMPT)]


def remarks_of(transcript: Path) -> str:
    """What stands above the first command."""
    return transcript.read_text("utf-8").partition(PROMPT)[0]


def transcript_of(commands: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """Return what the commands print, in the form of a transcript."""
    return "\n".join("".join(f"{line}\n" for line in printed_by(command, capsys)) for command in commands)


def printed_by(command: str, capsys: pytest.CaptureFixture[str]) -> list[str]:
    code = main(shlex.split(command))
    out, err = capsys.readouterr()
    ending = [f"[{code}]"] if code else []
    lines = [*out.splitlines(), *(f"! {line}" for line in err.splitlines()), *ending]
    return [PROMPT + command, *(line.replace("\x1b", "\\e").rstrip() for line in lines)]


@pytest.mark.parametrize(
    "transcript", TRANSCRIPTS, ids=lambda path: path.relative_to(FOLDER).with_suffix("").as_posix()
)
def test_transcript(transcript: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    if transcript.parent.name == "terminal":
        _be_terminal(monkeypatch)
    said = remarks_of(transcript) + transcript_of(commands_of(transcript), capsys)
    if os.environ.get("FIELDSCRIBE_ACCEPT"):
        transcript.write_text(said, "utf-8")
    assert said == transcript.read_text("utf-8")


def _be_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in {"TERM": "xterm", "COLUMNS": "100", "NO_COLOR": "", "COLORTERM": ""}.items():
        monkeypatch.setenv(name, value)
    for stream in (sys.stdout, sys.stderr):
        monkeypatch.setattr(stream, "isatty", lambda: True)
