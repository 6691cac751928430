# SPDX-License-Identifier: 0BSD
"""The fast path of a point: functions specialised for its facts.

The decoders take integers that are known to be raw numbers of the point, as in frames; `checked` makes one that takes
any argument. The encoders test the usual case inline (the exact type, one range) and compute. All other arguments go
to the `slow` path, which knows every case and words the errors. Both paths give the same bits.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any

from .rules import NO_RAWS

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from .rules import Line, Raws, Rule
    from .special import Special

    Way = Callable[..., Any]
    """Converts a raw number or a value, given the raw numbers of other points it needs."""

_NUMBERS = (float, int)
_INTEGERS = {int}
_REMEMBERED = 256
"""The most raw numbers of another point whose scale is remembered."""


def same(low: int, high: int, slow: Way) -> Way:
    """Convert integers of a range that are their own raw numbers, in both directions."""

    def convert(number: int, raws: Raws = NO_RAWS) -> Any:
        """Return the number if it is in the range; raises as the point does."""
        if type(number) is int and low <= number <= high:
            return number
        return slow(number, raws)

    return convert


def checked(sure: Way, ends: tuple[int, int], needs: Sequence[str], slow: Way) -> Way:
    """Return a decoder that checks the raw numbers before it calls `sure`."""
    low, high = ends

    def decode(raw: int, raws: Raws = NO_RAWS) -> Any:
        """Return the value (or special code) of a raw number; raises as the point's class says."""
        if type(raw) is int and low <= raw <= high:
            return sure(raw, raws)
        return slow(raw, raws)

    def decode_by_others(raw: int, raws: Raws = NO_RAWS) -> Any:
        """Return the value (or special code) of a raw number; raises as the point's class says."""
        try:
            is_known = {type(raws[name]) for name in needs} == _INTEGERS
        except (KeyError, TypeError):
            is_known = False
        return decode(raw, raws) if is_known else slow(raw, raws)

    return decode_by_others if needs else decode


def listed(known: Mapping[int, Any], slow: Way) -> Way:
    """Decode raw numbers by a table."""

    def decode(raw: int, raws: Raws) -> Any:
        try:
            return known[raw]
        except KeyError:
            pass
        return slow(raw, raws)

    return decode


def chosen(kind: type, known: Mapping[Any, int], slow: Way) -> Way:
    """Encode values of exactly one type by a table."""

    def encode(value: Any, raws: Raws = NO_RAWS) -> Any:
        """Return the raw number for a value; raises as the point's class says."""
        if type(value) is kind and value in known:
            return known[value]
        return slow(value, raws)

    return encode


def scaled(line: Line, low: int, high: int, slow: Way) -> Way:
    """The same as `checked(unchecked(line))` in one call: most points have a fixed scale."""
    times, less, over = line

    def decode(raw: int, raws: Raws = NO_RAWS) -> Any:
        """Return the value (or special code) of a raw number; raises as the point's class says."""
        if type(raw) is int and low <= raw <= high:
            return raw / over
        return slow(raw, raws)

    def decode_by_line(raw: int, raws: Raws = NO_RAWS) -> Any:
        """Return the value (or special code) of a raw number; raises as the point's class says."""
        if type(raw) is int and low <= raw <= high:
            return (raw * times - less) / over
        return slow(raw, raws)

    return decode if (times, less) == (1, 0) else decode_by_line


def unchecked(line: Line) -> Way:
    """Decode by a fixed scale."""
    times, less, over = line

    def decode(raw: int, raws: Raws) -> Any:
        return raw / over

    def decode_by_line(raw: int, raws: Raws) -> Any:
        return (raw * times - less) / over

    return decode if (times, less) == (1, 0) else decode_by_line


def itself(raw: int, raws: Raws) -> int:
    """Return the raw number, which is the value."""
    del raws
    return raw


def scaled_by(rule: Rule, low: int, high: int, slow: Way) -> Way:
    """Decode by a scale that other points decide: these seldom change."""
    points = tuple([factor.point for factor in rule.factors])
    point = points[0]
    lines: dict[Any, Line] = {}
    learned = _learner(lines, rule, (low, high), slow)

    def decode(raw: int, raws: Raws) -> Any:
        try:
            line = lines.get(raws[point])
        except (KeyError, TypeError):
            return slow(raw, raws)
        if line is not None:
            times, less, over = line
            return (raw * times - less) / over
        return learned(raws[point], raw, raws)

    def decode_by_several(raw: int, raws: Raws) -> Any:
        try:
            numbers = tuple(map(raws.__getitem__, points))
            line = lines.get(numbers)
        except (KeyError, TypeError, AttributeError):
            return slow(raw, raws)
        if line is not None:
            times, less, over = line
            return (raw * times - less) / over
        return learned(numbers, raw, raws)

    return decode if len(points) == 1 else decode_by_several


def _learner(lines: dict[Any, Line], rule: Rule, ends: tuple[int, int], slow: Way) -> Way:
    """Return the slow path, which remembers the scale for these numbers of other points in `lines`."""

    def learned(numbers: Any, raw: int, raws: Raws) -> Any:
        value = slow(raw, raws)  # raises if there is no value
        if len(lines) < _REMEMBERED and rule.is_safe(raws, *ends):
            lines[numbers] = rule.line(raws)
        return value

    return learned


