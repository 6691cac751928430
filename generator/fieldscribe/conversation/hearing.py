"""What is known while frames are decoded: the device, where its points are, and their values so far."""

from __future__ import annotations

from collections import ChainMap
from typing import TYPE_CHECKING

from fieldscribe.conversation.items import named_item, value_item
from fieldscribe.records import dataclass, field, replace

if TYPE_CHECKING:
    from collections.abc import Iterable
    from fractions import Fraction

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.conversation.items import Base
    from fieldscribe.families.answers import Item
    from fieldscribe.families.directory import Directory
    from fieldscribe.model import Device, Point


@dataclass(slots=True)
class Hearing:
    """What one dialogue has told: numbers for rules, words of parameters, and points that wait for others."""

    device: Device
    directory: Directory
    by_person: dict[str, int | Fraction]
    known: dict[str, int | Fraction] = field(default_factory=dict)
    words: dict[int, int] = field(default_factory=dict)
    waiting: dict[str, tuple[Point, int]] = field(default_factory=dict)
    """Points whose meaning needs others, by item, with their raw numbers."""

    @property
    def settings(self) -> Settings:
        """The numbers for rules: what the person gave, else what was heard."""
        return ChainMap(self.by_person, self.known)

    def learn(self, raws: Iterable[tuple[Point, int]]) -> None:
        """Keep the values of points that the device reported."""
        self.known.update(self.directory.settings(raws))

    def forget(self, address: int) -> None:
        """Forget the values that the device derives from a parameter, once the parameter was written."""
        written = {point.name for point in self.directory.at("parameter", address)}
        for point in self.device.points:
            if written & set(point.changes_with):
                self.known.pop(point.name, None)
                for at in point.addresses:
                    self.words.pop(at, None)

    def value(self, point: Point, base: Base, raw: int, *, written: bool = False) -> Item:
        """A point with the meaning of its raw number."""
        return value_item(self.device, point, base, (raw, self.settings), written=written)


def odd_item(point: Point, base: Base, said: str, odd: str) -> Item:
    """A point for which a frame carries something else than its number, and why that is wrong."""
    return replace(named_item(point, base, f"{said}; {odd}"), findings=(odd,))
