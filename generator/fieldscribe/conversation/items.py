"""The points of a device by where they are, and what raw numbers say of them."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.arithmetic.codec import setting_of
from fieldscribe.conversation.answers import Item
from fieldscribe.conversation.meanings import meaning_of, range_remark, raw_text, unchecked_remark
from fieldscribe.conversation.selection import absence, label, same_meaning
from fieldscribe.existence import absent
from fieldscribe.families import family
from fieldscribe.text import line
from fieldscribe.wording import title_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from fractions import Fraction

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.conversation.meanings import Meaning
    from fieldscribe.model import Device, Point

Where = tuple[str, int, int]
"""(the space or the telegram, the address, the index that travels beside it or 0)."""

Base = tuple[str, int, int]
"""(space, address, count): where an item is."""

Numbers = tuple[int, "Settings"]
"""The raw number of a point, and what is known of others."""


class Directory:
    """Which points stand where."""

    def __init__(self, device: Device) -> None:
        self._at: dict[Where, list[Point]] = {}
        indexed = family(device.family).indexed
        for point in present_first(device):
            for place in point.places:
                index = (point.index or 0) if place.space in indexed else 0
                for address in place.addresses:
                    here = self._at.setdefault((point.telegram or place.space, address, index), [])
                    if point not in here and not (here and absence(device, point)):
                        here.append(point)
        self._places: dict[str, set[tuple[tuple[int, ...], int | None]]] = {}
        for point in device.points:
            self._places.setdefault(point.name, set()).add((point.addresses, point.index))

    def at(self, where: str, address: int, index: int = 0) -> list[Point]:
        """The points of which that is a word."""
        return self._at.get((where, address, index), [])

    def settings(self, found: Iterable[tuple[Point, int]]) -> Iterator[tuple[str, int | Fraction]]:
        """What rules take of points with these raw numbers; not of variants that are in different places."""
        for point, raw in found:
            if len(self._places[point.name]) == 1:
                yield point.name, setting_of(point, raw)


def without_variants(points: Iterable[Point], *, limits: bool) -> list[Point]:
    """The points, of variants that mean the same (and, with `limits`, may hold the same) one, without its variant."""
    by_name: dict[str, list[Point]] = {}
    for point in points:
        by_name.setdefault(point.name, []).append(point)
    result: list[Point] = []
    for first, *others in by_name.values():
        alike = all(same_meaning(one, first) and (not limits or one.allowed == first.allowed) for one in others)
        result += [replace(first, variant=None)] if others and alike else [first, *others]
    return result


def title_of(point: Point) -> str:
    """The English title."""
    return title_text({"en": point.title["en"]})


def present_first(device: Device) -> list[Point]:
    """All points, those last that the chosen variants do not have: in their places others may stand."""
    return sorted(device.points, key=lambda point: absent(point.when, device.variants))


def named_item(point: Point, base: Base, said: str = "", *, odd: str = "") -> Item:
    """A point that a frame names without a raw number; `said` stands for the title, `odd` is a finding."""
    text = f"{label(point)}: {said or title_of(point)}" + (f"; {odd}" if odd else "")
    return Item(*base, line(text), point.item, point.code, findings=(odd,) if odd else ())


def value_said(device: Device, point: Point, numbers: Numbers) -> str:
    """What a raw number means, and the raw number: `5 Hz (raw 500 = 01F4h)`."""
    raw, settings = numbers
    return _said(point, raw, meaning_of(device, point, raw, settings))


def _said(point: Point, raw: int, meaning: Meaning) -> str:
    return f"{meaning.text} ({raw_text(point, raw)})"


def value_item(device: Device, point: Point, base: Base, numbers: Numbers, *, written: bool = False) -> Item:
    """A point and what its raw number means; if it is `written`, also why the device will not take it."""
    raw, settings = numbers
    meaning = meaning_of(device, point, raw, settings)
    text = f"{label(point)} = {_said(point, raw, meaning)}: {title_of(point)}"
    odd = (absence(device, point) or range_remark(device, point, raw, settings)) if written else ""
    open_limits = unchecked_remark(device, point, raw, settings) if written and not odd else ""
    text += "".join(f"; {said}" for said in (odd, open_limits) if said)
    text += f"; {meaning.hint}" if meaning.hint else ""
    shown = None if point.text is not None else raw
    findings = (odd,) if odd else ()
    return Item(*base, line(text), point.item, point.code, shown, meaning.value, meaning.missing, findings)
