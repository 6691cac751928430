"""The canonical form: what it is, that it says the same, keeps all comments, and is its own canonical form."""

from __future__ import annotations

import json
import os
import random
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.authoring import formatting
from fieldscribe.cli import main
from fieldscribe.diagnostics import Report
from fieldscribe.language.canonical import canonical, comments, pieces, unbroken
from fieldscribe.language.key_tables import schema_text
from fieldscribe.language.load import load
from fieldscribe.language.nodes import SourceFile
from support.described import DEVICES, described
from support.places import ROOT, TESTS

SHIPPED = sorted((ROOT / "descriptions").rglob("*.yaml"))
MADE = sorted(DEVICES.rglob("*.yaml"))
WRONG = sorted((TESTS / "bad").rglob("*.yaml"))

CASES = {
    "indents": ("a:\n    b:\n        c: 1\n", "a:\n  b:\n    c: 1\n"),
    "dashes": ("a:\n  - 1\n  -   b: 2\n      c: 3\n", "a:\n- 1\n- b: 2\n  c: 3\n"),
    "dash alone": ("a:\n-\n  b: 2\n  c: 3\n", "a:\n- b: 2\n  c: 3\n"),
    "list in a list": ("a:\n  -   - 1\n      - 2\n", "a:\n- - 1\n  - 2\n"),
    "empty items": ("a:\n-\n-\n- 1\nb:\nc: 1\n", "a:\n-\n-\n- 1\nb:\nc: 1\n"),
    "blanks": ("a :  {b:   1 ,c: [ 1,2 ]}\n", "a: {b: 1, c: [1, 2]}\n"),
    "last comma": ("a: [1, 2, ]\nb: {c: 1,\n}\n", "a: [1, 2]\nb: {c: 1}\n"),
    "broken brackets": ("a: {\n  b: 1,\n  c: 2\n}\n", "a: {b: 1,\n    c: 2}\n"),
    "lines in brackets": ("- {b: 1,\n  c: [1,\n   2]}\n", "- {b: 1,\n   c: [1,\n       2]}\n"),
    "quotes": ("a: 'b'\nb: 'it''s'\nc: 'a \"b\"'\nd: '\\'\n", 'a: "b"\nb: "it\'s"\nc: \'a "b"\'\nd: \'\\\'\n'),
    "empty lines": ("\n\na: 1\n\n\n\nb: 2\n\n", "a: 1\n\nb: 2\n"),
    "line ends": ("a: 1  \r\nb: 2\r\n", "a: 1\nb: 2\n"),
    "no end": ("a: 1", "a: 1\n"),
    "comment at the end": ("a: 1 # b", "a: 1  # b\n"),
    "blank that is said": ('a: "b \\\n   c\\ \n   d"\n', 'a: "b \\\n  c\\ \n  d"\n'),
    "documents": ("a: 1\n--- # next\nb: 2\n...\n", "a: 1\n---  # next\nb: 2\n...\n"),
    "anchors": ("a: &x\n  - 1\nb: *x\nc: &y\n   d: 1\n", "a: &x\n- 1\nb: *x\nc: &y\n  d: 1\n"),
    "long text": ("a:\n   b: c\n    d\n\n    e\n", "a:\n  b: c\n    d\n\n    e\n"),
    "long quoted": ('a: {b: "c\n         d"}\n', 'a: {b: "c\n  d"}\n'),
    "block text": ("a:\n    b: |\n        c\n          d\n\n        e\n", "a:\n  b: |\n    c\n      d\n\n    e\n"),
    "value below": ("a:\n      b c\n", "a:\n  b c\n"),
    "nothing in brackets": ("{a: , b: [ ], c: { }}\n", "{a: , b: [], c: {}}\n"),
    "comment kept in its column": ("a: 1        # b\n", "a: 1        # b\n"),
    "comment too near": ("a: 1 # b\n", "a: 1  # b\n"),
    "comment that goes on": ("  a: 1   # b\n         # c\n", "a: 1     # b\n         # c\n"),
    "comments between": (
        "# a\nb:\n    # c\n    - d: 1\n      # e\n    # f\n# g\nh: 1\n# i\n",
        "# a\nb:\n# c\n- d: 1\n  # e\n# f\n# g\nh: 1\n# i\n",
    ),
    "comments in brackets": ("a: [ # b\n 1, # c\n # d\n 2 ]\n", "a: [  # b\n    1,  # c\n    # d\n    2]\n"),
}