def rounded(steps: tuple[float, float, float], low: int, high: int, slow: Way) -> Way:
    """Encode values into a range: steps in binary64, then round to nearest, halves away from zero."""
    num, den, offset = steps

    def encode(value: float, raws: Raws = NO_RAWS) -> Any:
        """Return the raw number for a value; raises as the point's class says."""
        if type(value) in _NUMBERS:
            try:
                result = value * num / den + offset
                raw = int(result)
            except (OverflowError, ValueError):  # beyond every integer, or NaN
                return slow(value, raws)
            rest = result - raw  # exact: they are within a factor of two, or the integer is zero
            if rest >= 0.5:
                raw += 1
            elif rest <= -0.5:
                raw -= 1
            if low <= raw <= high:
                return raw
        return slow(value, raws)

    return encode


def from_pattern(number: struct.Struct, word: struct.Struct) -> Way:
    """Decode bit patterns of IEEE 754 numbers."""
    pack, unpack = word.pack, number.unpack

    def decode(raw: int, raws: Raws) -> Any:
        return unpack(pack(raw))[0]

    return decode


def to_pattern(number: struct.Struct, word: struct.Struct, low: float, high: float, slow: Way) -> Way:
    """Encode values of a range as bit patterns of IEEE 754 numbers."""
    pack, unpack, nearest = number.pack, word.unpack, number.unpack

    def encode(value: float, raws: Raws = NO_RAWS) -> Any:
        """Return the bit pattern for a value; raises as the point's class says."""
        if type(value) in _NUMBERS:
            try:
                data = pack(value)
            except (OverflowError, struct.error):
                return slow(value, raws)
            if low <= nearest(data)[0] <= high:
                return unpack(data)[0]
        return slow(value, raws)

    return encode


def coded(find: Callable[[int], Special | None], plain: Way) -> Way:
    """Decode special codes, and other raw numbers by `plain`."""

    def decode(raw: int, raws: Raws) -> Any:
        return find(raw) or plain(raw, raws)

    return decode


def uncoded(find: Callable[[int], Special | None], plain: Way, slow: Way) -> Way:
    """Encode by `plain`, unless the result is a special code."""

    def encode(value: Any, raws: Raws = NO_RAWS) -> Any:
        """Return the raw number for a value; raises as the point's class says."""
        raw = plain(value, raws)
        return raw if find(raw) is None else slow(value, raws)

    return encode


def bits_of(low: int, mask: int, sign: int, then: Way) -> Way:
    """Decode some bits of a word by `then`; `sign` is their highest bit if they are signed."""

    def decode(word: int, raws: Raws = NO_RAWS) -> Any:
        return then((word >> low & mask ^ sign) - sign, raws)

    return decode


def taken_apart(unpack: Callable[[bytes], tuple[int, ...]], plan: Sequence[tuple[str, Any, Way]], slow: Way) -> Way:
    """Decode bytes to values by name; the plan has the field and the decoder of each point.

    Most frames have a few points, where a loop would cost as much as the decoding.
    """

    def decode(data: bytes, raws: Raws = NO_RAWS) -> Any:
        """Return the values in the bytes; raises as the layout's class says."""
        try:
            fields = unpack(data)
        except (struct.error, TypeError):
            return slow(data, raws)
        return {name: way(fields[at], raws) for name, at, way in plan}

    if len(plan) == 3:
        (name_1, at_1, way_1), (name_2, at_2, way_2), (name_3, at_3, way_3) = plan

        def decode_3(data: bytes, raws: Raws = NO_RAWS) -> Any:
            """Return the values in the bytes; raises as the layout's class says."""
            try:
                fields = unpack(data)
            except (struct.error, TypeError):
                return slow(data, raws)
            return {
                name_1: way_1(fields[at_1], raws),
                name_2: way_2(fields[at_2], raws),
                name_3: way_3(fields[at_3], raws),
            }

        return decode_3
    if len(plan) == 4:
        (name_1, at_1, way_1), (name_2, at_2, way_2), (name_3, at_3, way_3), (name_4, at_4, way_4) = plan

        def decode_4(data: bytes, raws: Raws = NO_RAWS) -> Any:
            """Return the values in the bytes; raises as the layout's class says."""
            try:
                fields = unpack(data)
            except (struct.error, TypeError):
                return slow(data, raws)
            return {
                name_1: way_1(fields[at_1], raws),
                name_2: way_2(fields[at_2], raws),
                name_3: way_3(fields[at_3], raws),
                name_4: way_4(fields[at_4], raws),
            }

        return decode_4
    return decode


def put_together(pack: Callable[..., bytes], plan: Sequence[tuple[str, Way]]) -> Way:
    """Encode values by name as bytes; the plan has an encoder for each field."""

    def encode(values: Mapping[str, Any], raws: Raws) -> bytes:
        return pack(*[way(values[name], raws) for name, way in plan])

    if len(plan) == 4:
        (name_1, way_1), (name_2, way_2), (name_3, way_3), (name_4, way_4) = plan

        def encode_4(values: Mapping[str, Any], raws: Raws) -> bytes:
            return pack(
                way_1(values[name_1], raws),
                way_2(values[name_2], raws),
                way_3(values[name_3], raws),
                way_4(values[name_4], raws),
            )

        return encode_4
    return encode
