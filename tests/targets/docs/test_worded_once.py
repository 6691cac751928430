"""What is said alike of many points is worded once; each point worded by itself reads the same."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.render import render
from fieldscribe.targets.docs import alike, outputs
from fieldscribe.targets.docs.alike import Alike
from support.described import DEVICES, made, shipped
from support.models import point, sample_device
from support.places import ROOT

if TYPE_CHECKING:
    from fieldscribe.model import Device, Point


def twins() -> Device:
    """Two points that differ in their shape alone."""
    first = point("first", 10)
    return sample_device((first, replace(first, name="second", shape=replace(first.shape, access="r"))))


ALL = [
    twins(),
    *(made(path.parent.name) for path in sorted(DEVICES.glob("kitchen_*/device.yaml"))),
    *(shipped(path.parent.name) for path in sorted((ROOT / "descriptions").glob("*/device.yaml"))),
]


@pytest.mark.parametrize("device", ALL, ids=lambda device: device.id)
def test_each_point_by_itself_reads_the_same(device: Device, monkeypatch: pytest.MonkeyPatch) -> None:
    together = list(outputs(device, render))
    monkeypatch.setattr(Alike, "of", lambda self, subject: self._word(subject))
    assert list(outputs(device, render)) == together


@pytest.mark.parametrize("part", range(3), ids=["shape", "terms", "limits"])
def test_a_forgotten_part_of_the_key_is_seen(part: int, monkeypatch: pytest.MonkeyPatch) -> None:
    sound = {device.id: list(outputs(device, render)) for device in ALL}
    whole: Any = alike._key

    def forgetful(subject: Point) -> tuple[object, ...]:
        key = whole(subject)
        return (*key[:part], *key[part + 1 :])

    monkeypatch.setattr(alike, "_key", forgetful)
    assert any(list(outputs(device, render)) != sound[device.id] for device in ALL)
