"""Remembers what raw numbers mean in words: on a bus most numbers come again and again."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from fieldscribe.conversation.items import title_of, without_variants
from fieldscribe.conversation.meanings import Meanings, raw_form
from fieldscribe.conversation.selection import absence
from fieldscribe.conversation.spans import SpanLayout
from fieldscribe.conversation.telegrams import Stretch, process_sayings
from fieldscribe.conversation.writing import written_remarks
from fieldscribe.families.decoded_frame import BoundedMemo
from fieldscribe.families.frame_results import Item
from fieldscribe.text import line
from fieldscribe.wording import label

if TYPE_CHECKING:
    from collections.abc import Callable

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.conversation.items import Base, Saying
    from fieldscribe.conversation.spans import SpanKey
    from fieldscribe.conversation.telegrams import StretchKey
    from fieldscribe.families.directory import Directory
    from fieldscribe.model import Device, Point

MOST = 64
"""How many numbers of one point are remembered: a stream may last for days."""
PARAMETER = "parameter"
"""The space of parameters."""
_MOST_SPANS = 2048
"""How many different spans of addresses are remembered."""


class PointFormatter:
    """Puts the raw numbers of one point into words."""

    def __init__(self, device: Device, point: Point, base: Base, *, written: bool) -> None:
        self._device, self._point, self._base, self._written = device, point, base, written
        self.needs = point.arguments if written else point.scale_arguments
        self.comes: Callable[[tuple[str, ...]], str] | None = None
        """What tells where missing points come, if that is known."""
        self._head, self._title = f"{label(point)} = ", title_of(point)
        self._name, self._code, self._is_text = point.item, point.code, point.text is not None
        self._raw_text = raw_form(point)
        self._absent = absence(device, point) if written else ""
        self._meanings = Meanings(device, point)
        self._items: dict[Any, Item] = {}

    def item(self, raw: int, settings: Settings) -> Item:
        """The point with the meaning of its raw number; if it is written, also why the device refuses it."""
        key: Any = raw
        if self.needs:  # a special code equals the plain number, and is no quantity: so the types
            given = [settings.get(name) for name in self.needs]
            key = (raw, *given, *map(type, given))
        item = self._items.get(key)
        if item is None:
            if len(self._items) >= MOST:
                self._items.clear()
            item = self._items[key] = self._said(raw, settings)
        return item

    def lacks(self, settings: Settings) -> bool:
        """Whether its scale needs numbers of other points that are not among these."""
        return self._meanings.lacks(settings)

    def value(self, raw: int, settings: Settings) -> str:
        """The meaning of a raw number, and the number itself: `5 Hz (raw 500 = 01F4h)`."""
        meaning = self._meanings.of(raw, settings)
        text = meaning.flags.sentence(raw) if meaning.flags else meaning.text
        return f"{text} ({self._raw_text(raw)})"

    def _said(self, raw: int, settings: Settings) -> Item:
        meaning, number = self._meanings.of(raw, settings), self._raw_text(raw)
        odd, rest = self._remarks(raw, settings) if self._written else ("", self._title)
        rest = f"{rest}; {meaning.hint}" if meaning.hint else rest
        rest += self.comes(meaning.missing) if meaning.missing and self.comes else ""
        said = f"{number}: {rest}" if meaning.flags else f"{meaning.text} ({number}): {rest}"
        return Item(
            *self._base, line(self._head + said), self._name, self._code, None if self._is_text else raw,
            meaning.value, meaning.missing, (odd,) if odd else (), meaning.flags,
        )  # fmt: skip

    def _remarks(self, raw: int, settings: Settings) -> tuple[str, str]:
        """Why the device refuses a raw number that is written, and the title with what is remarked on it."""
        odd, remark = self._absent, self._absent
        if not odd:
            odd, unchecked = written_remarks(self._device, self._point, raw, settings)
            remark = odd or unchecked
        return odd, f"{self._title}; {remark}" if remark else self._title


class PointTextCache:
    """What the points of a device mean; each meaning is put into words once as long as it is remembered."""

    def __init__(self, device: Device, directory: Directory) -> None:
        self.device, self.directory = device, directory
        self._voices: dict[tuple[str, Base, bool], PointFormatter] = {}
        self.spans: BoundedMemo[SpanKey, SpanLayout] = BoundedMemo(_MOST_SPANS, partial(SpanLayout, self))
        self.stretches: BoundedMemo[StretchKey, Stretch] = BoundedMemo(_MOST_SPANS, partial(Stretch, self))
        """Parts of telegrams that have come."""
        self.process_data: BoundedMemo[tuple[str, int], list[Saying]] = BoundedMemo(64, partial(process_sayings, self))
        self.elements: BoundedMemo[tuple[int, int, bool], list[Point]] = BoundedMemo(_MOST_SPANS, self._element)
        """The points of a parameter's element, as frames show them; variants that are written may differ in limits."""

    def _element(self, key: tuple[int, int, bool]) -> list[Point]:
        parameter, index, written = key
        return without_variants(self.directory.at(PARAMETER, parameter, index), limits=written)

    def voice(self, point: Point, base: Base, *, written: bool = False) -> PointFormatter:
        """What speaks for a point at this place."""
        key = point.item, base, written
        voice = self._voices.get(key)
        if voice is None:
            voice = self._voices[key] = PointFormatter(self.device, point, base, written=written)
        return voice
