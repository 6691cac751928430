"""The columns of tables and the names of rows: what nearly all print in one of them, none prints in another one."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.manual import Extent, Manual, Token

_ROWS = 8
"""So many places have to print a fact before they show its column."""
_STRAYS = 0.02
"""At most so large a share of the places, or one place, prints it elsewhere: it was changed there."""
_NAME = re.compile(r"[^\W\d]*")
_Columns: TypeAlias = "frozenset[int | str]"
_Stands: TypeAlias = "tuple[Claim, Extent, _Columns]"


class Columns:
    """In which columns of its row each fact stands, or in which rows of its section, by their first words."""

    def __init__(self, manual: Manual) -> None:
        self.manual = manual
        self._claims: dict[Extent, list[tuple[Claim, _Columns]]] = {}

    def note(self, claim: Claim, extent: Extent, tokens: Iterable[Token]) -> None:
        """Numbers that state a fact."""
        if claim.optional:
            return
        if extent.kind == "section" and not claim.names:
            self._note(claim, extent, {self._name_of(token.line) for token in tokens})
        elif extent.kind == "row":
            self.note_columns(claim, extent, {self.manual.column(token.line, token.column - 1) for token in tokens})

    def note_columns(self, claim: Claim, extent: Extent, columns: set[int | None]) -> None:
        """The columns in which a fact stands in its row."""
        if extent.kind == "row":
            self._note(claim, extent, {column for column in columns if column is not None})

    def note_heading(self, claim: Claim, extent: Extent, stands: bool) -> None:
        """Whether a title stands in the heading of its section."""
        if extent.kind == "section":
            self._note(claim, extent, {"heading"} if stands else ())

    def strays(
        self, is_shared: Callable[[Extent], bool], is_taken: Callable[[Claim, Extent], bool]
    ) -> Iterator[tuple[Claim, Extent]]:
        """The facts that stand in their row, but not in the column of their kind."""
        kinds: dict[object, list[_Stands]] = {}
        for extent, claims in self._claims.items():
            for claim, own in claims:
                columns = own
                if claim.is_address:  # a number that is misprinted in one notation stands right in the other
                    columns = frozenset().union(*(others for other, others in claims if _are_alike(claim, other)))
                for table in self._tables(extent):
                    kind = (*table, claim.fact, claim.kind_of_subject, is_shared(extent))
                    kinds.setdefault(kind, []).append((claim, extent, columns))
        for alike in kinds.values():
            yield from _strays(alike, is_taken)

    def _note(self, claim: Claim, extent: Extent, columns: Iterable[int | str]) -> None:
        self._claims.setdefault(extent, []).append((claim, frozenset(columns)))

    def _name_of(self, line: int) -> str:
        """The first word of a line."""
        match = _NAME.match(self.manual.line(line))
        return match[0] if match else ""

    def _tables(self, extent: Extent) -> Iterator[tuple[str, int, str]]:
        """What tells tables apart: how many columns they have, and their heads, too."""
        line = self.manual.line(extent.first)
        gap = "|" if line.startswith("|") else "\t"
        if extent.kind == "section":
            yield "section", 0, ""
        else:
            yield gap, line.count(gap), ""
            yield gap, line.count(gap), self.manual.head(extent.first)


def _are_alike(claim: Claim, other: Claim) -> bool:
    return (claim.subject, claim.fact) == (other.subject, other.fact)


def _strays(alike: list[_Stands], is_taken: Callable[[Claim, Extent], bool]) -> Iterator[tuple[Claim, Extent]]:
    """Those that lack a column in which nearly all stand; what an erratum speaks of is not counted."""
    if len(alike) < _ROWS:
        return
    columns = frozenset().union(*(columns for _, _, columns in alike))
    often = [column for column in columns if sum(column in own for _, _, own in alike) >= len(alike) / 2]
    for column in sorted(often, key=str):
        lacking = [(claim, extent) for claim, extent, own in alike if column not in own]
        lacking = [(claim, extent) for claim, extent in lacking if not is_taken(claim, extent)]
        if len(lacking) <= max(1, _STRAYS * len(alike)):
            yield from lacking
