"""The measurement of one manual."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from functools import cache
from random import Random
from typing import TYPE_CHECKING

from fieldscribe.audit import Audit, Auditor
from fieldscribe.audit.comparison import Comparison
from fieldscribe.audit.layout import Fingerprint
from fieldscribe.audit.manual import Manual
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_analysis
from fieldscribe.resources import descriptions_dir

from audit_power.changes import Change, Changes

if TYPE_CHECKING:
    from pathlib import Path


@dataclass(slots=True)
class Power:
    """How many claims there are, how many were changed, and which changes the audit did not report."""

    claims: int
    changed: int = 0
    kinds: Counter[str] = field(default_factory=Counter)
    missed: list[Change] = field(default_factory=list)

    @property
    def reported(self) -> int:
        """How many changes the audit reported."""
        return self.changed - len(self.missed)


class Sound:
    """A device with the text that it was transcribed from, audited once."""

    def __init__(self, device: str, manuals: Path) -> None:
        subject = load_analysis(descriptions_dir() / device / "device.yaml", Report())
        assert subject is not None, device
        file = next(document.file for document in subject.scope.documents.values() if document.file)
        self.device = device
        self.auditor = Auditor(subject)
        text = (manuals / file).read_text("utf-8")
        self.fingerprint = Fingerprint.of(text, "")
        self.manual = Manual(text, self.auditor.names)
        self.comparison = Comparison(self.manual, self.auditor, Audit(device, file, True, len(self.manual)))
        self.outcome = self.comparison.run()

    def changes(self, random: Random) -> Changes:
        """What can be changed in the text."""
        return Changes(self.comparison, random)

    def audited(self, text: str) -> Audit:
        """Another text against the same description."""
        return self.auditor.audit("", text, same_text=False, kept=self.fingerprint)


@cache
def sound(device: str, manuals: Path) -> Sound:
    """A device, read once."""
    return Sound(device, manuals)


def measure(device: str, manuals: Path, seed: int, count: int) -> Power:
    """Changes so many claims of a device, each in a text of its own."""
    read = sound(device, manuals)
    assert read.outcome.clean, device
    claims = [claim for claim in read.auditor.claims if not claim.optional]
    random = Random(f"{seed} {device}")
    changes = read.changes(random)
    power = Power(len(claims))
    for claim in random.sample(claims, len(claims)):
        change = changes.of(claim) if power.changed < count else None
        if change is None:
            continue
        power.changed += 1
        power.kinds[change.kind] += 1
        if read.audited(change.text(read.manual.lines)).clean:
            power.missed.append(change)
    return power
