"""The bytes of a worked frame as a manual prints them: number after number, or down a column of a table."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.audit.manual import Token
    from fieldscribe.audit.passage import Passage

_Run: TypeAlias = "tuple[frozenset[Fraction], ...]"

_LONG, _SHORTEST = 4, 2
"""So many numbers of a frame are no chance; so many need to stand right behind each other."""


def ways_of_bytes(digits: str) -> tuple[_Run, _Run]:
    """The numbers of a frame, byte by byte and word by word."""
    bytes_of_frame, words = (
        tuple(frozenset((Fraction(int(digits[at : at + width], 16)),)) for at in range(0, len(digits), width))
        for width in (2, 4)
    )
    return bytes_of_frame, words


def runs_of_bytes(digits: str, passage: Passage) -> Iterator[list[Token]]:
    """The numbers of a frame wherever they follow each other, in the text or down a column."""
    for part in (passage, *passage.columns):
        for way in ways_of_bytes(digits):
            yield from part.in_order(way)


def other_bytes(digits: str, passage: Passage) -> Iterator[Token]:
    """Each number that stands in place of one byte or word of a frame, all others of which stand in their order.

    A frame of a few words has nothing but signs between them: `067E 0000`.
    """
    for part in (passage, *passage.columns):
        for way in ways_of_bytes(digits):
            yield from part.nearly_in_order(way, tight=len(way) < _LONG, least=_SHORTEST)
