"""The findings of an audit, as plain data."""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict, dataclass, field


@dataclass(slots=True)
class Missing:
    """A fact that does not stand where it is cited. `nearest` is the nearest line that has it, None if none does.

    `place` is where the description says it: file:line:column. `printed` is what stands there instead, if known.
    """

    subject: str
    fact: str
    wanted: str
    line: int
    last: int
    nearest: int | None
    place: str
    printed: str | None
    also: list[str] = field(default_factory=list)
    """Other subjects of the rows below that miss the same fact."""
    lost: int = 1
    """How many facts of the subject are missing there, where nearly all are: its place is gone, or elsewhere."""

    def spread(self, other: Missing) -> None:
        """Takes in the same fact of a row below."""
        self.last = max(self.last, other.last)
        if other.subject != self.subject and other.subject not in self.also:
            self.also.append(other.subject)


@dataclass(frozen=True, slots=True)
class Moved:
    """A cited place that stands on another line now."""

    subject: str
    line: int
    now: int


@dataclass(frozen=True, slots=True)
class Unused:
    """A number in a cited place that no fact uses. `place` is where the description says the first of the subjects."""

    line: int
    column: int
    number: str
    subjects: tuple[str, ...]
    place: str


@dataclass(frozen=True, slots=True)
class Uncited:
    """A section, or rows of a table up to `last`, that nothing cites; `among_cited` if others of its section are."""

    line: int
    last: int
    kind: str
    text: str
    among_cited: bool = False


@dataclass(frozen=True, slots=True)
class Unprinted:
    """An erratum whose printed text does not stand at its line."""

    erratum: str
    printed: str
    line: int
    nearest: int | None


@dataclass(slots=True)
class Audit:
    """All findings. `facts` counts the claims; `uncheckable` the errata without a number or quoted text to search."""

    device: str
    manual: str
    same_text: bool | None
    lines: int
    has_fingerprint: bool = False
    """Whether the layout of the text that was transcribed is known."""
    facts: int = 0
    errata: int = 0
    uncheckable: int = 0
    missing: list[Missing] = field(default_factory=list)
    moved: list[Moved] = field(default_factory=list)
    unprinted: list[Unprinted] = field(default_factory=list)
    unused: list[Unused] = field(default_factory=list)
    uncited: list[Uncited] = field(default_factory=list)

    @property
    def clean(self) -> bool:
        """Whether all that is cited stands there, errata too, and nothing more than that."""
        return not (self.findings or self.moved)

    @property
    def findings(self) -> int:
        """How many there are, cited places that moved not counted."""
        return len(self.missing) + len(self.unprinted) + len(self.unused) + len(self.added)

    @property
    def added(self) -> list[Uncited]:
        """The rows that nothing cites among rows that are cited."""
        return [place for place in self.uncited if place.among_cited]

    @property
    def counts(self) -> dict[str, int]:
        """How much there is of each."""
        return {
            "facts": self.facts,
            "missing": len(self.missing),
            "moved": len(self.moved),
            "errata": self.errata,
            "errata_not_printed": len(self.unprinted),
            "errata_uncheckable": self.uncheckable,
            "unused_numbers": len(self.unused),
            "uncited": sum(place.last - place.line + 1 for place in self.uncited),
        }

    def shifts(self) -> list[tuple[int, int, int, int]]:
        """Moved places in runs that moved alike: first line, last line, by how many lines, how many places."""
        runs: list[tuple[int, int, int, int]] = []
        for line, by in sorted({(place.line, place.now - place.line) for place in self.moved}):
            count = Counter((place.line, place.now - place.line) for place in self.moved)[line, by]
            if runs and runs[-1][2] == by:
                first, _, _, before = runs[-1]
                runs[-1] = (first, line, by, before + count)
            else:
                runs.append((line, line, by, count))
        return runs

    def as_data(self) -> dict[str, object]:
        """The same for JSON."""
        return {
            "device": self.device,
            "manual": self.manual,
            "same_text": self.same_text,
            "fingerprint": self.has_fingerprint,
            "clean": self.clean,
            "counts": self.counts,
            "missing": [asdict(fact) for fact in self.missing],
            "moved": [asdict(place) for place in self.moved],
            "errata_not_printed": [asdict(erratum) for erratum in self.unprinted],
            "unused_numbers": [asdict(number) for number in self.unused],
            "uncited": [asdict(place) for place in self.uncited],
        }
