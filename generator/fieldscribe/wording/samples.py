"""A raw number to show in an example: one that may be written and moves a machine least."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.arithmetic.floats import float_of, pattern_of
from fieldscribe.arithmetic.words import with_fixed
from fieldscribe.wording.exact import hex_text, rounded

if TYPE_CHECKING:
    from fieldscribe.model import Point


def sample_raw(point: Point) -> int | None:
    """A raw number that may be written: the default, else the smallest; None where no fixed one is sure."""
    if point.text is not None:
        return None
    if point.info.floating:
        first = point.allowed.units[0][0] if point.allowed.units else 0
        number = first if point.default is None else point.default
        return pattern_of(number, point.info.bits)
    raw = point.default_raw
    if raw is not None:
        special = point.special(raw)
        if special is None or special.writable:
            return with_fixed(point, raw) if special is None else raw
    ends = [end for one in point.allowed.intervals for end in (one.low, one.high) if isinstance(end, int)]
    return with_fixed(point, min(ends, key=abs)) if ends else None


def sample_said(point: Point, raw: int) -> str:
    """The number as an example: what it means, and the raw number."""
    if point.info.floating:
        number = float_of(raw, point.info.bits)
        shown = f"{number:g}" if point.display is None else rounded(*number.as_integer_ratio(), point.display)
        return f"for example {wording.with_unit(shown, point)} is the pattern {hex_text(raw, point.width // 4)}"
    meaning = wording.meaning_text(point, raw)
    return f"for example {meaning} is raw {raw}" if meaning else f"for example raw {raw}"
