"""The casing of identifiers, for all targets."""

from __future__ import annotations

from functools import lru_cache


@lru_cache(maxsize=65536)
def pascal(name: str) -> str:
    """Return `base_frequency` as `BaseFrequency`; an underscore between digits stays (`a_1_2` is `A1_2`)."""
    parts = name.split("_")
    result = parts[0].capitalize()
    for part in parts[1:]:
        joined_digits = part[:1].isdigit() and result[-1:].isdigit()
        result += ("_" if joined_digits else "") + part.capitalize()
    return result


@lru_cache(maxsize=65536)
def upper(name: str) -> str:
    """Return `base_frequency` as `BASE_FREQUENCY`."""
    return name.upper()