@pytest.mark.parametrize("case", CASES)
def test_form(case: str) -> None:
    before, after = CASES[case]
    assert canonical(unbroken(before)) == after
    assert canonical(after) == after
    assert parsed(unbroken(before)) == parsed(after)


def parsed(text: str) -> list[Any] | None:
    """What a text says, with the order of its keys; None if it is no sound description."""
    report = Report()
    documents = load(SourceFile("a.yaml", text), report) if text else []
    return None if report.findings or None in documents else [_ordered(document) for document in documents]


def _ordered(value: Any) -> Any:
    if isinstance(value, dict):
        return [(key, _ordered(inner)) for key, inner in value.items()]
    return [_ordered(inner) for inner in value] if isinstance(value, list) else (type(value), value)


@pytest.mark.full(seconds=0.1)
@pytest.mark.parametrize("file", SHIPPED, ids=lambda file: f"{file.parent.name}-{file.stem}")
def test_shipped_descriptions_are_the_model(file: Path) -> None:
    text = file.read_text("utf-8")
    assert canonical(text) == text


def sound(files: list[Path]) -> Iterator[tuple[Path, str]]:
    for file in files:
        text = unbroken(file.read_bytes().decode("utf-8", "replace"))
        if parsed(text):
            yield file, text


def disturbed(text: str, dice: random.Random) -> str:
    """The same description by a careless hand: blanks, breaks, empty lines and comments where they do not matter."""
    result, depth, end = [], 0, 0
    for piece in pieces(text):
        if piece.text or piece.kind == "end":
            start = text.index(piece.text, end)
            gap = text[end:start]
            result += [_careless(gap, depth, dice), piece.text]
            end = start + len(piece.text)
        depth += (piece.kind in ("{", "[")) - (piece.kind in ("}", "]"))
    return "".join(result) + text[end:]


def _careless(gap: str, depth: int, dice: random.Random) -> str:
    if dice.random() > 0.15:
        return gap
    if "\n" in gap and not depth:
        line, rest = gap.split("\n", 1)
        return dice.choice([f"{line} \n{rest}", f"{line}\n\n\n{rest}", f"{line} # odd\n{rest}" if not line else gap])
    if depth and gap == " ":
        return dice.choice(["   ", f"\n{'':60}", f" # odd: ]\n{'':70}"])
    return gap


