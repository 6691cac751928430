"""Two readers of YAML, one result: the plain reader takes nearly all files, and gives what PyYAML gives."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING

import pytest
from fieldscribe.diagnostics import Report
from fieldscribe.language.lines import plain_documents
from fieldscribe.language.source import SourceFile, decoded
from fuzz.reading import FILES, difference, texts
from support.places import ROOT

if TYPE_CHECKING:
    from pathlib import Path

CASES, PARTS = 120, 4
SHIPPED = sorted((ROOT / "descriptions").glob("*/*.yaml"))
ANCHORED = {"parameters_analog.yaml"}


def source_of(file: Path) -> SourceFile | None:
    """The file as it is read."""
    return decoded(file.name, file.read_bytes(), Report())


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.relative_to(ROOT).as_posix())
def test_both_read_the_same(file: Path) -> None:
    """All descriptions, and all files of tests, the wrong ones too."""
    source = source_of(file)
    if source is not None:
        assert difference(source.text) is None


@pytest.mark.parametrize("part", range(PARTS))
def test_both_read_the_same_of_changed_texts(part: int) -> None:
    """Seeded; `make fuzz` has many more of them."""
    for index in range(part, CASES, PARTS):
        for text in texts(20261122, index):
            if decoded("a.yaml", text.encode("utf-8", "replace"), Report()) is not None:
                assert difference(text) is None, text


def test_shipped_descriptions_are_plain() -> None:
    """Only one has anchors; the others never need PyYAML."""
    read = {file.name: source_of(file) for file in SHIPPED}
    left = {name for name, source in read.items() if source is None or plain_documents(source) is None}
    assert left == ANCHORED


@pytest.mark.parametrize(
    "text",
    [
        "a: &x 1\nb: *x\n",
        "a: !!int 1\n",
        "a: |\n  text\n",
        "a: >-\n  text\n",
        "a: one\n  two\n",
        "a: 1\na: 2\n",
        "{a: 1, a: 2}\n",
        "a: {b: 1, b: 2}\n",
        "a:\nb: 1\n",
        "a:\n  b: 1\na:\n  b: 1\n",
        "a:\n  b: 1\na: 1\n",
        "a: 1\n  b: 2\n",
        "a:\n    b: 1\n  c: 2\n",
        "a: [1, 2\n",
        "a: {b}\n",
        "a: {b: 1, c}\n",
        "a: [b: 1]\n",
        "a: {b: c: d}\n",
        "a: b: c\n",
        'a: "\\x41"\n',
        "a: 'it''s'\n",
        "a:\tb\n",
        "a: b\u2028c: d\n",
        "a: b\x85c: d\n",
        "a: \ufeffb\n",
        "a: {b: 1,\nc: 2}\n",
        "a: [1,\n# no\n  2]\n",
        "- a\n- b\n",
        "text\n",
        "? a\n: b\n",
        "%YAML 1.2\n---\na: 1\n",
        "--- a: 1\n",
        "a: 1\n...\n",
        "a: -\n",
        "a:\n- \n- 1\n",
        "# nothing\n",
        "a: {b: }\n",
        "a: [1, , 2]\n",
        "a: [1, 2}\n",
        "a: @b\n",
        "a: %b\n",
        "a: `b`\n",
        'a: "b" c\n',
        "a: [b]c\n",
        "a: #b\nc\n",
        "a :b\n",
    ],
)
def test_what_is_not_plain_is_left_to_pyyaml(text: str) -> None:
    assert plain_documents(SourceFile("a.yaml", text)) is None


def test_places_are_those_of_the_text() -> None:
    """Of a key in a list below another one, and of what stands in brackets on several lines, counted by hand."""
    text = 'a: 1\nlist:\n# more\n- x: "y"  # why\n  deep: {k: [1, 2],\n         l: \'m\'}\n- x: z\nb:\n  - 5\n  - "6"\n'
    documents = plain_documents(SourceFile("a.yaml", text))
    assert documents is not None
    (root,) = documents
    assert root.places == {"a": (1, 1, 1, 4), "list": (2, 1, 4, 1), "b": (8, 1, 9, 3)}
    first, second = root["list"]
    assert (first.at, second.at) == ((4, 3), (7, 3))
    assert first.places == {"x": (4, 3, 4, 7), "deep": (5, 3, 5, 9)}
    assert first["deep"].places == {"k": (5, 10, 5, 13), "l": (6, 10, 6, 14)}
    assert first["deep"]["k"].item_at == [(5, 14), (5, 17)]
    assert root["b"].item_at == [(9, 5), (10, 6)]


def test_reading_takes_time_in_proportion(tmp_path: Path) -> None:
    """Brackets and quotes that never close are not looked for again and again."""
    import time

    chance = Random(1)
    for piece in (
        "a: [",
        'a: "',
        "  a: {b",
        "  - [x",
        "a: [[[[[[[",
        "x: {a: 'b",
        '  b: {a: {b: "',
        "a: b:c:d: e",
        "- - - - ",
    ):
        text = "".join(f"{piece}{chance.randrange(9)}\n" for _ in range(40_000))
        started = time.process_time()
        plain_documents(SourceFile("a.yaml", text))
        assert time.process_time() - started < 1.5, piece
