"""The state of decoding: the addresses of points, their texts, and the numbers of frames so far."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from typing import Any

from fieldscribe.arithmetic.codec import setting_of
from fieldscribe.conditions import absent
from fieldscribe.conversation.point_items import Base, PointFormatter, english_title
from fieldscribe.conversation.selection import moved, same_meaning
from fieldscribe.families import family
from fieldscribe.families.decoded_frame import AddressSpan
from fieldscribe.families.frame_results import Item
from fieldscribe.grouping import grouped
from fieldscribe.model import Device, Found, Place, Point
from fieldscribe.text import line
from fieldscribe.wording import label


class FoundBlocks:
    """What the replies of a unit show of a chain of blocks; `starts` and `lasts` have the bases that follow."""

    def __init__(self, device: Device, found: Found) -> None:
        self._found = found
        self._bases = [base for base in device.bases if base.block is not None]
        self._first: int | None = None
        self._heads: dict[int, int] = {}
        self._counts: dict[tuple[str, str], int] = {}
        self.starts: dict[str, int] = {}
        self.lasts: dict[str, int] = {}

    def take(self, space: str, address: int, words: Sequence[int]) -> bool:
        """Take words that the device reported; return True if they move a base."""
        if space != self._found.space:
            return False
        seen = dict(enumerate(words, address))
        marker, before = self._found.words, dict(self.starts)
        for place in self._found.places:
            if self._first is None and all(seen.get(place + at) == word for at, word in enumerate(marker)):
                self._first = place + len(marker)
        blocks = self._blocks(seen)
        for base in self._bases:
            if base.block not in blocks:
                continue
            start, last = blocks[base.block]
            for name, at, _ in base.counts:
                if start + at in seen:
                    self._counts[base.name, name] = seen[start + at]
            numbers = [self._counts.get((base.name, name)) for name, _, _ in base.counts]
            known = [number for number in numbers if number is not None]
            if len(known) == len(numbers):
                counted = zip(known, base.counts, strict=True)
                self.starts[base.name] = start + base.offset + sum(number * each[2] for number, each in counted)
                self.lasts[base.name] = last
        return self.starts != before

    def _blocks(self, seen: dict[int, int]) -> dict[int, tuple[int, int]]:
        """Return the first and the last address of each block with a known head; the first of an id counts."""
        blocks: dict[int, tuple[int, int]] = {}
        at = self._first
        while at is not None:
            self._heads.update({head: seen[head] for head in (at, at + 1) if head in seen})
            block, length = self._heads.get(at), self._heads.get(at + 1)
            if block is None or length is None or block == self._found.end:
                break
            blocks.setdefault(block, (at, at + 1 + length))
            at += 2 + length
        return blocks


PARAMETER = "parameter"
"""The space of parameters."""

Where = tuple[str, int, int]
"""The space or the telegram, the address, and the index that travels with it (0 without one)."""

PointPlace = tuple[Point, Place]


class Directory:
    """The points of a device by address, for reading and for writing."""

    def __init__(self, device: Device) -> None:
        self._at: dict[Where, list[PointPlace]] = {}
        self._points: dict[Where, list[Point]] = {}
        indexed = family(device.family).indexed
        # points that the chosen variants lack come last, so that present points win their places
        for point in sorted(device.points, key=lambda point: absent(point.when, device.variants)):
            for place in point.places if point.base is None else ():
                index = (point.index or 0) if point.space in indexed else 0
                for address in place.addresses:
                    here = self._at.setdefault((point.telegram or point.space, address, index), [])
                    if not (here and absent(point.when, device.variants)):
                        here.append((point, place))
        places: dict[str, set[tuple[tuple[int, ...], int | None]]] = {}
        for point in device.points:
            places.setdefault(point.name, set()).add((point.addresses, point.index))
        self.has_selections = bool(device.selecting)
        rules = device.selecting.union(*(point.arguments for point in device.points))
        self._settings = {name for name in rules if len(places.get(name, ())) == 1}
        named = ((point.telegram or "", point) for point in device.points if point.addresses)
        self._firsts = {(telegram, point.name): point.addresses[0] for telegram, point in named}
        self._derived = grouped((name, point) for point in device.points for name in point.changes_with)

    def places(self, where: str, address: int, index: int = 0) -> list[PointPlace]:
        """Return the points that have a word at this address, each with its place."""
        return self._at.get((where, address, index), [])

    def at(self, where: str, address: int, index: int = 0) -> list[Point]:
        """Return the points that have a word at this address."""
        place = where, address, index
        if place not in self._points and place in self._at:  # some, if the device decides the number
            self._points[place] = list({point.item: point for point, _ in self._at[place]}.values())
        return self._points.get(place, [])

    def starting_at(self, where: str, address: int) -> list[PointPlace]:
        """Return the points whose lowest address is this, each with its place."""
        return [(point, place) for point, place in self.places(where, address) if min(place.addresses) == address]

    def neighbours(self, point: Point, address: int) -> list[Point]:
        """Return the points that begin at an address in the space or telegram of a point."""
        return [other for other, _ in self.starting_at(point.telegram or point.space, address)]

    def first(self, telegram: str, name: str) -> int | None:
        """Return the first address of a point of the telegram; None if the telegram has no such point."""
        return self._firsts.get((telegram, name))

    def derived(self, name: str) -> list[Point]:
        """Return the points whose values change when the named point is written."""
        return self._derived.get(name, [])

    def teaches(self, point: Point) -> bool:
        """Return True if a rule needs the raw number of this point, and not if its variants have different places."""
        return point.name in self._settings


_MOST_PLANS = 1024
"""The number of places whose plan is kept."""

Read = Callable[[Sequence[int]], Any]
"""Returns the raw number of a point from the words of a frame; None while it lacks words of other frames."""

Step = tuple[PointFormatter | None, Read, Any]
"""A point and its number, or without a formatter what has no point: a place, as whoever makes the plan knows it."""


class Plan:
    """How the words at one place become items. `taught` are the points that are settings for others."""

    def __init__(self, taught: Sequence[tuple[Point, Read]], steps: Sequence[Step]) -> None:
        self.taught, self.steps = taught, steps

    def teach(self, state: DecodeState, words: Sequence[int]) -> None:
        """Let the state learn the settings in the words."""
        if self.taught:
            state.learn([(point, raw) for point, read in self.taught if (raw := read(words)) is not None])


@dataclass(slots=True)
class DecodeState:
    """What is known from the frames of one unit: numbers for rules, words of parameters, and incomplete points."""

    device: Device
    directory: Directory
    formatters: dict[tuple[str, Base, bool], PointFormatter]
    """The formatters that all units of the device share, each made once."""
    given: Mapping[str, int | Fraction]
    settings: dict[str, int | Fraction]
    """The numbers for rules: those of the user, else those of frames."""
    doubting: bool = False
    """True if items say whether their numbers are in range."""
    words: dict[int, int] = field(default_factory=dict)
    incomplete: dict[str, tuple[PointFormatter, int]] = field(default_factory=dict)
    """The points whose meaning needs unknown settings, by item, with their raw numbers."""
    version: int = 0
    """A number that grows with each change of the state on which later frames depend."""
    since: dict[str, int] = field(default_factory=dict)
    """The version since which each setting has its number, and each incomplete point its own."""
    changed: set[str] = field(default_factory=set)
    """The settings that have changed since the incomplete points were last tried."""
    blocks: FoundBlocks | None = None
    """The blocks that a master searches for, if the device has such."""
    plans: dict[Any, Plan] = field(default_factory=dict)
    """The plans for the words of spans and telegrams, by their place."""

    def locate(self, span: AddressSpan, described: Device) -> None:
        """Move the points of blocks to their addresses, as far as the words that the unit reported show them."""
        if self.blocks is not None and self.blocks.take(span.space, span.address, span.words or ()):
            self.device = moved(described, self.blocks.starts, self.blocks.lasts)
            self.directory, self.formatters, self.plans = Directory(self.device), {}, {}
            self.version += 1

    def planned(self, place: object, plan: Plan) -> Plan:
        """Keep the plan for the words at a place, and return it."""
        if len(self.plans) >= _MOST_PLANS:
            self.plans.clear()
        self.plans[place] = plan
        return plan

    def learn(self, raws: Iterable[tuple[Point, int]]) -> None:
        """Keep the numbers of points that the device reported."""
        for point, raw in raws:
            name = point.name
            if name in self.given or not self.directory.teaches(point):
                continue
            before, setting = self.settings.get(name), setting_of(point, raw)
            # a special code equals the plain number, and is not a quantity
            if before != setting or type(before) is not type(setting):
                self.settings[name] = setting
                self.changed.add(name)
                self.touch(name)

    def touch(self, name: str) -> None:
        """Note a change of a setting, or of an incomplete point."""
        self.version += 1
        self.since[name] = self.version

    def keeps(self, items: Iterable[Item], version: int) -> bool:
        """Return True if a frame with these items has the same ones, and changes nothing, as it did at a version."""
        if self.blocks is not None or self.directory.has_selections:
            return False
        since = self.since
        return all(since.get(name, 0) <= version for item in items for name in (item.point, *item.rests_on) if name)

    def forget(self, address: int) -> None:
        """Forget the numbers that depend on a parameter that was written."""
        self.version += 1
        for written in {point.name for point in self.directory.at(PARAMETER, address)}:
            for point in self.directory.derived(written):
                if point.name not in self.given:
                    self.settings.pop(point.name, None)
                    self.touch(point.name)
                for at in point.addresses:
                    self.words.pop(at, None)

    def value(self, point: Point, base: Base, raw: int, *, written: bool = False) -> Item:
        """Return a point with the meaning of its raw number."""
        return self.formatter(point, base, written=written).item(raw, self.settings)

    def formatter(self, point: Point, base: Base, *, written: bool = False) -> PointFormatter:
        """Return the formatter of a point at this place."""
        key = point.item, base, written
        if key not in self.formatters:
            neighbours = partial(self.directory.neighbours, point) if self.doubting else None
            made = PointFormatter(self.device, point, base, written=written, neighbours=neighbours)
            if self.directory.teaches(point):
                made.rests_on += (point.name,)
            self.formatters[key] = made
        return self.formatters[key]


def named_item(point: Point, base: Base, text: str = "", *, finding: str = "", rests_on: tuple[str, ...] = ()) -> Item:
    """Return a point that a frame names without a number; `text` replaces its title."""
    full = f"{label(point)}: {text or english_title(point)}" + (f"; {finding}" if finding else "")
    findings = (finding,) if finding else ()
    return Item(*base, line(full), point.item, point.code, findings=findings, carries=line(text), rests_on=rests_on)


def without_variants(points: Iterable[Point], *, limits: bool) -> list[Point]:
    """Return the points, with one of all variants that have the same meaning (with `limits`, also the same limits)."""
    by_name = grouped((point.name, point) for point in points)
    result: list[Point] = []
    for first, *others in by_name.values():
        same = all(same_meaning(other, first) and (not limits or other.allowed == first.allowed) for other in others)
        result += [replace(first, variant=None)] if others and same else [first, *others]
    return result
