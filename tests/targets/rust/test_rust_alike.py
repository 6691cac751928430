"""Texts of Rust that are laid out once for all that are alike are those that each would have alone."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.code_view import for_code
from fieldscribe.conditions import Comparison, Condition
from fieldscribe.model import Limit, Place, Variant
from fieldscribe.render import render
from fieldscribe.targets.rust import conformance, identity, points, subjects
from fieldscribe.targets.rust.conformance import conformance_tables
from fieldscribe.targets.rust.points import point_texts
from fieldscribe.targets.rust.subjects import scope_of
from fieldscribe.targets.rust.words import enum_texts, word_texts
from support.described import made, shipped
from support.models import HERTZ, allowed, changed, linear, point, sample_device, scaled, trip_device, units, value_of
from support.rust_crates import can_device, odd_device, rare_device, uss_device

if TYPE_CHECKING:
    from collections.abc import Callable

    from fieldscribe.model import Device
    from fieldscribe.targets.rust.subjects import CrateScope

SHIPPED = ("hitachi_l200", "jumo_controller", "nord_sk5xxe", "siemens_mm4", "woodward_mpu2s")
MADE = ("kitchen_sink", "kitchen_codes", "kitchen_can", "kitchen_uss", "odd_names")
DEVICES: dict[str, Callable[[], Device]] = {
    **{name: partial(shipped, name) for name in SHIPPED},
    **{name: partial(made, name) for name in MADE},
    "sample": sample_device,
    "trips": trip_device,
    "rare": rare_device,
    "odd": odd_device,
    "odd_can": can_device,
    "odd_uss": uss_device,
}
Texts = tuple[tuple[str, bool], str, list[tuple[str, str]]]


def texts(device: Device, scope: CrateScope) -> Texts:
    """All texts of a crate that are laid out once for all that are alike."""
    rows = [(table.name, table.text) for table in conformance_tables(scope, device)]
    return point_texts(scope, render), "".join(word_texts(scope, render)), rows


def alone(device: Device, monkeypatch: pytest.MonkeyPatch) -> Texts:
    """The same with a layout for each point, of its own words instead of blanks."""
    scope = scope_of(device)
    own = tuple(subject._replace(kin=number) for number, subject in enumerate(scope.subjects))
    with monkeypatch.context() as patch:
        patch.setattr(identity, "blanks", lambda words: words)
        patch.setattr(points, "_STEP", 1)
        return texts(device, replace(scope, subjects=own))


@pytest.mark.parametrize("name", DEVICES)
def test_points_that_are_alike_share_a_layout(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    device = for_code(DEVICES[name]())
    assert texts(device, scope_of(device)) == alone(device, monkeypatch)


@pytest.mark.parametrize("name", DEVICES)
def test_enums_that_are_alike_share_a_layout(name: str) -> None:
    device = for_code(DEVICES[name]())
    scope = scope_of(device)
    each = [enum_texts(replace(device, enums=(enum,)), scope, render) for enum in device.enums]
    assert enum_texts(device, scope, render) == ("".join(text for text, _ in each), any(long for _, long in each))


LOWEST = Limit(linear(1, 0, value_of("other")), (), 0, 4000)
KINS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "shape": ({}, {"access": "r"}),
    "arguments": ({"allowed": allowed((0, 9))}, {"allowed": allowed((LOWEST, 9))}),
    "space": ({}, {"space": "input"}),
    "unit": ({}, {"unit": HERTZ}),
    "bits": ({"type": "u8", "bits": (7, 0)}, {"type": "u8", "bits": (15, 8)}),
    "steps": ({"scale": scaled(10)}, {"scale": scaled(10), "steps": ((1, 2),)}),
    "telegram": ({}, {"telegram": "actual"}),
    "index": ({}, {"index": 3}),
    "references": ({}, {"references": {"wire": 1}}),
    "write_place": ({}, {"write_place": Place((7,), {})}),
    "variant": ({}, {"variant": Variant("voltage_class", "200V")}),
    "when": ({}, {"when": Condition(((Comparison("other", ">", (3,)),),))}),
    "errata": ({}, {"errata": ("a020_wire",)}),
    "keeps": ({}, {"keeps": "no"}),
    "was": ({"was": ("former",)}, {"was": ("earlier",), "name": "third"}),
    "name": ({"name": "none"}, {"name": "some"}),
}
"""For each fact that makes a kin two points that differ in it alone, in the order of the key."""


def of_kin(fact: str, pair: tuple[dict[str, Any], dict[str, Any]]) -> Device:
    """A device with two points that differ in this."""
    first, second = (changed(point(name, 1), **facts) for name, facts in zip(("first", "second"), pair, strict=True))
    three = first, second, point("other", 9)
    return replace(uss_device(), points=three) if fact == "keeps" else sample_device(three)


def without(part: int, key: Callable[..., tuple[object, ...]], *facts: object) -> tuple[object, ...]:
    """A key that lacks one of its parts."""
    whole = key(*facts)
    return (*whole[:part], *whole[part + 1 :])


@pytest.mark.full(seconds=6)
@pytest.mark.parametrize("fact", KINS)
def test_each_fact_of_a_kin_is_needed(fact: str, monkeypatch: pytest.MonkeyPatch) -> None:
    device = of_kin(fact, KINS[fact])
    right = texts(device, scope_of(device))
    assert right == alone(device, monkeypatch)
    monkeypatch.setattr(subjects, "_kin", partial(without, list(KINS).index(fact), subjects._kin))
    assert texts(device, scope_of(device)) != right


def test_every_fact_of_a_kin_has_its_points() -> None:
    (subject, *_) = scope_of(sample_device()).subjects
    assert len(subjects._kin(subject.point, subject.shape, subject.name, subject.arguments)) == len(KINS)


LAYOUT: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "title": ({"name": "a_" * 60 + "b"}, {"name": "b" * 121}),
    "name": ({"was": ("former",)}, {"was": ("former",), "name": "c" * 99}),
    "code": ({}, {"code": "?"}),
    "alias": ({"code": "A1"}, {"code": "A?"}),
    "span": ({"type": "bit", "allowed": allowed()}, {"type": "bit", "allowed": allowed((0, 1))}),
    "limits": ({"allowed": allowed((0, 65535))}, {"allowed": allowed((0, 65534))}),
}
"""The same for each part of a layout, in the order of the key."""

WIDTHS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "code": ({"code": "A1"}, {"code": "A12345678"}),
    "span": ({"allowed": allowed((0, 1))}, {"allowed": allowed((0, 10000))}),
    "hexadecimal": ({"place": Place((10000,), {})}, {"place": Place((99999,), {})}),
    "decimal": ({"place": Place((1,), {})}, {"place": Place((1000,), {})}),
    "index": ({"index": 1}, {"index": 1000}),
}
"""The same for the widths of words in a doc comment of several lines."""


def of_layout(first: dict[str, Any], second: dict[str, Any]) -> Device:
    """A device with two such points for each place where a line may be broken."""
    pairs = []
    for width in range(1, 60):
        when = Condition(((Comparison("w" * width, ">", (3,)),),))
        pairs.append(changed(point("first", 1), when=when, **first))
        pairs.append(changed(point("second", 1), when=when, **second))
    return sample_device(tuple(pairs))


@pytest.mark.full(seconds=10)
@pytest.mark.parametrize(
    ("key", "facts", "fact"),
    [
        *(("layout_of", LAYOUT, fact) for fact in LAYOUT),
        *(("widths_of", WIDTHS, fact) for fact in WIDTHS),
    ],
)
def test_each_part_of_a_layout_is_needed(
    key: str, facts: dict[str, tuple[dict[str, Any], dict[str, Any]]], fact: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    device = of_layout(*facts[fact])
    right = texts(device, scope_of(device))
    assert right == alone(device, monkeypatch)
    monkeypatch.setattr(points, key, partial(without, list(facts).index(fact), getattr(points, key)))
    assert texts(device, scope_of(device)) != right


ROWS = ("shape", "arguments", "unit", "bits", "telegram", "index", "references", "write_place", "keeps", "name")


@pytest.mark.parametrize("fact", ROWS)
def test_each_fact_about_rows_is_needed(fact: str, monkeypatch: pytest.MonkeyPatch) -> None:
    device = of_kin(fact, ({}, {"bits": (15, 0)}) if fact == "bits" else KINS[fact])
    right = texts(device, scope_of(device))
    assert right == alone(device, monkeypatch)
    monkeypatch.setattr(conformance, "_kind", partial(without, ROWS.index(fact), conformance._kind))
    assert texts(device, scope_of(device)) != right


def test_limits_that_are_no_single_range_are_needed(monkeypatch: pytest.MonkeyPatch) -> None:
    device = sample_device(
        (point("first", 1, "f32", allowed=units(0, 9)), point("second", 3, "f32", allowed=units(0, 8)))
    )
    right = texts(device, scope_of(device))
    assert right == alone(device, monkeypatch)
    assert right[0][0].count("ranges [") == 2
    monkeypatch.setattr(identity, "_form", lambda _: None)
    assert texts(device, scope_of(device)) != right
