"""What two editions of a manual mean for a description, as plain data."""

from __future__ import annotations

from fieldscribe.records import dataclass, field, values_of


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
    """Why a line is not explained, and where the description says what does not hold any more, if it does."""

    text: str
    place: str = ""


@dataclass(frozen=True, slots=True)
class Draft:
    """What new rows seem to be, where in the description's YAML they are to be pasted, and that YAML."""

    line: int
    kind: str
    place: str
    yaml: str


@dataclass(frozen=True, slots=True)
class Finding:
    """Lines that were changed, added, removed or moved; `words` are the old ones beside the new ones."""

    kind: str
    old: tuple[int, int] | None
    new: tuple[int, int] | None
    was: tuple[str, ...]
    now: tuple[str, ...]
    words: tuple[tuple[str, str], ...]
    cited_by: tuple[Cite, ...]
    reasons: tuple[Reason, ...]
    drafts: tuple[Draft, ...] = ()

    @property
    def explained(self) -> bool:
        """Whether the description has all that the lines say, and says nothing of them that does not hold."""
        return not self.reasons

    def as_data(self) -> dict[str, object]:
        """The same for JSON."""
        data = values_of(self)
        data["words"] = [{"old": old, "new": new} for old, new in self.words]
        data["cited_by"] = [values_of(cite) for cite in self.cited_by]
        data["reasons"] = [values_of(reason) for reason in self.reasons]
        data["drafts"] = [values_of(draft) for draft in self.drafts]
        return {**data, "explained": self.explained}


@dataclass(frozen=True, slots=True)
class Void:
    """An erratum that the new edition made void: whether the manual now has what was taken, so that it can go."""

    erratum: str
    place: str
    is_corrected: bool
    line: int


@dataclass(frozen=True, slots=True)
class StaleNote:
    """A sentence of the description that says what a changed line said: whose it is, where, and what of which line."""

    owner: str
    key: str
    place: str
    said: tuple[tuple[str, str], ...]


@dataclass(slots=True)
class Comparison:
    """Everything that a new edition means for a description.

    `elsewhere` are facts that do not hold though no line that they cite changed. `shifted` counts the cited lines that
    have another number in the new edition, `renumbered` says that the description counts the lines of the new one.
    """

    device: str
    old: str
    new: str
    old_is_known: bool | None
    new_is_known: bool | None
    counts: dict[str, int]
    findings: list[Finding] = field(default_factory=list)
    elsewhere: list[Reason] = field(default_factory=list)
    void: list[Void] = field(default_factory=list)
    notes: list[StaleNote] = field(default_factory=list)
    shifted: int = 0
    renumbered: bool = False

    @property
    def explained(self) -> bool:
        """Whether nothing of the new edition is left to be looked at."""
        return not self.elsewhere and not self.void and all(finding.explained for finding in self.findings)

    def as_data(self) -> dict[str, object]:
        """The same for JSON."""
        unexplained = sum(not finding.explained for finding in self.findings)
        return {
            "device": self.device,
            "old": self.old,
            "manual": self.new,
            "old_is_transcribed": self.old_is_known,
            "same_text": self.new_is_known,
            "explained": self.explained,
            "counts": {**self.counts, "unexplained": unexplained, "shifted": self.shifted},
            "renumbered": self.renumbered,
            "findings": [finding.as_data() for finding in self.findings],
            "elsewhere": [values_of(reason) for reason in self.elsewhere],
            "void_errata": [values_of(void) for void in self.void],
            "notes": [{**values_of(note), "said": dict(note.said)} for note in self.notes],
        }
