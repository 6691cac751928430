"""How much the audit reports: a sample of `make audit-power`, and new editions with many changes at once."""

from __future__ import annotations

import os
from pathlib import Path
from random import Random

import pytest
from audit_power.editions import edition
from audit_power.measure import measure, sound
from fieldscribe.resources import descriptions_dir

DEVICES = sorted(path.parent.name for path in descriptions_dir().glob("*/device.yaml"))
SAMPLE = 10


@pytest.fixture(name="manuals")
def _manuals() -> Path:
    manuals = os.environ.get("FIELDSCRIBE_MANUALS")
    if not manuals:
        pytest.skip("set FIELDSCRIBE_MANUALS to the folder with the manuals' texts")
    return Path(manuals)


@pytest.mark.full(seconds=60)
def test_nearly_all_changed_facts_are_reported(manuals: Path) -> None:
    missed = [change for device in DEVICES for change in measure(device, manuals, 7, SAMPLE).missed]
    assert len(missed) <= 1, missed


@pytest.mark.full(seconds=5)
@pytest.mark.parametrize("device", ["hitachi_l200", "woodward_mpu2s"])
def test_findings_of_a_new_edition_tell_of_its_changes(device: str, manuals: Path) -> None:
    read = sound(device, manuals)
    new = edition(read, Random(device))
    outcome = read.audited(new.text)
    findings = len(outcome.missing) + len(outcome.unused) + len(outcome.unprinted) + len(outcome.added)
    assert len(new.changes) == 14
    assert findings >= 14
    assert len(new.noise(outcome)) * 20 <= findings, new.noise(outcome)
