"""What a point of a telegram is as a signal of a database: scale, limits, unit, names of numbers, and a comment."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.arithmetic.lines import SAME
from fieldscribe.text import line
from fieldscribe.wording.exact import fixed_rule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device, Flag, Point


_MOST_CODES = 32
"""A longer band of special codes goes to the comment only: a database names single numbers."""

_HALVES = ("high", "low")


@dataclass(frozen=True, slots=True)
class Meaning:
    """A signal without its place in the frame. `address` is its first word in the telegram, the high word."""

    name: str
    address: int
    words: int
    bits: tuple[int, int] | None
    signed: bool
    factor: str
    offset: str
    least: str
    greatest: str
    unit: str
    comment: str
    values: tuple[tuple[int, str], ...]


def signals_of_point(device: Device, point: Point, per_frame: int, *, joins: bool) -> Iterator[Meaning]:
    """The signal of a point; one signal for each word where its words lie in two frames or in falling order.

    `joins` says whether neighbouring words of a frame are one number to a database.
    """
    addresses = point.addresses
    comment = _comment(device, point)
    whole = addresses == tuple(range(addresses[0], addresses[0] + len(addresses)))
    if point.words > 1 and (not joins or point.info.floating or point.text is not None):
        whole = False
    if whole and addresses[0] // per_frame == addresses[-1] // per_frame:
        yield _meaning(point, comment)
        return
    for place, address in enumerate(addresses):
        name = _HALVES[place] if len(addresses) == 2 else f"word_{place + 1}"
        count = len(addresses)
        remark = f"{comment}. Word {place + 1} of {count}, the high part first; a database cannot put them together"
        yield Meaning(f"{point.name}_{name}", address, 1, None, False, "1", "0", "0", "65535", "", line(remark), ())


def _meaning(point: Point, comment: str) -> Meaning:
    rule = fixed_rule(point) if point.generated else None
    multiply, add, divide = line = rule or SAME
    least, greatest = wording.outer_raw(point) or (point.least, point.greatest)
    ends = sorted(map(line.result, (least, greatest)))
    return Meaning(
        point.name,
        point.addresses[0],
        point.words,
        point.bits,
        point.info.signed,
        decimal(Fraction(multiply, divide)),
        decimal(Fraction(add, divide)),
        decimal(ends[0]),
        decimal(ends[1]),
        point.unit.symbol if rule is not None else "",
        comment,
        tuple(_names(point)),
    )


def decimal(number: Fraction) -> str:
    """A number as databases write it: the shortest decimal of the nearest binary64."""
    return str(number.numerator) if number.denominator == 1 else repr(float(number))


def _names(point: Point) -> Iterator[tuple[int, str]]:
    seen: set[int] = set()
    for special in point.specials if not point.info.floating else ():
        if special.high - special.low < _MOST_CODES:
            seen.update(range(special.low, special.high + 1))
            yield from ((raw, special.name) for raw in range(special.low, special.high + 1))
    for entry in point.enum.entries if point.enum is not None else ():
        if entry.raw not in seen:
            yield entry.raw, entry.name


def _flag_text(flag: Flag, point: Point) -> str:
    """A flag with what its numbers mean, in English: `bits 7..6 fault_class_3: 0 Inactive, 3 Active`."""
    head = f"{'bit' if flag.width == 1 else 'bits'} {wording.flag_bits(flag, point)} {flag.name}"
    if flag.values:
        return f"{head}: " + ", ".join(f"{value.raw} {value.title['en']}" for value in flag.values)
    return head + (", true when 0" if flag.width == 1 and flag.active == 0 else "")


def _comment(device: Device, point: Point) -> str:
    """The title, and facts that a database has no place for: rules that need other points, bits of a word."""
    parts = [point.title["en"]]
    if not point.generated:
        parts.append(f"Raw: {point.reason or 'the manual leaves it open'}")
    elif fixed_rule(point) is None:
        by_name = {named.name: named for named in device.points}
        parts.append(f"Raw: the value is {wording.scale_text(point, by_name)}")
    if point.flags:
        parts += [_flag_text(flag, point) for flag in point.flags]
    for special in point.specials:
        if point.info.floating or special.high - special.low >= _MOST_CODES or len(point.addresses) > 1:
            parts.append(f"No quantity: {wording.special_numbers(special, point.width)} {special.name}")
    printed = ", ".join(f"{key} {number}" for key, number in point.references.items())
    if printed:
        parts.append(f"In the manual: {printed}")
    return line(". ".join(parts))
