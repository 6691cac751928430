"""Numbers of the protocol that have names."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.rust.documentation import sentence
from fieldscribe.targets.rust.layout import Item, arm, binding
from fieldscribe.targets.rust.literals import integer
from fieldscribe.text import rust_string

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.model import Code

Constant = tuple[str, tuple[str, ...]]
"""The doc comment of a constant, and its lines."""


def constants(codes: Iterable[Code], type_: str, what: str = "") -> tuple[Constant, ...]:
    """A constant of that type for each code; `what` is the word for its number in the doc comment."""
    return tuple(
        (
            f"{sentence(code.name).rstrip('.')}: {what} {code.number}." if what else sentence(code.name),
            binding(4, Item(f"pub const {code.name.upper()}", type_), integer(code.number)),
        )
        for code in codes
    )


def code_names(codes: Iterable[Code]) -> tuple[str, ...]:
    """The match arms from codes to their names, each code once."""
    named = {code.number: code.name for code in reversed(tuple(codes))}
    arms = (arm(12, name.upper(), f"Some({rust_string(name)})") for _, name in sorted(named.items()))
    return tuple(line for lines in arms for line in lines)
