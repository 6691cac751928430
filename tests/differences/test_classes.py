"""One edit of a description a row: which facts differ, in which class, and which step the version must take."""

from __future__ import annotations

import json
import shutil
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from fieldscribe.diagnostics import Report
from fieldscribe.differences.changes import CLASSES, Comparison, fact_of, is_taken, next_version, step_for, subject_of
from fieldscribe.differences.comparison import differences
from fieldscribe.differences.described import Described
from fieldscribe.differences.sides import Side
from fieldscribe.export import export_model
from fieldscribe.pipeline import load_analysis
from support.described import DEVICES, group, head, together, write

BASE = together(
    head(
        note="{en: A remark}",
        variants="{size: {title: Size, values: {small: {title: Small}, large: {title: Large}}}}",
        bus="{framings: [rtu], units: 1..247, broadcast: 0, timing: {answer: 5 ms}, serial: {speed: {04: 9600 Bd}}, "
        "gaps: {holding: [900..999]}, exceptions: {01h: bad_function}, "
        "functions: {03h: {name: read, max: 16}, 06h: write, 10h: write_many}}",
        enums="{modes: {0: stop, 1: run}}",
        commands="[{name: enter, function: 06h, at: 800h, value: 1, title: Enter, note: Once, "
        "wears: 9999, busy: status}, "
        "{name: prime, arguments: {unit: 1..9}, "
        "steps: [{at: 810h, words: [unit, 7]}, {wait: {source.raw: 1}, within: 2 s}]}]",
        frames='[{name: read_speed, framing: rtu, direction: request, bytes: "01 03 00 10 00 01 85 CF"}]',
        errata='[{id: odd, where: in the words, section: "1", printed: this at line 7, taken: that, why: so, '
        "certainty: likely}]",
        units="{sack: {name: sack of flour, quantity: flour}}",
        records="{event: {points: [{name: code, at: base}]}}",
    ),
    group(
        "- {code: P1, name: speed, title: {en: Speed, de: Tempo}, at: 10h, range: 0..4000, default: 500, line: 7, "
        "scale: value = raw * 0.1, unit: Hz, special: {FFFFh: {name: broken, no_value: yes}}}\n"
        "- {name: total, at: 20h, type: u32, words: high first, access: r, steps: {0: 5}}\n"
        "- {name: source, at: 30h, enum: {0: keypad, 1: panel}, keeps: yes, conditions: [stopped]}\n"
        "- {name: status, at: 31h, access: r, flags: {0: ready, 1: {name: fault, active: 0}, 5..4: {name: mode, "
        "values: {0: idle, 1: busy}}}}\n"
        "- {name: low, at: 32h, bits: 3..0}\n"
        "- {name: limited, at: 33h, range: 0..low}\n"
        "- {name: label, at: 40h, type: text, characters: 8}\n"
        "- {name: mode_of, at: 50h, enum: modes, when: source == 1}\n"
        "- {name: level, at: 60h, variants: {size=small: {range: 0..5}, size=large: {range: 0..9}}}\n"
        "- {name: pair, at: 61h, digits: {count: 2, enum: {0: none, 1: some}}}\n"
        "- {name: control, at: 62h, flags: {0: go}, fixed: {15: 1}}\n"
        "- {name: unsettled, at: 80h, type: ~, default: 3}\n"
        "- {name: nowhere, at: ~, range: 0..19}\n",
        numbering="{modicon: wire + 1}",
        title="{en: Main}",
    ),
    group(
        "- {name: packed, at: 100h, coding: bcd, bytes: low first}\n"
        "- {name: magnitude, at: 101h, type: s16, coding: sign and magnitude}\n"
        "- {name: words, at: 102h, type: text, characters: 4, encoding: latin-1, padding: 00h}\n"
        "- {name: moment, at: 104h, type: u32, notation: time since 1970-01-01}\n"
        "- {name: clock, at: 106h, per_word: 1, parts: [hour, minute]}\n"
        "- {name: twin, at: 108h, write_at: 109h}\n"
        "- {name: trot, at: 10Ah, unit: sack, takes_effect: after a restart, write_with: [twin]}\n"
        "- {name: event_1, record: event, at: 10Bh}\n"
        "- {name: seen, at: 10Ch, certainty: hardware, until: firmware 9}\n"
        "- {name: again, at: 10Ch, view_of: seen, changes: never}\n"
        "- {name: paged, at: 10Dh, select: {source: 1}, changes_with: [twin]}\n"
        "- {name: wide, at: 120h, type: u32, sets: {2: {at: 130h}}, display: {decimals: 1}, scale: value = raw / 100}\n"
        "- {name: unread, at: 140h, access: none, untyped: in two parts}\n",
        group="second",
    ),
)

Told = list[list[str | None]]
EDITS: list[tuple[str, str, Told, str]] = [
    (old, new, told, places[0] if places else old)
    for edits in json.loads(Path(__file__).with_name("edits.json").read_text("utf-8")).values()
    for old, new, told, *places in edits
]
"""What is replaced by what, all differences (class, subject and fact, the gravest first), and what stands in the
line that is told, if that is not the edited one."""

