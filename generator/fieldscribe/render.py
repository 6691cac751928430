"""The one Jinja environment. Templates only place text: what they need is worked out before."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import TYPE_CHECKING

from fieldscribe.resources import templates_dir

if TYPE_CHECKING:
    from jinja2 import Environment

Render = Callable[[str, Mapping[str, object]], str]
"""A function that fills the template of a name from a context."""


@cache
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
        autoescape=False,  # noqa: S701 - no HTML: views hold finished text, encoded by text.py
    )


def render(template: str, context: Mapping[str, object]) -> str:
    """Return the template of that path below the templates' folder, filled from `context`."""
    return _environment().get_template(template).render(context)
