"""Digests of facts: the digest for code changes when generated code does, and only then."""

from __future__ import annotations

import csv
import io
import json
import os
import re
import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from collections.abc import Set as AbstractSet
from dataclasses import fields, is_dataclass, replace
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.cli import main
from fieldscribe.code_view import for_code
from fieldscribe.differences.changes import CLASSES
from fieldscribe.differences.comparison import differences
from fieldscribe.export import export_model
from fieldscribe.facts.digest import facts_digest, with_digest
from fieldscribe.model import Device
from fieldscribe.pipeline import outputs
from fieldscribe.resources import templates_dir
from fieldscribe.targets import TARGETS, target
from support.described import loaded, made
from support.files import copy_compiler
from support.models import FREQUENCY_SOURCE, point, sample_device
from support.places import ROOT, TESTS
from support.quick import full_but

DEVICES = TESTS / "devices"
CODE = [name for name in TARGETS if not target(name).SEES_TITLES]

Step = tuple[str, Any]
"""A field, an index or a key on the way to a value."""


def leaves(value: Any, owner: str = "", path: tuple[Step, ...] = ()) -> Iterator[tuple[str, tuple[Step, ...], Any]]:
    """Each plain value of a model: the field that it belongs to (`Point.type`), the way to it, and itself."""
    if is_dataclass(value):
        for field in fields(value):
            name = f"{type(value).__name__}.{field.name}"
            yield from leaves(getattr(value, field.name), name, (*path, ("field", field.name)))
    elif isinstance(value, dict):
        for key, one in value.items():
            yield from leaves(one, owner, (*path, ("key", key)))
    elif isinstance(value, tuple) and value:
        for index, one in enumerate(value):
            yield from leaves(one, owner, (*path, ("index", index)))
    else:
        yield owner, path, value


def changed(value: Any, path: tuple[Step, ...], new: Any) -> Any:
    """The model with one value put in place of another."""
    if not path:
        return new
    (kind, at), rest = path[0], path[1:]
    if kind == "field":
        return replace(value, **{at: changed(getattr(value, at), rest, new)})
    if kind == "key":
        return {**value, at: changed(value[at], rest, new)}
    return (*value[:at], changed(value[at], rest, new), *value[at + 1 :])


def others(value: Any) -> list[Any]:
    """Other values that could stand there."""
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value + 1, value - 1, 3]
    if isinstance(value, Fraction):
        return [value + 1]
    if isinstance(value, str):
        return [f"{value}_x", "never", "none", "r", "u16", "==", "yes"]
    if isinstance(value, bytes):
        return [value + b"\0"]
    return ["firmware 9", 7, "no", "never"] if value is None else [("x",), ("stopped",)]


def digest(device: Device) -> str:
    """The digest of what code may know of a device."""
    return with_digest(device, for_code(device))[0].digest


def all_facts(device: Device) -> str:
    """The digest of all facts of a device."""
    return facts_digest(with_digest(device, for_code(device))[0])


def code(device: Device) -> dict[str, str]:
    """All generated code of a device, as if it had the digest of nothing."""
    return {path: text for _, path, text in outputs(replace(device, digest="0" * 64), CODE)}


NO_FACTS = (
    *(
        *("Device.id", "Device.version", "Device.digest", "Device.command", "Device.family", "Device.blocks"),
        "Device.enums",
    ),
    *(
        *(
            "Bus.line_numbers",
            "Block.space",
            "Block.function",
            "Block.address",
            "Block.count",
            "Block.points",
            "Block.base",
        ),
        *("Code.most", "Code.line", "Frame.family_facts", "Message.length"),
    ),
    *("Field.start", "Field.width", "Field.low_first", "Field.word", "Field.when"),
    *("Point.errata", "Frame.errata", "Enum.was", "Erratum.where", "ScaleCase.written"),
    *("Shape.width", "Shape.encodes_values", "Shape.most_raw", "Shape.patterns", "Text.characters", "ScaleCase.raw"),
    *("Factor.within", "Factor.slope", "Factor.intercept", "Limit.least", "Limit.greatest"),
    *("Allowed.listed", "Point.default"),
)
"""Fields that follow from others, that cannot be changed alone, or that `diff` does not compare."""
UNPUBLISHED = ("Special.hexadecimal", "Special.shared", "Erratum.facts", "Place.references", "Terms.reason")
"""Facts that count in digests and are not told by `diff`, or only with others."""


