"""Whether a passage has the evidence for a claim: one function for each kind of evidence."""

import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

from fieldscribe.audit.claims import Bytes, Evidence, Label, Number, Run, Word
from fieldscribe.audit.manual import Passage, has_word, places_of_word
from fieldscribe.audit.numbers import Token

_RUN = re.compile(r"\bbis\b|\bto\b|\.\.|\u2026|[0-9]\s*[-\u2013]\s*[0-9]")
"""Matches a run of numbers ("0 to 4", "0..4"), which means all numbers between its ends."""
_TAG = re.compile(r"</?[A-Za-z]{1,6}/?>")
_MOST = 0.75
_FEWEST_LISTED = 4
"""The number of labels that are enough to decide on which side of its numbers a list prints them."""


class Found(NamedTuple):
    """How often a passage has the evidence, with its numbers and its lines."""

    times: int
    tokens: tuple[Token, ...] = ()
    lines: frozenset[int] = frozenset()


def found(evidence: Evidence, passage: Passage, *, binary: bool) -> Found:
    """Search for one kind of evidence; `labels_found` searches for labels together.

    `binary`: two or three binary digits may mean a number, as in `11` for 3.
    """
    match evidence:
        case Number():
            return _number(evidence, passage, binary=binary)
        case Run():
            return _run(evidence, passage, binary=binary)
        case Word():
            return _word(evidence, passage)
        case Bytes():
            return _bytes(evidence, passage)
        case Label():
            return labels_found([evidence], passage)[evidence]


def _number(evidence: Number, passage: Passage, *, binary: bool) -> Found:
    """Find a number: it counts each time that it is printed, in any notation, also as part of a name."""
    tokens = [token for token in passage.tokens if _reads(token, evidence.numbers, binary=binary)]
    if evidence.names:
        named = {id(token) for token in passage.after_names(evidence.names)}
        allowed = named | passage.opening_lines if named else set()
        tokens = [token for token in tokens if not allowed or id(token) in allowed]
    words = [_word(Word((word,)), passage) for word in evidence.words]
    times = max([len(tokens), *(word.times for word in words)])
    if not times and evidence.ends:
        readings = frozenset().union(*(token.readings for token in passage.tokens))
        times = int(readings >= evidence.ends and _RUN.search(passage.text) is not None)
    lines = frozenset(token.line for token in tokens).union(*(word.lines for word in words))
    return Found(times, (*tokens, *(token for word in words for token in word.tokens)), lines)


def _run(evidence: Run, passage: Passage, *, binary: bool) -> Found:
    """Find numbers in one of the given orders; spread ones anywhere on one line."""
    runs = [
        run
        for way in evidence.ways
        for run in passage.in_order(way)
        if binary or all(token.is_plainly(wanted) for token, wanted in zip(run, way, strict=True))
    ]
    if not runs and evidence.spread:
        runs = [run for way in evidence.ways for run in _spread(way, passage)]
    tokens = tuple(token for run in runs for token in run)
    return Found(len(runs), tokens, frozenset(token.line for token in tokens))


def _spread(way: Sequence[frozenset[Fraction]], passage: Passage) -> Iterator[list[Token]]:
    hits = [[token for token in passage.tokens if token.readings & numbers] for numbers in way]
    for line in sorted(set.intersection(*({token.line for token in tokens} for tokens in hits))):
        yield [token for tokens in hits for token in tokens if token.line == line]


def _word(evidence: Word, passage: Passage) -> Found:
    """Find a word by itself. With rivals only the first line counts, and it agrees if it prints neither."""
    if evidence.rivals:
        line = passage.pieces[0][0]
        printed = printed_notations(evidence, passage.pieces[0][2])
        stands = not printed or not set(evidence.words).isdisjoint(printed)
        return Found(int(stands), (), frozenset((line,) if printed else ()))
    spans = [(at, at + len(word)) for word in evidence.words for at in places_of_word(passage.text, word)]
    tokens = tuple(token for span in spans for token in passage.inside(*span))
    return Found(len(spans), tokens, frozenset(passage.line_at(first) for first, _ in spans))


def printed_notations(evidence: Word, line: str) -> list[str]:
    """Return the words, out of a word and its rivals, that a line prints or has as whole cells."""
    notations = sorted((*evidence.words, *evidence.rivals), key=len, reverse=True)
    if evidence.cells:
        cells = [cell.strip() for cell in line.split("|" if line.startswith("|") else "\t")]
        return [cell for cell in cells if cell in notations] if len(cells) > 1 else []
    patterns = (rf"(?<!\w){re.escape(word)}(?!\w)" if word.isalnum() else re.escape(word) for word in notations)
    return re.findall("|".join(patterns), line)


def _bytes(evidence: Bytes, passage: Passage) -> Found:
    """Find a frame in one piece, or each of its bytes or words as a number, along the text or down a column."""
    digits = evidence.digits
    spans = [span for pattern in (digits, f"{digits[:-4]}(?=CRC)") for span in _pieces(pattern, passage)]
    if spans:
        tokens = tuple(token for span in spans for token in passage.overlapping(*span))
        return Found(1, tokens, frozenset(passage.line_at(first) for first, _ in spans))
    ways = [[int(digits[at : at + width], 16) for at in range(0, len(digits), width)] for width in (2, 4)]
    wanted = {Fraction(number) for way in ways for number in way}
    tokens = tuple(token for token in passage.tokens if token.readings & wanted)  # also names of bytes: Low byte (1)
    runs = (tuple(frozenset((Fraction(number),)) for number in way) for way in ways)
    stands = any(True for run in runs for part in (passage, *passage.columns) for _ in part.in_order(run))
    return Found(int(stands), tokens, frozenset(token.line for token in tokens))


