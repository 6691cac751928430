"""Finds the templates and the shipped descriptions: inside the installed package, or beside it in a checkout."""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

_LEFT_BEHIND = frozenset({"__pycache__", "target", ".mypy_cache", ".ruff_cache"})
_PACKAGE = Path(__file__).resolve().parent


@lru_cache(maxsize=1)
def templates_dir() -> Path:
    """Return the folder that has a folder of templates for each target."""
    return _shipped("templates")


@lru_cache(maxsize=1)
def descriptions_dir() -> Path:
    """Return the folder of the descriptions that come with the compiler."""
    return _shipped("descriptions")


def compiler_files() -> Iterator[str]:
    """Yield the files of the compiler and its templates, in a fixed order: all output depends on them."""
    for root in (_PACKAGE, templates_dir()):
        for folder, folders, files in os.walk(root):
            folders[:] = sorted(set(folders) - _LEFT_BEHIND)
            yield from (os.path.join(folder, name) for name in sorted(files))


def runtime_files(folder: str) -> tuple[str, ...]:
    """Return the files of a runtime below a folder of templates, in a fixed order, without leftovers of tools."""
    root = templates_dir() / folder
    files = (path.relative_to(root) for path in root.rglob("*") if path.is_file())
    return tuple(sorted(path.as_posix() for path in files if not _LEFT_BEHIND.intersection(path.parts)))


def _shipped(name: str) -> Path:
    inside = _PACKAGE / "shipped" / name
    return inside if inside.is_dir() else _PACKAGE.parents[1] / name
