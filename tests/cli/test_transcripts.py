"""What the commands say to people, word by word: each file in tests/transcripts holds commands and what they print.

After a change of wording, look at what `FIELDSCRIBE_ACCEPT=1 pytest tests/cli/test_transcripts.py` makes of them.
"""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

import pytest
from support.places import ROOT, TESTS
from support.transcripts import commands_of, remarks_of, told

if TYPE_CHECKING:
    from pathlib import Path


FOLDER = TESTS / "transcripts"
TRANSCRIPTS = sorted(FOLDER.glob("*/*.txt"))

pytestmark = pytest.mark.usefixtures("loads_once")


@pytest.mark.parametrize(
    "transcript", TRANSCRIPTS, ids=lambda path: path.relative_to(FOLDER).with_suffix("").as_posix()
)
def test_transcript(transcript: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    if transcript.parent.name == "terminal":
        _be_terminal(monkeypatch)
    said = remarks_of(transcript) + told(commands_of(transcript), capsys)
    if os.environ.get("FIELDSCRIBE_ACCEPT"):
        transcript.write_text(said, "utf-8")
    assert said == transcript.read_text("utf-8")


def _be_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in {"TERM": "xterm", "COLUMNS": "100", "NO_COLOR": "", "COLORTERM": ""}.items():
        monkeypatch.setenv(name, value)
    for stream in (sys.stdout, sys.stderr):
        monkeypatch.setattr(stream, "isatty", lambda: True)
