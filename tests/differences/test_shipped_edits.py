"""Plausible edits of descriptions that are shipped: whom each breaks, as a user of the bindings would say."""

from __future__ import annotations

import shutil
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

import pytest
from fieldscribe.diagnostics import Report
from fieldscribe.differences.changes import fact_of, step_for
from fieldscribe.differences.comparison import differences
from fieldscribe.export import export_model
from fieldscribe.pipeline import load_analysis
from support.places import ROOT

if TYPE_CHECKING:
    from pathlib import Path


class Edit(NamedTuple):
    """One fact of a file in other words, the step that this asks for, and the differences that it makes."""

    file: str
    old: str
    new: str
    step: str
    told: dict[tuple[str, str], int]


EDITS = {
    "rename point": Edit(
        "hitachi_l200/basic_f.yaml", "name: motor_direction", "name: rotation", "major", {("api", "name"): 1}
    ),
    "rename set point": Edit(
        "hitachi_l200/basic_f.yaml", "name: acceleration_time", "name: ramp_up_time", "major", {("api", "name"): 2}
    ),
    "move point": Edit("hitachi_l200/basic_f.yaml", "at: 1013h", "at: 1021h", "major", {("wire", "address"): 1}),
    "unit": Edit(
        "hitachi_l200/monitor_d.yaml",
        'range: 0..2000\n  scale: value = raw * 0.1\n  unit: "%"',
        "range: 0..2000\n  scale: value = raw * 0.1\n  unit: A",
        "major",
        {("wire", "unit"): 1},
    ),
    "scale": Edit(
        "hitachi_l200/basic_f.yaml",
        "scale: value = raw * 0.01",
        "scale: value = raw * 0.1",
        "major",
        {("wire", "scale"): 2, ("docs", "meaning"): 1},
    ),
    "scale of record member": Edit(
        "hitachi_l200/monitor_d.yaml",
        "base + 4, scale: value = raw * 0.1",
        "base + 4, scale: value = raw * 0.01",
        "major",
        {("wire", "scale"): 3},
    ),
    "enum entry renamed": Edit(
        "hitachi_l200/basic_f.yaml",
        "name: reverse, en: Reverse",
        "name: backward, en: Backward",
        "major",
        {("api", "entry reverse name"): 1},
    ),
    "special code number": Edit(
        "hitachi_l200/standard_a.yaml",
        "special: {0: {name: inactive",
        "special: {1: {name: inactive",
        "minor",
        {("behaviour", "range"): 4, ("behaviour", "code inactive raw"): 2},
    ),
    "limits narrower": Edit(
        "hitachi_l200/basic_f.yaml", "range: 1..300000", "range: 10..300000", "minor", {("behaviour", "range"): 2}
    ),
    "default": Edit("nord_sk5xxe/parameters.yaml", "default: 0", "default: 1", "patch", {("docs", "default"): 1}),
    "record one more": Edit(
        "hitachi_l200/monitor_d.yaml",
        "- code: d083\n",
        "- code: d084\n  name: trip_4\n  record: trip\n  at: 1100h\n  line: 722\n- code: d083\n",
        "minor",
        {("compatible", "point"): 6},
    ),
    "record member added": Edit(
        "hitachi_l200/monitor_d.yaml",
        "    - {name: run_time, ",
        "    - {name: extra, at: base + 1}\n    - {name: run_time, ",
        "minor",
        {("compatible", "point"): 3},
    ),
    "set count": Edit("nord_sk5xxe/parameters.yaml", "sets: 4", "sets: 3", "major", {("api", "point"): 1}),
    "array length": Edit(
        "nord_sk5xxe/parameters.yaml", "indices: 5", "indices: 6", "minor", {("compatible", "point"): 4}
    ),
    "group renamed": Edit("hitachi_l200/basic_f.yaml", "group: basic_f", "group: basic", "major", {("api", "name"): 1}),
    "text place": Edit(
        "woodward_mpu2s/parameters_texts.yaml", "at: 739..732", "at: 732..739", "major", {("wire", "order of words"): 1}
    ),
    "exception code": Edit(
        "hitachi_l200/bus.yaml",
        "21h: {name: value_out_of_range",
        "23h: {name: value_out_of_range",
        "major",
        {("wire", "number"): 1},
    ),
    "exception renamed": Edit(
        "hitachi_l200/bus.yaml", "name: not_available", "name: refused_now", "major", {("api", "name"): 1}
    ),
    "alias added": Edit(
        "hitachi_l200/basic_f.yaml",
        "name: motor_direction",
        "name: motor_direction\n  was: [old_direction]",
        "minor",
        {("compatible", "old names"): 1},
    ),
    "rename with alias": Edit(
        "hitachi_l200/basic_f.yaml",
        "name: motor_direction",
        "name: rotation\n  was: [motor_direction]",
        "minor",
        {("compatible", "name"): 1},
    ),
    "command renamed": Edit("hitachi_l200/bus.yaml", "- name: enter", "- name: store", "major", {("api", "name"): 1}),
    "access": Edit(
        "hitachi_l200/basic_f.yaml",
        "name: motor_direction",
        "name: motor_direction\n  access: r",
        "major",
        {("api", "access"): 1},
    ),
    "access widened": Edit(
        "hitachi_l200/monitor_d.yaml",
        "name: trip_count",
        "name: trip_count\n  access: rw",
        "minor",
        {("compatible", "access"): 1},
    ),
    "type": Edit(
        "hitachi_l200/monitor_d.yaml",
        "at: 0010h\n  range: 0..65535",
        "at: 0010h\n  type: s16\n  range: 0..32767",
        "major",
        {("wire", "type"): 1, ("behaviour", "range"): 1},
    ),
    "type settled": Edit(
        "nord_sk5xxe/parameters.yaml",
        "at: 103, line: 161",
        "at: 103, type: u16, line: 161",
        "major",
        {("api", "type"): 1},
    ),
    "function max": Edit(
        "hitachi_l200/bus.yaml",
        "name: read_holding_registers, title: {en: Read holding registers, de: Lese Holding Register}, max: 4",
        "name: read_holding_registers, title: {en: Read holding registers, de: Lese Holding Register}, max: 8",
        "minor",
        {("behaviour", "max"): 1},
    ),
    "units": Edit("hitachi_l200/bus.yaml", "units: 1..32", "units: 1..247", "minor", {("behaviour", "units"): 1}),
    "baud": Edit("hitachi_l200/bus.yaml", "6: 19200}", "6: 19200, 7: 38400}", "minor", {("behaviour", "serial"): 1}),
    "exponent range": Edit(
        "woodward_mpu2s/telegram.yaml",
        "type: s8, range: 0..5",
        "type: s8, range: 0..6",
        "major",
        {("behaviour", "range"): 1, ("api", "decimals"): 1},
    ),
    "keeps": Edit(
        "hitachi_l200/basic_f.yaml",
        "keep_with: enter",
        "keeps: yes",
        "minor",
        {("docs", "kept"): 1, ("behaviour", "kept"): 5},
    ),
    "numbering": Edit(
        "hitachi_l200/basic_f.yaml", "modicon: wire + 1", "modicon: wire + 2", "major", {("wire", "base"): 5}
    ),
    "title": Edit(
        "hitachi_l200/basic_f.yaml",
        "en: Rotation direction, de: Drehrichtung",
        "en: Direction of rotation, de: Drehrichtung",
        "patch",
        {("docs", "title"): 1},
    ),
    "erratum lines": Edit(
        "hitachi_l200/bus.yaml",
        "The replies at lines 246 and 297 carry",
        "The replies at lines 250 and 301 carry",
        "patch",
        {("docs", "reason"): 1},
    ),
    "printed lines": Edit(
        "siemens_mm4/bus.yaml", "at line 148 an inverter", "at line 158 an inverter", "patch", {("docs", "printed"): 1}
    ),
}


@cache
def shipped(device: str) -> Any:
    """The exported model of a device that is shipped."""
    return _exported(ROOT / "descriptions" / device)


def _exported(folder: Path) -> Any:
    subject = load_analysis(folder / "device.yaml", Report(), with_errors=True)
    assert subject is not None
    return export_model(subject.device)


@pytest.mark.full(seconds=1)
@pytest.mark.parametrize("edit", EDITS.values(), ids=EDITS)
def test_an_edit_of_a_shipped_description(edit: Edit, tmp_path: Path) -> None:
    device, _, part = edit.file.partition("/")
    file = shutil.copytree(ROOT / "descriptions" / device, tmp_path / device) / part
    text = file.read_text("utf-8")
    assert edit.old in text
    file.write_text(text.replace(edit.old, edit.new, 1), "utf-8")
    new, told = _exported(tmp_path / device), dict[tuple[str, str], int]()
    for difference in differences(shipped(device), new):
        said = difference.weight, fact_of(difference)
        told[said] = told.get(said, 0) + 1
    assert told == edit.told
    assert step_for(weight for weight, _ in told) == edit.step
