"""Vectors of numbers: raw numbers with their values in binary64, and with their counts of 10^-decimals units.

Then those of names, special codes, flags, bit groups and words. `collection` asks for all of a point.
"""

from collections.abc import Callable, Iterable, Iterator
from functools import cache
from math import inf, isfinite, isnan, nan, nextafter
from typing import Any

from fieldscribe.arithmetic.words import mask_of
from fieldscribe.model import Shape
from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.lines import Lines, real, text
from fieldscribe.targets.vectors.oracle import (
    INT64,
    WHOLE,
    Oracle,
    Ratio,
    admit,
    as_pattern,
    as_raw,
    code_of,
    half_away,
    quantity_at_most,
    quotient,
)
from fieldscribe.targets.vectors.samples import PointEncoding

INT32 = 1 << 31
OTHER_BITS = 0xA5C3
"""The bits of a shared word around those of the point."""
_CODED = (0x1234_5678_9012_3456, 0x9999_9999_9999_9999, 0x0102_0304_8506_9708)
"""Samples of decimal digits, of which a shorter number has the last ones."""
_NARROW = (0x8000, 0x8001, 0xFFFD, 0x7FFE)
"""Samples of a signed word: the least number, negative odd numbers, a positive number."""

Questions = tuple[str, Callable[[Any], str], Iterable[Any]]
"""A kind of vector, the function that answers what is asked, and what is asked."""

Memory = dict[tuple[int, Ratio], "Conversions"]
"""The conversions so far, by shape and ratio."""


def numbers(lines: Lines, oracle: Oracle, encoding: PointEncoding, memory: Memory, *, deep: bool) -> None:
    """Add vectors of a number for each setting of the points that it needs; fewer unless `deep`."""
    shape, full = encoding.shape, deep
    kinds = _kinds(shape)
    for settings in samples.settings(oracle, encoding, deep=deep):
        if settings:
            lines.set("with", settings)
        ratio = oracle.ratio(shape, settings) if shape.form == "scaled" else WHOLE
        limits = oracle.limits(shape, encoding.allowed, settings)
        if isinstance(ratio, str):
            questions = _without_rule(shape, ratio)
        elif isinstance(limits, str):
            questions = _without_limits(encoding, ratio, limits)
        else:
            if (key := (id(shape), ratio)) not in memory:
                memory[key] = Conversions(shape, ratio)
            questions = _Numbers(encoding, memory[key], limits).questions(deep=deep, full=full)
            full = full and shape.form != "scaled"
        for kind, answer, samples_of_kind in questions:
            if kinds[kind]:
                lines.add_answers(kind, answer, samples_of_kind, real if kind == "encode" else str)
    if shape.writable and shape.form == "scaled" and not shape.encodes_values:
        lines.add("encode_refused", 1.0, "wrong_type")


def _kinds(shape: Shape) -> dict[str, bool]:
    """Return the kinds of vectors, and whether a number has them: without a scale, its count is the raw number."""
    scaled, counted = shape.form == "scaled", shape.form != "scaled" or shape.decimals is not None
    return {
        "decode": shape.readable and scaled,
        "decode_count": shape.readable and counted,
        "encode": shape.writable and scaled and shape.encodes_values,
        "encode_count": shape.writable and counted,
        "check": shape.writable,
    }


def _without_rule(shape: Shape, status: str) -> Iterator[Questions]:
    """Yield what is asked under a setting under which nothing can be computed."""
    raw = quantity_at_most(shape, 1)
    for kind, question in (("decode", raw), ("decode_count", raw), ("encode", 1.0), ("encode_count", 1)):
        yield kind, lambda _: status, (question,)
    yield "encode", lambda _: "not_a_number", (nan,)


def _without_limits(encoding: PointEncoding, ratio: Ratio, status: str) -> Iterator[Questions]:
    """Yield what is asked under a setting under which only the limits cannot be computed.

    It is inside the outer bounds of the limit, so that only the limit itself can refuse it.
    """
    shape = encoding.shape
    raw = quantity_at_most(shape, samples.limits_of(encoding.allowed)[0].greatest)
    yield "encode", lambda _: status, (quotient(ratio.numerator(raw), ratio.denominator),)
    yield "encode_count", lambda _: status, (ratio.count_of_raw(raw, shape.decimals or 0),)
    yield "check", lambda _: status, (raw,)


