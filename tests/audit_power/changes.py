"""One changed fact: what a new edition may print in place of what a claim needs."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.audit.facts import reading, runs_of
from fieldscribe.audit.frames import runs_of_bytes
from fieldscribe.audit.instead import printed_access
from fieldscribe.audit.labels import standing

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from random import Random

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.comparison import Comparison
    from fieldscribe.audit.labels import Standing
    from fieldscribe.audit.manual import Token
    from fieldscribe.audit.passage import Passage

_CELL = re.compile(r"[^|\t]+")
_WORDS = ("Sollwert", "gesperrt", "Pumpe", "Notbetrieb", "Wartung", "Vorlauf", "dritte", "umgekehrt")


@dataclass(frozen=True, slots=True)
class Change:
    """Lines of a manual as another edition prints them: which, from 0, and their new text; None takes a line out."""

    kind: str
    claim: Claim
    lines: tuple[tuple[int, str | None], ...]
    shown: str

    def text(self, lines: Sequence[str]) -> str:
        """The whole edition."""
        new = dict(self.lines)
        return (
            "\n".join(line for number, text in enumerate(lines) if (line := new.get(number, text)) is not None) + "\n"
        )


class Changes:
    """Finds what a claim needs in the text that was transcribed, and changes it."""

    def __init__(self, sound: Comparison, random: Random) -> None:
        self.sound, self.random = sound, random
        self.lines = sound.manual.lines
        self.lists: dict[tuple[str, str, object], list[Claim]] = {}
        for claim in sound.claims:
            if claim.entry is not None:
                self.lists.setdefault((claim.subject, claim.fact, claim.cited), []).append(claim)

    def of(self, claim: Claim) -> Change | None:
        """One of the changes that the claim can have; None if nothing of it is printed where it is cited."""
        ways = [self._number, self._words, self._swap, self._added_entry, self._access, self._bytes, self._row]
        self.random.shuffle(ways)
        ways.sort(key=self._row.__eq__)  # a row is taken out where nothing else can be changed, or by chance
        if self.random.random() < 0.05:
            ways.insert(0, self._row)
        return next((change for way in ways if (change := way(claim)) is not None), None)

    def _tokens(self, claim: Claim) -> Iterator[Token]:
        for cited in claim.cited:
            passage = self.sound.passage(self.sound.extent(*cited))
            if claim.in_order and (runs := list(runs_of(claim, passage))):
                yield from (token for run in runs for token in run)
            elif claim.beside or (claim.entry is not None and not claim.words):  # others may read so by chance
                for label in self._labels(claim, cited):
                    yield label.tokens[0]
            else:
                hits = self.sound.hits(claim, passage) or reading(claim, passage)
                listed = self._listed(claim, passage)
                yield from [token for token in hits if token in listed] or hits

    def _listed(self, claim: Claim, passage: Passage) -> list[Token]:
        """The list of all numbers of a fact, where it is printed: others read so by chance."""
        lists = (other for other in self.sound.claims if (other.subject, other.fact) == (claim.subject, claim.fact))
        return [token for other in lists if other.in_order for run in runs_of(other, passage) for token in run]

    def _labels(self, claim: Claim, cited: tuple[int, int]) -> list[Standing]:
        together = self.lists.get((claim.subject, claim.fact, claim.cited), [claim])
        labels = standing(together, self.sound.passage(self.sound.extent(*cited)))
        return [label for label in labels if label.claim == claim]

    def _number(self, claim: Claim) -> Change | None:
        tokens = [token for token in self._tokens(claim) if token.line not in self.sound.empty]
        if not tokens:
            return None
        token = self.random.choice(tokens)
        line = self.lines[token.line - 1]
        new = self._other_number(token, line)
        at = token.column - 1
        return self._line("number", claim, token.line, line[:at] + new + line[at + len(token.text) :], token.text, new)

    def _other_number(self, token: Token, line: str) -> str:
        others = [other.text for other in self.sound.manual.tokens_in(line, 1) if not other.readings & token.readings]
        if others and self.random.random() < 0.25:
            return self.random.choice(others)
        places = [at for at, char in enumerate(token.text) if char.isdigit() and not token.text[at:].startswith("0x")]
        at = self.random.choice(places or [0])
        digit = self.random.choice([char for char in "123456789" if char != token.text[at]])
        return token.text[:at] + digit + token.text[at + 1 :]

    def _place_of_words(self, claim: Claim) -> tuple[int, int, int] | None:
        """Line, column and end of words that stand on one line."""
        places = []
        for cited in claim.cited:
            extent = self.sound.extent(*cited)
            passage = self.sound.passage(extent)
            if claim.entry is not None or claim.beside or claim.fact == "title":
                starts = {label.place for label in self._labels(claim, cited)}
                spans = [span for word in claim.words for span in passage.places(word) if span[0] in starts]
            else:
                spans = [
                    (at.start(), at.end()) for word in claim.words for at in re.finditer(_alone(word), passage.text)
                ]
            whole = "\n".join(self.lines[extent.first - 1 : extent.last])
            for first, end in spans:
                if end <= len(whole) and "\n" not in whole[first:end]:
                    line = whole.count("\n", 0, first)
                    start = whole.rfind("\n", 0, first) + 1
                    places.append((extent.first + line, first - start, end - start))
        return self.random.choice(places) if places else None

    def _words(self, claim: Claim) -> Change | None:
        place = self._place_of_words(claim) if claim.words and claim.fact not in ("access", "section") else None
        if place is None:
            return None
        number, first, end = place
        line = self.lines[number - 1]
        old = line[first:end]
        if claim.fact == "code":
            digits = [at for at, char in enumerate(old) if char.isdigit()]
            if not digits:
                return None
            at = self.random.choice(digits)
            new = old[:at] + self.random.choice([d for d in "123456789" if d != old[at]]) + old[at + 1 :]
            return self._line("code", claim, number, line[:first] + new + line[end:], old, new)
        other = self.random.choice([word for word in _WORDS if word.lower() not in old.lower()])
        words = old.split()
        words[self.random.randrange(len(words))] = other
        new = " ".join(words)
        kind = "title" if claim.fact == "title" else "label"
        return self._line(kind, claim, number, line[:first] + new + line[end:], old, new)

    def _swap(self, claim: Claim) -> Change | None:
        together = self.lists.get((claim.subject, claim.fact, claim.cited), [])
        others = [other for other in together if not set(other.words) & set(claim.words)]
        mine = self._place_of_words(claim) if others else None
        theirs = self._place_of_words(self.random.choice(others)) if others else None
        if mine is None or theirs is None or (mine[0] == theirs[0] and mine[1] < theirs[2] and theirs[1] < mine[2]):
            return None
        one, two = self.lines[mine[0] - 1][mine[1] : mine[2]], self.lines[theirs[0] - 1][theirs[1] : theirs[2]]
        if one == two:
            return None
        edits = sorted([(*mine, two), (*theirs, one)], reverse=True)
        new = {number: self.lines[number - 1] for number, *_ in edits}
        for number, first, end, words in edits:
            new[number] = new[number][:first] + words + new[number][end:]
        return Change("swap", claim, tuple((number - 1, text) for number, text in new.items()), f"{one} <> {two}")

    def _added_entry(self, claim: Claim) -> Change | None:
        together = self.lists.get((claim.subject, claim.fact, claim.cited), [])
        if claim.fact != "enum" or not together or claim != together[-1]:
            return None
        place = self._place_of_words(claim)
        if place is None:
            return None
        number, _, end = place
        line = self.lines[number - 1]
        highest = max(int(reading) for other in together for reading in other.beside)
        new = f" {highest + 1:02} .. {self.random.choice(_WORDS)}"
        return self._line("entry added", claim, number, line[:end] + new + line[end:], "", new)

    def _access(self, claim: Claim) -> Change | None:
        if claim.fact != "access" or not claim.rivals:
            return None
        number = self.sound.extent(*claim.cited[0]).first
        line = self.lines[number - 1]
        printed = printed_access(claim, line)
        if not printed:
            return None
        new = self.random.choice(claim.rivals)
        at = re.search(_alone(printed[0]) if printed[0].isalnum() else re.escape(printed[0]), line)
        assert at is not None
        return self._line("access", claim, number, line[: at.start()] + new + line[at.end() :], printed[0], new)

    def _bytes(self, claim: Claim) -> Change | None:
        if claim.fact != "bytes":
            return None
        spots = [
            (number, column + match.start(), match[0])
            for cited in claim.cited
            for number, column, text in self._of_frame(claim.shown, self.sound.passage(self.sound.extent(*cited)))
            for match in re.finditer(r"(?<![0-9A-Fa-f])(?:0x)?(?:[0-9A-F]{2})+(?![0-9A-Za-z])", text)
            if number not in self.sound.empty
        ]
        if not spots:
            return None
        number, at, old = self.random.choice(spots)
        new = old[:-1] + self.random.choice([digit for digit in "0123456789ABCDEF" if digit != old[-1]])
        line = self.lines[number - 1]
        return self._line("bytes", claim, number, line[:at] + new + line[at + len(old) :], old, new)

    def _of_frame(self, digits: str, passage: Passage) -> Iterator[tuple[int, int, str]]:
        """What is printed of a frame: line, column from 0, text. Other numbers may read like its bytes by chance."""
        pieces = list(passage.pieces_of_bytes(digits))
        for first, end in pieces:
            for line, column, width in passage.parts(first, end):
                yield line, column - 1, self.lines[line - 1][column - 1 : column - 1 + width]
        for run in runs_of_bytes(digits, passage) if not pieces else ():
            yield from ((token.line, token.column - 1, token.text) for token in run)

    def _row(self, claim: Claim) -> Change | None:
        number = self.sound.extent(*claim.cited[0]).first
        line = self.lines[number - 1]
        if not self.sound.manual.is_row(number):
            return None
        return Change("row deleted", claim, ((number - 1, None),), line.strip()[:50])

    def _line(self, kind: str, claim: Claim, number: int, text: str, old: str, new: str) -> Change | None:  # noqa: PLR0917
        if text == self.lines[number - 1]:
            return None
        return Change(kind, claim, ((number - 1, text),), f"line {number}: {old} > {new}")


def _alone(word: str) -> str:
    return rf"(?<!\w){re.escape(word)}(?!\w)"
