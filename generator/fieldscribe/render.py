"""The one Jinja environment. Templates place text; everything is decided before."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import TYPE_CHECKING

from fieldscribe.resources import templates_dir

if TYPE_CHECKING:
    from pathlib import Path

    from jinja2 import Environment

Render = Callable[[str, Mapping[str, object]], str]
"""Template name and context to text."""


@lru_cache(maxsize=1)
def _environment(folder: Path) -> Environment:
    """Templates are compiled once a run and never stored: all code that runs comes from the package."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(folder),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        auto_reload=False,
        autoescape=False,  # noqa: S701 - no HTML: views hold finished text, encoded by text.py
    )
    # views are objects without items: to look for items behind attributes took a tenth of a large compile
    vars(environment)["getattr"] = getattr
    return environment


def render(template: str, context: Mapping[str, object]) -> str:
    """The template of that name (relative to the templates folder), filled from `context`."""
    return _environment(templates_dir()).get_template(template).render(context)
