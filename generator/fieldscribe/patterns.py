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

_BLANK = re.compile("|".join(f"{blank}+" for blank in _BLANKS))
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
        numbers = [_NUMBERS[blank[0][0]] for blank in _BLANK.finditer(text)]
        self._text = _BLANK.sub("%s", text.replace("%", "%%"))
        self._words: Callable[[Sequence[str]], object] = itemgetter(*numbers) if numbers else lambda _: ()

    def filled(self, words: Sequence[str]) -> str:
        """The text with these words, in the order in which the blanks were made."""
        return self._text % self._words(words)
