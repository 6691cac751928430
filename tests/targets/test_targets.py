"""The registry of targets."""

from __future__ import annotations

import pytest
from fieldscribe.targets import TARGETS, knows, target
from support.models import sample_device


def test_targets_are_written_in_the_order_that_help_names() -> None:
    """Code first, in the order of its users, then what is made of the same facts for people and for tests."""
    assert TARGETS == ("c", "python", "rust", "docs", "vectors")
    assert [name for name in TARGETS if target(name).SEES_TITLES] == ["docs"]


@pytest.mark.parametrize("name", TARGETS)
def test_every_target_knows_a_modbus_device(name: str) -> None:
    assert knows(name, sample_device())
