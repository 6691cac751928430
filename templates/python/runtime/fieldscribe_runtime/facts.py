# SPDX-License-Identifier: 0BSD
"""Where points are, and what else a description says of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NotRequired, TypedDict

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .forms import Allowed


@dataclass(frozen=True, slots=True)
class Place:
    """Where a point is: its space, its addresses (the high part first), and a function if it is not the usual one."""

    space: str
    addresses: tuple[int, ...]
    function: int | None = None

    @property
    def address(self) -> int:
        """The lowest address, which a request names."""
        return min(self.addresses)

    @property
    def span(self) -> int:
        """How many words or bits a request for it covers."""
        return max(self.addresses) - min(self.addresses) + 1


def coil(*addresses: int, function: int | None = None) -> Place:
    """A bit that can be read and written."""
    return Place("coil", addresses, function)


def discrete(*addresses: int, function: int | None = None) -> Place:
    """A bit that can be read."""
    return Place("discrete", addresses, function)


def holding(*addresses: int, function: int | None = None) -> Place:
    """Registers that can be read and written."""
    return Place("holding", addresses, function)


def input_register(*addresses: int, function: int | None = None) -> Place:
    """Registers that can be read."""
    return Place("input", addresses, function)


class FactArguments(TypedDict):
    """What generated code says of a point beside its form."""

    at: Place
    write_at: NotRequired[Place]
    bits: NotRequired[tuple[int, int]]
    group: NotRequired[str]
    code: NotRequired[str]
    references: NotRequired[Mapping[str, int | str]]
    unit: NotRequired[str]
    allowed: NotRequired[Allowed]
    default: NotRequired[float]
    specials: NotRequired[Mapping[str, tuple[int, int]]]
    changes: NotRequired[str]
    variant: NotRequired[tuple[str, str]]
    name: NotRequired[str]


@dataclass(slots=True, kw_only=True)
class Facts:
    """What a description says of a point. `item` is what the attribute is called, `name` leaves out the variant.

    `references` are the manual's other numberings of the point, `allowed` the raw numbers that it allows.
    """

    at: Place
    write_at: Place | None = None
    bits: tuple[int, int] | None = None
    group: str = ""
    code: str | None = None
    references: Mapping[str, int | str] = field(default_factory=dict)
    unit: str = ""
    allowed: Allowed | None = None
    default: float | None = None
    specials: Mapping[str, tuple[int, int]] = field(default_factory=dict)
    changes: str | None = None
    variant: tuple[str, str] | None = None
    name: str = ""
    item: str = ""