def code_answer(shape: Shape, raw: int) -> str:
    """Return what decoding answers for a special code; empty for any other raw number."""
    code = code_of(shape, raw) if shape.specials else None
    return "" if code is None else f"special\t-\t{text(code.name)}"


class Conversions:
    """Converts between raw numbers, values and counts of one shape under one ratio; remembers each number.

    It knows no limits, so points with different limits share it.
    """

    def __init__(self, shape: Shape, ratio: Ratio) -> None:
        self.shape, self.ratio, self.under, self.tens = shape, ratio, ratio.denominator, 10 ** (shape.decimals or 0)
        self.decode, self.decode_count, self.count = cache(self._decode), cache(self._decode_count), cache(self._count)
        self.raw_of_value = cache(ratio.raw_of_float)
        self.raw_of_count = cache(lambda count: ratio.raw_of_count(count, shape.decimals or 0))
        self.ends = [self.count(raw) for raw in (shape.least, shape.greatest)]

    def _decode(self, raw: int) -> str:
        """Return status and value; empty if languages may differ in the last place."""
        shape = self.shape
        if shape.specials and (special := code_answer(shape, raw)):
            return special
        if self._is_too_large(raw):
            return "overflow"
        is_exact = not (shape.scale_arguments and shape.encodes_values) or self.ratio.divides_exactly(raw)
        return f"ok\t{real(self.ratio.numerator(raw) / self.under)}" if is_exact else ""

    def _decode_count(self, raw: int) -> str:
        """Return status and count; empty for an integer of 64 bits whose sign languages see differently."""
        shape, count = self.shape, self.count(raw)
        if shape.specials and (special := code_answer(shape, raw)):
            return special
        if -INT64 <= count < INT64 and not self._is_too_large(raw):
            return f"ok\t{count}"
        return "overflow" if shape.form == "scaled" else ""

    def _count(self, raw: int) -> int:
        return half_away(self.ratio.numerator(raw) * self.tens, self.under)

    def _is_too_large(self, raw: int) -> bool:
        """Return True if a raw number is too large to compute with."""
        most = self.shape.most_raw
        return most is not None and abs(raw) > most


