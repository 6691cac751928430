"""The page on a changed manual is walked as it stands there: its files, its edits, its commands and what they print.

After a change of wording, look at what `FIELDSCRIBE_ACCEPT=1 pytest tests/audit/test_new_edition_page.py` makes of it.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
from pathlib import Path

import pytest
from fieldscribe.cli import main
from support.places import ROOT

PAGE = ROOT / "descriptions" / "new-edition.md"
BLOCK = re.compile(r"(?:`(?P<name>[\w./]+)`:\n\n)?^```(?P<kind>\w+)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)


def test_the_page_is_walked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    page = PAGE.read_text("utf-8")

    def walked(block: re.Match[str]) -> str:
        name, kind, text = block["name"], block["kind"], block["text"]
        if name:
            (tmp_path / name).parent.mkdir(exist_ok=True)
            (tmp_path / name).write_text(text, "utf-8")
        elif kind == "diff":
            _edit(tmp_path, text)
        elif kind == "console":
            command = text.splitlines()[0]
            if not (tmp_path / "before").exists():
                shutil.copytree("heat_pump", "before")
            code = main(shlex.split(command.removeprefix("$ fieldscribe ")))
            output = capsys.readouterr()
            printed = output.out + output.err
            findings = any(words in printed for words in ("not stand", "not accepted"))
            assert code == findings, printed
            return f"```console\n{command}\n{printed}```"
        return block[0]

    seen = BLOCK.sub(walked, page)
    if os.environ.get("FIELDSCRIBE_ACCEPT"):
        PAGE.write_text(seen, "utf-8")
    assert seen == PAGE.read_text("utf-8")
    assert main(["diff", "before", "heat_pump"]) == 1
    assert "the version must take a major step" in capsys.readouterr().out


def _edit(folder: Path, text: str) -> None:
    """Carry out an edit: the text after each minus becomes that after each plus."""
    head, *lines = text.splitlines()
    place = folder / head.removeprefix("--- ")
    old = "\n".join(line[1:] for line in lines if line.startswith("-"))
    new = "\n".join(line[1:] for line in lines if line.startswith("+"))
    before = place.read_text("utf-8")
    assert before.count(old) == 1, old
    place.write_text(before.replace(old, new) if new else before.replace(f"{old}\n", ""), "utf-8")


def test_the_page_is_short() -> None:
    assert len(PAGE.read_text("utf-8").splitlines()) <= 120


def test_the_first_page_names_it() -> None:
    assert "(new-edition.md)" in (ROOT / "descriptions" / "README.md").read_text("utf-8")
