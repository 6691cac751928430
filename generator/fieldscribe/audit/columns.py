"""The columns of tables: what nearly all rows print in one column, no row prints in another one."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.manual import Extent, Manual, Token

_ROWS = 8
"""So many rows have to print a fact before they show its column."""
_STRAYS = 0.02
"""At most so large a share of the rows, or one row, prints it elsewhere: it was changed, or an erratum says so."""
_Kind: TypeAlias = "tuple[str, int, str, bool, str]"


class Columns:
    """In which columns of its row each fact stands."""

    def __init__(self, manual: Manual) -> None:
        self.manual = manual
        self._claims: dict[Extent, list[tuple[Claim, set[int]]]] = {}

    def note(self, claim: Claim, extent: Extent, tokens: Iterable[Token]) -> None:
        """Numbers or words of a row that state a fact."""
        if not claim.optional:
            columns = {self.manual.column(token.line, token.column - 1) for token in tokens}
            self.note_columns(claim, extent, columns)

    def note_columns(self, claim: Claim, extent: Extent, columns: set[int | None]) -> None:
        """The columns in which a fact stands."""
        if extent.kind == "row":
            self._claims.setdefault(extent, []).append((claim, columns - {None}))  # type: ignore[arg-type]

    def strays(self, is_shared: Callable[[Extent], bool]) -> Iterator[tuple[Claim, Extent]]:
        """The facts that stand in their row, but not in the column of their kind."""
        rows: dict[_Kind, list[tuple[Claim, Extent, set[int]]]] = {}
        for extent, claims in self._claims.items():
            line = self.manual.line(extent.first)
            gap = "|" if line.startswith("|") else "\t"
            for claim, own in claims:
                columns = own
                if claim.is_address:  # a number that is misprinted in one notation stands right in the other
                    columns = set().union(*(others for other, others in claims if _are_alike(claim, other)))
                kind = (gap, line.count(gap), claim.fact, is_shared(extent))
                rows.setdefault((*kind, ""), []).append((claim, extent, columns))
                rows.setdefault((*kind, self.manual.head(extent.first)), []).append((claim, extent, columns))
        for alike in rows.values():
            needed = _columns_of([columns for _, _, columns in alike])
            yield from ((claim, extent) for claim, extent, columns in alike if not needed <= columns)


def _are_alike(claim: Claim, other: Claim) -> bool:
    return (claim.subject, claim.fact) == (other.subject, other.fact)


def _columns_of(rows: list[set[int]]) -> set[int]:
    """The columns in which nearly all rows print a fact."""
    enough = len(rows) - max(1, _STRAYS * len(rows))
    columns = set().union(*rows) if len(rows) >= _ROWS else set()
    return {column for column in columns if sum(column in row for row in rows) >= enough}
