"""A description is a series of YAML documents: its head, then parts, below it or in files of their own."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import pytest
from support.described import compile_in, together

if TYPE_CHECKING:
    from pathlib import Path


HEAD = """\
fieldscribe: 1
device: drv
version: 1.0.0
vendor: Bench
model: DRV
title: {en: Bench drive}
family: modbus
documents:
  manual: {title: Bench, language: en, file: bench.txt, sha256: b06935aa2755a9a6836251f8eb393160950c51bbb09a2b6ebc134c9701533966}
"""  # noqa: E501  # as such a file stands elsewhere
BUS = """\
bus:
  framings: [rtu]
  units: 1..32
  broadcast: 0
  words: {u32: high first}
  functions:
    03h: {name: read_holding_registers, title: {en: Read n words}, max: 32, line: 1}
    06h: {name: write_register, title: {en: Write one word}, line: 1}
    10h: {name: write_registers, title: {en: Write n words}, max: 32, line: 1}
"""
STATUS = """\
group: status
title: {en: Status}
space: holding
access: rw
source: {document: manual, section: "1"}
points:
- {name: out_freq, title: {en: Output frequency}, at: 0, type: s16, scale: raw = value * 256, unit: Hz, line: 1}
- {name: out_volt, title: {en: Output voltage}, at: 1, type: u16, scale: raw = value * 50, unit: V, line: 2}
"""
GROUP_1 = """\
group: group_1
title: {en: Group 1, de: Gruppe 1}
space: holding
access: rw
source: {document: manual, section: "1"}
numbering: {modicon: wire + 1, reference: 400000 + modicon}
points:
- code: P0
  name: point_0
  title: {en: Point number 0, de: Punkt Nummer 0}
  at: 10
  line: 1
  range: 0..900
  scale: value = raw * 0.1
  unit: "%"
  printed: {modicon: [000Bh, 11], wire: [000Ah, 10]}
- code: P1
  name: point_1
  title: {en: Point number 1, de: Punkt Nummer 1}
  at: 11
  line: 2
  access: r
  flags: {0: ready, 1: running, 2: warning, 3: {name: fault, active: 0}, 7: at_speed}
- code: P2
  name: point_2
  at: 12
  line: 3
  type: u32
  words: low first
  range: 1..900
"""
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
    last = GROUP_1.replace("roup_1", "roup_2").replace("point_", "other_").replace("at: 1", "at: 2").replace("P", "Q")
    last = last.replace("modicon: [000Bh, 11], wire: [000Ah, 10]", "wire: 20")
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


@pytest.mark.parametrize("group", ["group: x\nspace: holding\npoints: []\n", "points: []\n"])
def test_a_group_in_the_head_is_told_where_it_belongs(group: str, tmp_path: Path) -> None:
    _, findings = compile_in(tmp_path, device=HEAD + BUS + group)
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
