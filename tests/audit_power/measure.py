"""The measurement of one manual."""

from __future__ import annotations

from collections import Counter
from random import Random
from typing import TYPE_CHECKING

from audit_power.changes import Change, Changes
from fieldscribe.audit import Audit, Auditor
from fieldscribe.audit.comparison import Comparison
from fieldscribe.audit.manual import Manual
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_subject
from fieldscribe.records import dataclass, field
from fieldscribe.resources import descriptions_dir

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


def measure(device: str, manuals: Path, seed: int, count: int) -> Power:
    """Changes so many claims of a device, each in a text of its own."""
    report = Report()
    subject = load_subject(descriptions_dir() / device / "device.yaml", report)
    assert subject is not None, device
    text = next((manuals / document.file for document in subject.scope.documents.values() if document.file)).read_text(
        "utf-8"
    )
    auditor = Auditor(subject)
    manual = Manual(text, auditor.names)
    sound = Comparison(manual, auditor, Audit(device, "", True, len(manual)))
    assert sound.run().clean, device
    claims = [claim for claim in auditor.claims if not claim.optional]
    random = Random(f"{seed} {device}")
    changes = Changes(sound, random)
    power = Power(len(claims))
    for claim in random.sample(claims, len(claims)):
        change = changes.of(claim) if power.changed < count else None
        if change is None:
            continue
        power.changed += 1
        power.kinds[change.kind] += 1
        if auditor.audit(device, "", change.text(manual.lines), same_text=False).clean:
            power.missed.append(change)
    return power
