"""A description is a series of YAML documents: its head, then parts, below it or in files of their own."""

from __future__ import annotations

import time
from pathlib import Path

import pytest
from support.described import compile_in, group, head, together

HEAD, _, _BUS = head().partition("bus: ")
BUS = f"bus: {_BUS}"
STATUS = group("- {name: frequency, at: 0, type: s16}\n- {name: voltage, at: 1}\n", group="status", access="rw")
GROUP_1 = group("- {name: wide, at: 12, type: u32, words: low first}\n", group="group_1")
OF_ALL = "enums:\n  contact: {0: open, 1: closed}\n"


def test_parts_in_files_of_their_own(tmp_path: Path) -> None:
    """The shape of descriptions that stand outside this project."""
    parts = "parts: [bus.yaml, points.yaml, group_1.yaml]\n"
    device, findings = compile_in(tmp_path, device=HEAD + parts, bus=BUS, points=STATUS, group_1=GROUP_1)
    assert findings == ()
    assert device is not None
    assert [one.name for one in device.groups] == ["status", "group_1"]
    assert [one.addresses for one in device.points][-1] == (13, 12)


@pytest.mark.parametrize("documents", [(BUS, STATUS, GROUP_1), (BUS + STATUS, GROUP_1), (STATUS, GROUP_1, BUS)])
def test_a_device_in_one_file_is_the_same(documents: tuple[str, ...], tmp_path: Path) -> None:
    parts = "parts: [bus.yaml, points.yaml, group_1.yaml]\n"
    apart, _ = compile_in(tmp_path / "apart", device=HEAD + parts, bus=BUS, points=STATUS, group_1=GROUP_1)
    one_file, findings = compile_in(tmp_path / "one_file", device=together(HEAD, *documents))
    assert findings == ()
    assert one_file == apart


def test_a_part_holds_several_documents(tmp_path: Path) -> None:
    """What stands in device.yaml itself comes first, then what `parts` lists."""
    head = HEAD + BUS + "parts: [points.yaml]\n"
    last = group("- {name: other, at: 20}\n", group="group_2")
    device, findings = compile_in(tmp_path, device=together(head, GROUP_1), points=together(STATUS, OF_ALL, last))
    assert findings == ()
    assert device is not None
    assert [one.name for one in device.groups] == ["group_1", "status", "group_2"]


def test_empty_documents_are_nothing(tmp_path: Path) -> None:
    text = together("", "# nothing yet\n", HEAD + BUS, "", "# nor here\n", STATUS, "")
    device, findings = compile_in(tmp_path, device=text)
    assert findings == ()
    assert device is not None
    assert len(device.points) == 2


def test_findings_name_the_line_of_the_file(tmp_path: Path) -> None:
    """Each document is a part of its own: its keys are given once, its anchors end with it."""
    wrong = "group: more\nspace: holding\nspace: input\naccess: *rw\nsource: {section: x}\npoints: []\n"
    _, findings = compile_in(tmp_path, device=together(HEAD + BUS, STATUS.replace("rw", "&rw rw"), wrong))
    first = (HEAD + BUS).count("\n") + STATUS.count("\n") + 2
    assert [(one.rule, one.span.line - first, one.span.column) for one in findings] == [
        ("duplicate-key", 3, 1),
        ("yaml-alias", 4, 9),
    ]


@pytest.mark.parametrize(
    ("wrong", "rule"),
    [
        ("[1, 2]\n", "wrong-type"),
        ("text\n", "wrong-type"),
        ("~\n", "wrong-type"),
        ("title: Alone\n", "missing-key"),
        ("group: alone\nspace: holding\n", "missing-key"),
        ("points: []\n", "missing-key"),
        ("group: [\n", "yaml-syntax"),
        ("fieldscribe: 1\n", "unknown-key"),
    ],
)
def test_each_document_is_checked(wrong: str, rule: str, tmp_path: Path) -> None:
    device, findings = compile_in(tmp_path, device=together(HEAD + BUS, STATUS, wrong))
    assert device is None
    assert [one.rule for one in findings] == [rule]


@pytest.mark.parametrize("keys", ["group: x\nspace: holding\npoints: []\n", "points: []\n"])
def test_a_group_in_the_head_is_told_where_it_belongs(keys: str, tmp_path: Path) -> None:
    _, findings = compile_in(tmp_path, device=HEAD + BUS + keys)
    assert {one.rule for one in findings} == {"unknown-key"}
    assert all("below a line `---`" in (one.hint or "") for one in findings)


@pytest.mark.parametrize("document", ["---\n", "--- {}\n", "---\nx-a: 1\n", "---\n...\n"])
def test_the_number_of_documents_is_bounded(document: str, tmp_path: Path) -> None:
    started = time.process_time()
    _, findings = compile_in(tmp_path, device=HEAD + BUS + document * 100_000)
    assert [one.rule for one in findings] == ["yaml-size"]
    assert time.process_time() - started < 5


def test_a_file_of_empty_documents_is_empty(tmp_path: Path) -> None:
    _, findings = compile_in(tmp_path, device="---\n# nothing\n---\n")
    assert [one.rule for one in findings] == ["file-empty"]
