"""Hundreds of reads of a simulated drive with faults of all kinds; `make fuzz` makes 200,000."""

from __future__ import annotations

import pytest
from fieldscribe.simulation.line import KINDS
from fuzz.soak_simulated import soak


@pytest.mark.full(seconds=4)
def test_each_read_ends_as_its_fault_explains() -> None:
    outcome = soak(400, 0.06, 2, timeout=0.4)
    assert outcome.findings == []
    assert {fault for fault, _ in outcome.ends} == {"", *KINDS}
