"""The digest is that of what code is made of: it changes when generated code does, and only then."""

from __future__ import annotations

import shutil
from dataclasses import fields, is_dataclass, replace
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.pipeline import outputs
from fieldscribe.plain import digest, for_code
from fieldscribe.targets import TARGETS, target
from support.described import loaded, made
from support.places import TESTS

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from fieldscribe.model import Device

DEVICES = TESTS / "devices"
CODE = [name for name in TARGETS if not target(name).FOR_PEOPLE]

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


def code(device: Device) -> dict[str, str]:
    """All generated code of a device, as if it had the digest of nothing."""
    return {path: text for _, path, text in outputs(replace(device, digest="0" * 64), CODE)}


@pytest.mark.parametrize(
    "name", [pytest.param("kitchen_sink", marks=pytest.mark.full(seconds=4)), "kitchen_can", "kitchen_uss"]
)
def test_every_field_that_code_knows_counts(name: str) -> None:
    """Whatever changes in what code may know changes the digest; what is for people changes neither."""
    device = made(name)
    plain = for_code(device)
    assert device.digest == digest(device) == digest(plain)
    counted = set()
    for owner, path, value in leaves(device):
        if owner in counted or owner in ("Device.digest", "Device.asked") or value == ():
            continue
        mutant = changed(device, path, others(value)[0])
        try:
            assert (digest(mutant) != device.digest) == (for_code(mutant) != plain), owner
        except AttributeError:
            continue  # where nothing stood, a thing with parts belongs
        counted.add(owner)
    assert len(counted) > 100


@cache
def code_of(name: str) -> dict[str, str]:
    """The code of one of the devices that were made for the tests."""
    return code(made(name))


EDITS = (
    ("kitchen_uss", "parameters.yaml", "when: model == mm440", "when: model != mm440", True),
    ("kitchen_uss", "parameters.yaml", "when: model == mm440", "when: model in (mm440)", True),
    ("kitchen_uss", "parameters.yaml", "range: 0..3, when", "range: 0..4, when", True),
    ("kitchen_uss", "parameters.yaml", "name: quick_start", "name: quicker_start", True),
    (
        "kitchen_uss",
        "parameters.yaml",
        "name: quick_start,",
        "name: quick_start, title: New, note: New,",
        False,
    ),
    ("kitchen_uss", "parameters.yaml", "name: quick_start,", "name: quick_start, since: firmware 7, line: 7,", True),
    ("kitchen_sink", "ranges.yaml", "since: firmware 2.0, until: firmware 3.1", "since: firmware 2.5", False),
    ("kitchen_sink", "device.yaml", "version: 2.3.4", "version: 2.3.5", True),
)
"""Device, file, what stands there, what is put there, and whether code is made of it."""


@pytest.mark.parametrize("edit", EDITS, ids=range(len(EDITS)))
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
