"""Which cases of a test are in the core suite."""

from __future__ import annotations

from collections.abc import Iterable

import pytest
from _pytest.mark.structures import ParameterSet


def full_but(quick: Iterable[object], cases: Iterable[object], seconds: float = 1) -> list[ParameterSet]:
    """Return the cases, all of which but the quick ones are for the full suite."""
    marked = pytest.mark.full(seconds=seconds)
    return [pytest.param(case, marks=() if case in tuple(quick) else marked) for case in cases]