KITCHENS: list[tuple[str, str, list[str], Told]] = [
    (device, file, edit, told)
    for device, files in json.loads(Path(__file__).with_name("kitchens.json").read_text("utf-8")).items()
    for file, edits in files.items()
    for *edit, told in edits
]
"""The same for devices of other families: the device, its file, the edit, and all differences."""

STEPS = {"wire": "major", "api": "major", "behaviour": "minor", "compatible": "minor", "docs": "patch"}


@cache
def side(text: str) -> Side:
    """A description as one side of a comparison."""
    with TemporaryDirectory() as folder:
        return side_of(write(Path(folder), text))


@cache
def side_of(file: Path) -> Side:
    """A file as one side of a comparison."""
    analysis = load_analysis(file, Report())
    assert analysis is not None
    described = Described(analysis)
    return Side(export_model(described.device), described, "device.yaml")


def exported(text: str) -> Any:
    """The exported model of a description."""
    return side(text).exported


@pytest.mark.parametrize(("old", "new", "told", "place"), EDITS, ids=[f"{old} to {new}"[:60] for old, new, *_ in EDITS])
def test_an_edit(old: str, new: str, told: Told, place: str) -> None:
    assert old in BASE
    compared = Comparison("made_up", side(BASE), side(BASE.replace(old, new, 1)))
    found = [[each.weight, subject_of(each), fact_of(each)] for each in compared.differences]
    assert sorted(found, key=str) == sorted(told, key=str)
    gravest = next((weight for weight in CLASSES if any(weight == one[0] for one in found)), None)
    assert gravest == (told[0][0] if told else None)
    assert step_for(each.weight for each in compared.differences) == (STEPS[str(told[0][0])] if told else None)
    if told:
        places = compared.places(compared.differences[found.index(told[0])])
        edited = f":{BASE.partition(place)[0].count(chr(10)) + 1}"
        assert all(place is None or place.endswith(edited) for place in places.values()), (places, edited)
        assert any(places.values())


@pytest.mark.parametrize(("device", "file", "edit", "told"), KITCHENS, ids=lambda part: str(part)[:60])
def test_an_edit_of_a_kitchen(device: str, file: str, edit: list[str], told: Told, tmp_path: Path) -> None:
    shutil.copytree(DEVICES / device, tmp_path / device)
    edited = tmp_path / device / file
    text = edited.read_text("utf-8")
    old, new = edit
    assert old in text
    edited.write_text(text.replace(old, new, 1), "utf-8")
    sides = (side_of(folder / device / "device.yaml") for folder in (DEVICES, tmp_path))
    found = Comparison(device, *sides).differences
    assert [[each.weight, subject_of(each), fact_of(each)] for each in found] == told


def test_what_only_names_a_renamed_thing_is_no_difference() -> None:
    points = (
        "- {{name: {0}, at: 1}}\n- {{name: other, at: 2, range: 0..{0}, when: {0} == 1}}\n"
        "- {{name: third, at: 3, scale: raw = value * {0}, unit: V}}\n"
    )
    old, new = (exported(together(head(), group(points.format(name)))) for name in ("ratio", "quota"))
    assert [(each.weight, each.old, each.new, each.is_rename) for each in differences(old, new)] == [
        ("api", "ratio", "quota", True)
    ]


def test_an_edit_is_one_difference() -> None:
    """What only follows is not told: points whose group is renamed, errata about points that go with them."""
    about = BASE.replace("where: in the words", "points: [label, low]")
    edits = {
        "group: main": "group: basic",
        "- {name: label, at: 40h, type: text, characters: 8}\n": "",
        "at: 80h, type: ~": "at: 80h",
    }
    for old, new in edits.items():
        edited = about.replace(old, new, 1).replace(
            "points: [label, low]", f"points: [{'label, ' * ('label' not in old)}low]"
        )
        assert len(differences(exported(about), exported(edited))) == 1, old


def test_points_that_are_not_alone_at_a_place_are_no_rename() -> None:
    """Which of the two became which, nobody knows."""
    old, new = (
        exported(together(head(), group(f"- {{name: a{end}, at: ~}}\n- {{name: b{end}, at: ~}}\n")))
        for end in ("", "_x")
    )
    assert [fact_of(each) for each in differences(old, new)] == ["point"] * 4


@pytest.mark.parametrize(
    ("version", "step", "least"),
    [
        ("1.2.3", "major", "2.0.0"),
        ("1.2.3", "minor", "1.3.0"),
        ("1.2.3", "patch", "1.2.4"),
        ("0.2.3", "major", "0.3.0"),
        ("0.2.3", "minor", "0.2.4"),
        ("0.2.3", "patch", "0.2.4"),
        ("", "major", None),
        ("1.2", "major", None),
        ("1.2.x", "patch", None),
        ("1.2." + "9" * 5000, "patch", None),
    ],
)
def test_the_version_that_a_step_leads_to(version: str, step: str, least: str | None) -> None:
    assert next_version(version, step) == least
    assert is_taken(version, least or "9.9.9", step)
    assert is_taken(version, version, step) == (least is None)


def test_no_difference_asks_for_no_step() -> None:
    assert step_for(()) is None
    assert differences(exported(BASE), exported(BASE)) == []
