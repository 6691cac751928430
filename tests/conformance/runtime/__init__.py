"""Checks of the runtime itself, on made devices: every package ships it, so they run for every package."""

from __future__ import annotations

from collections.abc import Callable

from conformance.package import Package
from conformance.runtime import (
    arguments,
    can,
    descriptors,
    errors,
    fast,
    forms,
    guide,
    layouts,
    memory,
    modbus,
    quantities,
    reading,
    steps,
    traffic,
    uss,
    words,
)

_THEMES = (
    errors,
    arguments,
    guide,
    forms,
    fast,
    words,
    quantities,
    layouts,
    descriptors,
    memory,
    reading,
    traffic,
    steps,
    modbus,
    can,
    uss,
)
CHECKS: list[Callable[[Package], None]] = [
    check for theme in _THEMES for name, check in vars(theme).items() if name.startswith("check_")
]
"""Each raises AssertionError, or what the runtime raises, where it is not as it should be."""
