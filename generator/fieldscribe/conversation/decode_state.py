"""What is known while frames are decoded: the device, where its points are, and their values so far."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from fieldscribe.conversation.items import named_item

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from fractions import Fraction

    from fieldscribe.conversation.items import Base
    from fieldscribe.conversation.point_formatter import PointFormatter, PointTextCache
    from fieldscribe.families.directory import Directory
    from fieldscribe.families.frame_results import Item
    from fieldscribe.model import Device, Point


@dataclass(slots=True)
class DecodeState:
    """What one dialogue has told: numbers for rules, words of parameters, and points that wait for others."""

    device: Device
    directory: Directory
    told: PointTextCache
    by_person: Mapping[str, int | Fraction]
    settings: dict[str, int | Fraction]
    """The numbers for rules: what the person gave, else what was heard."""
    words: dict[int, int] = field(default_factory=dict)
    waiting: dict[str, tuple[PointFormatter, int]] = field(default_factory=dict)
    """What speaks for points whose meaning needs others, by item, with their raw numbers."""
    fresh: set[str] = field(default_factory=set)
    """The settings that have changed since the waiting points were last tried."""

    def learn(self, raws: Iterable[tuple[Point, int]]) -> None:
        """Keep the values of points that the device reported."""
        for name, setting in self.directory.settings(raws):
            before = self.settings.get(name)
            # a special code equals the plain number, and is no quantity
            if name not in self.by_person and (before != setting or type(before) is not type(setting)):
                self.settings[name] = setting
                self.fresh.add(name)

    def beside(self) -> DecodeState:
        """The same for one frame whose points are settings for each other: what it learns is not kept."""
        return replace(self, settings=dict(self.settings), fresh=set())

    def forget(self, address: int) -> None:
        """Forget the values that the device derives from a parameter, once the parameter was written."""
        for written in {point.name for point in self.directory.at("parameter", address)}:
            for point in self.directory.derived(written):
                if point.name not in self.by_person:
                    self.settings.pop(point.name, None)
                for at in point.addresses:
                    self.words.pop(at, None)

    def value(self, point: Point, base: Base, raw: int, *, written: bool = False) -> Item:
        """A point with the meaning of its raw number."""
        return self.told.voice(point, base, written=written).item(raw, self.settings)


def odd_item(point: Point, base: Base, said: str, odd: str) -> Item:
    """A point for which a frame carries something else than its number, and why that is wrong."""
    return replace(named_item(point, base, f"{said}; {odd}"), findings=(odd,))
