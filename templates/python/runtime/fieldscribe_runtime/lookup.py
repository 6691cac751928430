# SPDX-License-Identifier: 0BSD
"""Points by what people call them: the manual's code, with the index of an element in brackets."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable

    from .descriptors import PointAttribute


def find(points: Iterable[PointAttribute[Any, Any]], what: str) -> list[PointAttribute[Any, Any]]:
    """Return the points with a code, in capitals or not; `P0731[1]` is the element 1 of an array."""
    code, bracket, rest = what.partition("[")
    index = rest.removesuffix("]") if bracket else None
    return [point for point in points if is_code(point.facts.code, code) and index in (None, str(point.facts.at.index))]


def is_code(code: str | None, what: str) -> bool:
    """Return True if a code is meant, in capitals or not."""
    return code is not None and code.casefold() == what.casefold()


def nearest(points: Iterable[PointAttribute[Any, Any]], what: str) -> list[str]:
    """Return names and codes that resemble what was asked for."""
    from difflib import get_close_matches

    known = {name.casefold(): name for point in points for name in (point.facts.item, point.facts.code) if name}
    return [known[one] for one in get_close_matches(what.partition("[")[0].casefold(), list(known), 3)]
