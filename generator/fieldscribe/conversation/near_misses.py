"""Other readings of a number that lies outside its range: a fixed list, and of it those that lie in range.

Nothing is ranked or inferred: the words swapped, the other sign, and the points one address up and down.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from fieldscribe.arithmetic.codec import Settings
from fieldscribe.arithmetic.words import number_of, pattern_of, raw_of, words_of
from fieldscribe.conversation.meanings import Meanings
from fieldscribe.conversation.refusals import in_range, range_fault
from fieldscribe.model import Device, Point
from fieldscribe.text import line
from fieldscribe.wording import label

Neighbours = Callable[[int], Iterable[Point]]
"""Returns the points that begin at an address of the same space."""


def doubts(device: Device, point: Point, raw: int, settings: Settings, neighbours: Neighbours) -> tuple[str, ...]:
    """Return that a number lies outside the range of its point, then other readings; nothing if it lies in range."""
    fault = range_fault(device, point, raw, settings)
    return (fault, *near_misses(device, point, raw, settings, neighbours)) if fault else ()


def near_misses(device: Device, point: Point, raw: int, settings: Settings, neighbours: Neighbours) -> Iterator[str]:
    """Yield the other readings of a number that lie in range."""
    for text, other, number, tested in _readings(point, raw, words_of(point, raw), neighbours):
        limited = other.allowed.intervals or other.allowed.units or (other.enum is not None and other.enum.closed)
        if limited and in_range(other, tested, settings):
            meaning = Meanings(device, other).of(number, settings)
            if meaning.text and not (meaning.missing or meaning.hint):
                yield line(f"{text} it is {meaning.text}")


def _readings(
    point: Point, raw: int, words: tuple[int, ...], neighbours: Neighbours
) -> Iterator[tuple[str, Point, int, int]]:
    """Yield each other reading: in words, the point, its raw number, and the one that must be in range."""
    if len(words) > 1:
        swapped = raw_of(point, words[::-1])
        yield "with its words swapped", point, swapped, swapped
    if not point.info.floating:
        signed = number_of(pattern_of(point, raw), point.width, signed=True)
        if signed < 0:
            text, number = ("without its sign", -signed) if raw < 0 else ("as a signed number", signed)
            yield text, point, number, -signed
    first = point.addresses[0] if point.addresses else 0
    for name, address in (("up", first + 1), ("down", first - 1)) if point.addresses else ():
        for other in neighbours(address):
            if other.words == len(words) and other.generated and other.readable:
                number = raw_of(other, words)
                yield f"one address {name}, {label(other)},", other, number, number
