"""The points of a device by where they are, and what raw numbers say of them."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.conversation.meanings import meaning_of, range_remark, raw_text, unchecked_remark
from fieldscribe.conversation.selection import absence, same_meaning
from fieldscribe.families.answers import Item
from fieldscribe.text import line
from fieldscribe.wording import label, title_text

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.conversation.meanings import Meaning
    from fieldscribe.model import Device, Point

Base = tuple[str, int, int]
"""(space, address, count): where an item is."""

Numbers = tuple[int, "Settings"]
"""The raw number of a point, and what is known of others."""


def without_variants(points: Iterable[Point], *, limits: bool) -> list[Point]:
    """The points, of variants that mean the same (and, with `limits`, may hold the same) one, without its variant."""
    by_name: dict[str, list[Point]] = {}
    for point in points:
        by_name.setdefault(point.name, []).append(point)
    result: list[Point] = []
    for first, *others in by_name.values():
        alike = all(same_meaning(other, first) and (not limits or other.allowed == first.allowed) for other in others)
        result += [replace(first, variant=None)] if others and alike else [first, *others]
    return result


def title_of(point: Point) -> str:
    """The English title."""
    return title_text({"en": point.title["en"]})


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
