"""Two editions of a manual: every line that differs, with the facts that cite it and whether they still stand."""

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass

from fieldscribe.audit.alignment import Alignment, changed_words
from fieldscribe.audit.claims import Cited, Claim, Word
from fieldscribe.audit.claims_of_device import PrintedErratum
from fieldscribe.audit.held import Citations, Held
from fieldscribe.diagnostics import Span

_Mapping = Callable[[Cited], tuple[int, int] | None]


@dataclass(frozen=True, slots=True)
class CitedFact:
    """A fact that cites a line; `stands` is True if the new edition prints it where it is cited."""

    subject: str
    fact: str
    says: str
    place: str
    stands: bool


@dataclass(frozen=True, slots=True)
class ChangedLine:
    """A line that was changed, added, removed or moved, with its numbers and texts in both editions."""

    kind: str
    old_line: int | None
    new_line: int | None
    old: str
    new: str
    words: list[tuple[str, str]]
    facts: list[CitedFact]


@dataclass(slots=True)
class Comparison:
    """All lines that differ, all facts and errata that do not stand in the new edition, and the numbering in use."""

    device: str
    old: str
    new: str
    lines: list[ChangedLine]
    fallen: list[CitedFact]
    errata: list[str]
    """The errata whose printed text the new edition does not print."""
    left_to_renumber: int
    """The cited places with line numbers of the old edition that differ in the new one."""

    @property
    def stands(self) -> bool:
        """True if every cited fact and every erratum stands in the new edition."""
        return not self.fallen and not self.errata

    @property
    def uncited(self) -> int:
        """The number of lines that differ and that no fact cites."""
        return sum(not line.facts for line in self.lines)

    @property
    def counts(self) -> dict[str, int]:
        """The numbers of lines of each kind, and of open items."""
        kinds = Counter(line.kind for line in self.lines)
        return {
            **{kind: kinds[kind] for kind in ("changed", "added", "removed", "moved")},
            "without_facts": self.uncited,
            "facts_that_fell": len(self.fallen),
            "errata_not_printed": len(self.errata),
            "to_renumber": self.left_to_renumber,
        }

    def as_data(self) -> dict[str, object]:
        """Return the same for JSON."""
        return {
            "device": self.device,
            "old": self.old,
            "new": self.new,
            "stands": self.stands,
            "counts": self.counts,
            "lines": [asdict(line) for line in self.lines],
            "facts_that_fell": [asdict(fact) for fact in self.fallen],
            "errata_not_printed": self.errata,
        }


