"""`fieldscribe docs`: what it writes, what it refuses, and the page that tells of it.

After a change of wording say `FIELDSCRIBE_ACCEPT=1 pytest tests/vendoring/test_docs_command.py`, and look at it.
"""

from __future__ import annotations

import os
import re
import shlex
import sys
from pathlib import Path

import pytest
from fieldscribe.cli import main
from fieldscribe.targets.docs import sheet, tables
from fieldscribe.vendoring.requests import FORMATS
from support.places import ROOT

pytestmark = pytest.mark.usefixtures("loads_once")

PAGE = ROOT / "descriptions/using/tables.md"
KITCHEN = str(ROOT / "tests/devices/kitchen_uss")
TABLES = {"points": sheet.COLUMNS, "meanings": tables.MEANINGS, "errata": tables.ERRATA}


def docs(*words: str | Path) -> int:
    return main(["docs", *map(str, words)])


@pytest.mark.parametrize(
    ("form", "files"),
    [
        ("csv", {"kitchen_uss.csv", "kitchen_uss_meanings.csv"}),
        ("markdown", {"kitchen_uss.md"}),
        ("xlsx", {"kitchen_uss.xlsx"}),
    ],
)
def test_each_format(form: str, files: set[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = (KITCHEN, "--format", form, "--out", tmp_path)
    assert docs(*words) == 0
    assert {path.name for path in tmp_path.iterdir()} == {*files, "kitchen_uss.manifest.json"}
    before = {path: path.read_bytes() for path in tmp_path.iterdir()}
    capsys.readouterr()
    assert (docs(*words), docs(*words, "--check")) == (0, 0)
    assert capsys.readouterr().out == (
        f"0 written, 0 removed, {len(files) + 1} unchanged of kitchen_uss in {tmp_path}\n"
        f"0 of {len(files) + 1} files of kitchen_uss in {tmp_path} are not current\n"
    )
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_the_help_says_what_a_format_holds(capsys: pytest.CaptureFixture[str]) -> None:
    assert docs("--help") == 0
    said = " ".join(capsys.readouterr().out.split())
    assert all(f"{form}: {what}" in said for form, what in FORMATS.items())


def test_formats_live_beside_each_other(tmp_path: Path) -> None:
    for form in ("csv", "markdown"):
        assert docs(KITCHEN, "--format", form, "--out", tmp_path) == 0
    assert len(list(tmp_path.iterdir())) == 4
    assert "`fieldscribe docs kitchen_uss --format markdown`" in (tmp_path / "kitchen_uss.md").read_text("utf-8")


def test_a_table_with_notes_of_ones_own_is_not_replaced(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = (KITCHEN, "--format", "csv", "--out", tmp_path)
    assert docs(*words) == 0
    table = tmp_path / "kitchen_uss.csv"
    noted = table.read_text("utf-8") + "my note\n"
    table.write_text(noted, "utf-8")
    assert (docs(*words, "--check"), docs(*words)) == (1, 1)
    assert "kitchen_uss.csv is in the way: it was edited" in capsys.readouterr().err
    assert table.read_text("utf-8") == noted
    assert docs(*words, "--force") == 0
    assert "my note" not in table.read_text("utf-8")


def test_a_wrong_device_leaves_the_others_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "wrong.yaml").write_text("fieldscribe: 1\n", "utf-8")
    assert docs(tmp_path / "wrong.yaml", KITCHEN, "nobody", "--format", "csv", "--out", tmp_path / "out") == 2
    output = capsys.readouterr()
    assert "3 written" in output.out
    assert "there is no device or path `nobody`" in output.err
    assert docs(tmp_path / "wrong.yaml", "--format", "csv", "--out", tmp_path / "out") == 1


def test_a_device_that_is_named_twice_is_written_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert docs(KITCHEN, f"{KITCHEN}/device.yaml", "--format", "markdown", "--out", tmp_path) == 0
    assert capsys.readouterr().out.count(" written") == 1


def test_an_empty_name_is_no_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As of a variable that is not set: the devices here are not written."""
    monkeypatch.chdir(ROOT / "descriptions")
    assert docs("", "--format", "markdown", "--out", tmp_path) == 2
    assert not list(tmp_path.iterdir())


def test_without_its_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setitem(sys.modules, "xlsxwriter", None)
    assert docs(KITCHEN, "--format", "xlsx", "--out", tmp_path / "out") == 2
    assert 'pip install "fieldscribe[xlsx]"' in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def _walked(text: str, capsys: pytest.CaptureFixture[str]) -> str:
    """The block of a console, with what its commands print now."""
    seen = ""
    for command in re.findall(r"^\$ fieldscribe (.*)$", text, re.MULTILINE):
        assert main(shlex.split(command)) == 0
        seen += f"$ fieldscribe {command}\n{capsys.readouterr().out}"
    return seen


def _told(table: str) -> str:
    rows = [f"| `{column.name}` | {column.meaning} |" for column in TABLES[table]]
    return "\n".join(("| column | what it says |", "|---|---|", *rows, ""))


@pytest.mark.full(seconds=1)
def test_the_page_is_walked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    page = PAGE.read_text("utf-8")
    seen = re.sub(r"(?s)(?<=```console\n).*?(?=```)", lambda block: _walked(block[0], capsys), page)
    tables = r"(?s)(<!-- (\w+) -->\n).*?(?=\n\n|\Z)"
    seen = re.sub(tables, lambda table: table[1] + _told(table[2]).rstrip("\n"), seen).rstrip("\n") + "\n"
    if os.environ.get("FIELDSCRIBE_ACCEPT"):
        PAGE.write_text(seen, "utf-8")
    assert seen == PAGE.read_text("utf-8")
