"""Which claims of a description hold in the new edition, and which change keeps the others from it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.audit.claims_of_flags import LIST_OF_BITS

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.editions.changes import Editions
    from fieldscribe.audit.editions.tracing import Trace


class Pair(NamedTuple):
    """A claim as it is written, and with the lines of each edition; None where the edition has none of them."""

    claim: Claim
    old: Claim | None
    new: Claim | None


class Holding:
    """The claims beside the changes: `failing_at` are those that each change keeps from holding.

    `elsewhere` are claims that do not hold though no line that they cite changed.
    """

    def __init__(self, editions: Editions, traces: tuple[Trace, Trace], pairs: list[Pair]) -> None:
        self.old, self.new = traces
        self.editions = editions
        self._pairs_of: dict[int, list[Pair]] = {}
        self.failing_at: dict[int, list[Pair]] = {}
        self.elsewhere: list[Pair] = []
        self._of_old = _by_line((change.old, number) for number, change in enumerate(editions.changes))
        self._of_new = _by_line((change.new, number) for number, change in enumerate(editions.changes))
        self._headings, self._old_headings = frozenset(self.new.manual.headings), frozenset(self.old.manual.headings)
        self._code_of = {pair.claim.subject: pair for pair in pairs if pair.claim.fact == "code"}
        for pair in pairs:
            touched = self._touched(pair)
            for number in touched:
                self._pairs_of.setdefault(number, []).append(pair)
            if self._fails(pair):
                self._note_failing(pair, touched)

    def pairs(self, number: int) -> list[Pair]:
        """The claims in whose lines a change is."""
        return self._pairs_of.get(number, [])

    def changes_of(self, lines: Iterable[int]) -> set[int]:
        """The changes in some lines of the old edition."""
        return {number for line in lines for number in self._of_old.get(line, ())}

    def _note_failing(self, pair: Pair, touched: set[int]) -> None:
        """A claim that does not hold belongs to the change of its words, else to all that touch its lines."""
        of_code = self._code_of[pair.claim.subject] if self._left_column(pair) else pair
        touched = touched | self._touched(of_code)
        bearing = borne_by(self.old, pair.old) | borne_by(self.old, of_code.old)
        gone = set(filter(self.editions.is_gone, bearing))
        own = {number for number in touched for old, _ in self.editions.changes[number].gaps if gone.intersection(old)}
        own = own or self._counted_anew_by(pair) or touched
        for number in own:
            self.failing_at.setdefault(number, []).append(pair)
        failed_before = pair.old is not None and pair.old in self.old.missed
        if not own and not failed_before:
            self.elsewhere.append(pair)

    def _counted_anew_by(self, pair: Pair) -> set[int]:
        """The nearest change above a section that has another number now which brought a heading, or took one."""
        if not self._is_counted_anew(pair) or pair.old is None or pair.new is None:
            return set()
        was, now = pair.old.cited[0][0], pair.new.cited[0][0]
        above = [
            number
            for number, change in enumerate(self.editions.changes)
            if (change.kind == "added" and any(line < now for line in self._headings.intersection(change.new)))
            or (change.kind == "removed" and any(line < was for line in self._old_headings.intersection(change.old)))
        ]
        return set(above[-1:])

    def _touched(self, pair: Pair) -> set[int]:
        """The changes in the lines that a claim takes its fact from."""
        olds = self.old.extents_of(pair.old.cited) if pair.old else ()
        news = self.new.extents_of(pair.new.cited) if pair.new else ()
        lines = {line for extent in olds for line in range(extent.first, extent.last + 1)}
        touched = self.changes_of(lines)
        lines = {line for extent in news for line in range(extent.first, extent.last + 1)}
        return touched | {number for line in lines for number in self._of_new.get(line, ())}

    def _fails(self, pair: Pair) -> bool:
        """Whether a claim does not hold in the new edition: a fact whose words are all still there, in order, does."""
        lost = self._lost_access, self._is_parted, self._lost_list, self._is_counted_anew, self._left_column
        if any(has_lost(pair) for has_lost in lost):
            return True
        if pair.claim.optional or (pair.new is not None and pair.new not in self.new.missed):
            return False
        if pair.old is None or pair.old in self.old.missed:
            return True
        borne = self.old.borne.get(pair.old, set())
        if borne:
            there = [self.editions.there(word) for word in sorted(borne)]
            return min(there) < 0 or there != sorted(there)  # a label that stands behind its number now is another's
        return bool(self._touched(pair)) or pair.new is None

    def _is_counted_anew(self, pair: Pair) -> bool:
        """Whether the number of a section is another now: its heading is known by its title."""
        if pair.claim.fact != "section" or pair.old is None or pair.new not in self.new.missed:
            return False
        olds, news = self.editions.old.texts, self.editions.new.texts
        places = ((word, self.editions.there(word)) for word in self.old.named.get(pair.old, ()))
        return any(there >= 0 and olds[word] != news[there] for word, there in places)

    def _lost_access(self, pair: Pair) -> bool:
        """Whether a row that printed an access does not print it any more."""
        if pair.claim.fact != "access":
            return False
        was = self.old.named.get(pair.old, ()) if pair.old else ()
        return any(map(self.editions.is_gone, was)) and not (pair.new and self.new.named.get(pair.new))

    def _lost_list(self, pair: Pair) -> bool:
        """Whether a row that listed the bits of all flags lists others now."""
        if pair.claim.fact != LIST_OF_BITS or pair.old is None or pair.new is None:
            return False
        borne = self.old.borne.get(pair.old, set())
        return any(map(self.editions.is_gone, borne)) and not self.new.borne.get(pair.new)

    def _left_column(self, pair: Pair) -> bool:
        """Whether a code that stood in a table below the number of its place stands below another."""
        code = self._code_of.get(pair.claim.subject)
        if code is None or not pair.claim.is_address or pair.claim.cited == code.claim.cited:
            return False
        was, now = (
            _columns(trace, side) & _columns(trace, of_code)
            for trace, side, of_code in ((self.old, pair.old, code.old), (self.new, pair.new, code.new))
        )
        return bool(was) and not now

    def _is_parted(self, pair: Pair) -> bool:
        """Whether a label that stood right beside its number does not any more."""
        if not pair.claim.beside or pair.old is None or pair.new is None:
            return False
        if not any(map(self.editions.is_gone, self.old.borne[pair.old])):
            return False
        return not self.old.sides_of(pair.old) <= self.new.sides_of(pair.new)


def borne_by(trace: Trace, claim: Claim | None) -> set[int]:
    """The words of an edition that bear a claim; none where it does not stand."""
    return trace.borne.get(claim, set()) if claim is not None else set()


def _columns(trace: Trace, claim: Claim | None) -> set[int]:
    """In which columns of tables a claim stands."""
    text = trace.text
    columns = (trace.manual.column(text.line_of[word], text.column_of[word] - 1) for word in borne_by(trace, claim))
    return {column for column in columns if column is not None}


def _by_line(changes: Iterable[tuple[tuple[int, ...], int]]) -> dict[int, list[int]]:
    by_line: dict[int, list[int]] = {}
    for lines, number in changes:
        for line in lines:
            by_line.setdefault(line, []).append(number)
    return by_line