class Editions:
    """A description between two texts. Its line numbers are those of the old one until it is renumbered.

    Facts added or edited meanwhile may have line numbers of the new one: each place that cites lines uses the text in
    which more of its facts stand; if that does not decide, the one that most other places use.
    """

    def __init__(self, citations: Citations, old: str, new: str) -> None:
        self.citations = citations
        self._old, self._new = citations.manual(old), citations.manual(new)
        self.alignment = Alignment(self._old.lines, self._new.lines)
        self._counting_new: set[Span] = set()
        self._others_count_new = False
        self._decide()
        self.in_old = Held(citations, self._old, self._then)
        self.in_new = Held(citations, self._new, self._now, self._added_rows())

    def _added_rows(self) -> list[int]:
        """Return the rows of tables that only the new edition has: a fact of the row above does not reach into them."""
        added = (change.new for change in self.alignment.changes if change.kind == "added" and change.new is not None)
        return list(filter(self._new.opens_row, added))

    def counts_new(self, key: Span) -> bool:
        """Return True if the lines at a place of the YAML are those of the new edition."""
        return key in self._counting_new or (self._others_count_new and key not in self._counting_old)

    def is_blank_in_new(self, line: int) -> bool:
        """Return True if a line of the new edition holds nothing."""
        return not self._new.line(line).strip()

    def _decide(self) -> None:
        """Find the places with line numbers of the new edition; lines that did not move do not decide."""
        needed = (claim for claim in self.citations.claims if not claim.optional)
        claims = [claim for claim in needed if any(map(self._has_moved, claim.cited))]
        self._counting_old: set[Span] = set()
        if not claims:
            return
        as_old = self._standing(claims, lambda cited: cited.lines, self._moved(self.alignment.now))
        as_new = self._standing(claims, self._moved(self.alignment.then), lambda cited: cited.lines)
        for key in as_old.keys() | as_new.keys():
            if as_new[key] > as_old[key]:
                self._counting_new.add(key)
            elif as_old[key] > as_new[key]:
                self._counting_old.add(key)
        self._others_count_new = len(self._counting_new) > len(self._counting_old)

    def _has_moved(self, cited: Cited) -> bool:
        return self.alignment.now(cited.first) != cited.first

    def _standing(self, claims: list[Claim], in_old: _Mapping, in_new: _Mapping) -> Counter[Span]:
        """Count the claims that only one of the texts prints, by the place of their lines in the YAML.

        Claims count once for the whole cited place, and once for its first row: a row below has the facts of another
        numbering.
        """
        counts: Counter[Span] = Counter()
        for row_alone in (False, True):
            texts = [
                Held(self.citations, manual, now, filter(manual.opens_row, range(1, row_alone * len(manual) + 1)))
                for manual, now in ((self._old, in_old), (self._new, in_new))
            ]
            printed = [claim for claim in claims if any(held.is_printed(claim) for held in texts)]
            counts.update(cited.key for claim in printed for cited in claim.cited if self._has_moved(cited))
        return counts

    def _now(self, cited: Cited) -> tuple[int, int] | None:
        return cited.lines if self.counts_new(cited.key) else self._moved(self.alignment.now)(cited)

    def _then(self, cited: Cited) -> tuple[int, int] | None:
        return self._moved(self.alignment.then)(cited) if self.counts_new(cited.key) else cited.lines

    def _moved(self, line_of: Callable[[int], int | None]) -> _Mapping:
        def moved(cited: Cited) -> tuple[int, int] | None:
            numbers = range(cited.first, max(cited.first, cited.last) + 1)  # a range keeps the lines that are left
            lines = [line for number in numbers if (line := line_of(number)) is not None]
            return (min(lines), max(lines) if cited.last else 0) if lines else None

        return moved

    def compare(self, old_name: str, new_name: str) -> Comparison:
        """Return every line that differs with the facts that cite it."""
        facts = {claim: self._fact(claim) for claim in self.citations.claims}
        fallen = {claim for claim, fact in facts.items() if not fact.stands}
        by_old = _by_line(self.in_old, fallen)
        by_new = _by_line(self.in_new, {claim for claim in fallen if not _lines(self.in_old, claim)})
        lines = []
        for change in self.alignment.changes:
            claims = {**by_old.get(change.old or 0, {}), **by_new.get(change.new or 0, {})}
            old, new = self._old.line(change.old or 0), self._new.line(change.new or 0)
            words = changed_words(old, new) if change.kind == "changed" else []
            cited = [facts[claim] for claim in claims]
            lines.append(ChangedLine(change.kind, change.old, change.new, old, new, words, cited))
        errata = [erratum.id for erratum in self.citations.errata if self._fell(erratum)]
        cited_lines = (cited for claim in self.citations.claims for cited in claim.cited)
        left = {cited.key for cited in cited_lines if self._is_left(cited)}
        facts_that_fell = [fact for fact in facts.values() if not fact.stands]
        return Comparison(self.citations.device, old_name, new_name, lines, facts_that_fell, errata, len(left))

    def _fact(self, claim: Claim) -> CitedFact:
        """Return a cited fact; an optional one, such as a unit, must stand if the old edition prints it."""
        stands = self.in_new.stands(claim)
        if claim.optional and not isinstance(claim.evidence, Word):
            stands = stands or not self.in_old.is_printed(claim)
        elif isinstance(claim.evidence, Word) and (claim.optional or claim.evidence.rivals):
            was, now = (_lines(held, claim) for held in (self.in_old, self.in_new))
            there = {self.alignment.now(line) for line in was} - {None}
            may_be_gone = claim.optional or not self.in_new.places[claim]
            stands = ((stands or may_be_gone) and there <= now) or self.in_new.is_taken(claim)
        return CitedFact(claim.subject, claim.fact, claim.stated, claim.where, stands)

    def _fell(self, erratum: PrintedErratum) -> bool:
        has_text = bool(erratum.numbers or erratum.texts)
        return has_text and not self.in_new.erratum_stands(erratum)

    def _is_left(self, cited: Cited) -> bool:
        return not self.counts_new(cited.key) and self._now(cited) not in (None, cited.lines)


def _by_line(held: Held, fallen: Iterable[Claim]) -> dict[int, dict[Claim, None]]:
    """Return the claims on each line: on the lines of their evidence, or on the cited line if it is missing."""
    lines: dict[int, dict[Claim, None]] = {}
    for claim, places in held.places.items():
        for place in places:
            for line in place.found.lines or ((place.extent.first,) if claim in fallen else ()):
                lines.setdefault(line, {})[claim] = None
    return lines


def _lines(held: Held, claim: Claim) -> set[int]:
    """Return the lines with the evidence of a claim."""
    return {line for place in held.places[claim] for line in place.found.lines}
