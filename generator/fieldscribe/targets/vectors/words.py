"""Vectors of names, special codes, flags, bit groups and words."""

from fieldscribe.arithmetic.words import mask_of
from fieldscribe.model import Shape
from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.lines import Lines
from fieldscribe.targets.vectors.oracle import as_pattern, as_raw, code_of
from fieldscribe.targets.vectors.samples import PointEncoding


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


OTHER_BITS = 0xA5C3
"""The bits of a shared word around those of the point."""


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


_CODED = (0x1234_5678_9012_3456, 0x9999_9999_9999_9999, 0x0102_0304_8506_9708)
"""Samples of decimal digits, of which a shorter number has the last ones."""
_NARROW = (0x8000, 0x8001, 0xFFFD, 0x7FFE)
"""Samples of a signed word: the least number, negative odd numbers, a positive number."""


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
