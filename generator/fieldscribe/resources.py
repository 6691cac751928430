"""Where the templates and the shipped descriptions are: inside the installed package, or beside it in a checkout."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent


@lru_cache(maxsize=1)
def templates_dir() -> Path:
    """The folder that holds one folder of templates per target."""
    return _shipped("templates")


@lru_cache(maxsize=1)
def descriptions_dir() -> Path:
    """The folder of the descriptions that come with the compiler."""
    return _shipped("descriptions")


def _shipped(name: str) -> Path:
    inside = _PACKAGE / "shipped" / name
    return inside if inside.is_dir() else _PACKAGE.parents[1] / name
