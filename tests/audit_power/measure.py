"""The measurement of one manual: how many changed facts the audit reports, and `--old` shows with what cites them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

from fieldscribe.audit import Citations, Editions, audit
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_analysis
from fieldscribe.resources import descriptions_dir

from audit_power.changes import Change, change_of
from audit_power.facts import CitedFact, facts_of

_FACTS_OF_KEY = {"at": ("address", "printed", "code", "number"), "range_in_units": ("range",)}
"""The names that reports have for facts whose key in the YAML is another."""


@dataclass(slots=True)
class Power:
    """The changes that were tried, those that the plain audit missed, and those that `--old` did not list in full."""

    facts: int
    changes: list[Change]
    missed: list[Change] = field(default_factory=list)
    unlisted: list[Change] = field(default_factory=list)
    without_fact: list[Change] = field(default_factory=list)

    def share(self, failed: list[Change]) -> float:
        """Return the share of changes that did not fail."""
        return 1 - len(failed) / max(1, len(self.changes))

    def kinds(self, failed: list[Change]) -> Counter[str]:
        """Count failed changes by kind and key."""
        return Counter(f"{change.fact.kind} of {change.fact.key}" for change in failed)


class Reading:
    """A description with the text that it was transcribed from."""

    def __init__(self, device: str, manuals: Path) -> None:
        subject = load_analysis(descriptions_dir() / device / "device.yaml", Report())
        assert subject is not None, device
        file = next(document.file for document in subject.scope.documents.values() if document.file)
        self.text = (manuals / file).read_text("utf-8")
        self.lines = self.text.splitlines()
        self.facts: list[CitedFact] = facts_of(subject)
        self.citations = Citations(subject)

    def changes(self, random: Random) -> Iterator[Change]:
        """Yield one change of each fact that the manual prints as the YAML has it, in any order."""
        for fact in random.sample(self.facts, len(self.facts)):
            change = change_of(fact, self.lines, random)
            if change is not None:
                yield change

    def is_reported(self, text: str) -> bool:
        """Return True if the plain audit of a text has a finding."""
        return not audit(self.citations, "", text, same_text=False).is_clean


def measure(device: str, manuals: Path, seed: int, count: int) -> Power:
    """Change up to so many facts of a device, each in a text of its own."""
    reading = Reading(device, manuals)
    assert not reading.is_reported(reading.text), device
    changes = [change for _, change in zip(range(count), reading.changes(Random(f"{seed} {device}")), strict=False)]
    power = Power(len(reading.facts), changes)
    for change in changes:
        text = change.applied(reading.lines)
        if not reading.is_reported(text):
            power.missed.append(change)
        outcome = Editions(reading.citations, reading.text, text).compare("", "")
        listed = [line for line in outcome.lines if change.line in (line.old_line, line.new_line)]
        if not listed:
            power.unlisted.append(change)
        elif not any(_is_about(change.fact, fact.subject, fact.fact) for line in listed for fact in line.facts):
            power.without_fact.append(change)
    return power


def _is_about(wanted: CitedFact, subject: str, fact: str) -> bool:
    """An address may be claimed as the number of a code, or in one of the manual's numberings."""
    names = _FACTS_OF_KEY.get(wanted.key, (wanted.key.removesuffix("s"),))
    return subject == wanted.subject and any(name in fact for name in names)
