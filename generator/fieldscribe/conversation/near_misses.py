"""Other readings of a number that lies outside its range: a fixed list, and of it those that lie in range.

Nothing is ranked or inferred: the words swapped, the other sign, and the points one address up and down.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from fieldscribe.arithmetic.codec import Settings
from fieldscribe.arithmetic.words import number_of, pattern_of, reader_of, words_of
from fieldscribe.conversation.meanings import Meanings
from fieldscribe.conversation.refusals import in_range, range_fault, range_of
from fieldscribe.model import Device, Point
from fieldscribe.text import line
from fieldscribe.wording import label

Neighbours = Callable[[int], Iterable[Point]]
"""Returns the points that begin at an address of the same space."""


class Doubts:
    """What speaks against the numbers of a point: made once, since its limits and its neighbours stay."""

    def __init__(self, device: Device, point: Point, neighbours: Neighbours) -> None:
        self._device, self._point, self._fits = device, point, _range_test(point)
        self._meanings, self._range = Meanings(device, point), ""
        self._is_plain = point.form in ("scaled", "integer") and not (point.limit_arguments or point.fixed)
        self._read, self._swaps = reader_of(point), point.words > 1
        self._is_limited, self._is_signed = _is_limited(point), not point.info.floating
        first = point.addresses[0] if point.addresses else 0
        others = [
            (f"one address {name}, {label(other)},", other)
            for name, address in ((("up", first + 1), ("down", first - 1)) if point.addresses else ())
            for other in neighbours(address)
            if other.words == point.words and other.generated and other.readable and _is_limited(other)
        ]
        self._others = [(text, reader_of(one), _range_test(one), Meanings(device, one)) for text, one in others]

    def of(self, raw: int, settings: Settings, meaning: str) -> tuple[str, ...]:
        """Return that a number lies outside the range, then the other readings; nothing if it lies in range.

        `meaning` is what the number means.
        """
        if self._fits(raw, settings):
            return ()
        if self._is_plain and meaning:
            self._range = self._range or range_of(self._device, self._point, settings)
            fault = line(f"{meaning} is outside {self._range}")
        else:
            fault = range_fault(self._device, self._point, raw, settings)
        return (fault, *self._near_misses(raw, settings)) if fault else ()

    def _near_misses(self, raw: int, settings: Settings) -> Iterator[str]:
        """Yield the other readings that lie in range and have a meaning."""
        words = words_of(self._point, raw)
        for text, number, meanings in self._readings(raw, words, settings):
            meaning = meanings.of(number, settings)
            if meaning.text and not (meaning.missing or meaning.hint):
                yield line(f"{text} it is {meaning.text}")

    def _readings(self, raw: int, words: tuple[int, ...], settings: Settings) -> Iterator[tuple[str, int, Meanings]]:
        """Yield each other reading that lies in range: in words, its raw number, and what that means."""
        if self._is_limited and self._swaps and self._fits(number := self._read(words[::-1]), settings):
            yield "with its words swapped", number, self._meanings
        if self._is_limited and self._is_signed:
            signed = number_of(pattern_of(self._point, raw), self._point.width, signed=True)
            if signed < 0 and self._fits(-signed, settings):
                text, number = ("without its sign", -signed) if raw < 0 else ("as a signed number", signed)
                yield text, number, self._meanings
        for text, read, fits, meanings in self._others:
            if fits(number := read(words), settings):
                yield text, number, meanings


def _is_limited(point: Point) -> bool:
    """Return True if the manual limits the numbers of a point."""
    return bool(point.allowed.intervals or point.allowed.units or (point.enum is not None and point.enum.closed))


def _range_test(point: Point) -> Callable[[int, Settings], bool]:
    """Return the function that `in_range` is for this point."""
    spans = [(span.low, span.high) for span in point.allowed.intervals]
    ends = [(low, high) for low, high in spans if isinstance(low, int) and isinstance(high, int)]
    special = point.specials or point.fixed or point.digits or point.info.floating
    if special or len(ends) < len(spans) or not ends:
        return lambda raw, settings: in_range(point, raw, settings)
    least, greatest = point.least, point.greatest
    return lambda raw, _: least <= raw <= greatest and any(low <= raw <= high for low, high in ends)
