"""What differs from family to family: the items of a crate that are no points, and what points can do on their bus."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families import family
from fieldscribe.targets.rust.layout import filled

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from fieldscribe.model import Device
    from fieldscribe.targets.identifiers import Names
    from fieldscribe.targets.rust.subjects import CratePoint, CrateScope

Tokens = tuple[str, ...]
"""Words of a row, between which it may be broken."""

Needs = tuple[tuple[str, Tokens], ...]
"""Structs and their fields."""

Way = tuple[str, str, Needs]
"""How a point travels: the kind of vector, the runner's function, and what that needs."""


@dataclass(frozen=True, slots=True)
class Table:
    """The function that a table of conformance becomes, the runner's function behind it, and its rows.

    `kind` is that of the vectors of whole exchanges which it answers; empty for all others.
    """

    name: str
    run: str
    rows: tuple[Tokens, ...]
    kind: str = ""

    @property
    def lines(self) -> tuple[Tokens, ...]:
        """The rows in lines."""
        return tuple(filled("", " ", row, ";") for row in self.rows)


def nothing(*_: object) -> tuple[()]:
    """For families that have none."""
    return ()


@dataclass(frozen=True, slots=True)
class OfFamily:
    """What the part `targets.rust` of a family offers as `IN_RUST`.

    `context` is what the template of the family's items sees, `<family>.rs.j2`; `traits` are those that a point
    implements for its bus, each in a line; `identifiers` those of the family's own items. The conformance program asks
    for further `ways` of a point, for tables of points and of frames that only this family has, and for the kind of
    vectors that the codes of refusals are.
    """

    context: Callable[[Device], Mapping[str, object]]
    traits: Callable[[CratePoint, CrateScope], Iterable[str]] = nothing
    identifiers: Callable[[Device], Iterable[Names]] = nothing
    ways: Callable[[CratePoint, CrateScope], Iterable[Way]] = nothing
    tables_of_points: Callable[[CrateScope], Iterable[Table]] = nothing
    tables_of_frames: Callable[[Device], Iterable[Table]] = nothing
    refusals: str = "code"


def in_rust(name: str) -> OfFamily:
    """What the family of that name says of itself."""
    said: OfFamily = family(name).part("targets.rust").IN_RUST
    return said
