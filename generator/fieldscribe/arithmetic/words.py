"""Raw numbers in 16-bit words (high part first), in bits of a word that points share, and in other codings."""

from collections.abc import Callable, Iterable, Sequence
from operator import itemgetter
from struct import unpack_from

from fieldscribe.model import Point, Special

BCD = "bcd"
"""Decimal digits of four bits each. Bits that are not such a number represent one with too many digits."""

MAGNITUDE = "sign and magnitude"
"""The highest bit is the sign of the number in the others; minus zero reads as 0."""


def coded_ends(width: int, coding: str) -> tuple[int, int]:
    """Return the least and the greatest number that this many bits can hold."""
    if coding == BCD:
        return 0, int(10 ** (width // 4)) - 1
    most = (1 << width - 1) - 1
    return -most, most


def coded_number(pattern: int, width: int, coding: str) -> int:
    """Return the number in a pattern; for invalid digits, the pattern itself or the least number that is too long.

    So a code such as FFFFh, which has no decimal digits, stays a distinct number.
    """
    if coding == MAGNITUDE:
        sign = 1 << width - 1
        return sign - pattern if pattern & sign else pattern
    digits = f"{pattern:0{width // 4}x}"
    return int(digits) if digits.isdecimal() else max(pattern, coded_ends(width, coding)[1] + 1)


def coded_pattern(raw: int, width: int, coding: str) -> int:
    """Return the pattern of a number; one with too many digits is a pattern."""
    if coding == MAGNITUDE:
        return abs(raw) & (1 << width - 1) - 1 | (raw < 0) << width - 1
    return raw if raw > coded_ends(width, coding)[1] else int(str(raw), 16)


def ends_of(width: int, *, signed: bool) -> tuple[int, int]:
    """Return the least and the greatest number of a type with this many bits."""
    return (-(1 << (width - 1)), (1 << (width - 1)) - 1) if signed else (0, (1 << width) - 1)


def fits(numbers: Iterable[int], bits: int) -> bool:
    """Return True if a signed integer of this many bits holds all the numbers."""
    low, high = ends_of(bits, signed=True)
    return all(low <= number <= high for number in numbers)


INT32 = ends_of(32, signed=True)
INT64 = ends_of(64, signed=True)
UINT64 = ends_of(64, signed=False)


def mask_of(width: int, low: int = 0) -> int:
    """Return a mask of `width` ones from bit `low` on."""
    return ((1 << width) - 1) << low


def number_of(pattern: int, width: int, *, signed: bool) -> int:
    """Return the number in a pattern of `width` bits, read as two's complement if it is signed."""
    return pattern - (1 << width) if signed and pattern >> (width - 1) else pattern


def joined(words: Iterable[int]) -> int:
    """Return the words as one unsigned number."""
    pattern = 0
    for word in words:
        pattern = pattern << 16 | word
    return pattern


def words_in(data: bytes) -> tuple[int, ...]:
    """Return the words in the data, without a single last byte."""
    count = len(data) >> 1
    return unpack_from(f">{count}H", data)


def split(raw: int, count: int) -> tuple[int, ...]:
    """Return a number as `count` unsigned words."""
    return tuple(raw >> 16 * place & 0xFFFF for place in reversed(range(count)))


def exchanged(point: Point, *words: int) -> tuple[int, ...]:
    """Return words with the bytes in the order of the point: exchanged if its low byte comes first."""
    return tuple([(word & 0xFF) << 8 | word >> 8 for word in words]) if point.swapped else words


def raw_of(point: Point, words: Sequence[int]) -> int:
    """Return the raw number of a point from its words, high part first; for a text, all words as one number."""
    pattern = joined(exchanged(point, *words))
    if point.text is not None:
        return pattern
    low = 0 if point.bits is None else point.bits[1]
    pattern = pattern >> low & mask_of(point.width)
    if point.coding:
        return coded_number(pattern, point.width, point.coding)
    return number_of(pattern, point.width, signed=point.info.signed)


def reader_of(point: Point, places: Sequence[int] = ()) -> Callable[[Sequence[int]], int]:
    """Return a function that does for this point what `raw_of` does, and is quicker.

    `places` are those of the point's words among the words that it is given, if not from 0 on.
    """
    places = places or range(point.words)
    first, second = places[0], places[-1]
    low, mask = point.bits[1] if point.bits else 0, mask_of(point.width)
    top = 1 << point.width - 1 if point.info.signed else 0
    if point.text is not None or point.coding or point.swapped or point.words not in (1, 2):
        return lambda words: raw_of(point, [words[place] for place in places])
    if point.words == 2:
        return lambda words: ((words[first] << 16 | words[second]) >> low & mask ^ top) - top
    if top:
        return lambda words: (words[first] >> low & mask ^ top) - top
    return itemgetter(first) if mask == 0xFFFF else lambda words: words[first] >> low & mask


def pattern_of(point: Point, raw: int) -> int:
    """Return the bits of a raw number; of a negative one, with the sign in all bits above."""
    return coded_pattern(raw, point.width, point.coding) if point.coding else raw


def words_of(point: Point, raw: int, count: int = 0) -> tuple[int, ...]:
    """Return the unsigned words of a raw number: `count` words if given, else as many as the point has."""
    return exchanged(point, *split(pattern_of(point, raw), count or point.words))


def group_mask(point: Point) -> int:
    """Return the mask of the bits that a point takes in its word."""
    return 0xFFFF if point.bits is None else mask_of(point.width, point.bits[1])


def insert(point: Point, word: int, raw: int) -> int:
    """Return the word with the bits of a point replaced and its constant bits set."""
    low = 0 if point.bits is None else point.bits[1]
    mask = group_mask(point)
    word = exchanged(point, word)[0] & ~mask & 0xFFFF | pattern_of(point, raw) << low & mask
    return exchanged(point, word if point.fixed is None else word & ~point.fixed.mask | point.fixed.bits)[0]


def with_fixed(point: Point, raw: int) -> int:
    """Return the raw number of a whole word with its constant bits set."""
    if point.fixed is None or point.bits is not None:
        return raw
    pattern = (raw & ~point.fixed.mask | point.fixed.bits) & mask_of(point.width)
    return number_of(pattern, point.width, signed=point.info.signed)


def ends_without(codes: Iterable[Special], low: int, high: int) -> tuple[int, int]:
    """Return the ends of an interval of raw numbers without the special codes at them."""
    for code in sorted(codes, key=lambda code: code.low):
        low = code.high + 1 if code.low <= low <= code.high else low
    for code in sorted(codes, key=lambda code: -code.high):
        high = code.low - 1 if code.low <= high <= code.high else high
    return low, high
