"""Texts of Python that are laid out once for all points that are alike are those that each would have alone."""

from __future__ import annotations

from dataclasses import replace
from functools import cache, partial
from typing import TYPE_CHECKING

import pytest
from fieldscribe.code_view import for_code
from fieldscribe.model import Place
from fieldscribe.render import render
from fieldscribe.targets import python
from fieldscribe.targets.python import attributes, enums, words
from fieldscribe.targets.python.words import likeness
from support.described import made, shipped
from support.models import changed, sample_device, trip_device

if TYPE_CHECKING:
    from collections.abc import Callable

    from fieldscribe.model import Device

SHIPPED = ("hitachi_l200", "jumo_controller", "nord_sk5xxe", "siemens_mm4", "woodward_mpu2s")
MADE = ("kitchen_sink", "kitchen_codes", "kitchen_can", "kitchen_uss", "odd_names")
DEVICES: dict[str, Callable[[], Device]] = {
    **{name: partial(shipped, name) for name in SHIPPED},
    **{name: partial(made, name) for name in MADE},
    "sample": sample_device,
    "trips": trip_device,
}


def numbered_device() -> Device:
    """Points that differ in nothing but the name of a numbering."""
    device = sample_device()
    first, *_ = device.points
    named = [changed(first, name=name, place=Place((7,), {name: 7}), generated=True) for name in ("one", "two")]
    return replace(device, points=(*device.points, *named))


DEVICES["numbered"] = numbered_device
PARTS = {
    0: "shape",
    1: "terms",
    2: "form of limits",
    4: "references",
    5: "where it is written",
    6: "variant",
    7: "old names",
    8: "has a code",
    9: "has a default",
    10: "widths",
}
"""What the likeness of points consists of; the number of addresses (3) mostly follows from the widths."""


@cache
def plain(name: str) -> Device:
    return for_code(DEVICES[name]())


def texts(device: Device) -> dict[str, str]:
    return dict(python.outputs(device, render))


@pytest.mark.parametrize("name", DEVICES)
def test_points_that_are_alike_share_a_layout(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    shared = texts(plain(name))
    monkeypatch.setattr(attributes, "likeness", lambda *_: object())
    monkeypatch.setattr(words, "blanks", tuple)
    assert texts(plain(name)) == shared


@pytest.mark.parametrize("name", DEVICES)
def test_enums_that_are_alike_share_a_layout(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    shared = texts(plain(name))
    monkeypatch.setattr(enums, "id", lambda _: object(), raising=False)
    monkeypatch.setattr(enums, "blanks", tuple)
    assert texts(plain(name)) == shared


@pytest.mark.parametrize("part", PARTS, ids=PARTS.values())
def test_a_likeness_without_one_of_its_parts_is_noticed(part: int, monkeypatch: pytest.MonkeyPatch) -> None:
    def poorer(*facts: object) -> tuple[object, ...]:
        parts = likeness(*facts)  # type: ignore[arg-type]  # whatever it takes
        return (*parts[:part], *parts[part + 1 :])

    shared = [texts(plain(name)) for name in DEVICES]
    monkeypatch.setattr(attributes, "likeness", poorer)
    with pytest.raises((AssertionError, ValueError, IndexError)):
        assert [texts(plain(name)) for name in DEVICES] == shared