@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.full(seconds=4))])
def test_careless_hands(seed: int) -> None:
    dice = random.Random(seed)
    changed = 0
    files = list(sound([*SHIPPED, *MADE]))
    for file, text in files if seed > 1 else dice.sample(files, 8):
        before = disturbed(text, dice)
        assert parsed(before) == parsed(text), file
        formed = canonical(before)
        assert parsed(formed) == parsed(text), file
        assert comments(formed) == comments(before), file
        assert canonical(formed) == formed, file
        changed += formed != before
    assert changed > 5


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A description by a careless hand, in the working folder."""
    monkeypatch.chdir(tmp_path)
    place = tmp_path / "device.yaml"
    place.write_text(described("-   {name: a, at: 1 }\n"), "utf-8")
    return place


def test_fmt_writes_once(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["fmt", "--check"]) == 1
    assert capsys.readouterr().out == "not formatted: device.yaml\n1 not formatted, 0 in canonical form\n"
    assert main(["fmt"]) == 0
    assert capsys.readouterr().out == "formatted: device.yaml\n1 formatted, 0 in canonical form\n"
    assert file.read_text("utf-8") == described("- {name: a, at: 1}\n")
    state = os.stat(file)
    assert main(["fmt", "--format", "json"]) == 0
    assert json.loads(capsys.readouterr().out) == {"changed": [], "unchanged": 1, "findings": []}
    assert os.stat(file) == state
    assert main(["fmt", "--check"]) == 0


def test_fmt_takes_all_parts_and_a_part_alone(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("first", "second", "foreign"):
        (file.parent / f"{name}.yaml").write_text("x-a:   1\n", "utf-8")
    file.write_text(described("- {name: a, at: 1}\n", parts="[first.yaml, second.yaml, missing.yaml]"), "utf-8")
    assert main(["fmt", "first.yaml"]) == 0
    assert main(["fmt", "."]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "formatted: first.yaml",
        "1 formatted, 0 in canonical form",
        "formatted: second.yaml",
        "1 formatted, 2 in canonical form",
    ]


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("a: [1\n", "yaml-syntax"),
        ("a: 1\na: 2\n", "duplicate-key"),
        ("", "file-empty"),
        ("a: \x00\n", "yaml-character"),
        ("? a\n: 1\n", "no-canonical-form"),
        ("a: 1 # b\x85c: 2\n", "no-canonical-form"),
        ("a: |2\n    b\n", "no-canonical-form"),
        ("a: |+\n  b\n\n", "no-canonical-form"),
        ("  --- x: 1\n", "no-canonical-form"),
    ],
)
def test_what_cannot_be_read_stays(text: str, rule: str, file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file.write_text(text, "utf-8")
    assert main(["fmt"]) == 1
    assert f"error[{rule}]" in capsys.readouterr().err
    assert file.read_text("utf-8") == text
    assert os.listdir(file.parent) == ["device.yaml"]


def test_a_file_stays_what_it_is(file: Path) -> None:
    """Its permissions, and the link that it is reached by."""
    real = file.rename(file.parent / "real.yaml")
    real.chmod(0o640)
    file.symlink_to("real.yaml")
    assert main(["fmt"]) == 0
    assert file.is_symlink()
    assert real.stat().st_mode & 0o777 == 0o640
    assert "- {name: a, at: 1}" in real.read_text("utf-8")


def test_a_file_that_is_saved_meanwhile_is_not_lost(
    file: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    form: Callable[..., bytes | None] = formatting.formatted

    def slowly(*words: Any) -> bytes | None:
        file.write_text("mine: 1\n", "utf-8")
        return form(*words)

    monkeypatch.setattr(formatting, "formatted", slowly)
    assert main(["fmt"]) == 2
    assert "was saved while it was formatted: it stays as it is" in capsys.readouterr().err
    assert file.read_text("utf-8") == "mine: 1\n"


def test_what_would_say_something_else_is_not_written(
    file: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    before = file.read_text("utf-8")
    for wrong in ("device: other\n", before.replace("at: 1", "at: 2"), f"{before}# more\n", "a: ["):
        monkeypatch.setattr(formatting, "canonical", lambda _, wrong=wrong: wrong)
        assert main(["fmt"]) == 1
        assert "error[internal-error]: internal error: the canonical form would say something else" in (
            capsys.readouterr().err
        )
        assert file.read_text("utf-8") == before


def test_the_schema_beside_is_brought_up_to_date(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    schema = file.parent / "schema.json"
    file.write_text("# yaml-language-server: $schema=schema.json\n" + described("- {name: a, at: 1}\n"), "utf-8")
    schema.write_text(schema_text().replace("draft-07", "draft-06"), "utf-8")
    assert main(["fmt", "--check"]) == 1
    assert capsys.readouterr().out == "not formatted: schema.json\n1 not formatted, 1 in canonical form\n"
    assert main(["fmt"]) == 0
    assert schema.read_text("utf-8") == schema_text()
    schema.write_text("{}", "utf-8")  # somebody else's
    assert main(["fmt"]) == 0
    assert schema.read_text("utf-8") == "{}"


def test_a_schema_elsewhere_is_not_ours_to_write(file: Path) -> None:
    elsewhere = file.parent / "elsewhere/schema.json"
    elsewhere.parent.mkdir()
    old = schema_text().replace("draft-07", "draft-06")
    elsewhere.write_text(old, "utf-8")
    for named in (elsewhere.as_posix(), "elsewhere/schema.json", elsewhere.as_uri()):
        line = f"# yaml-language-server: $schema={named}\n"
        file.write_text(line + described("- {name: a, at: 1}\n"), "utf-8")
        assert main(["fmt"]) == 0
        assert elsewhere.read_text("utf-8") == old


def test_editors_may_ask_for_a_text(monkeypatch: pytest.MonkeyPatch, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    import io
    import sys

    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO("\ufeffa:   é\r\n".encode())))
    assert main(["fmt", "-"]) == 0
    assert capfdbinary.readouterr().out == "a: é\n".encode()
    assert main(["fmt", "-", "--check"]) == 2