class _Numbers:
    """The right answers for an encoding under one setting that allows computing, and what is asked."""

    def __init__(self, encoding: PointEncoding, by: Conversions, limits: samples.Limits) -> None:
        self.encoding, self.shape, self.by, self.ratio, self.limits = encoding, encoding.shape, by, by.ratio, limits

    def questions(self, *, deep: bool, full: bool) -> Iterator[Questions]:
        """Yield what is asked; `full` for the first setting of the first encoding that is computed in this way."""
        encoding, shape, limits = self.encoding, self.shape, self.limits
        decoded = samples.raws_to_decode(encoding, limits, deep=deep)
        checked = samples.raws_to_check(encoding, limits, deep=deep)
        edges = samples.edges(limits if deep else samples.limits_to_try(limits))
        counted = [*edges, *samples.codes(shape)] if deep else [*edges]
        if shape.form != "scaled":
            if deep:
                decoded = checked = [*checked, *decoded]
                counted += (shape.least - 1, shape.greatest + 1)
            counted += decoded
        yield "decode", self.by.decode, [*decoded, *samples.raws_telling_division(shape, self.ratio)]
        yield "decode_count", self.by.decode_count, [*decoded, *self._widest()]
        yield "encode", self._encode, self._values(counted, deep=deep, full=full)
        yield "encode_count", self._encode_count, self._counts(counted, deep=deep, full=full)
        if full or not deep or encoding.allowed.arguments:
            yield "check", self._check, checked

    def _encode(self, value: float) -> str:
        if not isfinite(value):
            return "not_a_number" if isnan(value) else "out_of_range"
        return self._put(self.by.raw_of_value(value))

    def _encode_count(self, count: int) -> str:
        return self._put(self.by.raw_of_count(count))

    def _put(self, raw: int | None) -> str:
        """Return the status of a raw number that was computed, and the raw number if it may be written."""
        if raw is None:
            return "out_of_range"
        put = raw if self.shape.fixed is None else self.encoding.with_fixed(raw)
        status = admit(self.shape, put, self.limits, by_value=True)
        return f"ok\t{put}" if status == "ok" else status

    def _check(self, raw: int) -> str:
        """Return the status of a raw number that is written directly."""
        shape = self.shape
        fits = shape.fixed is None or self.encoding.with_fixed(raw) == raw or code_of(shape, raw) is not None
        return admit(shape, raw, self.limits) if fits else "out_of_range"

    def _values(self, raws: Iterable[int], *, deep: bool, full: bool) -> Iterator[float]:
        """Yield the values of raw numbers, those a quarter of a step beyond the limits, halves, and no numbers."""
        ratio, low, high = self.ratio, self.limits[0][0], self.limits[-1][1]
        step = ratio.numerator(1) - ratio.numerator(0)
        quarters = [4 * ratio.numerator(raw) for raw in raws]
        quarters += [4 * ratio.numerator(low) - step, 4 * ratio.numerator(high) + step]
        yield from (quotient(over, 4 * self.by.under) for over in quarters)
        for half in samples.halves(ratio, self.limits) if deep else ():
            yield from (half, nextafter(half, 0.0))
        if full:
            yield from (-0.0, nan, inf, -inf, 1e300)

    def _counts(self, raws: Iterable[int], *, deep: bool, full: bool) -> Iterator[int]:
        """Yield the counts of raw numbers, around halves, and the ends of integers, as far as they hold the type."""
        narrow = (
            all(-INT32 <= end < INT32 for end in self.by.ends)
            if self.shape.form == "scaled"
            else self.shape.width <= 16
        )
        edge = INT32 if narrow else INT64  # the first count beyond the integers that hold all counts of the type
        counts = [*map(self.by.count, raws), *(self._halves() if deep else ())]
        if full:
            counts += [INT32 - 1, -INT32, edge - 1, -edge]
        yield from (count for count in counts if -edge <= count < edge)

    def _halves(self) -> Iterator[int]:
        """Yield the counts around the halves at the outer limits; none where each count is a raw number."""
        ratio, power = self.ratio, self.by.tens
        if self.by.under == power * abs(ratio.den) * ratio.under:
            return
        low, high = self.limits[0][0], self.limits[-1][1]
        for raw in (low - 1, low, high - 1, high):
            over = (ratio.numerator(raw) + ratio.numerator(raw + 1)) * power
            below, rest = divmod(over, 2 * self.by.under)
            yield from (below, below + 1) if rest else (below - 1, below + 1, below)

    def _widest(self) -> list[int]:
        """Return the raw numbers around the first counts of more than 64 bits."""
        shape = self.shape
        if all(-INT64 <= end < INT64 for end in self.by.ends):
            return []
        last = (self.by.raw_of_count(count) for count in (INT64 - 1, -INT64))
        raws = (raw + more for raw in last for more in (-1, 0, 1))
        return [raw for raw in raws if shape.least <= raw <= shape.greatest]


# Names, codes and flags.


def names(lines: Lines, shape: Shape, *, deep: bool) -> None:
    """Add vectors of the names of an enum, and of numbers without a name."""
    enum = shape.named_numbers
    if enum is None:
        return
    least, greatest = (0, 9) if shape.digits is not None else (shape.least, shape.greatest)
    named = {entry.raw: entry.name for entry in enum.entries if least <= entry.raw <= greatest}
    raws = [*named]
    if deep:
        others = dict.fromkeys((*(raw + 1 for raw in named), min(named, default=0) - 1, least, greatest))
        raws += [raw for raw in others if raw not in named and least <= raw <= greatest]
    else:
        raws = raws[:: max(1, len(named) - 1)]
    lines.add_all("name", [(raw, named.get(raw)) for raw in raws])


def specials(lines: Lines, shape: Shape) -> None:
    """Add vectors of the special codes, and of raw numbers at their ends and next to them."""
    for special in shape.specials:
        lines.add("special", special.name, special.low, special.high)
    for raw in dict.fromkeys(samples.codes(shape)):
        code = code_of(shape, raw)
        lines.add("special_name", raw, *(() if code is None else (code.name, int(code.no_value))))


def flags(lines: Lines, shape: Shape) -> None:
    """Add vectors of flags: each flag alone, all others, and the named numbers of flags of several bits."""
    full = (1 << shape.width) - 1
    for flag in shape.flags:
        ones = (1 << flag.width) - 1
        mask = ones << flag.low
        words = [mask, full ^ mask, *(1 << bit for bit in range(flag.low, flag.low + flag.width))]
        words += [entry.raw << flag.low for entry in flag.values if 0 <= entry.raw <= ones]
        for word in dict.fromkeys(words):
            number = word >> flag.low & ones
            truth = int(number == flag.active) if flag.width == 1 else None
            lines.add("flag", flag.name, as_raw(shape, word), number, truth)
        if flag.width > 1:
            for entry in flag.values:
                lines.add("flag_name", flag.name, entry.raw, entry.name)


