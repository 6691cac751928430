"""What yaml-language-server makes of a new description and of the shipped ones: completion, hover and findings."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.cli import main
from fieldscribe.language.keys import keys_of
from fieldscribe.language.keys.places import POINT
from support.language_server import LanguageServer
from support.places import ROOT

pytestmark = pytest.mark.full(seconds=0.1)
NUMBERS = count()
CURSOR = "¦"
GROUP = """\
# yaml-language-server: $schema=schema.json
group: main
title: {en: Main}
space: holding
access: rw
source: {document: manual, section: "1"}
points:
- name: speed
  at: 1
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A description that `init` made."""
    place = tmp_path_factory.mktemp("described")
    words = ["--family", "modbus", "--vendor", "Example", "--model", "HP 12", "--title", "Heat pump"]
    assert main(["init", "heat_pump", *words, "--in", str(place)]) == 0
    return place / "heat_pump"


@pytest.fixture(scope="module")
def server(folder: Path) -> Iterator[LanguageServer]:
    with LanguageServer(folder) as running:
        yield running


def new_name() -> str:
    """The server keeps what it opened once."""
    return f"edited_{next(NUMBERS)}.yaml"


def at_cursor(text: str) -> tuple[str, int, int]:
    """The text without the cursor, and where it is."""
    before, _, behind = text.partition(CURSOR)
    return before + behind, before.count("\n"), len(before) - (before.rfind("\n") + 1)


def offered(server: LanguageServer, text: str) -> dict[str, dict[str, Any]]:
    """What is offered at the cursor."""
    text, line, column = at_cursor(text)
    name = new_name()
    server.open(name, text)
    return server.completions(name, line, column)


def shown(server: LanguageServer, text: str, word: str) -> str:
    """What is shown of the first place where a word stands."""
    text, line, column = at_cursor(text.replace(word, word[0] + CURSOR + word[1:], 1))
    name = new_name()
    server.open(name, text)
    return server.hover(name, line, column)


def documentation(item: dict[str, Any]) -> str:
    output = item["documentation"]
    return str(output["value"] if isinstance(output, dict) else output)


def test_a_new_description_has_no_findings(server: LanguageServer, folder: Path) -> None:
    for name in ("device.yaml", "main.yaml"):
        server.open(name, (folder / name).read_text("utf-8"))
        assert server.findings(name) == []


def test_the_keys_of_a_point_are_offered_with_what_they_mean(server: LanguageServer) -> None:
    items = offered(server, f"{GROUP}  s{CURSOR}\n")
    keys = keys_of(POINT)
    assert set(items) >= set(keys) - {"name", "at"}
    assert set(items) <= {*keys, "point"}
    for name in set(items) & set(keys):
        assert documentation(items[name]).startswith(keys[name].shape.meaning.partition("`")[0].partition("_")[0]), name
    assert "range_in_units" in items


@pytest.mark.parametrize(
    ("key", "values"),
    [
        ("access", {"r", "w", "rw", "none"}),
        ("type", {"u16", "s16", "f32", "text"}),
        ("scale", {"value = raw * 0.1", "raw = value * 256"}),
        ("changes", {"never", "rarely", "always"}),
    ],
)
def test_values_are_offered(key: str, values: set[str], server: LanguageServer) -> None:
    assert set(offered(server, f"{GROUP}  {key}: {CURSOR}\n")) >= values


@pytest.mark.parametrize("key", sorted({*keys_of(POINT)} - {"name", "at"}))
def test_no_offer_is_nonsense(key: str, server: LanguageServer) -> None:
    for label, item in offered(server, f"{GROUP}  {key}: {CURSOR}\n").items():
        assert "object" not in label
        assert "object" not in item["insertText"]


def test_hover_says_what_a_key_means(server: LanguageServer, folder: Path) -> None:
    text = (folder / "main.yaml").read_text("utf-8")
    scale = shown(server, text, "scale")
    assert scale.startswith(keys_of(POINT)["scale"].shape.meaning.partition("`")[0])
    assert "```yaml\nvalue = raw * 0.1\n```" in scale
    assert "* `rw`" in shown(server, text, "access")
    frames = shown(server, (folder / "device.yaml").read_text("utf-8"), "frames")
    assert "```yaml\n- {name: write_base_frequency, direction: request, bytes: 05 06 10 28 01 F4 0C 91}\n```" in frames


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("  scael: value = raw * 0.1\n", "Property scael is not allowed."),
        ("  access: wr\n", 'Value is not accepted. Valid values: "r", "w", "rw", "none".'),
        ("  type: uint16\n", "String does not match the pattern of "),
        ("  title: {de: Drehzahl}\n", 'Missing property "en".'),
        ("  line: -1\n", "Value is below the minimum of 1."),
        ("- {at: 3}\n", 'Missing property "name".'),
        ("- {name: Speed 2}\n", "String does not match the pattern"),
    ],
)
def test_what_is_wrong_is_found_where_it_stands(line: str, found: str, server: LanguageServer) -> None:
    name = new_name()
    server.open(name, GROUP + line)
    findings = server.findings(name)
    assert [finding["message"].startswith(found) for finding in findings] == [True], findings
    assert findings[0]["range"]["start"]["line"] == GROUP.count("\n")


@pytest.mark.full(seconds=4)
def test_shipped_descriptions_have_no_findings() -> None:
    root = ROOT / "descriptions"
    with LanguageServer(root) as server:
        files = {file.relative_to(root).as_posix(): file.read_text("utf-8") for file in root.glob("*/*.yaml")}
        for name, text in files.items():
            server.open(name, text)
        assert {name: found for name in files if (found := server.findings(name))} == {}
