# SPDX-License-Identifier: 0BSD
"""Finds points by the manual's code, with the index of an element in brackets."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable

    from .descriptors import PointAttribute

_LOOK_ALIKE = str.maketrans("oil", "011")
_ZEROS = re.compile(r"(?<!\d)0+(?=\d)")


def find(points: Iterable[PointAttribute[Any, Any]], what: str) -> list[PointAttribute[Any, Any]]:
    """Return the points with a code, in either case; `P0731[1]` is the element 1 of an array."""
    code, bracket, rest = what.partition("[")
    index = rest.removesuffix("]") if bracket else None
    return [point for point in points if is_code(point.facts.code, code) and index in (None, str(point.facts.at.index))]


def is_code(code: str | None, what: str) -> bool:
    """Return True if the text is this code, in either case."""
    return code is not None and code.casefold() == what.casefold()


def nearest(points: Iterable[PointAttribute[Any, Any]], what: str) -> list[str]:
    """Return names and codes like the given one: those that look the same first, then by similarity and beginning."""
    from difflib import SequenceMatcher, get_close_matches

    known = {name.casefold(): name for point in points for name in (point.facts.item, point.facts.code) if name}
    wanted = what.partition("[")[0].casefold()

    def order(one: str) -> tuple[bool, float, int, str]:
        likeness = SequenceMatcher(None, one, wanted).ratio()
        same = [a == b for a, b in zip(one, wanted, strict=False)]
        return _plain(one) != _plain(wanted), -likeness, -[*same, False].index(False), one

    return [known[one] for one in sorted(get_close_matches(wanted, list(known), len(known) or 1), key=order)[:3]]


def _plain(code: str) -> str:
    """Return a code without leading zeros and with digits for the letters that look like them."""
    return _ZEROS.sub("", code.translate(_LOOK_ALIKE))
