"""A plausible new edition of a manual: several changed facts at once, rows that moved, and cells of another width."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator
    from random import Random

    from fieldscribe.audit import Audit

    from audit_power.changes import Change
    from audit_power.measure import Sound

_INSERTED = ("", "Stand der Ausgabe: siehe Umschlag.", "")


@dataclass(slots=True)
class Edition:
    """Its text, and where the lines of the old text stand in it that hold a changed fact."""

    text: str
    changes: list[Change]
    changed: set[int]

    def noise(self, outcome: Audit) -> list[str]:
        """Findings that tell of no changed line."""
        told = [(f"{fact.subject} {fact.fact} {fact.wanted}", fact.line, fact.last) for fact in outcome.missing]
        told += [(f"unused {number.number}", number.line, number.line) for number in outcome.unused]
        told += [(f"erratum {erratum.erratum}", erratum.line, erratum.line) for erratum in outcome.unprinted]
        told += [(f"uncited {place.text}", place.line, place.line) for place in outcome.added]
        return [shown for shown, first, last in told if not any(first - 2 <= line <= last + 2 for line in self.changed)]


def edition(sound: Sound, random: Random, count: int = 14) -> Edition:
    """So many facts changed on lines of their own, three passages inserted, and all tables padded anew."""
    changes = list(_apart(sound, random, count))
    edits = {number: text for change in changes for number, text in change.lines}
    headings = sound.manual.headings
    inserted = random.sample(headings, min(3, len(headings)))
    lines: list[str] = []
    changed = set()
    for number, old in enumerate(sound.manual.lines):
        if number + 1 in inserted:
            lines += _INSERTED
        new = edits.get(number, old)
        if number in edits:
            changed.add(len(lines) + 1)
        if new is not None:
            lines.append(_padded(new))
    return Edition("\n".join(lines) + "\n", changes, changed)


def _apart(sound: Sound, random: Random, count: int) -> Iterator[Change]:
    taken: set[int] = set()
    claims = [claim for claim in sound.auditor.claims if not claim.optional]
    for claim in random.sample(claims, len(claims)):
        change = sound.changes(random).of(claim) if count else None
        if change is not None and not taken & {number for number, _ in change.lines}:
            taken |= {near for number, _ in change.lines for near in range(number - 3, number + 4)}
            count -= 1
            yield change


def _padded(line: str) -> str:
    """A row of a table with cells of another width."""
    return re.sub(r"  +\|", " |", line) if line.startswith("|") else line
