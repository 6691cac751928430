"""What two editions of a manual mean for a description, as plain data."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field


@dataclass(frozen=True, slots=True)
class Cite:
    """What takes something from a line: the fact that stood on the changed words, or "" for the subject as a whole."""

    subject: str
    fact: str
    shown: str
    place: str

    @property
    def is_erratum(self) -> bool:
        """Whether it is an erratum, whose subject is named so."""
        return self.subject.startswith("erratum ")


@dataclass(frozen=True, slots=True)
class Reason:
    """Why a line is not explained, and where the description says what does not hold any more, if it does.

    `kind` is `missing`, `gone`, `number` or `word` (one that nothing has), `otherwise`, `sign` or `unit`. It is `said`
    of the `subjects`: several where a set or an array says the same at one place.
    """

    kind: str
    said: str
    place: str = ""
    subjects: tuple[str, ...] = ()
    words: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """What it says, as a sentence."""
        more = f" and {len(self.subjects) - 1} more" if len(self.subjects) > 1 else ""
        return f"{self.subjects[0]}{more}{self.said}" if self.subjects else self.said

    def as_data(self) -> dict[str, object]:
        """The same for JSON."""
        return {**asdict(self), "text": self.text}


@dataclass(frozen=True, slots=True)
class Draft:
    """What new rows seem to be, where in the description's YAML they are to be pasted, and that YAML."""

    line: int
    kind: str
    place: str
    yaml: str


Ends = tuple[int, int]
"""The first and the last of some lines."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where a change is: its lines in each edition, None where there are none."""

    old: Ends | None
    new: Ends | None


@dataclass(frozen=True, slots=True)
class Void:
    """An erratum that the new edition made void: whether the manual now has what was taken, so that it can go."""

    erratum: str
    place: str
    is_corrected: bool
    line: int


@dataclass(frozen=True, slots=True)
class Doubt:
    """An erratum in words about lines that changed: no claim can say whether it still holds, so a reader has to."""

    erratum: str
    place: str
    lines: tuple[Ends, ...]


@dataclass(frozen=True, slots=True)
class StaleNote:
    """A sentence of the description that says what a changed line said: whose it is, where, and what of which line."""

    owner: str
    key: str
    place: str
    said: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Finding:
    """Lines that were changed, added, removed, moved or swapped; `words` are the old ones beside the new ones.

    `places` has each place where the same was done, `was` and `now` are the lines of the first, `was_at` and `now_at`
    where in each of them its change begins. `beside` is where the description says what stands above them, if nothing
    cites them. `void` are errata that go with the change.
    """

    kind: str
    places: tuple[Place, ...]
    was: tuple[str, ...]
    now: tuple[str, ...]
    was_at: tuple[int, ...]
    now_at: tuple[int, ...]
    words: tuple[tuple[str, str], ...]
    cited_by: tuple[Cite, ...]
    reasons: tuple[Reason, ...]
    drafts: tuple[Draft, ...] = ()
    beside: str = ""
    void: tuple[Void, ...] = ()

    @property
    def explained(self) -> bool:
        """Whether the description has all that the lines say, and says nothing of them that does not hold."""
        return not self.reasons and not self.void

    @property
    def old(self) -> Ends | None:
        """The lines of the first place in the old edition."""
        return self.places[0].old

    @property
    def new(self) -> Ends | None:
        """The lines of the first place in the new edition."""
        return self.places[0].new

    def as_data(self) -> dict[str, object]:
        """The same for JSON."""
        data = asdict(self)
        data["places"] = [asdict(place) for place in self.places]
        data["words"] = [{"old": old, "new": new} for old, new in self.words]
        data["cited_by"] = [asdict(cite) for cite in self.cited_by]
        data["reasons"] = [reason.as_data() for reason in self.reasons]
        data["drafts"] = [asdict(draft) for draft in self.drafts]
        data["void"] = [asdict(void) for void in self.void]
        return {**data, "explained": self.explained}


@dataclass(frozen=True, slots=True)
class Remark:
    """Changes that hold no fact: `kind` is what they are, such as `heads_and_feet` or `contents`."""

    kind: str
    findings: tuple[Finding, ...]

    @property
    def places(self) -> tuple[Place, ...]:
        """Where they are."""
        return tuple(place for finding in self.findings for place in finding.places)

    def as_data(self) -> dict[str, object]:
        """The same for JSON."""
        return {"kind": self.kind, "findings": [finding.as_data() for finding in self.findings]}


@dataclass(slots=True)
class Comparison:
    """Everything that a new edition means for a description.

    `remarks` are about what holds no fact. `doubts` are errata that a reader has to look at. `void` are the errata that
    belong to no finding. `elsewhere` are facts that do not hold though no line that they cite changed. `shifted` counts
    the cited lines that have another number in the new edition, `renumbered` says that the description counts the lines
    of the new one.
    """

    device: str
    old: str
    new: str
    old_is_known: bool | None
    new_is_known: bool | None
    counts: dict[str, int]
    findings: list[Finding] = field(default_factory=list)
    remarks: list[Remark] = field(default_factory=list)
    elsewhere: list[Reason] = field(default_factory=list)
    void: list[Void] = field(default_factory=list)
    doubts: list[Doubt] = field(default_factory=list)
    notes: list[StaleNote] = field(default_factory=list)
    shifted: int = 0
    renumbered: bool = False

    @property
    def explained(self) -> bool:
        """Whether every change is explained."""
        return self.unexplained == 0

    @property
    def settled(self) -> bool:
        """Whether nothing of the new edition is left to be looked at."""
        return self.explained and not self.doubts

    @property
    def unexplained(self) -> int:
        """How many findings are left."""
        return len(self.elsewhere) + len(self.void) + sum(not finding.explained for finding in self.findings)

    def as_data(self) -> dict[str, object]:
        """The same for JSON."""
        return {
            "device": self.device,
            "old": self.old,
            "manual": self.new,
            "old_is_transcribed": self.old_is_known,
            "same_text": self.new_is_known,
            "explained": self.explained,
            "counts": {**self.counts, "unexplained": self.unexplained, "shifted": self.shifted},
            "renumbered": self.renumbered,
            "findings": [finding.as_data() for finding in self.findings],
            "remarks": [remark.as_data() for remark in self.remarks],
            "elsewhere": [reason.as_data() for reason in self.elsewhere],
            "void_errata": [
                asdict(void) for void in (*self.void, *(void for finding in self.findings for void in finding.void))
            ],
            "doubtful_errata": [asdict(doubt) for doubt in self.doubts],
            "notes": [{**asdict(note), "said": dict(note.said)} for note in self.notes],
        }
