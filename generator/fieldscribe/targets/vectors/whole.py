"""Vectors of points whose raw number is the value (integers, enums, flags, bits), of names and of bit groups."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.numbers import as_raw
from fieldscribe.targets.vectors.oracle import INT64, Oracle, admit, is_no_value

if TYPE_CHECKING:
    from fieldscribe.model import Point
    from fieldscribe.targets.vectors.lines import Lines


def whole(lines: Lines, oracle: Oracle, point: Point) -> None:
    """Decoding, encoding and checking of a point without a scale, for each setting of what it depends on."""
    for settings in samples.settings(oracle, point) if point.arguments else [{}]:
        limits = oracle.limits(point, settings)
        lines.set("with", settings)
        if isinstance(limits, str):
            raw = samples.limits_of(point)[0].greatest
            if point.writable:
                lines.add("encode_count", raw, limits)
                lines.add("check", raw, limits)
        else:
            _sheet(lines, point, limits)


def _sheet(lines: Lines, point: Point, limits: samples.Limits) -> None:
    raws = dict.fromkeys((*samples.raws_to_check(point, limits), *samples.raws_to_decode(point, limits)))
    raws.update({with_fixed(point, raw): None for raw in list(raws)})
    if point.enum is not None:
        raws.update(dict.fromkeys(entry.raw for entry in point.enum.entries))
    for flag in point.flags:
        raws[as_raw(point, (1 << flag.width) - 1 << flag.low)] = None
    top = INT64 if point.width > 16 else 1 << 31
    if point.readable:
        for raw in raws:
            if raw < INT64:
                lines.add("decode_count", raw, *(("no_value",) if is_no_value(point, raw) else ("ok", raw)))
    if not point.writable:
        return
    beyond = dict.fromkeys((*samples.edges(limits), point.least - 1, point.greatest + 1, top - 1, -top))
    for count in {**raws, **beyond}:
        if -top <= count < top:
            put = with_fixed(point, count)
            status = admit(point, put, limits)
            lines.add("encode_count", count, status, put if status == "ok" else None)
    for raw in raws:
        status = admit(point, raw, limits) if with_fixed(point, raw) == raw else "out_of_range"
        lines.add("check", raw, status)


def with_fixed(point: Point, raw: int) -> int:
    """A raw number with the bits put in that are always written as a constant; what the type cannot hold stays."""
    fixed = point.fixed
    if fixed is None or point.bits is not None or not point.least <= raw <= point.greatest:
        return raw
    return as_raw(point, raw & ~fixed.mask | fixed.bits)


def names(lines: Lines, point: Point) -> None:
    """Each named number of an enum, and numbers without a name."""
    if point.enum is None:
        return
    named = {entry.raw: entry.name for entry in point.enum.entries}
    for raw, name in named.items():
        lines.add("name", raw, name)
    strange = dict.fromkeys((*(raw + 1 for raw in named), min(named, default=0) - 1, point.least, point.greatest))
    for raw in [raw for raw in strange if raw not in named and point.least <= raw <= point.greatest]:
        lines.add("name", raw)


def specials(lines: Lines, point: Point) -> None:
    """The numbers that are no quantity."""
    for special in point.specials:
        lines.add("special", special.name, special.low, special.high)


def flags(lines: Lines, point: Point) -> None:
    """Each flag alone, all but each flag, and each of its named numbers, with the names of numbers of several bits."""
    full = (1 << point.width) - 1
    for flag in point.flags:
        ones = (1 << flag.width) - 1
        mask = ones << flag.low
        words = [mask, full ^ mask, *(1 << bit for bit in range(flag.low, flag.low + flag.width))]
        words += [entry.raw << flag.low for entry in flag.values if 0 <= entry.raw <= ones]
        for word in dict.fromkeys(words):
            lines.add("flag", flag.name, as_raw(point, word), word >> flag.low & ones)
        if flag.width > 1:
            for entry in flag.values:
                lines.add("flag_name", flag.name, entry.raw, entry.name)


def fixed(lines: Lines, point: Point) -> None:
    """The bits of the word that are always written as a constant."""
    if point.fixed is not None:
        lines.add("fixed", point.fixed.mask, point.fixed.bits)


def bits(lines: Lines, point: Point) -> None:
    """A bit group taken out of its word, and another number put in."""
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
