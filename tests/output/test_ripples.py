"""Regenerated output changes where facts did: lines of other points stay as they are, in every file."""

from __future__ import annotations

import re
import shutil
from collections import Counter
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

import pytest
from _pytest.mark.structures import ParameterSet
from fieldscribe.model import Device
from fieldscribe.pipeline import outputs
from fieldscribe.targets import TARGETS
from support.described import DEVICES, described, loaded, loaded_in

T = TypeVar("T")
Lines = dict[str, Counter[str]]

BEFORE = """\
- {name: first, code: A1, at: 0, range: 0..4000, scale: value = raw * 0.1, unit: Hz}
- {name: mode, at: 5, enum: {0: stopped, 1: running}}
- {name: motor, at: 10, enum: contact}
- {name: rated, at: 15, range: 100..400}
- {name: limit, at: 20, range: 0..rated.raw, scale: value = raw * rated.raw / 400, unit: V}
- {name: chosen, at: 25, range: "1, 3, 5, 9"}
"""
BEHIND = """\
- {name: second, code: A2, at: 30, range: 0..9000, scale: value = raw * 0.1, unit: Hz}
- {name: other, at: 35, enum: contact}
- {name: listed, at: 40, range: "1, 3, 5, 9"}
- {name: limit_2, at: 45, range: 0..rated.raw, scale: value = raw * rated.raw / 400, unit: V}
- {name: state, at: 50, flags: {0: ready, 3: fault}, access: r}
- {name: energy, at: 55, type: u32, range: 0..999999}
- {name: ratio, at: 60, type: f32}
- {name: last, at: 70}
"""
SAID = {"enums": "{contact: {0: normally_open, 1: normally_closed}}"}
POINTS = {
    "alike": "- {name: inserted, at: 200, range: 0..77, scale: value = raw * 0.1, unit: Hz}",
    "an enum of its own": "- {name: inserted, at: 200, enum: {0: warm, 1: cold}}",
    "an enum of others": "- {name: inserted, at: 200, enum: contact}",
    "a list of others": '- {name: inserted, at: 200, range: "1, 3, 5, 9"}',
    "a limit of others": "- {name: inserted, at: 200, range: 0..rated.raw, scale: value = raw * rated.raw / 400}",
    "first of its shape": "- {name: inserted, at: 200, type: s16, range: -5..5, scale: value = raw / 3, default: 3}",
    "flags": "- {name: inserted, at: 200, flags: {1: ready, 2: {name: fault, active: 0}}, access: r}",
    "not settled": "- {name: inserted, at: 200, type: ~}",
}
CHANGED = {
    "range": (POINTS["alike"], POINTS["alike"].replace("0..77", "0..99")),
    "scale": (POINTS["alike"], POINTS["alike"].replace("0.1", "0.2")),
    "unit": (POINTS["alike"], POINTS["alike"].replace("Hz", "rpm")),
    "address": (POINTS["alike"], POINTS["alike"].replace("200", "210")),
    "title": (POINTS["alike"], POINTS["alike"].replace("at:", "title: A longer title than any other, at:")),
    "enum entry": (POINTS["an enum of its own"], POINTS["an enum of its own"].replace("cold}", "cold, 2: icy}")),
    "default": (POINTS["alike"], POINTS["alike"].replace("at:", "default: 5, at:")),
    "a note": (POINTS["alike"], POINTS["alike"].replace("at:", "note: The first one, at:")),
}
COUNTS = {
    "docs": r"\| Points \| |Group `|Enum `contact`.* Used by ",
    "vectors": r"(kind|left_out|group)\t",
    "c": r"#define \w+_GROUP_COUNT ",
    "python": r'    """All points of ',
    "rust": r'        "\w+" => \w+\(vector\)',
    "typescript": r"import \{ ",
}
"""Lines that count points, list names or tables of vectors: they may change when there is one more point."""


def lines_of(device: Device) -> Lines:
    """The lines of each file of a device, without its digest; HTML pages number what points share."""
    digest = re.compile("|".join((device.digest, device.digest[:16], device.digest[:8])))
    files = [(path, text) for _, path, text in outputs(device, TARGETS) if not path.endswith(".html")]
    return {path: Counter(digest.sub("", text).split("\n")) for path, text in files}


def lost(old: Lines, new: Lines, also: Lines | None = None) -> list[tuple[str, str]]:
    """The old lines that are gone, but for those that count points, and for those that `also` lacks."""
    return [
        (path, line)
        for path, lines in old.items()
        for line in (lines - new.get(path, Counter())) - (lines - also.get(path, Counter()) if also else Counter())
        if not re.match(COUNTS.get(path.split("/")[0], "$x"), line)
    ]


@cache
def made(point: str = "", *, first: bool = False) -> Lines:
    """The lines with that point in the middle, or in front of all."""
    line = point and f"{point}\n"
    points = line + BEFORE + BEHIND if first else BEFORE + line + BEHIND
    with TemporaryDirectory() as folder:
        return lines_of(loaded_in(Path(folder), described(points, **SAID)))


def cases(table: dict[str, T], core: str) -> list[ParameterSet]:
    """All of a table, of which one belongs to the core suite."""
    full = pytest.mark.full(seconds=1)
    return [pytest.param(case, id=name, marks=() if name == core else full) for name, case in table.items()]


@pytest.mark.parametrize("point", cases(POINTS, "a list of others"))
def test_one_more_point_leaves_the_lines_of_others(point: str) -> None:
    assert lost(made(), made(point)) == []


@pytest.mark.parametrize("point", cases(POINTS, "flags"))
def test_examples_stay_with_their_point(point: str) -> None:
    """What is shown or tried once for many is so at the lowest address, wherever a new point is described."""
    assert lost(made(), made(point, first=True)) == []


@pytest.mark.parametrize("change", cases(CHANGED, "range"))
def test_a_changed_fact_changes_lines_of_its_point_alone(change: tuple[str, str]) -> None:
    without, old, new = made(), *map(made, change)
    assert old != new
    assert lost(old, new, without) == []
    assert lost(new, old, without) == []


@pytest.mark.full(seconds=2)
@pytest.mark.parametrize(
    ("device", "part", "behind", "point"),
    [
        (
            "kitchen_can",
            "parameters.yaml",
            "- {name: transformer_choice,",
            "- {name: inserted, at: 9000, range: 0..77}\n",
        ),
        ("kitchen_uss", "parameters.yaml", "- {code: P2000,", "- {name: inserted, at: 1900, range: 0..77}\n"),
    ],
)
def test_one_more_point_in_other_families(tmp_path: Path, device: str, part: str, behind: str, point: str) -> None:
    folder = tmp_path / device
    shutil.copytree(DEVICES / device, folder)
    old, text = lines_of(loaded(folder / "device.yaml")), (folder / part).read_text("utf-8")
    assert text.count(behind) == 1
    (folder / part).write_text(text.replace(behind, point + behind), "utf-8")
    assert lost(old, lines_of(loaded(folder / "device.yaml"))) == []
