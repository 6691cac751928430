"""Each description says what the second reading of its manual says, fact by fact; see second_reading.py."""

from __future__ import annotations

import re
import shutil
from collections import Counter
from pathlib import Path

import pytest
import yaml
from support.described import shipped
from support.places import ROOT
from support.second_reading import READ_TWICE, differences, errata, key, rows, settled_wrongly, unanswered

each_device = pytest.mark.parametrize("name", READ_TWICE)


@each_device
def test_the_description_says_what_the_second_reading_says(name: str) -> None:
    found = differences(name, ROOT / "descriptions" / name)
    assert not found, "\n".join(map(str, found))


@each_device
def test_each_row_is_told_from_the_others(name: str) -> None:
    keys = Counter(key(row) for row in rows(name) if row["kind"] != "note")
    assert [one for one, times in keys.items() if times > 1] == []


@each_device
def test_what_is_settled_was_read_otherwise_and_has_its_reason(name: str) -> None:
    assert settled_wrongly(name, errata(ROOT / "descriptions" / name)) == []


@each_device
def test_every_finding_of_the_second_reader_is_answered(name: str) -> None:
    assert unanswered(name, errata(ROOT / "descriptions" / name)) == []


@each_device
def test_what_a_group_says_of_a_type_is_said_of_a_point(name: str) -> None:
    """Otherwise nobody notices that a number of it is wrong."""
    documents = [
        document
        for path in sorted((ROOT / "descriptions" / name).glob("*.yaml"))
        for document in yaml.safe_load_all(path.read_text("utf-8"))
    ]
    used = {(point.group, str(point.type)) for point in shipped(name).points}
    said = [
        (document["group"], kind) for document in documents if "group" in document for kind in document.get("types", ())
    ]
    assert [each for each in said if each not in used] == []


def test_every_description_was_read_twice() -> None:
    assert sorted(path.parent.name for path in (ROOT / "descriptions").glob("*/device.yaml")) == READ_TWICE


SLIPS = [
    (
        "eastron_sdm630",
        "settings.yaml",
        {
            "1: {name: single_phase": "3: {name: single_phase",
            "3: {name: three_phase_four": "1: {name: three_phase_four",
        },
        "enum 1065353216",
    ),
    ("eastron_sdm630", "measurements.yaml", {"unit: kvarh": "unit: kWh"}, "unit"),
    ("eastron_sdm630", "measurements.yaml", {"!= single_phase_two_wire": "== three_phase_four_wire"}, "when"),
    (
        "fronius_datamanager",
        "settings.yaml",
        {"10 ** reference_voltage_exponent": "10 ** maximum_power_exponent"},
        "scale",
    ),
    ("fronius_datamanager", "controls.yaml", {"access: rw, ": ""}, "access"),
    (
        "hitachi_l200",
        "coils.yaml",
        {"0: {name: forward": "0: {name: reverse", "1: {name: reverse": "1: {name: forward"},
        "enum 0",
    ),
    ("hitachi_l200", "coils.yaml", {"name: overload\n": "name: overheating\n"}, "name"),
    ("hitachi_l200", "monitor_d.yaml", {"type: u32": "type: s32"}, "type"),
    ("hitachi_l200", "monitor_d.yaml", {"access: r\n": "access: rw\n"}, "access"),
    (
        "jumo_controller",
        "process_data.yaml",
        {"name: output_2,": "name: output_3,", "name: output_3,": "name: output_2,"},
        "flags 1",
    ),
    ("jumo_controller", "process_data.yaml", {"at: 0x005B": "at: 0x005F"}, "the whole row"),
    ("nord_sk5xxe", "process_data.yaml", {"name: quick_stop": "name: slow_stop"}, "flags 2"),
    ("siemens_mm4", "parameters.yaml", {"unit: Hz": "unit: s"}, "unit"),
    (
        "woodward_mpu2s",
        "telegram.yaml",
        {"raw / 10 ": "raw / 100 ", "raw * 10 ** IGNEXPO": "raw * 10 ** UGNEXPO"},
        "scale",
    ),
]
"""(device, file, what is exchanged in it, the fact that differs then)."""


def swapped(text: str, exchanged: dict[str, str]) -> str:
    """The text with each of these pieces in place of another, all at once."""
    return re.sub("|".join(map(re.escape, exchanged)), lambda found: exchanged[found[0]], text)


@pytest.mark.parametrize("name", sorted({name for name, *_ in SLIPS}))
def test_each_slip_is_noticed(tmp_path: Path, name: str) -> None:
    """All slips of a device at once: each is another fact."""
    folder, facts = tmp_path / name, set[str]()
    shutil.copytree(ROOT / "descriptions" / name, folder)
    for _, file, exchanged, fact in (slip for slip in SLIPS if slip[0] == name):
        text = (folder / file).read_text("utf-8")
        changed = swapped(text, exchanged)
        assert changed != text
        (folder / file).write_text(changed, "utf-8")
        assert fact not in facts
        facts.add(fact)
    assert facts <= {one.fact for one in differences(name, folder)}
