"""Commands that are several requests in order, each with the words that follow from the arguments of the command."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.model.numbers import Titles
from fieldscribe.model.point import Source

if TYPE_CHECKING:
    from fieldscribe.conditions import Condition

WHOLE_WORD = 0xFFFF


@dataclass(frozen=True, slots=True)
class Word:
    """A word of a step: constant + factor * argument, modulo 65536. Bits outside `mask` stay as the device has them."""

    constant: int
    factor: int = 0
    argument: str | None = None
    mask: int = WHOLE_WORD

    def __str__(self) -> str:
        """Return the formula: `65535 - unit`."""
        if self.argument is None:
            return str(self.constant)
        product = self.argument if abs(self.factor) == 1 else f"{abs(self.factor)} * {self.argument}"
        sign = "-" if self.factor < 0 else "+"
        return product if sign == "+" and not self.constant else f"{self.constant} {sign} {product}"

    def of(self, arguments: Mapping[str, int]) -> int:
        """Return the word with these arguments; 0 outside the mask."""
        return (self.constant + (self.factor * arguments[self.argument] if self.argument else 0)) & self.mask


@dataclass(frozen=True, slots=True)
class Step:
    """One request: it writes words with the function `write`, or reads with `read` until all words are these.

    With both functions, words are read first, and what is outside the masks is written as it was. `within` are the
    milliseconds that the words may take to come. `says` is what the author says: points with their values, or words.
    `base` is the name of what the address counts from; None if that is 0.
    """

    space: str
    address: int
    words: tuple[Word, ...]
    read: int | None
    write: int | None
    within: int | None
    when: Condition | None
    says: str
    base: str | None = None

    def arguments_in(self, words: Sequence[int], ends: Mapping[str, tuple[int, int]]) -> dict[str, int] | None:
        """Return the arguments, within these ends, that give the words; None if none do."""
        given: dict[str, int] = {}
        for word, number in zip(self.words, words, strict=True):
            if word.argument is not None and word.argument not in given:
                low, high = ends[word.argument]
                numbers = range(low, high + 1)
                given[word.argument] = next((one for one in numbers if word.of({word.argument: one}) == number), low)
            if word.of(given) != number & word.mask:
                return None
        return given


@dataclass(frozen=True, slots=True)
class SteppedCommand:
    """Requests in order under a name. `every` are the milliseconds after which it is given again, if `run` says so.

    `arguments` are the least and the greatest number of each that whoever gives the command chooses.
    """

    name: str
    title: Titles
    note: Titles
    run: str
    every: int | None
    arguments: Mapping[str, tuple[int, int]]
    steps: tuple[Step, ...]
    source: Source
