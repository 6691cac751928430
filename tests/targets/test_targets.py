"""The registry of targets."""

from __future__ import annotations

import re

import pytest
from fieldscribe.pipeline import outputs
from fieldscribe.targets import TARGETS, knows, target
from support.described import SHIPPED, shipped
from support.models import sample_device
from support.quick import full_but


def test_targets_are_written_in_the_order_that_help_names() -> None:
    """In such an order that two processes can share a large run: each gets a part that takes about as long."""
    known = ["c", "python", "rust", "vectors", "typescript", "docs"]
    assert [name for name in TARGETS if name in known] == known
    assert [name for name in TARGETS if target(name).SEES_TITLES] == ["docs"]


@pytest.mark.parametrize("name", TARGETS)
def test_every_target_knows_a_modbus_device(name: str) -> None:
    assert knows(name, sample_device())


def squeezed(text: str) -> str:
    """Return the letters and digits of a text, without its tags."""
    return re.sub(r"<.*?>|[\W_]", "", text)


@pytest.mark.parametrize("name", ["c", "python", "rust", "typescript", "docs"])
@pytest.mark.parametrize("device_id", full_but(("hitachi_l200",), SHIPPED))
def test_what_the_manual_leaves_open_stands_at_its_points(device_id: str, name: str) -> None:
    """What is about no point stands at the head of the device; code has nothing else of errata but their ids."""
    device = shipped(device_id)
    text = squeezed("".join(text for _, _, text in outputs(device, [name])))
    for erratum in device.errata:
        points = [
            one
            for one in device.points
            if one.name in erratum.points and (one.generated or name not in ("python", "typescript"))
        ]
        doubts = squeezed(", ".join(f"{said} ({erratum.id})" for _, said in erratum.leaves_open))
        times, most = len(points) if erratum.points else name != "docs", text.count(doubts) if doubts else 0
        assert (times if doubts else 0) == most or (name == "docs" and most > times), erratum.id
        assert name == "docs" or squeezed(erratum.why) not in text
