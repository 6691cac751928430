"""Transcripts: commands as people type them, each with all that is printed and how it ends.

A line `$ fieldscribe ...` is a command. Below it stands what goes to standard output, then, behind `! `, what goes to
standard error, then, in brackets, the exit code if it is not 0. The escape of a terminal's colours is written `\\e`.
"""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING

from fieldscribe.cli import main

if TYPE_CHECKING:
    from pathlib import Path

    import pytest

PROMPT = "$ fieldscribe "


def commands_of(transcript: Path) -> list[str]:
    """The commands of a transcript, in their order; lines above the first are remarks."""
    lines = transcript.read_text("utf-8").splitlines()
    return [line.removeprefix(PROMPT) for line in lines if line.startswith(PROMPT)]


def remarks_of(transcript: Path) -> str:
    """What stands above the first command."""
    return transcript.read_text("utf-8").partition(PROMPT)[0]


def told(commands: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """What the commands print, in the form of a transcript."""
    return "\n".join("".join(f"{line}\n" for line in _told(command, capsys)) for command in commands)


def _told(command: str, capsys: pytest.CaptureFixture[str]) -> list[str]:
    code = main(shlex.split(command))
    out, err = capsys.readouterr()
    ending = [f"[{code}]"] if code else []
    lines = [*out.splitlines(), *(f"! {line}" for line in err.splitlines()), *ending]
    return [PROMPT + command, *(line.replace("\x1b", "\\e").rstrip() for line in lines)]
