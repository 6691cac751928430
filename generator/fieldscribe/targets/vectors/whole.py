"""Vectors of points whose raw number is the value (integers, enums, flags, bits), names and bit groups."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.numbers import as_raw
from fieldscribe.targets.vectors.oracle import INT64, Oracle, admit, code_of, quantity_at_most

if TYPE_CHECKING:
    from fieldscribe.model import Point
    from fieldscribe.targets.vectors.lines import Lines


def whole(lines: Lines, oracle: Oracle, point: Point, *, deep: bool) -> None:
    """Add vectors of decoding, encoding and checking a point without a scale, for each setting of other points."""
    for settings in samples.settings(oracle, point, deep=deep) if point.arguments else [{}]:
        limits = oracle.limits(point, settings)
        lines.set("with", settings)
        if isinstance(limits, str):
            raw = quantity_at_most(point, samples.limits_of(point)[0].greatest)
            if point.writable:
                lines.add("encode_count", raw, limits)
                lines.add("check", raw, limits)
        else:
            _sheet(lines, point, limits, deep=deep)


def _sheet(lines: Lines, point: Point, limits: samples.Limits, *, deep: bool) -> None:
    top = INT64 if point.width > 16 else 1 << 31
    checked = _raws(point, samples.raws_to_check(point, limits, deep=deep), deep=deep)
    decoded = _raws(point, samples.raws_to_decode(point, limits, deep=deep), deep=deep)
    if deep:
        checked = decoded = {**checked, **decoded}
    if point.readable:
        for raw in decoded:
            if raw < INT64:
                code = code_of(point, raw)
                lines.add("decode_count", raw, *(("ok", raw) if code is None else ("special", None, code.name)))
    if not point.writable:
        return
    ends = (point.least - 1, point.greatest + 1, top - 1, -top) if deep else ()
    for count in {**decoded, **samples.edges(limits if deep else samples.limits_to_try(limits)), **dict.fromkeys(ends)}:
        if -top <= count < top:
            put = with_fixed(point, count)
            status = admit(point, put, limits, by_value=True)
            lines.add("encode_count", count, status, put if status == "ok" else None)
    for raw in checked:
        fits = with_fixed(point, raw) == raw or code_of(point, raw) is not None
        lines.add("check", raw, admit(point, raw, limits) if fits else "out_of_range")


def _raws(point: Point, raws: list[int], *, deep: bool) -> dict[int, None]:
    """These raw numbers, also with the constant bits set, numbers of the enum (if deep, all), and each flag alone."""
    raws_to_try = dict.fromkeys(raws)
    raws_to_try.update({with_fixed(point, raw): None for raw in raws})
    if point.enum is not None:
        raws_to_try.update({entry.raw: None for entry in point.enum.entries if deep or entry is point.enum.entries[-1]})
    raws_to_try.update({as_raw(point, (1 << flag.width) - 1 << flag.low): None for flag in point.flags})
    return raws_to_try


def with_fixed(point: Point, raw: int) -> int:
    """A raw number with the constant bits set; unchanged if the type cannot hold it."""
    fixed = point.fixed
    if fixed is None or point.bits is not None or not point.least <= raw <= point.greatest:
        return raw
    return as_raw(point, raw & ~fixed.mask | fixed.bits)


def names(lines: Lines, point: Point, *, deep: bool) -> None:
    """Add vectors of the names of an enum, and of numbers without a name."""
    enum = point.digits.enum if point.digits is not None else point.enum
    if enum is None:
        return
    least, greatest = (0, 9) if point.digits is not None else (point.least, point.greatest)
    named = {entry.raw: entry.name for entry in enum.entries if least <= entry.raw <= greatest}
    if not deep:
        for raw in dict.fromkeys((*named,)[:: max(1, len(named) - 1)]):
            lines.add("name", raw, named[raw])
        return
    for raw, name in named.items():
        lines.add("name", raw, name)
    strange = dict.fromkeys((*(raw + 1 for raw in named), min(named, default=0) - 1, least, greatest))
    for raw in [raw for raw in strange if raw not in named and least <= raw <= greatest]:
        lines.add("name", raw)


def specials(lines: Lines, point: Point) -> None:
    """Add vectors of the special codes, and of raw numbers at their ends and beside them."""
    for special in point.specials:
        lines.add("special", special.name, special.low, special.high)
    for raw in dict.fromkeys(samples.codes(point)):
        code = code_of(point, raw)
        lines.add("special_name", raw, *(() if code is None else (code.name, int(code.no_value))))


def flags(lines: Lines, point: Point) -> None:
    """Add vectors of flags: each flag alone, all others, and the named numbers of flags of several bits."""
    full = (1 << point.width) - 1
    for flag in point.flags:
        ones = (1 << flag.width) - 1
        mask = ones << flag.low
        words = [mask, full ^ mask, *(1 << bit for bit in range(flag.low, flag.low + flag.width))]
        words += [entry.raw << flag.low for entry in flag.values if 0 <= entry.raw <= ones]
        for word in dict.fromkeys(words):
            number = word >> flag.low & ones
            truth = int(number == flag.active) if flag.width == 1 else None
            lines.add("flag", flag.name, as_raw(point, word), number, truth)
        if flag.width > 1:
            for entry in flag.values:
                lines.add("flag_name", flag.name, entry.raw, entry.name)


def fixed(lines: Lines, point: Point) -> None:
    """Add the vector of the bits that are always written as a constant."""
    if point.fixed is not None:
        lines.add("fixed", point.fixed.mask, point.fixed.bits)


def bits(lines: Lines, point: Point) -> None:
    """Add vectors of a bit group: taken out of its word, and replaced in it."""
    if point.bits is None:
        return
    low, ones = point.bits[1], (1 << point.width) - 1
    patterns = (0, ones, 1, ones >> 1, ones ^ ones >> 1)
    tries = [(0, ones), (0xFFFF, 0), (0x5A3C, 0x5555 & ones), (0xA5C3, 0xAAAA & ones)]
    tries += [(0, put) for put in patterns] + [(pattern << low, ones ^ pattern) for pattern in patterns]
    for word, put in dict.fromkeys(tries):
        raw, result = word >> low & ones, word & ~(ones << low) | put << low
        if point.fixed is not None:
            result = result & ~point.fixed.mask | point.fixed.bits
        lines.add("bits", word, as_raw(point, raw), as_raw(point, put), result)
