"""What a family adds to the vectors of a device: the part `targets.vectors` of its folder builds on this."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from fieldscribe.model import Bus, Code, Device, Point
    from fieldscribe.targets.vectors.lines import Lines

NO_BROADCAST = 0xFFFF
"""The unit number for devices without broadcast: larger than any other."""

Script = list[tuple[bytes, bytes]]
"""The requests of an exchange with their answers."""


class Wire(Protocol):
    """A way in which a family reads and writes the words of a point."""

    def opens(self, lines: Lines) -> None:
        """Set what all exchanges share: the unit and the settings of the line."""

    def reads(self, point: Point, words: tuple[int, ...]) -> Script | None:
        """The exchange that reads these words, in ascending order of address; None if no request can."""

    def writes(self, point: Point, words: tuple[int, ...], *, keep: bool) -> Script | None:
        """The exchange that writes these words; with `keep` permanently, if another request does that."""

    def spoils(self, point: Point, script: Script, *, writes: bool) -> Iterator[tuple[str, Script]]:
        """The exchange with bad answers, each with the status that it gives."""


class FamilyVectors:
    """The vectors that only one family has. By default there are none."""

    KINDS: Mapping[str, str] = MappingProxyType({})
    """The kinds of vectors that only this family has, with the fields of their lines."""

    def limits(self, lines: Lines, bus: Bus) -> None:
        """Add the vectors of the constants of the bus."""

    def frames(self, lines: Lines, device: Device) -> None:
        """Add the vectors of the frames of a device."""

    def wires(self, device: Device) -> Sequence[Wire]:
        """The ways in which points travel, with the usual way first."""
        del device
        return ()


def add_limits(lines: Lines, **numbers: int) -> None:
    """Add a `limit` vector for each constant of the bus."""
    for what, number in numbers.items():
        lines.add("limit", what, number)


def add_codes(lines: Lines, kind: str, what: str, numbers: Iterable[Code]) -> None:
    """Add vectors for named numbers of the protocol: a `code` that is received, or a `constant` for callers."""
    for code in numbers:
        lines.add(kind, what, code.number, code.name)


def writing_addresses(point: Point) -> tuple[int, ...]:
    """Where a point is written."""
    return point.addresses if point.write_place is None else point.write_place.addresses
