"""What is said alike of many points is worded once; each point worded by itself reads the same."""

from __future__ import annotations

from dataclasses import replace
from itertools import count
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.model import Place
from fieldscribe.render import render
from fieldscribe.targets.docs import outputs, points, subjects
from support.described import DEVICES, made, shipped
from support.models import point, sample_device
from support.places import ROOT

if TYPE_CHECKING:
    from fieldscribe.model import Device, Point


def _nearly_alike() -> Device:
    """Points that share all but a single fact."""
    first, bare = point("first", 1), point("bare", 5, untyped="", generated=False)
    read_only = replace(first, name="read_only", shape=replace(first.shape, access="r"))
    lost = replace(first, name="lost", terms=replace(first.terms, keeps="no"))
    return sample_device((first, read_only, lost, bare, replace(bare, name="longer", place=Place((6, 7, 8), {}))))


ALL = [
    _nearly_alike(),
    *(made(path.parent.name) for path in sorted(DEVICES.glob("kitchen_*/device.yaml"))),
    *(shipped(path.parent.name) for path in sorted((ROOT / "descriptions").glob("*/device.yaml"))),
]


@pytest.mark.parametrize("device", ALL, ids=lambda device: device.id)
def test_each_point_by_itself_reads_the_same(device: Device, monkeypatch: pytest.MonkeyPatch) -> None:
    together = list(outputs(device, render))
    numbers = count()
    monkeypatch.setattr(subjects, "kin_of", lambda point, shape: next(numbers))
    assert list(outputs(device, render)) == together
    assert next(numbers) == len(device.points)


@pytest.mark.parametrize("part", range(3), ids=["shape", "terms", "addresses"])
def test_a_forgotten_part_of_the_kin_is_seen(part: int, monkeypatch: pytest.MonkeyPatch) -> None:
    sound = {device.id: list(outputs(device, render)) for device in ALL}
    whole: Any = subjects.kin_of

    def forgetful(point: Point, shape: object) -> tuple[object, ...]:
        key = whole(point, shape)
        return (*key[:part], *key[part + 1 :])

    monkeypatch.setattr(subjects, "kin_of", forgetful)
    assert any(list(outputs(device, render)) != sound[device.id] for device in ALL)


def test_limits_are_no_part_of_the_kin(monkeypatch: pytest.MonkeyPatch) -> None:
    sound = {device.id: list(outputs(device, render)) for device in ALL}
    monkeypatch.setattr(subjects, "limits_of", lambda point, kin: kin)
    assert any(list(outputs(device, render)) != sound[device.id] for device in ALL)


def test_the_form_of_remarks_is_needed(monkeypatch: pytest.MonkeyPatch) -> None:
    sound = {device.id: list(outputs(device, render)) for device in ALL}
    monkeypatch.setattr(points, "form_of", lambda own: ())
    assert any(list(outputs(device, render)) != sound[device.id] for device in ALL)
