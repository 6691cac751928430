"""YAML is read as libyaml reads it: each value, and where it stands."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path
from random import Random
from typing import Any

import pytest
import yaml
from fieldscribe import pipeline
from fieldscribe.diagnostics import Report
from fieldscribe.language.load import load, scalar
from fieldscribe.language.nodes import Map, Seq, SourceFile, decoded
from support.places import ROOT, TESTS

FILES = [*sorted((ROOT / "descriptions").glob("*/*.yaml")), *sorted((TESTS / "devices").rglob("*.yaml"))]


def read(text: str) -> Map:
    """The only document of a sound text."""
    report = Report()
    (root,) = load(SourceFile("a.yaml", text), report)
    assert report.findings == ()
    assert root is not None
    return root


def messages(text: str) -> list[tuple[str, int, int]]:
    """The rule, line and column of each finding about a text."""
    report = Report()
    load(SourceFile("a.yaml", text), report)
    return [(finding.rule, finding.span.line, finding.span.column) for finding in report.findings]


def place_of(node: Any) -> tuple[int, int]:
    """Where PyYAML's node starts, behind its quote."""
    quoted = isinstance(node, yaml.ScalarNode) and node.style in ("'", '"')
    return node.start_mark.line + 1, node.start_mark.column + 1 + quoted


def assert_equal(value: Any, node: Any, seen: set[Any]) -> None:
    """Hold what we read against PyYAML's own tree, value for value and place for place; that tree hides aliases."""
    seen.add(node)
    if isinstance(node, yaml.MappingNode):
        assert list(value) == [key.value for key, _ in node.value]
        for key, inner in node.value:
            mark = key.start_mark
            assert value.key_span(key.value).at == (mark.line + 1, mark.column + 1)
            assert inner in seen or value.span(key.value).at == place_of(inner)
            assert_equal(value[key.value], inner, seen)
    elif isinstance(node, yaml.SequenceNode):
        for index, (item, inner) in enumerate(zip(value, node.value, strict=True)):
            assert inner in seen or value.span(index).at == place_of(inner)
            assert_equal(item, inner, seen)
    else:
        expected = node.value if node.style else scalar(node.value)
        assert (type(value), value) == (type(expected), expected)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.relative_to(ROOT).as_posix())
def test_values_and_places_are_those_of_pyyaml(file: Path) -> None:
    source = decoded(file.name, file.read_bytes(), Report())
    assert source is not None
    documents = [node for node in yaml.compose_all(source.text, yaml.CSafeLoader) if node.value]
    for value, node in zip(load(source, Report()), documents, strict=True):
        assert_equal(value, node, set())


def test_places_of_keys_values_and_items() -> None:
    """Counted by hand: of a key in a list below another one, of brackets on several lines, behind quotes."""
    root = read('a: 1\nlist:\n# more\n- x: "y"  # why\n  deep: {k: [1, 2],\n         l: \'m\'}\nb:\n  - 5\n  - "6"\n')
    (first,) = root["list"]
    assert [root.span(key).at for key in root] == [(1, 4), (4, 1), (8, 3)]
    assert [first.key_span(key).at for key in first] == [(4, 3), (5, 3)]
    assert [first.span(key).at for key in first] == [(4, 7), (5, 9)]
    assert (first.span().at, first["deep"]["k"].span().at) == ((4, 3), (5, 13))
    assert [first["deep"]["k"].span(index).at for index in (0, 1)] == [(5, 14), (5, 17)]
    assert root["b"].span(1).at == (9, 6)


