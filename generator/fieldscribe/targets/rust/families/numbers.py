"""Numbers of the protocol that have names."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.rust.documentation import sentence
from fieldscribe.targets.rust.layout import binding
from fieldscribe.targets.rust.literals import integer

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.model import Code

Constant = tuple[str, tuple[str, ...]]
"""What a doc comment says of a constant, and its lines."""


def constants(codes: Iterable[Code], type_: str) -> tuple[Constant, ...]:
    """A constant of that type for each code."""
    return tuple(
        (sentence(one.name), binding(4, f"pub const {one.name.upper()}: {type_}", integer(one.number))) for one in codes
    )
