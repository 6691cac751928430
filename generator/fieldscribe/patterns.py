"""Text that is laid out once for a shape and filled for each point.

A blank stands in the text for a word that differs from point to point. It is as wide as the word, so lines break where
they would with the word itself: a pattern fits all points of its shape whose words are as wide.
"""

from __future__ import annotations

import re
from operator import itemgetter
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

_BLANKS = (
    *map(chr, range(0xFDD0, 0xFDF0)),
    *(chr((plane << 16) + last) for plane in range(17) for last in (0xFFFE, 0xFFFF)),
)
"""What is no character, which the encoders of `text` never let through."""

_RUN = re.compile("([\ufdd0-\U0010ffff])\\1*")
"""A run of one sign: of a blank, or of a rare sign that is none. One range is found faster than many signs."""
_NUMBERS = {blank: number for number, blank in enumerate(_BLANKS)}


def blanks(words: Iterable[str]) -> tuple[str, ...]:
    """A blank for each word, as wide as it is; at most 66. An empty word stays empty, so it is part of the shape."""
    return tuple(_BLANKS[number] * len(word) for number, word in enumerate(words))


def widths(words: Iterable[str]) -> tuple[int, ...]:
    """What tells the patterns of a shape apart."""
    return tuple(map(len, words))


class Pattern:
    """A text with blanks. Two blanks of the same word never touch."""

    def __init__(self, text: str) -> None:
        parts = [text] if text.isascii() else _RUN.split(text)
        signs = parts[1::2]
        if not _NUMBERS.keys() >= set(signs):
            parts = _around_blanks(text)
            signs = parts[1::2]
        self._parts = parts
        self._words = _getter([_NUMBERS[sign] for sign in signs])

    def filled(self, words: Sequence[str]) -> str:
        """The text with these words, in the order in which the blanks were made."""
        parts = self._parts.copy()
        parts[1::2] = self._words(words)
        return "".join(parts)


def _around_blanks(text: str) -> list[str]:
    """What stands between blanks, and the sign of each, for a text that has other rare signs too."""
    parts, at = [], 0
    for run in _RUN.finditer(text):
        if run[1] in _NUMBERS:
            parts += [text[at : run.start()], run[1]]
            at = run.end()
    return [*parts, text[at:]]


def _getter(numbers: list[int]) -> Callable[[Sequence[str]], Sequence[str]]:
    """A function that takes the words of these numbers."""
    if len(numbers) > 1:
        return itemgetter(*numbers)
    return lambda words: [words[number] for number in numbers]
