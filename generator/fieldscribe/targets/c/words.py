"""The words of a point: what its text has of it alone, each as it stands in C. All else is common to its kind."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.names import upper
from fieldscribe.patterns import blanks
from fieldscribe.targets.c.comments import range_words
from fieldscribe.targets.c.limits import has_ranges_table
from fieldscribe.targets.c.literals import bare, hexadecimal, signed
from fieldscribe.targets.c.scales import scaled
from fieldscribe.targets.c.special_codes import encoded_limits
from fieldscribe.text import c_comment, c_string
from fieldscribe.wording import default_text

if TYPE_CHECKING:
    from collections.abc import Hashable

    from fieldscribe.model import Point

Filling = tuple[str, ...]
"""The words one after the other, as a pattern takes them."""


class Limits(NamedTuple):
    """The words that points of the same shape have of their limits; `form` is all else that their text has of them.

    `low` and `high` bound raw numbers, `first` and `last` counts; `range` is for people. `alone` says that the text has
    more of them than words.
    """

    low: str
    high: str
    low_signed: str
    high_signed: str
    first: str
    last: str
    range: str
    form: Hashable
    alone: bool


class Words(NamedTuple):
    """The words of a point by name.

    `item` is also written in capitals (`macro`) and for people (`said`). `address` is the lowest one, in decimal
    `number`; `start` and `end` are the first and the last. `references` are pairs: for people, and as a literal.
    """

    item: str
    macro: str
    low: str
    high: str
    low_signed: str
    high_signed: str
    first: str
    last: str
    range: str
    said: str
    code_said: str
    default: str
    address: str
    start: str
    end: str
    number: str
    code: str
    references: Filling

    @classmethod
    def of(cls, filling: Filling) -> Words:
        """The words by name."""
        return cls._make((*filling[:_FIXED], filling[_FIXED:]))


_FIXED = len(Words._fields) - 1
_IN_COMMENT = slice(Words._fields.index("range"), Words._fields.index("default") + 1)
"""Words of which no width matters: comments are laid out later."""


def filling_of(point: Point, item: str, addresses: tuple[int, ...], limits: Limits) -> Filling:
    """The words of a point."""
    if len(addresses) == 1:
        lowest = start = end = hexadecimal(addresses[0])
        number = str(addresses[0])
    elif addresses:
        least = min(addresses)
        lowest, start, end = hexadecimal(least), hexadecimal(addresses[0]), hexadecimal(addresses[-1])
        number = str(least)
    else:
        lowest = start = end = number = ""
    default = "" if point.default is None and point.default_raw is None else c_comment(default_text(point))
    said, literal = ("", "") if point.code is None else (c_comment(point.code), c_string(point.code))
    references: list[str] = []
    for reference in point.references.values():
        if isinstance(reference, str):
            references += (c_comment(reference), c_string(reference))
        else:
            number_text = str(reference)
            references += (number_text, number_text if reference >= 0 else signed(reference))
    return (
        item, upper(item), *limits[:7], item.replace("_", " "), said, default,
        lowest, start, end, number, literal, *references,
    )  # fmt: skip


def words_of(point: Point) -> Words:
    """The words of a single point."""
    return Words.of(filling_of(point, point.item, point.addresses, limits_of(point)))


def stand_ins(filling: Filling) -> Filling:
    """Blanks for these words."""
    in_comment = ["_" if word else "" for word in filling[_IN_COMMENT]]
    return blanks((*filling[: _IN_COMMENT.start], *in_comment, *filling[_IN_COMMENT.stop :]))


def widths_of(filling: Filling) -> Hashable:
    """The widths that decide about the layout, but those of the limits, and which words of the comment are missing."""
    return len(filling[0]), *map(bool, filling[_IN_COMMENT]), *map(len, filling[_IN_COMMENT.stop :])


def limits_of(point: Point) -> Limits:
    """The words of a point's limits."""
    allowed, (low, high) = point.allowed, (0, 0) if point.info.floating else point.outer
    scale = scaled(point, *encoded_limits(point)) if point.form == "scaled" and not point.scale_arguments else None
    first, last = (0, 0) if scale is None else scale.counts
    low_text, high_text = bare(low), bare(high)
    ends = (
        low_text, high_text,
        low_text if low >= 0 else signed(low), high_text if high >= 0 else signed(high),
        bare(first), bare(last),
    )  # fmt: skip
    is_simple, said = allowed.fixed == ((low, high),), range_words(point)
    form = (
        (low, high) == point.held if is_simple and not point.specials else allowed.fixed,
        allowed.units,
        scale and (scale.wide, scale.inside, (first, last) == (low, high), point.writable and scale.raw_of_count),
        tuple(map(len, ends)),
        point.unit.symbol,
    )
    is_plain = is_simple and c_comment(point.unit.symbol) == point.unit.symbol
    alone = allowed.moves or has_ranges_table(point)
    return Limits(*ends, said if is_plain else c_comment(said), form, alone)
