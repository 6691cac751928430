"""The items of single points: their raw numbers, and what these mean as soon as somebody asks."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from functools import lru_cache, partial
from typing import Any

from fieldscribe.arithmetic.codec import Settings
from fieldscribe.conversation.meanings import Doubts, Meaning, Meanings, raw_form
from fieldscribe.conversation.refusals import written_remarks
from fieldscribe.conversation.selection import absence
from fieldscribe.families.frame_results import BitTexts, Item
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
        self.place: dict[str, Any] = {"point": point.item, "code": point.code}
        """Facts of each item, by their names."""
        self.place.update(zip(("space", "address", "count"), base, strict=True))
        doubting = neighbours is not None and point.text is None and point.generated
        self.doubts = Doubts(device, point, neighbours) if neighbours is not None and doubting else None
        self.needs = point.arguments if written or neighbours is not None else point.scale_arguments
        self.head, self.title = f"{label(point)} = ", english_title(point)
        self.name, self.raw_text = point.item, raw_form(point)
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
    """A point with its raw number. Most users look at a part of what it means, so each part waits until it is asked."""

    _formatter: PointFormatter
    _number: int
    _settings: Settings
    _known_meaning: Meaning | None = None
    _known_remarks: tuple[str, str] | None = None

    def __init__(self, formatter: PointFormatter, number: int, *values: int | Fraction | None) -> None:
        """`values` are the settings that the formatter needs, in its order."""
        settings: dict[str, int | Fraction] = {}
        if values:
            settings = {name: value for name, value in zip(formatter.needs, values, strict=True) if value is not None}
        raw = None if formatter.point.text is not None else number
        self.__dict__.update(formatter.place, raw=raw, _formatter=formatter, _number=number, _settings=settings)

    @property
    def _meaning(self) -> Meaning:
        known = self._known_meaning
        if known is None:
            known = self.__dict__["_known_meaning"] = self._formatter.meanings.of(self._number, self._settings)
        return known

    @property
    def _remarks(self) -> tuple[str, str]:
        """Return what the device refuses, and the same or what else is to be said of a write."""
        form, known = self._formatter, self._known_remarks
        if known is None:
            finding, unchecked = form.absent, ""
            if form.written and not finding:
                finding, unchecked = written_remarks(form.device, form.point, self._number, self._settings)
            known = self.__dict__["_known_remarks"] = finding, finding or unchecked
        return known

    @property
    def summary(self) -> str:
        """Everything but the flags, in one line."""
        form, meaning, remark = self._formatter, self._meaning, self._remarks[1]
        number, rest = form.raw_text(self._number), form.title
        if remark or meaning.hint or not rest:
            rest = "; ".join(text for text in (form.title, remark, meaning.hint) if text)
        text = f"{number}: {rest}" if meaning.flags else f"{meaning.text} ({number}): {rest}"
        return line(form.head + text)

    @property
    def value(self) -> str | None:
        """The exact value."""
        return self._meaning.value

    @property
    def missing(self) -> tuple[str, ...]:
        """The points whose numbers the value needs."""
        return self._meaning.missing

    @property
    def findings(self) -> tuple[str, ...]:
        """Why the device refuses a write."""
        finding = self._remarks[0] if self._formatter.written else ""
        return (finding,) if finding else ()

    @property
    def bit_texts(self) -> BitTexts | None:
        """What explains the bits of a word."""
        return self._meaning.flags

    @property
    def meaning(self) -> str:
        """The value with its unit, or a name."""
        return self._meaning.text

    @property
    def doubts(self) -> tuple[str, ...]:
        """That the number lies outside its range, and the other readings; none unless the formatter has neighbours."""
        doubts = self._formatter.doubts
        if doubts is None or doubts.fits(self._number, self._settings):
            return ()
        return doubts.of(self._number, self._settings, self.meaning)[1 if self.findings else 0 :]


def english_title(point: Point) -> str:
    """Return the English title."""
    return title_text({"en": point.title["en"]})
