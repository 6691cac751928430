"""The README, and the sizes of the pages: every program of the README is true, and no page is too long to read."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from fieldscribe.cli import main
from fieldscribe.simulation import simulated
from support.described import group, head
from support.places import ROOT
from support.python_package import imported

README = (ROOT / "README.md").read_text("utf-8")
USING = ROOT / "descriptions/using"


def block(language: str) -> str:
    """Return the first code block of the README in a language."""
    found = re.search(rf"^```{language}\n(.*?)^```$", README, re.MULTILINE | re.DOTALL)
    assert found is not None
    return found[1]


def test_the_point_compiles(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "device.yaml").write_text(
        f"{head()}---\n{group(block('yaml'), access='rw', numbering='{modicon: wire + 1}')}", "utf-8"
    )
    assert main(["check", str(tmp_path)]) == 0
    assert "1 point (1 generated)" in capsys.readouterr().out


@pytest.mark.parametrize("language", ["c", "python", "rust", "typescript"])
def test_the_first_program_is_that_of_its_page(language: str) -> None:
    """The page's own test runs it."""
    assert block(language) in (USING / f"{language}.md").read_text("utf-8")


def test_the_first_commands_print_what_stands_there(capsys: pytest.CaptureFixture[str]) -> None:
    """A drive is simulated as the README's words do it: with the numbers of its manual."""
    command, _, expected = block("console").partition("\n")
    with simulated("hitachi_l200") as drive:
        words = command.removeprefix("$ fieldscribe ").replace(":5020", f":{drive.port}")
        assert main(shlex.split(words)) == 0
    assert capsys.readouterr().out == expected


def test_points_convert_without_a_line() -> None:
    for package in imported(ROOT / "generated/python", "hitachi_l200"):
        assert package.HitachiL200.base_frequency.decode(500) == 50.0
        first, *_ = package.HitachiL200.layouts("status")
        assert first.decode(bytes(first.size)).keys() == {point.facts.name for point in first.points}


def test_every_command_of_the_readme_has_help(capsys: pytest.CaptureFixture[str]) -> None:
    rows = re.findall(r"^\| (`[a-z].*?) \|", README, re.MULTILINE)
    names = {name for row in rows for name in re.findall(r"`([a-z]+)(?: [^`]*)?`", row)}
    assert len(names) > 15
    for name in sorted(names):
        assert main([name, "--help"]) == 0
    assert "usage" in capsys.readouterr().out


def test_the_commands_of_the_page_on_the_command_line_work(capsys: pytest.CaptureFixture[str]) -> None:
    page = (USING / "command-line.md").read_text("utf-8")
    commands = re.findall(r"^    fieldscribe (.*)$", page, re.MULTILINE)
    assert commands
    for command in commands:
        assert main(shlex.split(command)) == 0
    assert "base_frequency" in capsys.readouterr().out


def prose(page: Path) -> list[str]:
    """Return the lines of a page outside code blocks and tables."""
    text = re.sub(r"^```.*?^```$", "", page.read_text("utf-8"), flags=re.MULTILINE | re.DOTALL)
    return [line for line in text.splitlines() if not line.startswith("|")]


@pytest.mark.parametrize(
    ("page", "most"),
    [
        ("README.md", 160),
        ("CHANGELOG.md", 60),
        ("descriptions/new-edition.md", 120),
        *((str(page.relative_to(ROOT)), 200) for page in sorted(USING.glob("*.md"))),
    ],
)
def test_pages_are_short(page: str, most: int) -> None:
    lines = (ROOT / page).read_text("utf-8").splitlines()
    assert len(lines) <= most
    assert [line for line in prose(ROOT / page) if len(line) > 120] == []


def test_no_line_of_the_readme_is_wide() -> None:
    assert [line for line in README.splitlines() if len(line) > 120] == []
