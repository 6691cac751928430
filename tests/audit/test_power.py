"""How much the audit reports: a sample of `make audit-power`."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from audit_power.measure import measure
from support.described import SHIPPED
from support.places import has_text

SAMPLE = 3


@pytest.mark.full(seconds=14)
def test_nearly_all_changed_facts_are_reported_and_all_are_listed() -> None:
    manuals = os.environ.get("FIELDSCRIBE_MANUALS")
    if not manuals:
        pytest.skip("set FIELDSCRIBE_MANUALS to the folder with the manuals' texts")
    powers = [measure(device, Path(manuals), 7, SAMPLE) for device in SHIPPED if has_text(device, Path(manuals))]
    assert [change for power in powers for change in power.unlisted] == []
    assert len([change for power in powers for change in power.missed]) <= 2
    assert len([change for power in powers for change in power.without_fact]) <= 1
