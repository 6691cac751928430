# SPDX-License-Identifier: 0BSD
"""Conditions of points and steps: one of several groups of tests must hold."""

from __future__ import annotations

import operator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

Test = tuple[str, str, tuple[int | str, ...]]
"""A comparison of a variant axis (by name) or a point (by raw number): its name, the operator, the constants."""
Clauses = tuple[tuple[Test, ...], ...]
"""Groups of tests: all tests of at least one group must hold."""

_TESTS: Mapping[str, Callable[[int, int], bool]] = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}


def holds(value: int | str, test: str, than: tuple[int | str, ...]) -> bool:
    """Return True if a test is true of a raw number, or of a name."""
    if test in _TESTS:
        return isinstance(value, int) and _TESTS[test](value, int(than[0]))
    return (value in than) is (test != "!=")


def may_hold(clauses: Clauses, held: Mapping[str, int | str | None]) -> bool:
    """Return True unless the known values contradict the condition; missing ones and None are unknown."""
    return not clauses or any(
        all((value := held.get(of)) is None or holds(value, test, than) for of, test, than in clause)
        for clause in clauses
    )


def names_in(clauses: Clauses) -> list[str]:
    """Return the axes and points that a condition compares."""
    return [of for clause in clauses for of, _, _ in clause]
