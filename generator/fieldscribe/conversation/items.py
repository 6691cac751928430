"""What decoded frames say about points, as items for people and JSON."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.conversation.selection import same_meaning
from fieldscribe.families.frame_results import Item
from fieldscribe.text import line
from fieldscribe.wording import label, title_text

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.model import Point

Base = tuple[str, int, int]
"""Space, address, and count of an item."""

Saying = Callable[[Sequence[int], "Settings"], Item]
"""What says an item, from the words of a frame and the known raw numbers of other points."""


def without_variants(points: Iterable[Point], *, limits: bool) -> list[Point]:
    """The points; variants with the same meaning (with `limits`, also the same limits) become one point."""
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
    """A point that a frame names without a raw number; `said` replaces the title, `odd` is a finding."""
    text = f"{label(point)}: {said or title_of(point)}" + (f"; {odd}" if odd else "")
    return Item(*base, line(text), point.item, point.code, findings=(odd,) if odd else ())


def always(item: Item) -> Saying:
    """What says the same whatever a frame carries."""
    return lambda _words, _settings: item
