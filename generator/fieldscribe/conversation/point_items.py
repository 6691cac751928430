"""The items of single points: their raw numbers, and what these mean."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from functools import lru_cache, partial
from typing import Any

from fieldscribe.arithmetic.codec import Settings
from fieldscribe.conversation.meanings import Doubts, Meanings, raw_form
from fieldscribe.conversation.refusals import written_remarks
from fieldscribe.conversation.selection import absence
from fieldscribe.families.frame_results import Item
from fieldscribe.model import Device, Point
from fieldscribe.text import line
from fieldscribe.wording import label, title_text

Base = tuple[str, int, int]
"""Space or telegram, address, and number of addresses of an item."""

_MOST_ITEMS = 64
"""How many items of one point are cached: a stream may last for days."""


class PointFormatter:
    """Turns the raw numbers of one point into items; on a bus most numbers come again, so items are cached."""

    def __init__(
        self,
        device: Device,
        point: Point,
        base: Base,
        *,
        written: bool,
        neighbours: Callable[[int], Iterable[Point]] | None = None,
    ) -> None:
        """With `neighbours`, the points that begin at an address, each item says whether its number is in range."""
        self.device, self.point, self.base, self.written = device, point, base, written
        doubting = neighbours is not None and point.text is None and point.generated
        self.doubts = Doubts(device, point, neighbours) if neighbours is not None and doubting else None
        self.needs = point.arguments if written or neighbours is not None else point.scale_arguments
        self.head, self.title = f"{label(point)} = ", english_title(point)
        self.code, self.stays = point.code, not self.needs
        self.name, self.raw_text, self.is_text = point.item, raw_form(point), point.text is not None
        self.absent = absence(device, point) if written else ""
        self.meanings = Meanings(device, point)
        # typed: a special code equals the plain number, and is no quantity
        self._cached_item = lru_cache(_MOST_ITEMS, typed=True)(partial(PointItem, self))

    def item(self, raw: int, settings: Settings) -> PointItem:
        """Return the point with the meaning of its raw number; if it is written, also why the device refuses it."""
        if not self.needs:
            return self._cached_item(raw)
        return self._cached_item(raw, *[settings.get(name) for name in self.needs])

    def lacks(self, settings: Settings) -> bool:
        """Return True if the scale needs numbers of other points that are not among these."""
        return self.meanings.lacks(settings)

    def value(self, raw: int, settings: Settings) -> str:
        """Return the meaning of a raw number, and the number itself: `5 Hz (raw 500 = 01F4h)`."""
        return f"{self.meanings.text(raw, settings)} ({self.raw_text(raw)})"


class PointItem(Item):
    """A point with its raw number and its meaning. Summary and doubts wait until somebody asks: many users do not."""

    __slots__ = ("_formatter", "_hint", "_number", "_remark", "_settings")

    def __init__(self, formatter: PointFormatter, number: int, *values: int | Fraction | None) -> None:
        """`values` are the settings that the formatter needs, in its order."""
        settings: dict[str, int | Fraction] = {}
        if values:
            settings = {name: value for name, value in zip(formatter.needs, values, strict=True) if value is not None}
        self._formatter, self._number, self._settings = formatter, number, settings
        self.space, self.address, self.count = formatter.base
        self.point, self.code, self.stays = formatter.name, formatter.code, formatter.stays
        self.raw = None if formatter.is_text else number
        meaning = formatter.meanings.of(number, settings)
        self.meaning, self.value, self.missing, self._hint, self.bit_texts = meaning
        self.carries = self.subject = self._remark = ""
        self.findings: tuple[str, ...] = ()
        if formatter.written:
            finding, unchecked = formatter.absent, ""
            if not finding:
                finding, unchecked = written_remarks(formatter.device, formatter.point, number, settings)
            self.findings, self._remark = (finding,) if finding else (), finding or unchecked
        if formatter.doubts is None:
            self.doubts = ()

    def __getattr__(self, name: str) -> Any:
        """Make the summary or the doubts, once."""
        if name == "summary":
            self.summary = self._summarised()
            return self.summary
        if name == "doubts":
            self.doubts = self._doubted()
            return self.doubts
        raise AttributeError(name)

    def _summarised(self) -> str:
        form, remark, hint = self._formatter, self._remark, self._hint
        number, rest = form.raw_text(self._number), form.title
        if remark or hint or not rest:
            rest = "; ".join(text for text in (form.title, remark, hint) if text)
        text = f"{number}: {rest}" if self.bit_texts else f"{self.meaning} ({number}): {rest}"
        return line(form.head + text)

    def _doubted(self) -> tuple[str, ...]:
        doubts = self._formatter.doubts
        if doubts is None or doubts.fits(self._number, self._settings):
            return ()
        return doubts.of(self._number, self._settings, self.meaning)[1 if self.findings else 0 :]


def english_title(point: Point) -> str:
    """Return the English title."""
    return title_text({"en": point.title["en"]})
