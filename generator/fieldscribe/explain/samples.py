"""A raw number to show in an example: one that may be written and moves a machine least."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from fieldscribe.model import Point


def sample_raw(point: Point) -> int | None:
    """A raw number that may be written: the default, else the smallest; None where no fixed one is sure."""
    if point.text is not None:
        return None
    if point.info.floating:
        first = point.allowed.units[0][0] if point.allowed.units else 0
        number = first if point.default is None else point.default
        kind = ("<f", "<I") if point.type == "f32" else ("<d", "<Q")
        result: int = struct.unpack(kind[1], struct.pack(kind[0], float(number)))[0]
        return result
    raw = point.default_raw
    if raw is not None:
        special = point.special(raw)
        if special is None or special.writable:
            return _with_fixed(point, raw) if special is None else raw
    ends = [end for one in point.allowed.intervals for end in (one.low, one.high) if isinstance(end, int)]
    return _with_fixed(point, min(ends, key=abs)) if ends else None


def sample_said(point: Point, raw: int) -> str:
    """The number as an example: what it means, and the raw number."""
    if point.info.floating:
        kind = ("<f", "<I") if point.type == "f32" else ("<d", "<Q")
        number = struct.unpack(kind[0], struct.pack(kind[1], raw))[0]
        return f"for example {wording.with_unit(f'{number:g}', point)} is the pattern {hex_text(raw, point.width // 4)}"
    meaning = wording.meaning_text(point, raw)
    return f"for example {meaning} is raw {raw}" if meaning else f"for example raw {raw}"


def _with_fixed(point: Point, raw: int) -> int:
    if point.fixed is None or point.bits is not None:
        return raw
    return raw & ~point.fixed.mask | point.fixed.bits
