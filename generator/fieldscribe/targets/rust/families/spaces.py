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


def space(name: str) -> str:
    """A space as a variant of the runtime's enum."""
    known = _SPACES.get(name)
    return f"runtime::Space::{known}" if known else f"runtime::Space::Other({rust_string(name)})"