def _pieces(pattern: str, passage: Passage) -> Iterator[tuple[int, int]]:
    """Yield the places of hexadecimal digits in one piece, with or without blanks between."""
    spaced = r"\s*".join(re.findall(r"[0-9A-F]|\(.*\)", pattern))
    for match in re.finditer(spaced, passage.text, re.IGNORECASE):
        yield match.span()


def labels_found(labels: Sequence[Label], passage: Passage) -> dict[Label, Found]:
    """Find the labels of a list, which is printed in one way: each label before or after its number.

    If most labels are right beside their numbers, all must be. The labels of a short list may be on either side.
    """
    search = _LabelSearch(labels, passage)
    ways = {
        is_touching: [
            {label: search.found(label, after, way, is_touching) for label in labels}
            for way in range(max(1, 0, *(len(label.adjacent) for label in labels)))
            for after in (True, False)
        ]
        for is_touching in (True, False)
    }
    near, far = (max(ways[is_touching], key=_standing) for is_touching in (True, False))
    if _standing(near) > _MOST * _standing(far):
        far = near | _outside(near, far)
    numbered = sum(bool(label.adjacent) for label in labels)
    if numbered >= _FEWEST_LISTED or _standing(far) == numbered:
        return far
    return {label: max((way[label] for way in ways[False]), key=lambda place: place.times > 0) for label in labels}


def _outside(near: Mapping[Label, Found], far: Mapping[Label, Found]) -> dict[Label, Found]:
    """Return the labels that only `far` has, in lines above or below all others: in a footnote, say."""
    lines = {line for label, place in near.items() if label.adjacent for line in place.lines}
    inside = range(min(lines, default=0), max(lines, default=0) + 1)
    alone = {label for label, place in far.items() if place.times and not near[label].times}
    return {label: far[label] for label in alone if not far[label].lines & set(inside)}


def _standing(way: Mapping[Label, Found]) -> int:
    return sum(place.times > 0 for label, place in way.items() if label.adjacent)


class _LabelSearch:
    """The places of the labels of one list. A label inside a longer one of the list does not count."""

    def __init__(self, labels: Sequence[Label], passage: Passage) -> None:
        self.passage = passage
        spans = {label: {span for words in label.words for span in passage.places(words)} for label in labels}
        longest = _without_inner({span for label, places in spans.items() if label.adjacent for span in places})
        self.spans = {label: sorted(places & longest if label.adjacent else places) for label, places in spans.items()}
        everywhere = set().union(*spans.values())
        inside = {id(token) for span in everywhere for token in passage.inside(*span)}
        self.numbers = [at for at, token in enumerate(passage.tokens) if id(token) not in inside]
        """The numbers that are in no label, by their place in the passage."""
        text = list(passage.text)
        for first, end in everywhere:
            text[first:end] = " " * (end - first)
        self.text_between = passage.manual.without_names("".join(text))
        """The text with blanks in place of the labels."""

    def found(self, label: Label, after: bool, way: int, is_touching: bool) -> Found:
        """One label, `after` its number or before it."""
        adjacent = label.numbers(way)
        tokens: list[Token] = []
        lines = []
        for first, end in self.spans[label]:
            if label.adjacent:
                number = self._number_before(first) if after else self._number_after(end)
                if number is None or not self.passage.tokens[number].readings & adjacent:
                    continue
                if is_touching and self._has_words_between(number, first, end):
                    continue
                tokens.append(self.passage.tokens[number])
            tokens += self.passage.inside(first, end)
            lines.append(self.passage.line_at(first))
        return Found(len(lines), tuple(tokens), frozenset(lines))

    def _number_before(self, place: int) -> int | None:
        at = bisect_right(self.numbers, place, key=self.passage.ends.__getitem__)
        return self.numbers[at - 1] if at else None

    def _number_after(self, place: int) -> int | None:
        at = bisect_left(self.numbers, place, key=self.passage.starts.__getitem__)
        return self.numbers[at] if at < len(self.numbers) else None

    def _has_words_between(self, number: int, first: int, end: int) -> bool:
        start, stop = self.passage.starts[number], self.passage.ends[number]
        between = self.text_between[stop:first] if start < first else self.text_between[end:start]
        return any(map(str.isalpha, _TAG.sub("", between)))


def _without_inner(spans: set[tuple[int, int]]) -> set[tuple[int, int]]:
    """Return the spans that are not inside a longer one."""
    longest: set[tuple[int, int]] = set()
    end = -1
    for span in sorted(spans, key=lambda span: (span[0], -span[1])):
        if span[1] > end:
            longest.add(span)
            end = span[1]
    return longest


def lies_in_section(section: str, line: int, passage: Passage) -> bool:
    """Return True if a line lies in a numbered section, or below the words of one without a number."""
    manual = passage.manual
    start = manual.line_of_section.get(section)
    if start is not None:
        return start <= line <= manual.end_of_section(section)
    return any(has_word(manual.line(above), section) for above in range(max(1, line - _FAR), line))


_FAR = 400
"""A section without a number is searched for in so many lines above."""


def _reads(token: Token, numbers: frozenset[Fraction], *, binary: bool) -> bool:
    return not token.readings.isdisjoint(numbers) and (binary or token.is_plainly(numbers))
