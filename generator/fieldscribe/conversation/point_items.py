"""The items of single points: their raw numbers, what these mean, and the doubts about them.

A number outside its range has other readings: the words swapped, the other sign, and the points one address up and
down. Those that lie in range are listed; nothing is ranked or inferred.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache
from types import MappingProxyType

from fieldscribe.arithmetic.codec import Settings
from fieldscribe.arithmetic.words import number_of, pattern_of, reader_of, words_of
from fieldscribe.conversation.meanings import Meaning, Meanings, raw_form
from fieldscribe.conversation.refusals import in_range, range_fault, range_of, written_remarks
from fieldscribe.conversation.selection import absence
from fieldscribe.families.frame_results import Item
from fieldscribe.model import Device, Point
from fieldscribe.text import line
from fieldscribe.wording import label, title_text

_FEW_BITS = 8
"""The most bits of a point whose items are all kept."""
_NO_SETTINGS: Settings = MappingProxyType({})

Base = tuple[str, int, int]
"""Space or telegram, address, and number of addresses of an item."""


class PointFormatter:
    """Turns the raw numbers of one point into items."""

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
        self.head, self.title = f"{line(label(point))} = ", line(english_title(point))
        self.name, self.raw_text, self.is_text = point.item, raw_form(point), point.text is not None
        self.code, self.rests_on = point.code, tuple(self.needs)
        self.sources: Callable[[tuple[str, ...]], str] = lambda _missing: ""
        """Returns where the numbers come that are missing."""
        self.absent = absence(device, point) if written else ""
        self.meanings = Meanings(device, point)
        meaning_of = self.meanings.under(_NO_SETTINGS)
        most = 1 << point.width if point.width <= _FEW_BITS else 1
        self._kept = lru_cache(most)(lambda raw: PointItem(self, raw, meaning_of(raw), _NO_SETTINGS))
        """Returns an item that needs no numbers of other points: the last one is kept, or all of few bits."""

    def item(self, raw: int, settings: Settings) -> PointItem:
        """Return the item of a raw number under these settings of other points."""
        if self.needs:
            return PointItem(self, raw, self.meanings.under(settings)(raw), settings)
        return self._kept(raw)

    def value(self, raw: int, settings: Settings) -> str:
        """Return the meaning of a raw number, and the number itself: `5 Hz (raw 500 = 01F4h)`."""
        return f"{self.meanings.text(raw, settings)} ({self.raw_text(raw)})"


class PointItem(Item):
    """A point with its raw number and its meaning. The summary waits until somebody asks: many users do not."""

    _remark = ""

    def __init__(self, formatter: PointFormatter, number: int, meaning: Meaning, settings: Settings) -> None:
        self._formatter, self._number = formatter, number
        self.space, self.address, self.count = formatter.base
        self.point, self.code, self.rests_on = formatter.name, formatter.code, formatter.rests_on
        self.raw = None if formatter.is_text else number
        self.meaning, self.value, self.missing, self._hint, self.bit_texts = meaning
        self.statement = ""
        if formatter.written:
            finding, unchecked = formatter.absent, ""
            if not finding:
                finding, unchecked = written_remarks(formatter.device, formatter.point, number, settings)
            self.findings, self._remark = (finding,) if finding else (), finding or unchecked
        if formatter.doubts is not None:
            self.doubts = formatter.doubts.of(number, settings, self.meaning)[1 if self.findings else 0 :]

    @property
    def summary(self) -> str:
        """The point, its meaning, its raw number, its title and what is missing, in one line; made once."""
        if self.statement:
            return self.statement
        form, remark, hint = self._formatter, self._remark, self._hint
        number, rest = form.raw_text(self._number), form.title
        if remark or hint:
            rest = line("; ".join(text for text in (form.title, remark, hint) if text))
        text = f"{number}: {rest}" if self.bit_texts else f"{self.meaning} ({number}): {rest}"
        if form.is_text or not rest:
            text = line(text)
        self.statement = form.head + text + (form.sources(self.missing) if self.missing else "")
        return self.statement


def english_title(point: Point) -> str:
    """Return the English title."""
    return title_text({"en": point.title["en"]})


Neighbours = Callable[[int], Iterable[Point]]
"""Returns the points that begin at an address of the same space."""


class Doubts:
    """Finds doubts about the numbers of a point; its limits and neighbours are looked up once."""

    def __init__(self, device: Device, point: Point, neighbours: Neighbours) -> None:
        self._device, self._point, self._fits = device, point, _range_test(point)
        self._meanings, self._range = Meanings(device, point), ""
        self._is_plain = point.form in ("scaled", "integer") and not (point.limit_arguments or point.fixed)
        self._read, self._swaps = reader_of(point), point.words > 1
        self._is_limited, self._is_signed = _is_limited(point), not point.info.floating
        first = point.addresses[0] if point.addresses else 0
        if point.variant is not None and point.addresses:  # which variant this is, nobody may have said
            variants = [other for other in neighbours(first) if other.variant and other.words == point.words]
            tests = list(map(_range_test, (point, *variants)))
            self._fits = lambda raw, settings: any(test(raw, self._known(settings)) for test in tests)
        others = [
            (f"one address {name}, {label(other)},", other)
            for name, address in ((("up", first + 1), ("down", first - 1)) if point.addresses else ())
            for other in neighbours(address)
            if other.words == point.words and other.generated and other.readable and _is_limited(other)
        ]
        self._others = [(text, reader_of(one), _range_test(one), Meanings(device, one)) for text, one in others]

    def of(self, raw: int, settings: Settings, meaning: str) -> tuple[str, ...]:
        """Return a text that a number is out of range, then the other readings; nothing for a number in range.

        `meaning` is its meaning.
        """
        if self._fits(raw, settings):
            return ()
        known = self._known(settings)
        if self._is_plain and meaning:
            self._range = self._range or range_of(self._device, self._point, known)
            fault = line(f"{meaning} is outside {self._range}")
        else:
            fault = range_fault(self._device, self._point, raw, known)
        return fault, *self._near_misses(raw, known)

    def _known(self, settings: Settings) -> Settings:
        """Return the settings that the point names: only with these its items change."""
        return {name: settings[name] for name in self._point.arguments if name in settings}

    def _near_misses(self, raw: int, settings: Settings) -> Iterator[str]:
        """Yield the other readings that lie in range and have a meaning."""
        words = words_of(self._point, raw)
        for text, number, meanings in self._readings(raw, words, settings):
            meaning = meanings.of(number, settings)
            if meaning.text and not (meaning.missing or meaning.hint):
                yield line(f"{text} it is {meaning.text}")

    def _readings(self, raw: int, words: tuple[int, ...], settings: Settings) -> Iterator[tuple[str, int, Meanings]]:
        """Yield each other reading in range: in words, its raw number, and its meaning."""
        if self._is_limited and self._swaps and self._fits(number := self._read(words[::-1]), settings):
            yield "with its words swapped", number, self._meanings
        if self._is_limited and self._is_signed:
            signed = number_of(pattern_of(self._point, raw), self._point.width, signed=True)
            if signed < 0 and self._fits(-signed, settings):
                text, number = ("without its sign", -signed) if raw < 0 else ("as a signed number", signed)
                yield text, number, self._meanings
        for text, read, fits, meanings in self._others:
            if fits(number := read(words), settings):
                yield text, number, meanings


def _is_limited(point: Point) -> bool:
    """Return True if the manual limits the numbers of a point."""
    return bool(point.allowed.intervals or point.allowed.units or (point.enum is not None and point.enum.closed))


def _ranges(point: Point) -> tuple[list[tuple[int, int]], bool]:
    """Return raw numbers (low, high) between which all are in range, and whether no others are."""
    if point.fixed or point.digits or point.info.floating:
        return [], False
    least, greatest, spans = point.least, point.greatest, [(span.low, span.high) for span in point.allowed.intervals]
    fixed = [
        (low, high) for low, high in spans or [(least, greatest)] if isinstance(low, int) and isinstance(high, int)
    ]
    ends = [(max(low, least), min(high, greatest)) for low, high in fixed]
    return ends, not point.specials and len(ends) >= len(spans)


def _range_test(point: Point) -> Callable[[int, Settings], bool]:
    """Return a function that does for this point what `in_range` does, and is quicker."""
    ends, complete = _ranges(point)
    if len(ends) == 1:
        ((low, high),) = ends
        return lambda raw, settings: low <= raw <= high or (not complete and in_range(point, raw, settings))
    return lambda raw, settings: (
        any(low <= raw <= high for low, high in ends) or (not complete and in_range(point, raw, settings))
    )
