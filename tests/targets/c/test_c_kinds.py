"""Points of one kind share their text: the key of the kind has all that the text depends on."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.code_view import for_code
from fieldscribe.conditions import Comparison, Condition
from fieldscribe.model import Enum, Erratum, Place, Special
from fieldscribe.pipeline import device_files_below
from fieldscribe.render import render
from fieldscribe.resources import descriptions_dir
from fieldscribe.targets import c
from fieldscribe.targets.c import kinds
from fieldscribe.targets.c.fold import folded
from fieldscribe.targets.c.scope import scope_of
from fieldscribe.targets.c.special_codes import encoded_limits
from support.described import DEVICES, loaded
from support.models import CELSIUS, HERTZ, SOURCE, allowed, device_of, entry, point, scaled, titles

if TYPE_CHECKING:
    from pathlib import Path

    from fieldscribe.model import Device, Point
    from fieldscribe.targets.c.scope import HeaderScope

FILES = [*device_files_below(descriptions_dir()), *device_files_below(DEVICES)]
LONG = "a_name_so_long_that_lines_break_where_they_do_not_break_for_its_neighbour"
MODES = Enum("mode", titles("Mode"), (entry(0, "off"), entry(1, "slow")), False)
FAULT = (Special(65535, 65535, "fault", titles("Fault"), True, own=False),)
OFF = Erratum("E1", ("two",), "", SOURCE, "1", "2", "", "sure", (("scale", "1"),))


def pair(second: dict[str, Any], first: dict[str, Any] | None = None, type_name: str = "u16") -> tuple[Point, Point]:
    """Two points that differ in little more than their words."""
    return point("one", 1, type_name, **(first or {})), point("two", 3, type_name, **second)


PAIRS = {
    "number": pair({"type": "s16", "width": 16, "allowed": allowed((0, 9))}, {"allowed": allowed((0, 9))}),
    "terms": pair({"space": "input"}),
    "form": pair({"allowed": allowed((0, 65534))}),
    "first_names": pair({"enum": MODES}, {"enum": MODES}),
    "first_codes": pair({"specials": FAULT, "specials_of": "u16"}, {"specials": FAULT, "specials_of": "u16"}),
    "widths": (point("one", 1), point(LONG, 3)),
    "order": pair({"order": (4, 3)}, type_name="u32"),
    "references": (point("one", 1), replace(point("two", 3), place=Place((3,), {"manual": 4}))),
    "index": pair({"index": 2}),
    "errata": pair({"errata": ("E1",)}),
}
BITS = {"width": 4, "allowed": allowed((0, 9))}
TERMS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "space": ({}, {"space": "input"}),
    "bits": ({**BITS, "bits": (3, 0)}, {**BITS, "bits": (7, 4)}),
    "steps": (
        {"unit": HERTZ, "scale": scaled(10), "decimals": 1},
        {"unit": HERTZ, "scale": scaled(10), "decimals": 1, "steps": ((0, 5),)},
    ),
    "when": ({}, {"when": Condition(((Comparison("voltage_class", "==", ("200V",)),),))}),
    "telegram": ({}, {"telegram": "fast"}),
}
"""Facts of a first and a second point that differ in a part of their terms."""
SAID = ("space", "shown", "bits", "steps", "keeps", "when", "telegram", "untyped")
"""The parts of what terms say in C, in their order."""
PARTS = ("number", "terms", "form", "first_names", "first_codes", "widths", "order", "references", "index", "errata")
"""The parts of a key, in its order."""


class Cut(dict[Any, Any]):
    """Kinds whose keys lack a part; without a part to leave out it forgets every kind."""

    def __init__(self, part: int | None) -> None:
        super().__init__()
        self.part = part

    def get(self, key: Any, default: Any = None) -> Any:
        """The kind with the rest of the key."""
        return default if self.part is None else super().get((*key[: self.part], *key[self.part + 1 :]), default)

    def __setitem__(self, key: Any, kind: Any) -> None:
        if self.part is not None:
            super().__setitem__((*key[: self.part], *key[self.part + 1 :]), kind)


def cut(monkeypatch: pytest.MonkeyPatch, part: int | None) -> None:
    """Leave out a part of every key from now on."""

    class Cutting(kinds.Kinds):
        def __init__(self, scope: HeaderScope) -> None:
            super().__init__(scope)
            self._kinds = Cut(part)

    monkeypatch.setattr(kinds, "Kinds", Cutting)


def texts(device: Device) -> dict[str, str]:
    """The generated files."""
    return dict(c.outputs(device, render))


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.parent.name)
def test_sharing_changes_no_text(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    device = for_code(loaded(file))
    shared = texts(device)
    names = list(c.identifiers(device))
    cut(monkeypatch, None)
    assert texts(device) == shared
    assert list(c.identifiers(device)) == names


@pytest.mark.parametrize("part", PARTS)
def test_every_part_of_a_key_decides(part: str, monkeypatch: pytest.MonkeyPatch) -> None:
    device = for_code(device_of("pair", PAIRS[part], errata=(OFF,)))
    right = texts(device)
    with monkeypatch.context() as patch:
        cut(patch, None)
        assert texts(device) == right
    cut(monkeypatch, PARTS.index(part))
    assert texts(device) != right


def test_a_key_has_the_parts_that_are_tested(monkeypatch: pytest.MonkeyPatch) -> None:
    device = for_code(device_of("pair", PAIRS["terms"]))
    sorted_points = kinds.Kinds(scope_of(device))
    for each in device.points:
        sorted_points.placed(each)
    keys: Any = sorted_points._kinds
    assert {len(key) for key in keys} == {len(PARTS)}


LIMITS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "all of the type": ({"allowed": allowed((0, 65534))}, {"allowed": allowed((0, 65535))}),
    "several intervals": ({"allowed": allowed((0, 40))}, {"allowed": allowed((0, 9), (20, 40))}),
    "the way from a count to its raw number": (
        {"scale": scaled("3/7"), "decimals": 1, "allowed": allowed((0, 7300))},
        {"scale": scaled("3/7"), "decimals": 1, "allowed": allowed((0, 8000))},
    ),
    "that of what is only read": (
        {"scale": scaled("3/7"), "decimals": 1, "allowed": allowed((0, 7300)), "access": "r"},
        {"scale": scaled("3/7"), "decimals": 1, "allowed": allowed((0, 8000)), "access": "r"},
    ),
    "counts of their own": (
        {"scale": scaled(1), "decimals": 0, "allowed": allowed((10, 40))},
        {"scale": scaled(1), "decimals": 0, "allowed": allowed((10, 99))},
    ),
    "digits": ({"allowed": allowed((0, 99))}, {"allowed": allowed((0, 100))}),
    "units": ({"unit": HERTZ, "allowed": allowed((0, 10))}, {"unit": CELSIUS, "allowed": allowed((0, 10))}),
    "codes": ({"specials": FAULT, "allowed": allowed((0, 9))}, {"specials": FAULT, "allowed": allowed((0, 65535))}),
}
"""Facts of points of one type whose limits differ, by what the difference is."""


@pytest.mark.parametrize("differs", LIMITS)
@pytest.mark.parametrize("type_name", ["u16", "s32"])
def test_points_with_other_limits_read_as_each_would_alone(
    differs: str, type_name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    first, second = LIMITS[differs]
    points = (point("one", 1, type_name, **first), point("two", 3, type_name, **second))
    device = for_code(device_of("pair", points))
    shared = texts(device)
    cut(monkeypatch, None)
    assert texts(device) == shared


@pytest.mark.parametrize("names", [("zero", "mode", "made"), ("mode", "zero", "made"), ("zero", "made", "mode")])
def test_an_enum_of_its_own_is_told_from_that_of_another_point(
    names: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whichever comes first: what is named after the point itself moves with its name."""
    points = tuple(point(name, at, enum=MODES) for at, name in enumerate(names))
    device = for_code(device_of("pair", points))
    shared = texts(device)
    cut(monkeypatch, None)
    assert texts(device) == shared


