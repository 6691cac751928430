"""A line that is written in the layout of the old text, with the words of the new one."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.audit.layout.fingerprint import Text

_CELLS = "|\t"


class Line:
    """A line that is written."""

    def __init__(self, new: Text) -> None:
        self.new, self.text = new, ""
        self.places: list[tuple[int, int, int]] = []
        """The column of each word, with line and column in the new text."""
        self._last, self._was_kept = -1, False

    def put(self, pieces: Iterable[int], gap: str) -> str:
        """Words that were not there, with the cells that the new text has between; what is left of the gap."""
        for piece in pieces:
            own = self.new.gaps[piece]
            if self._last != piece - 1 or self.new.opens_line(piece):
                own = own if not self.text else " "
                own = "" if self._joins(piece) else own
            for sign in [sign for sign in own if sign in _CELLS]:
                if sign in gap:
                    gap = gap.replace(sign, "", 1)
                else:
                    own = own.replace(sign, " ", 1)
            self._put(piece, as_written(own, first=not self.text))
        return gap

    def _joins(self, piece: int) -> bool:
        """Whether a word is the rest of one that a hyphen parts at the end of a line; that goes."""
        parted = self.text.endswith("-") and self.text[-2:-1].isalpha() and self.new.piece(piece)[0].islower()
        if parted:
            self.text = self.text[:-1]
        return parted

    def put_kept(self, piece: int, gap: str, *, is_first: bool) -> None:
        """A word that was there; the gap is the old one, or after new words what is left of it."""
        if is_first and not self.text:
            self._put(piece, as_written(gap, first=True))
        elif not (self._was_kept or gap.strip(" ") or self.new.opens_line(piece)) and self._last == piece - 1:
            self._put(piece, as_written(_without_cells(self.new.gaps[piece])))
        else:
            parted = self._last >= 0 and not self._was_kept and not gap
            self._put(piece, " " if parted else as_written(gap))
        self._was_kept = True

    def _put(self, piece: int, gap: str) -> None:
        self.text += gap
        self.places.append((len(self.text) + 1, self.new.line_of[piece], self.new.columns[piece]))
        self.text += self.new.piece(piece)
        self._last, self._was_kept = piece, False


def joined(gap: str, other: str) -> str:
    """What parts words between which others are gone."""
    signs = "".join(sign for sign in gap + other if sign != " ")
    return signs or max(gap, other, key=len)


def _without_cells(gap: str) -> str:
    return "".join(" " if sign in _CELLS else sign for sign in gap)


def as_written(gap: str, *, first: bool = False, last: bool = False) -> str:
    """A gap as it is written: cells with blanks, breaks as tags."""
    text = gap.replace("<", "<br>").replace("|", " | ")
    text = text.removeprefix(" ") if first and gap.startswith("|") else text
    return text.rstrip() if last else text