@pytest.mark.parametrize(
    "names", [pytest.param(("kitchen_can", "kitchen_sink"), marks=pytest.mark.full(seconds=5)), ("kitchen_uss",)]
)
def test_every_field_of_the_model_counts(names: tuple[str, ...]) -> None:
    """A changed field is a difference with a class and changes the digest of all facts.

    It changes the digest for code if code sees it. A new field fails here until the table of facts lists it. The larger
    device has the fields that the first one does not have.
    """
    counted = set[str]()
    for device in map(made, names):
        counted |= counted_fields(device, counted)
    assert len(counted) > 80


def counted_fields(device: Device, known: AbstractSet[str]) -> set[str]:
    """Change fields of a device one by one, but for those that are known; return those that count as they shall."""
    plain, exported, usual = for_code(device), export_model(device), facts_digest(device)
    assert device.digest == digest(device)
    counted, tries = set[str](), Counter[str]()
    for owner, path, value in leaves(device):
        follows = owner in NO_FACTS or path[0] == ("field", "enums") or (owner == "Enum.name" and not value)
        if owner in counted | known or follows or value == () or tries[owner] > 2:
            continue
        tries[owner] += 1
        for other in (other for other in others(value) if other != value):
            mutant = changed(device, path, other)
            try:
                seen = for_code(mutant)
                digested = with_digest(mutant, seen)[0]
                assert facts_digest(digested) != usual, owner
                same = (digested.digest != device.digest) == (seen != plain)
                assert same, f"{owner}: `for_people` of its fact and code_view.py disagree"
                found = {each.weight for each in differences(exported, export_model(mutant))}
            except (AttributeError, TypeError, KeyError):
                continue  # no value of that kind belongs there
            assert found or owner in UNPUBLISHED, owner
            assert found <= CLASSES.keys()
            counted.add(owner)
            break
    return counted


def test_texts_for_people_count_among_all_facts() -> None:
    device = made("kitchen_can")
    point = device.points[0]
    edited = [
        replace(device, vendor="Another"),
        replace(device, note={"en": "A remark"}),
        replace(device, points=(replace(point, title={"en": "Another title"}), *device.points[1:])),
        replace(device, points=(replace(point, source=replace(point.source, line=7)), *device.points[1:])),
    ]
    assert facts_digest(replace(device, version="9.9.9")) == facts_digest(device)
    assert len({all_facts(other) for other in (device, *edited)}) == len(edited) + 1


def test_the_digest_of_a_release_stays() -> None:
    """What nobody changed has no other digest with a newer compiler: users would be warned of it."""
    released = json.loads((ROOT / "generated/manifest/nord_sk5xxe.json").read_text("utf-8"))["facts"]["digest"]
    assert facts_digest(loaded(ROOT / "descriptions/nord_sk5xxe/device.yaml")) == released


@pytest.mark.parametrize(
    "facts",
    [{"name": "third"}, {"closed": False}, {"entries": FREQUENCY_SOURCE.entries[:2]}, {"name": "first"}],
    ids=str,
)
def test_what_tells_an_enum_from_one_of_the_same_shape_counts(facts: dict[str, Any]) -> None:
    """Shapes that differ in the name of their enum are worked out once; each still has its name, and other facts."""
    first = point("first", 1, enum=replace(FREQUENCY_SOURCE, name="first"))
    shape = replace(first.shape, enum=replace(FREQUENCY_SOURCE, name="second"))
    second = point("second", 2)
    device = sample_device((first, replace(second, shape=shape)))
    changed_shape = replace(shape, enum=replace(FREQUENCY_SOURCE, **{"name": "second", **facts}))
    other = replace(device, points=(first, replace(second, shape=changed_shape)))
    assert digest(other) != digest(device)


NEW_KEY = """    Fact(
        "hazard",
        "What can go wrong.",
        null_or(STRING),
        value=lambda point, _: "moves" if point.name == HAZARDOUS else None,
        weight=BEHAVIOUR,
        label="Hazard",
        remark="hazard: {}",
        column="what can go wrong",
    ),
"""
"""One entry of the table: the export, its schema, `diff`, `explain`, pages, sheets and digests follow from it."""


