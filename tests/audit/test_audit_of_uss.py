"""The audit of a USS description: words of telegrams, codes of answers, and names that the manual writes otherwise."""

from __future__ import annotations

import json
from hashlib import sha256
from pathlib import Path

import pytest
from fieldscribe.cli import main
from support.described import group, head, together, write

USS_MANUAL = """Drive

Words\tPZD1\tPZD2
Bit 0\ton
Bit13\tfault
The part before the point stands in PWE1, that behind it in PWE2.

10\tReserved\t-
9 - 12\tNot used
15\tText\t7
Source 21, P0700 = 21.0
"""

WORDS = "{document: manual, section: Words}"
USS_DOCUMENTS = """
  manual: {title: Manual, language: en, file: manual.txt, sha256: SHA, writes: {31..16: [PWE1], 15..0: [PWE2]}}"""
USS_BUS = """
  units: 0..31
  pkw: [127]
  pzd: 0..2
  functions:
    1: {name: read_value, answers: [1, 2]}
    0Fh: {name: text, refusals: [7], line: 10, printed: {refusals: []}}
  responses:
    1: {name: word, answers: [1]}
    2: {name: double_word, answers: [1]}
    7: {name: refused, answers: [15]}
    9: {name: unused_9, line: 9}
    10: {name: unused_10, line: 9}
    11: {name: unused_11, line: 9}
    12: {name: unused_12, line: 9}"""
USS_PARAMETERS = """\
- code: P0700
  name: source
  at: 700
  type: u32
  access: r
  flags: {31..16: parameter, 15..0: bit}
  line: 11
  lines: {flags: 6..6}
- {code: r0021, name: frequency, at: 21, access: r, line: 11}
errata:
- id: letter
  point: frequency
  line: 11
  printed: No letter is printed.
  taken: r0021
  why: It cannot be written.
  certainty: likely
- id: refusal
  function: 15
  line: 10
  printed: {refusals: []}
  taken: {refusals: [7]}
  why: The response list has it.
  certainty: likely
"""
USS_WORDS = """\
- {name: control_word, at: 0, flags: {0: on, 13: fault}, line: 4, lines: {address: 3}}
- {name: setpoint, at: 1, line: 3, printed: {pzd: 2}}
errata:
- {id: level, point: control_word, line: 5, printed: No level is said., taken: 1 is on., why: Usual., certainty: likely}
"""
USS_DEVICE = together(
    head(
        device="audited",
        family="uss",
        documents=USS_DOCUMENTS,
        bus=USS_BUS,
        telegrams="[{name: task, direction: request, length: 2}]",
    ),
    group(USS_PARAMETERS, group="parameters", space="parameter", source=WORDS),
    group(
        USS_WORDS,
        group="words",
        space="telegram",
        source=WORDS,
        telegram="task",
        access="w",
        numbering="{pzd: wire + 1}",
    ),
)


@pytest.mark.parametrize(
    ("old", "new", "missing"),
    [
        ("", "", []),
        ("9 - 12", "9, 12", ["response 10", "response 11"]),
        ("PZD2", "PZD3", ["setpoint", "setpoint"]),
        ("PZD1", "PZD7", ["control_word"]),
        ("Bit13", "Bit14", ["control_word"]),
        ("PWE1", "PWE3", ["source", "source"]),
        ("15\tText\t7", "15\tText\t-", []),
    ],
)
def test_uss_manuals_are_read_as_they_write(
    old: str, new: str, missing: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "audited"
    manual = USS_MANUAL.replace(old, new) if old else USS_MANUAL
    text = USS_DEVICE.replace("SHA", sha256(manual.encode()).hexdigest())
    write(folder, text)
    (tmp_path / "manual.txt").write_text(manual, "utf-8")
    main(["audit", str(folder), "--manual", str(tmp_path / "manual.txt"), "--report", "json"])
    assert [one["subject"] for one in json.loads(capsys.readouterr().out)["missing"]] == missing