def test_items_keep_their_places_when_others_are_dropped() -> None:
    items: Seq = read("a: [1, 2, 3]\n")["a"]
    copy = items.copied()
    copy.drop(0)
    assert (copy, copy.span(0).at, items.span(0).at) == ([2, 3], (1, 8), (1, 5))


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("a: one\n  two\n", {"a": "one two"}),
        ("a: |\n  text\n", {"a": "text\n"}),
        ("a: &x 1\nb: *x\n", {"a": 1, "b": 1}),
        ("? a\n: b\n", {"a": "b"}),
        ("%YAML 1.2\n---\na: 'it''s'\n...\n", {"a": "it's"}),
        ("version&a : 1.0.0\n", {"version&a": "1.0.0"}),
        ("  --- x: 1\n", {"--- x": 1}),
        ("a: ... b\n", {"a": "... b"}),
        ("a: [b: 1]\n", {"a": [{"b": 1}]}),
    ],
)
def test_yaml_is_read_as_yaml_says(text: str, value: dict[str, Any]) -> None:
    assert read(text) == value


@pytest.mark.parametrize(
    ("text", "finding"),
    [
        ("a: 1\n... b: 2\n", ("yaml-syntax", 2, 5)),
        (f'a: 1\n"{"k" * 1_100}": 1\n', ("yaml-syntax", 2, 1)),
        ("a: b: c\n", ("yaml-syntax", 1, 5)),
        ("a:\tb\n\tc: 1\n", ("yaml-syntax", 2, 1)),
        ("a: 1\ra: 2\r", ("duplicate-key", 2, 1)),
        ("a: {b: 1, c}\n", ("yaml-comma", 1, 11)),
        ("a: !!int 1\n", ("yaml-tag", 1, 4)),
        ("&x a: 1\n", ("yaml-tag", 1, 1)),
        ("[a]: 1\n", ("yaml-key", 1, 1)),
        ("a: &x [*x]\n", ("yaml-alias", 1, 8)),
        ("a: *x\n", ("yaml-alias", 1, 4)),
        ("a: " + "[" * 60 + "]" * 60, ("yaml-depth", 1, 43)),
        ("- a\n", ("wrong-type", 1, 1)),
        ("# nothing\n", ("file-empty", 2, 1)),
        ("---\na: 1\n" * 10_001, ("yaml-size", 20_001, 1)),
    ],
    ids=lambda case: case[:20] if isinstance(case, str) else case[0],
)
def test_a_finding_names_line_and_column(text: str, finding: tuple[str, int, int]) -> None:
    assert messages(text) == [finding]


def test_aliases_count_each_time() -> None:
    bomb = "a: &a [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n" + "".join(
        f"{name}: &{name} [{', '.join([f'*{before}'] * 10)}]\n" for before, name in zip("abcdef", "bcdefg", strict=True)
    )
    started = time.process_time()
    assert [rule for rule, _, _ in messages(bomb)] == ["yaml-size"]
    assert time.process_time() - started < 1


def test_too_many_keys_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fieldscribe.language.load.MOST_VALUES", 1_000)
    assert messages("a: {" + ",".join(f"k{number}: 1" for number in range(1_001)) + "}") == [("yaml-size", 1, 4)]


@pytest.mark.parametrize(
    "piece",
    ["a: [", 'a: "', "  a: {b", "  - [x", "a: [[[[[[[", "x: {a: 'b", '  b: {a: {b: "', "a: b:c:d: e", "- - - - "],
)
def test_reading_takes_time_in_proportion(piece: str) -> None:
    """Brackets and quotes that never close are not looked for again and again."""
    chance = Random(1)
    text = "".join(f"{piece}{chance.randrange(9)}\n" for _ in range(40_000))
    started = time.process_time()
    load(SourceFile("a.yaml", text), Report())
    assert time.process_time() - started < 1.5


@pytest.mark.parametrize(("module", "loaded"), [("cli.generate", False), ("language.files", True)])
def test_yaml_is_loaded_only_where_files_are_read(module: str, loaded: bool) -> None:
    """`generate` with nothing changed takes a third less time without it."""
    code = f"import sys, fieldscribe.{module}; sys.exit('yaml' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == loaded


@pytest.mark.full(seconds=1)
def test_a_text_without_findings_is_read_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fieldscribe.language.nodes.find_positions", lambda _: pytest.fail("read again for places"))
    for device_file in (ROOT / "descriptions").glob("*/device.yaml"):
        assert pipeline.load_analysis(device_file, Report()) is not None
