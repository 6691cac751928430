"""What is said alike of many points is worded once; each point worded by itself reads the same."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.render import render
from fieldscribe.targets.docs import alike, outputs
from fieldscribe.targets.docs.alike import Alike
from support.described import DEVICES, made, shipped
from support.places import ROOT

if TYPE_CHECKING:
    from fieldscribe.model import Device, Point

ALL = [
    *(made(path.parent.name) for path in sorted(DEVICES.glob("kitchen_*/device.yaml"))),
    *(shipped(path.parent.name) for path in sorted((ROOT / "descriptions").glob("*/device.yaml"))),
]


@pytest.mark.parametrize("device", ALL, ids=lambda device: device.id)
def test_each_point_by_itself_reads_the_same(device: Device, monkeypatch: pytest.MonkeyPatch) -> None:
    together = list(outputs(device, render))
    monkeypatch.setattr(Alike, "of", lambda self, point: self._word(point))
    assert list(outputs(device, render)) == together


@pytest.mark.parametrize("part", range(3), ids=["shape", "allowed", "unit"])
def test_a_forgotten_part_of_the_key_is_seen(part: int, monkeypatch: pytest.MonkeyPatch) -> None:
    sound = {device.id: list(outputs(device, render)) for device in ALL}
    whole: Any = alike._key

    def forgetful(point: Point) -> tuple[object, ...]:
        key = whole(point)
        return (*key[:part], *key[part + 1 :])

    monkeypatch.setattr(alike, "_key", forgetful)
    assert any(list(outputs(device, render)) != sound[device.id] for device in ALL)
