"""Remembers what raw numbers mean in words: on a bus most numbers come again and again."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fieldscribe.conversation.items import title_of
from fieldscribe.conversation.meanings import Meanings, raw_form
from fieldscribe.conversation.selection import absence
from fieldscribe.conversation.writing import range_remark, unchecked_remark
from fieldscribe.families.answers import Item
from fieldscribe.text import line
from fieldscribe.wording import label

if TYPE_CHECKING:
    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.conversation.items import Base
    from fieldscribe.conversation.telegrams import Stretch
    from fieldscribe.model import Device, Point

MOST = 64
"""How many numbers of one point are remembered: a stream may last for days."""


class Voice:
    """Puts the raw numbers of one point into words."""

    def __init__(self, device: Device, point: Point, base: Base, *, written: bool) -> None:
        self._device, self._point, self._base, self._written = device, point, base, written
        self._needs = point.arguments if written else point.scale_arguments
        self._head, self._title = f"{label(point)} = ", title_of(point)
        self._point_item, self._is_text = point.item, point.text is not None
        self._raw_text = raw_form(point)
        self._meanings = Meanings(device, point)
        self._items: dict[Any, Item] = {}

    def item(self, raw: int, settings: Settings) -> Item:
        """The point with the meaning of its raw number; if it is written, also why the device refuses it."""
        key: Any = raw
        if self._needs:  # a special code equals the plain number, and is no quantity: so the types
            given = [settings.get(name) for name in self._needs]
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

    def _said(self, raw: int, settings: Settings) -> Item:
        point = self._point
        meaning = self._meanings.of(raw, settings)
        odd = remark = ""
        if self._written:
            odd = absence(self._device, point) or range_remark(self._device, point, raw, settings)
            remark = odd or unchecked_remark(self._device, point, raw, settings)
        number = self._raw_text(raw)
        remarks = "".join(f"; {text}" for text in (remark, meaning.hint) if text)
        rest = f": {self._title}{remarks}"
        return Item(
            *self._base,
            line(f"{self._head}{meaning.text} ({number}){rest}"),
            self._point_item,
            point.code,
            None if self._is_text else raw,
            meaning.value,
            meaning.missing,
            (odd,) if odd else (),
            line(f"{self._head}{number}{rest}") if meaning.flags else "",
            meaning.flags,
        )


class Told:
    """What the points of a device mean; each meaning is put into words once as long as it is remembered."""

    def __init__(self, device: Device) -> None:
        self._device = device
        self._voices: dict[tuple[str, Base, bool], Voice] = {}
        self.stretches: dict[tuple[str, range], Stretch] = {}
        """Parts of telegrams that have come, worked out once."""

    def voice(self, point: Point, base: Base, *, written: bool = False) -> Voice:
        """What speaks for a point at this place."""
        key = point.item, base, written
        voice = self._voices.get(key)
        if voice is None:
            voice = self._voices[key] = Voice(self._device, point, base, written=written)
        return voice
