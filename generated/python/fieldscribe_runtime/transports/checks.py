# SPDX-License-Identifier: 0BSD
"""Checks of the arguments of transports."""

from __future__ import annotations

import math
from typing import Any, NoReturn

from ..arguments import shown
from ..errors import RequestError

_MOST_SECONDS = 86400


def refuse(what: str, takes: str, given: object) -> NoReturn:
    """Raises RequestError (bad_transport) that says what is expected."""
    raise RequestError("bad_transport", f"{what} is {takes}, not {shown(given)}")


def text(what: str, takes: str, given: Any) -> str:
    """Return a text that is not empty."""
    if not isinstance(given, str) or not given.strip():
        refuse(what, takes, given)
    return given


def number(what: str, given: Any, ends: tuple[int, int]) -> int:
    """Return an integer between the ends."""
    if isinstance(given, bool) or not isinstance(given, int) or not ends[0] <= given <= ends[1]:
        refuse(what, f"a number from {ends[0]} to {ends[1]}", given)
    return given


def seconds(given: Any) -> float:
    """Return how long to wait."""
    is_number = isinstance(given, (int, float)) and not isinstance(given, bool)
    if not is_number or not math.isfinite(given) or not 0 < given <= _MOST_SECONDS:
        refuse("a timeout", "a number of seconds above 0", given)
    return float(given)


def object_with(what: str, takes: str, given: Any, *methods: str) -> None:
    """Raises RequestError unless an object has these methods."""
    if isinstance(given, type) or not all(callable(getattr(given, name, None)) for name in methods):
        refuse(what, takes, given)
