"""The printed table: killed by kind, and the survivors."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from mutants.judges import KILLED, LEFT_OUT, SURVIVED, Verdict
from mutants.sources import Mutant

MARKS = {"c": 97.0, "python": 97.0, "rust": 97.0, "typescript": 97.0, "descriptions": 85.0, "generator": 90.0}
"""Per cent that must be killed."""
OF_A_KIND = {"generator": 85.0}
"""Per cent that must be killed of each kind."""
MOST_EQUIVALENT = 3.0
"""Per cent that may be named equivalent."""
EQUIVALENT = "equivalent"


@dataclass(slots=True)
class Table:
    """The mutants of a language and what became of them."""

    language: str
    counts: dict[str, Counter[str]] = field(default_factory=dict)
    survivors: list[Mutant] = field(default_factory=list)
    killers: Counter[str] = field(default_factory=Counter)

    def add(self, mutant: Mutant, verdict: Verdict, *, equivalent: bool) -> None:
        """Count one."""
        outcome = EQUIVALENT if equivalent and verdict.outcome == SURVIVED else verdict.outcome
        self.counts.setdefault(mutant.kind, Counter())[outcome] += 1
        if outcome == SURVIVED:
            self.survivors.append(mutant)
        if outcome == KILLED:
            self.killers[verdict.by.partition("::")[0]] += 1

    @property
    def judged(self) -> int:
        """How many count."""
        return sum(map(self.judged_of, self.counts))

    @property
    def total(self) -> Counter[str]:
        """The sum of all kinds."""
        return sum(self.counts.values(), Counter())

    @property
    def met(self) -> bool:
        """Whether the marks are met."""
        total = self.total
        few = total[EQUIVALENT] * 100 <= MOST_EQUIVALENT * max(self.judged, 1)
        return few and per_cent(total) >= MARKS[self.language] and not self.missed

    @property
    def missed(self) -> list[str]:
        """The kinds that miss the mark of a kind."""
        return [kind for kind, of in self.counts.items() if per_cent(of) < OF_A_KIND.get(self.language, 0.0)]

    def judged_of(self, kind: str) -> int:
        """How many of a kind count."""
        of = self.counts.get(kind, Counter())
        return of.total() - of[LEFT_OUT]

    def lines(self) -> list[str]:
        """The table."""
        head = f"{self.language:24}{'killed':>9}{'survived':>10}{'equivalent':>12}{'left out':>10}{'per cent':>10}"
        rows = [_row(kind, of) for kind, of in self.counts.items()]
        mark = f"the mark is {MARKS[self.language]:g} per cent: {'met' if self.met else 'missed'}"
        below = f"; below {OF_A_KIND[self.language]:g}: {', '.join(self.missed)}" if self.missed else ""
        by = ", ".join(f"{who} {count}" for who, count in self.killers.most_common())
        return [head, *rows, _row("all", self.total), f"killed by: {by}", mark + below]

    def survivor_lines(self) -> list[str]:
        """Each survivor with its place, before and after."""
        rows = sorted(self.survivors, key=lambda one: (one.kind, one.path, one.line))
        return [f"{one.path}:{one.line} ({one.what})\n  - {one.before}\n  + {one.after}" for one in rows]


def per_cent(of: Counter[str]) -> float:
    """How many of those that could be noticed were."""
    return 100 * of[KILLED] / max(of[KILLED] + of[SURVIVED], 1)


def _row(name: str, of: Counter[str]) -> str:
    cells = f"{of[KILLED]:9}{of[SURVIVED]:10}{of[EQUIVALENT]:12}{of[LEFT_OUT]:10}"
    return f"  {name:22}{cells}{per_cent(of):10.1f}"