@pytest.mark.full
def test_neither_a_new_key_nor_a_renamed_field_changes_generated_files(tmp_path: Path) -> None:
    """In a copy of the compiler, a key that no point uses is added, and a field of the model is renamed."""
    package = copy_compiler(tmp_path / "fieldscribe")
    shutil.copytree(templates_dir(), package / "shipped/templates")
    for file in (*package.rglob("*.py"), *package.rglob("*.j2")):
        text = file.read_text("utf-8")
        file.write_text(re.sub(r"\bwrite_place\b", "second_place", text), "utf-8")
    table = package / "facts/points.py"
    text = table.read_text("utf-8").replace("POINT: FactTable = (\n", f"POINT: FactTable = (\n{NEW_KEY}", 1)
    for name, is_used in (("nothing", False), ("wanted_speed", True)):
        table.write_text(text.replace("HAZARDOUS", f'"{name}"'), "utf-8")
        command = ["generate", str(DEVICES / "kitchen_sink"), "--out", str(tmp_path / name), "--target", "c,docs"]
        subprocess.run(
            [sys.executable, "-m", "fieldscribe", *command],
            cwd=tmp_path,
            env={**os.environ, "PYTHONPATH": str(tmp_path), "XDG_CACHE_HOME": str(tmp_path / "cache")},
            check=True,
            capture_output=True,
        )
        assert main([*command[:3], str(tmp_path / "ours"), *command[4:]]) == 0
        made_by_copy, ours = (
            {file.name: file.read_bytes() for file in sorted((tmp_path / folder).rglob("*.*"), reverse=True)}
            for folder in (name, "ours")
        )
        assert (made_by_copy != ours) == is_used
        assert [file for file, text in made_by_copy.items() if b"hazard: moves" in text] == (
            ["kitchen_sink.md"] if is_used else []
        )
        sheet = csv.DictReader(io.StringIO(made_by_copy["kitchen_sink.csv"].decode("utf-8-sig"), newline=""))
        hazards = {row["name"]: row["hazard"] for row in sheet if row.get("hazard")}
        assert hazards == ({"wanted_speed": "moves"} if is_used else {})
        assert ("hazard" in (sheet.fieldnames or ())) == is_used


@cache
def code_of(name: str) -> dict[str, str]:
    """The code of one of the devices that were made for the tests."""
    return code(made(name))


EDITS = (
    ("kitchen_uss", "parameters.yaml", "when: model == mm440", "when: model != mm440", True),
    ("kitchen_uss", "parameters.yaml", "when: model == mm440", "when: model in (mm440)", True),
    ("kitchen_uss", "parameters.yaml", "range: 0..3, when", "range: 0..4, when", True),
    ("kitchen_uss", "parameters.yaml", "name: quick_start", "name: quicker_start", True),
    ("kitchen_uss", "parameters.yaml", "name: quick_start,", "name: quick_start, title: New, note: New,", False),
    ("kitchen_uss", "parameters.yaml", "name: quick_start,", "name: quick_start, since: firmware 7, line: 7,", True),
    ("kitchen_sink", "ranges.yaml", "since: firmware 2.0, until: firmware 3.1", "since: firmware 2.5", False),
    ("kitchen_sink", "device.yaml", "version: 2.3.4", "version: 2.3.5", True),
)
"""Device, file, what stands there, what is put there, and whether code is made of it."""


@pytest.mark.parametrize("edit", full_but(EDITS[:6], EDITS))
def test_the_digest_changes_with_the_code(tmp_path: Path, edit: tuple[str, str, str, str, bool]) -> None:
    """An edited description has another digest exactly if it has other code."""
    name, file, old, new, counts = edit
    folder = tmp_path / name
    shutil.copytree(DEVICES / name, folder)
    text = (folder / file).read_text("utf-8")
    assert old in text
    (folder / file).write_text(text.replace(old, new, 1), "utf-8")
    before, after = made(name), loaded(folder / "device.yaml")
    assert (after.digest != before.digest) == counts
    assert (code(after) != code_of(name)) == counts
