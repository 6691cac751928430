"""Spaces as the runtime names them."""

from __future__ import annotations

from fieldscribe.text import rust_string

_SPACES = {
    "coil": "Coil",
    "discrete": "Discrete",
    "input": "Input",
    "holding": "Holding",
    "parameter": "Parameter",
    "telegram": "Telegram",
}


def space_variant(name: str) -> str:
    """A space as a variant of the runtime's enum."""
    known = _SPACES.get(name)
    return known or f"Other({rust_string(name)})"


def space(name: str) -> str:
    """The same with the enum, as a value."""
    return f"runtime::Space::{space_variant(name)}"
