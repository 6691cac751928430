"""A piece of a manual's text as the claims read it: its numbers in order, and its letters without layout."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from functools import cached_property
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from fractions import Fraction

    from fieldscribe.audit.manual import Manual, Token

_TAG = re.compile(r"</?[A-Za-z]{1,6}/?>")

_SHORT_LINE = re.compile(r"(?:\w\W{1,3})?[^\W\d]+ [0-9]+\W*")
_LISTED = 4
"""So many numbers make a list that is known though another one stands in place of one of them."""


def letters_of(text: str) -> str:
    """Letters and digits alone, in small letters: blanks, hyphens and line breaks are layout."""
    return "".join(char for char in text.casefold() if char.isalnum())


class Passage:
    """Pieces of text, each with the line and column (from 0) where it begins."""

    def __init__(self, manual: Manual, pieces: Iterable[tuple[int, int, str]]) -> None:
        self.manual = manual
        self.tokens: list[Token] = []
        self.starts: list[int] = []
        self.ends: list[int] = []
        self.pieces = list(pieces)
        texts: list[str] = []
        length = 0
        for line, column, text in self.pieces:
            for token in manual.tokens_in(text, line, column):
                self.tokens.append(token)
                self.starts.append(length + token.column - 1 - column)
                self.ends.append(self.starts[-1] + len(token.text))
            texts.append(text)
            length += len(text) + 1
        self.text = "\n".join(texts)

    @cached_property
    def folded(self) -> str:
        """The text in small letters."""
        return self.text.casefold()

    @cached_property
    def _letters(self) -> tuple[str, list[int]]:
        """The letters, and where each stands in the text."""
        shown = _TAG.sub(lambda tag: " " * len(tag[0]), self.text)
        letters, places = [], []
        for place, char in enumerate(shown):
            if char.isalnum():
                for letter in char.casefold():
                    letters.append(letter)
                    places.append(place)
        return "".join(letters), places

    def places(self, words: str) -> Iterator[tuple[int, int]]:
        """Where words stand by themselves: first place and the place behind the last letter."""
        wanted = letters_of(words)
        letters, places = self._letters
        at = letters.find(wanted) if wanted else -1
        while at >= 0:
            first, last = places[at], places[at + len(wanted) - 1]
            if self._opens(first, wanted) and self._closes(last):
                yield first, last + 1
            at = letters.find(wanted, at + 1)

    def _opens(self, place: int, wanted: str) -> bool:
        """Whether a word may begin here: tables lose their gaps, and a capital or a digit tells where a cell began."""
        before, char = self.text[place - 1 : place] if place else "", self.text[place]
        glued = char.isupper() or (char.isdigit() and before.isalpha() and not wanted.isdigit())
        return not before.isalnum() or glued

    def _closes(self, place: int) -> bool:
        char, after = self.text[place], self.text[place + 1 : place + 2]
        return not after.isalnum() or (char.isalpha() and (after.isdigit() or after.isupper()))

    def parts(self, first: int, end: int) -> Iterator[tuple[int, int, int]]:
        """What lies between two places, line by line: line, column (from 1) and width."""
        start = 0
        for line, column, text in self.pieces:
            here, there = max(first, start), min(end, start + len(text))
            if here < there:
                yield line, column + here - start + 1, there - here
            start += len(text) + 1

    def column(self, place: int) -> int | None:
        """The column of a table in which a place lies; None outside of tables."""
        start = 0
        for line, column, text in self.pieces:
            if place <= start + len(text):
                return self.manual.column(line, column + place - start)
            start += len(text) + 1
        return None

    @cached_property
    def _openings(self) -> dict[int, Token | None]:
        """The number that stands alone in the first cell of each row; None where several do."""
        if self.in_first_cell is self.tokens:
            return {}
        alone: dict[int, Token | None] = {}
        for token in self.in_first_cell:
            alone[token.line] = None if token.line in alone else token
        return alone

    @property
    def opening_rows(self) -> list[Token]:
        """The numbers that stand alone in the first cell of a row."""
        return [token for token in self._openings.values() if token is not None]

    def behind(self, opening: frozenset[Fraction]) -> list[Token]:
        """The numbers in the row that such a number alone opens; none if not exactly one row begins so."""
        opens = [line for line, token in self._openings.items() if token is not None and token.is_plainly(opening)]
        if len(opens) != 1:
            return []
        end = opens[0] + 1
        while self.manual.is_merged(end) or self.manual.line(end).startswith("\t"):
            end += 1
        first = set(map(id, self.in_first_cell))
        return [token for token in self.tokens if opens[0] <= token.line < end and id(token) not in first]

    def under(self, head: frozenset[Fraction]) -> list[Token]:
        """The numbers in the column of a number that a table's head counts, in the row below the head."""
        rows: dict[int, list[Token]] = {}
        for token in self.tokens:
            rows.setdefault(token.line, []).append(token)
        below: list[Token] = []
        for line, heads in rows.items():
            counts = len(heads) >= _LISTED and all(at in token.readings for at, token in enumerate(heads))
            columns = {self._column_of(token) for token in heads if counts and token.is_plainly(head)} - {None}
            below += (token for token in rows.get(line + 1, ()) if self._column_of(token) in columns)
        return below

    def _column_of(self, token: Token) -> int | None:
        return self.manual.column(token.line, token.column - 1)

    @cached_property
    def of_short_lines(self) -> Passage:
        """The lines that are nothing but a name and a number, as `b.) Byte 1`."""
        return Passage(self.manual, [piece for piece in self.pieces if _SHORT_LINE.fullmatch(piece[2])])

    @cached_property
    def columns(self) -> list[Passage]:
        """The columns of its tables, each as a passage of its own."""
        cells: dict[int, list[tuple[int, int, str]]] = {}
        for line, column, text in self.pieces:
            for cell in re.finditer(r"[^|]+" if text.startswith("|") else r"[^\t]+", text):
                place = self.manual.column(line, column + cell.start())
                if place is not None:
                    cells.setdefault(place, []).append((line, column + cell.start(), cell[0]))
        return [Passage(self.manual, cells[place]) for place in sorted(cells)]

    def part(self, own: frozenset[Fraction], others: frozenset[Fraction]) -> Passage:
        """What stands behind each number of one's own, up to the next number of others."""
        cuts = [at for at, token in enumerate(self.tokens) if token.readings & others]
        spans = [
            (self.starts[at], self.starts[following] if following is not None else len(self.text))
            for at, following in zip(cuts, (*cuts[1:], None), strict=False)
            if self.tokens[at].readings & own
        ]
        pieces = []
        start = 0
        for line, column, text in self.pieces:
            for first, end in spans:
                inside = text[max(0, first - start) : max(0, end - start)]
                if inside:
                    pieces.append((line, column + max(0, first - start), inside))
            start += len(text) + 1
        return Passage(self.manual, pieces)

    def pieces_of_bytes(self, digits: str) -> Iterator[tuple[int, int]]:
        """Where these digits stand in one piece, blanks aside; in place of a checksum may stand a word."""
        for pattern in (digits, f"{digits[:-4]}(?=CRC)"):
            spaced = r"\s*".join(re.findall(r"[0-9A-F]|\(.*\)", pattern))
            for match in re.finditer(spaced, self.text, re.IGNORECASE):
                yield match.span()

    def overlapping(self, first: int, end: int) -> list[Token]:
        """The numbers of which a part stands between two places."""
        return self.tokens[bisect_right(self.ends, first) : bisect_left(self.starts, end)]

    def inside(self, first: int, end: int) -> list[Token]:
        """The numbers that stand in a part of the text."""
        return self.tokens[bisect_left(self.starts, first) : bisect_left(self.starts, end)]

    def start_of(self, token: Token) -> int:
        """Where a number begins in the text."""
        return self.starts[self.tokens.index(token)]

    def end_of(self, token: Token) -> int:
        """The place behind a number in the text."""
        return self.ends[self.tokens.index(token)]

    def has_signs_alone(self, first: Token, last: Token) -> bool:
        """Whether no letters stand between two numbers."""
        return not any(map(str.isalpha, self.text[self.end_of(first) : self.start_of(last)]))

    def follows_as_entry(self, token: Token, end: int) -> bool:
        """Whether a number follows in the same cell as a place, with signs and a word behind it."""
        between = self.text[end : self.start_of(token)]
        in_cell = not any(char.isalpha() or char in "|\t\n" for char in between)
        return in_cell and re.match(r"[\s.=:-]*[^\W\d]", self.text[self.end_of(token) :]) is not None

    def before(self, place: int) -> Token | None:
        """The last number that ends before a place."""
        at = bisect_right(self.ends, place)
        return self.tokens[at - 1] if at else None

    def after(self, place: int) -> Token | None:
        """The first number from a place on."""
        at = bisect_left(self.starts, place)
        return self.tokens[at] if at < len(self.tokens) else None

    def is_apart(self, token: Token, first: int, end: int) -> bool:
        """Whether letters stand between a number and words from first to end."""
        at = self.tokens.index(token)
        between = self.text[self.ends[at] : first] if self.starts[at] < first else self.text[end : self.starts[at]]
        return any(map(str.isalnum, self.manual.without_names(_TAG.sub("", between))))

    def reading(self, numbers: frozenset[Fraction]) -> list[Token]:
        """The numbers that can mean one of these."""
        return [token for token in self.tokens if token.readings & numbers]

    def behind_names(self, names: tuple[str, ...]) -> list[Token]:
        """The numbers that stand right behind one of these names, as in `Mux 3` or `Default: 0`."""
        pattern = rf"(?<!\w)(?:{'|'.join(map(re.escape, names))})(?:\s*[:=])?\s*(?=[0-9])"
        return [
            token for match in re.finditer(pattern, self.text) for token in self.inside(match.end(), match.end() + 1)
        ]

    def joins(self, names: tuple[str, ...]) -> bool:
        """Whether the passage writes such a name and a number in one word, as in `PZD2`."""
        return re.search(rf"(?<!\w)(?:{'|'.join(map(re.escape, names))})[0-9]+(?!\w)", self.text) is not None

    @cached_property
    def in_first_cell(self) -> list[Token]:
        """The numbers in the first cell of each row; all where there are no cells."""
        cells = [match.span() for match in re.finditer(r"^\|?[^|\t\n]*(?=[|\t])", self.text, re.MULTILINE)]
        return [token for first, end in cells for token in self.inside(first, end)] if cells else self.tokens

    def words_behind(self, tokens: Iterable[Token], words: tuple[str, ...]) -> list[list[tuple[int, int]]]:
        """Where one of these words stands in the line of each number, behind it: first place and the place behind."""
        spans = [span for word in words for span in self.places(word)]
        behind = []
        for first in map(self.end_of, tokens):
            end = self.text.find("\n", first)
            behind.append([span for span in spans if first <= span[0] and (end < 0 or span[0] < end)])
        return behind

    def is_followed_by(self, token: Token, words: str) -> bool:
        """Whether words stand right behind a number, such as its unit."""
        at = self.end_of(token)
        return self.text[at : at + len(words) + 2].lstrip().startswith(words)

    def nearly_in_order(
        self, numbers: tuple[frozenset[Fraction], ...], *, tight: bool = False, least: int = _LISTED
    ) -> Iterator[Token]:
        """Each number that stands in place of one of a list, which are enough (`least`) to be known without it.

        One between the first, or the last, and all others is no such number: the list is whole.
        """
        for at in range(len(self.tokens) - len(numbers) + 1 if len(numbers) >= least else 0):
            end = at + len(numbers)
            run = self.tokens[at:end]
            others = [token for token, wanted in zip(run, numbers, strict=True) if not token.readings & wanted]
            if len(others) != 1 or (tight and not self.has_signs_alone(run[0], run[-1])):
                continue
            before, behind = self.tokens[max(0, at - 1) : at], self.tokens[end : end + 1]
            put_between = (others[0] is run[0] and any(token.readings & numbers[0] for token in before)) or (
                others[0] is run[-1] and any(token.readings & numbers[-1] for token in behind)
            )
            if not put_between:
                yield others[0]

    def in_order(self, numbers: tuple[frozenset[Fraction], ...]) -> Iterator[list[Token]]:
        """Each run of numbers that follow each other as these do, with no other number between them."""
        for at in range(len(self.tokens) - len(numbers) + 1):
            run = self.tokens[at : at + len(numbers)]
            if all(token.readings & wanted for token, wanted in zip(run, numbers, strict=True)):
                yield run