def fixed(lines: Lines, shape: Shape) -> None:
    """Add the vector of the bits that are always written as a constant."""
    if shape.fixed is not None:
        lines.add("fixed", shape.fixed.mask, shape.fixed.bits)


# Bit groups and words.


def bits(lines: Lines, encoding: PointEncoding) -> None:
    """Add vectors of a bit group: extracted from its word, and replaced in it."""
    shape = encoding.shape
    if encoding.bits is None:
        return
    low, ones = encoding.bits[1], (1 << shape.width) - 1
    patterns = (0, ones, 1, ones >> 1, ones ^ ones >> 1)
    tries = [(0, ones), (0xFFFF, 0), (0x5A3C, 0x5555 & ones), (0xA5C3, 0xAAAA & ones)]
    tries += [(0, put) for put in patterns] + [(pattern << low, ones ^ pattern) for pattern in patterns]
    for word, put in dict.fromkeys(tries):
        held = bytes_exchanged(shape, word)
        raw, result = held >> low & ones, held & ~(ones << low) | (as_pattern(shape, as_raw(shape, put)) & ones) << low
        if shape.fixed is not None:
            result = result & ~shape.fixed.mask | shape.fixed.bits
        lines.add("bits", word, as_raw(shape, raw), as_raw(shape, put), bytes_exchanged(shape, result))


def words(lines: Lines, encoding: PointEncoding) -> None:
    """Add vectors of the words of a number, in ascending order of the addresses."""
    shape, order = encoding.shape, encoding.order
    if order is None or encoding.bits is not None or shape.text is not None:
        return
    count = shape.words
    if count < 2 and not shape.info.signed and not shape.swapped and not shape.coding:
        return
    patterns = _wide_patterns(count) if count > 1 else _NARROW
    raws = [as_raw(shape, pattern) for pattern in (*patterns, *(_CODED if shape.coding else ()))]
    raws = [raw for raw in dict.fromkeys(raws) if not shape.coding or as_raw(shape, as_pattern(shape, raw)) == raw]
    lines.add_all("words", [(raw, words_of(encoding, order, raw)) for raw in raws])


def _wide_patterns(count: int) -> tuple[int, ...]:
    top = 1 << 16 * count - 1
    ascending = sum(0x0001_0203_0405_0607 >> 64 - 16 * count & 0xFFFF << 16 * place for place in range(count))
    mixed = sum((0x8000 if place % 2 else 0x8001) << 16 * place for place in range(count))
    return (0, 1, ascending, top, top + 1, top - 1, mixed, (1 << 16 * count) - 1, 0xFFFF)


def words_of(encoding: PointEncoding, order: tuple[int, ...], raw: int, *, received: bool = False) -> tuple[int, ...]:
    """Return the words of a raw number as they travel, in ascending order of address: `order` says which is which.

    A bit group shares its word with other bits. Constant bits and those above a narrow number have their written value
    when sent, and another one when received.
    """
    if encoding.bits is not None:
        return (_shared_word(encoding, encoding.bits[1], raw, received=received),)
    count = len(order)
    pattern = as_pattern(encoding.shape, raw) & (1 << 16 * count) - 1
    if received and encoding.shape.narrow:
        pattern ^= mask_of(16 * count - encoding.shape.width, encoding.shape.width)
    in_reading_order = [pattern >> 16 * (count - 1 - place) & 0xFFFF for place in order]
    return tuple([bytes_exchanged(encoding.shape, word) for word in in_reading_order])


def bytes_exchanged(shape: Shape, word: int) -> int:
    """Return a word as it travels: with the low byte first if the point says so."""
    return int.from_bytes(word.to_bytes(2, "little" if shape.swapped else "big"), "big")


def _shared_word(encoding: PointEncoding, low: int, raw: int, *, received: bool) -> int:
    ones, fixed = (1 << encoding.shape.width) - 1, encoding.shape.fixed
    word = OTHER_BITS & ~(ones << low) | (as_pattern(encoding.shape, raw) & ones) << low
    if fixed is not None:
        word = word & ~fixed.mask | (fixed.bits ^ fixed.mask if received else fixed.bits)
    return bytes_exchanged(encoding.shape, word)
