"""Finds the templates and the shipped descriptions, inside the installed package or beside it; fills templates.

Templates only place text: what they need is worked out before.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jinja2 import Environment

Render = Callable[[str, Mapping[str, object]], str]
"""A function that fills the template of a name from a context."""

_LEFT_BEHIND = frozenset({"__pycache__", "target", ".mypy_cache", ".ruff_cache", "Cargo.lock"})
_PACKAGE = Path(__file__).resolve().parent


@lru_cache(maxsize=1)
def templates_dir() -> Path:
    """Return the folder that has a folder of templates for each target."""
    return _shipped("templates")


@lru_cache(maxsize=1)
def descriptions_dir() -> Path:
    """Return the folder of the descriptions that come with the compiler."""
    return _shipped("descriptions")


def pages_dir() -> Path:
    """Return the folder of our pages: the README, and the folder of the descriptions with the others."""
    return descriptions_dir().parent


def compiler_files() -> Iterator[str]:
    """Yield the files of the compiler and its templates, in a fixed order: all output depends on them."""
    for root in (_PACKAGE, templates_dir()):
        for folder, folders, files in os.walk(root):
            folders[:] = sorted(set(folders) - _LEFT_BEHIND)
            yield from (os.path.join(folder, name) for name in sorted(set(files) - _LEFT_BEHIND))


def runtime_files(folder: str) -> tuple[str, ...]:
    """Return the files of a runtime below a folder of templates, in a fixed order, without leftovers of tools."""
    root = templates_dir() / folder
    files = (path.relative_to(root) for path in root.rglob("*") if path.is_file())
    return tuple(sorted(path.as_posix() for path in files if not _LEFT_BEHIND.intersection(path.parts)))


def use_python_runtime() -> None:
    """Let `fieldscribe_runtime` be imported from the templates, which is the one that generated packages get.

    Raises ImportError if the program has imported one from elsewhere: objects of two runtimes do not fit together.
    """
    folder = templates_dir() / "python/runtime"
    loaded = getattr(sys.modules.get("fieldscribe_runtime"), "__file__", None)
    if loaded is not None and Path(loaded).resolve().parents[1] != folder:
        here = Path(loaded).parent
        raise ImportError(f"fieldscribe_runtime was imported from {here}, and fieldscribe needs the one in {folder}")
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))


def _shipped(name: str) -> Path:
    inside = _PACKAGE / "shipped" / name
    return inside if inside.is_dir() else _PACKAGE.parents[1] / name


@lru_cache(maxsize=1)
def _environment() -> Environment:
    """Return the environment. Templates are compiled once a run and never stored: no code comes from a cache."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    return Environment(
        loader=FileSystemLoader(templates_dir()),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        auto_reload=False,
        optimized=False,  # templates have no constant expressions to work out
        autoescape=False,  # noqa: S701 - no HTML: views hold finished text, encoded by text.py
    )


def render(template: str, context: Mapping[str, object]) -> str:
    """Return the template of that path below the templates' folder, filled from `context`."""
    return _environment().get_template(template).render(context)
