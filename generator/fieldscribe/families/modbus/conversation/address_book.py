"""Which points stand at the addresses that a frame names, and what its words or bits mean for them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.arithmetic.codec import setting_of
from fieldscribe.conversation.answers import Item
from fieldscribe.conversation.items import named_item, present_first, value_item
from fieldscribe.conversation.lookup import word_text
from fieldscribe.conversation.selection import absence
from fieldscribe.families.modbus.conversation.words import raw_of
from fieldscribe.families.modbus.functions import READS, SPACES
from fieldscribe.text import line
from fieldscribe.wording import title_text
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Mapping
    from fractions import Fraction

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.model import Command, Device, Place, Point

_SPACE_OF: Mapping[int, str] = {
    function: name
    for name, space in SPACES.items()
    for function in (space.read, space.write_one, space.write_many)
    if function is not None
}


@dataclass(frozen=True, slots=True)
class Area:
    """Consecutive addresses that a frame names, and what it carries for them (None: it only asks)."""

    function: int
    address: int
    count: int
    values: tuple[int, ...] | None = None

    @property
    def space(self) -> str:
        """The space that the function reaches."""
        return _SPACE_OF.get(self.function, "")

    @property
    def words(self) -> dict[int, int]:
        """What is carried, by address."""
        return dict(zip(range(self.address, self.address + self.count), self.values or (), strict=False))


class AddressBook:
    """The points of a device by space and address."""

    def __init__(self, device: Device) -> None:
        self._device = device
        self._at: dict[tuple[str, int], list[tuple[Point, Place]]] = {}
        for point in present_first(device):
            for place in point.places:
                spaces = {place.space, _SPACE_OF.get(place.function or 0, place.space)}
                for key in ((space, address) for space in sorted(spaces) for address in place.addresses):
                    here = self._at.setdefault(key, [])
                    if not (here and absence(device, point)):
                        here.append((point, place))

    def starting_at(self, space: str, address: int) -> list[tuple[Point, Place]]:
        """The points whose lowest address this is."""
        return [one for one in self._at.get((space, address), ()) if min(one[1].addresses) == address]

    def raws(self, area: Area) -> dict[str, int | Fraction]:
        """What rules take of all points that the area carries whole, by point name."""
        words, found = area.words, {}
        for point, place in self._points(area):
            if all(address in words for address in place.addresses):
                found[point.name] = setting_of(point, raw_of(point, place.addresses, words))
        return found

    def items(self, area: Area, settings: Settings) -> tuple[Item, ...]:
        """What the area says, in the order of its addresses; neighbours that nobody knows are one item."""
        items: list[Item] = []
        unknown: list[int] = []
        end = area.address + area.count
        for address in range(area.address, end):
            here = self._at.get((area.space, address), [])
            command = next((one for one in self._device.commands if _names(one, area, address)), None)
            if here or command:
                items += self._unknown(area, unknown)
                unknown = []
            else:
                unknown.append(address)
            items += [self._item(area, one, settings) for one in here if address == self._first(area, one[1])]
            if command:
                items.append(_command(command, area))
        return (*items, *self._unknown(area, unknown))

    def _points(self, area: Area) -> list[tuple[Point, Place]]:
        found: dict[str, tuple[Point, Place]] = {}
        for address in range(area.address, area.address + area.count):
            found.update((one[0].item, one) for one in self._at.get((area.space, address), ()))
        return list(found.values())

    @staticmethod
    def _first(area: Area, place: Place) -> int:
        """The first address of the place that lies in the area."""
        return min(address for address in place.addresses if address >= area.address)

    def _item(self, area: Area, found: tuple[Point, Place], settings: Settings) -> Item:
        point, place = found
        inside = [one for one in place.addresses if area.address <= one < area.address + area.count]
        whole = len(inside) == len(place.addresses)
        words = area.words
        base = (area.space, min(inside), len(inside))
        odd = "" if words and area.function in READS else absence(self._device, point)
        if not whole:
            texts = [word_text(place.addresses, one) + _carried(words, one) for one in inside]
            return named_item(point, base, f"only the {', '.join(texts)}", odd=odd)
        if not all(address in words for address in inside):
            return named_item(point, base, odd=odd)
        raw = raw_of(point, place.addresses, words)
        return value_item(self._device, point, base, (raw, settings), written=area.function not in READS)

    def _unknown(self, area: Area, addresses: list[int]) -> list[Item]:
        if not addresses:
            return []
        low, high = addresses[0], addresses[-1]
        words = area.words
        carried = [
            f"{words[one]:04X}h" if area.space in ("holding", "input") else str(words[one])
            for one in addresses
            if one in words
        ]
        text = f"{span_text(low, high)}: no point is described here"
        gap = next((gap for gap in self._device.bus.gaps.get(area.space, ()) if gap[0] <= high and low <= gap[1]), None)
        closed = "" if gap is None else f"the manual closes {hex_text(gap[0])} to {hex_text(gap[1])}"
        text += f"; {closed}" if closed else ""
        if carried:
            text += f" (carries {' '.join(carried[:16])}{' ...' if len(carried) > 16 else ''})"
        return [Item(area.space, low, len(addresses), text, findings=(closed,) if closed else ())]


def span_text(low: int, high: int) -> str:
    """Addresses in both notations: `1028h (4136)`, `1013h to 1014h (4115 to 4116)`."""
    return f"{hex_text(low)} ({low})" if low == high else f"{hex_text(low)} to {hex_text(high)} ({low} to {high})"


def _carried(words: Mapping[int, int], address: int) -> str:
    return f" = {words[address]:04X}h" if address in words else ""


def _names(command: Command, area: Area, address: int) -> bool:
    return command.address == address and command.space == area.space and area.function not in READS


def _command(command: Command, area: Area) -> Item:
    text = f"command {command.name}: {title_text(command.title)}"
    given = area.words.get(command.address)
    wrong = command.value is not None and given is not None and given != command.value
    odd = f"it takes {command.value}, here is {given}" if wrong else ""
    text += f"; {odd}" if odd else ""
    if command.wears:
        text += f"; the memory stands {command.wears} writes"
    return Item(area.space, command.address, 1, line(text), raw=given, findings=(odd,) if odd else ())
