"""What is written before an address means a point, as arrays of the Modbus header."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from fieldscribe.arithmetic.words import group_mask, insert, words_of
from fieldscribe.families.modbus import SPACES, Profile
from fieldscribe.model import Device, Point
from fieldscribe.model.device import WHOLE_WORD
from fieldscribe.targets.c.scope import HeaderScope, hexadecimal, unsigned


@dataclass(slots=True)
class Selections:
    """The rows of all selections of a device by the name of their array, each once."""

    device: Device
    profile: Profile
    scope: HeaderScope
    has_pages: bool
    """True if some points select others."""
    arrays: dict[str, list[str]] = field(default_factory=dict)

    def of(self, point: Point) -> str | None:
        """Return the argument that says what selects a point; empty in a device without pages, None if no row can."""
        held = list(self.device.selections(point))
        if point.selects and (point.base or not all(self._has_row(other) for other, _ in held)):
            return None
        if not held:
            return "NULL" if self.has_pages else ""
        parts = [f"{other.item}_{raw}".replace("-", "minus_") for other, raw in held]
        name = f"{self.scope.prefix}_select_{'_'.join(parts)}"
        if name not in self.arrays:
            self.arrays[name] = list(self._rows(held))
        return name

    def _has_row(self, point: Point) -> bool:
        """Return True if one word at one address holds the raw number of a point."""
        at_one = point.write_place is None or point.bits is None
        has_address = bool(point.written.addresses)
        return has_address and point.words == 1 and point.base is None and at_one and bool(self._write(point))

    def _write(self, point: Point) -> int | None:
        return self.profile.write_function(point.space, 1)

    def _rows(self, held: list[tuple[Point, int]]) -> Iterator[str]:
        for other, raw in held:
            [word], mask, read = words_of(other, raw), WHOLE_WORD, 0
            if other.bits is not None:
                word, mask, read = insert(other, 0, raw), group_mask(other), SPACES[other.space].read
                mask |= other.fixed.mask if other.fixed is not None else 0
            place = hexadecimal(min(other.written.addresses)), hexadecimal(mask), unsigned(word)
            is_last = "true" if other is held[-1][0] else "false"
            yield f"{{{', '.join((*place, unsigned(read), unsigned(self._write(other) or 0), is_last))}}}"