@pytest.mark.parametrize(
    ("line", "parts"),
    [
        ("a" * 100 + " " + "b" * 19, ["a" * 100 + " " + "b" * 19]),
        ("a" * 100 + " " + "b" * 20, ["a" * 100, "    " + "b" * 20]),
        ("  return " + "a" * 90 + " " + "b" * 30, ["  return " + "a" * 90, "      " + "b" * 30]),
        ("#define A " + "a" * 80 + " " + "b" * 40, ["#define A " + "a" * 80 + " \\", "    " + "b" * 40]),
        ("#define A " + "a" * 107 + " bb", ["#define A " + "a" * 107 + " bb"]),
        ("#define A " + "a" * 108 + " bb", ["#define A " + "a" * 108 + " \\", "    bb"]),
        ('x = "' + "a b " * 30 + '" + 1;', ["x =", '    "' + "a b " * 30 + '" + 1;']),
    ],
)
def test_a_long_line_is_folded_and_a_macro_goes_on_behind_a_backslash(line: str, parts: list[str]) -> None:
    """At the last space up to 120 characters that is in no string."""
    assert folded(line).split("\n") == parts


@pytest.mark.parametrize(
    ("type_name", "facts", "limits"),
    [
        ("u64", {}, (0, 2**64 - 1)),
        ("u64", {"specials": FAULT}, (0, 2**64 - 1)),
        ("u64", {"specials": FAULT, "scale": scaled(10), "decimals": 1}, (0, 2**63 - 1)),
        ("u16", {"specials": FAULT, "allowed": allowed((5, 9))}, (5, 65535)),
        ("s16", {"specials": (Special(-9, -8, "lost", titles("Lost"), True),), "allowed": allowed((5, 9))}, (-9, 9)),
    ],
)
def test_values_are_checked_between_limits_and_special_codes(
    type_name: str, facts: dict[str, Any], limits: tuple[int, int]
) -> None:
    """Values that are computed have signed 64 bits; plain ones all of their type."""
    assert encoded_limits(point("one", 1, type_name, **facts)) == limits


class CutTerms(dict[Any, Any]):
    """Numbers of terms of which a part is left out."""

    def __init__(self, part: int) -> None:
        super().__init__()
        self.part = part

    def setdefault(self, said: Any, default: Any = None) -> Any:
        """The number of terms that say the rest."""
        return super().setdefault((*said[: self.part], *said[self.part + 1 :]), default)


@pytest.mark.parametrize("part", TERMS)
def test_every_part_of_the_terms_decides(part: str, monkeypatch: pytest.MonkeyPatch) -> None:
    first, second = TERMS[part]
    device = for_code(device_of("pair", pair(second, first)))
    right = texts(device)

    class Cutting(kinds.Kinds):
        def __init__(self, scope: HeaderScope) -> None:
            super().__init__(scope)
            self._said = CutTerms(SAID.index(part))

    monkeypatch.setattr(kinds, "Kinds", Cutting)
    assert texts(device) != right
