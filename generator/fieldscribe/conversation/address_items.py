"""Items of what a frame carries at consecutive addresses, and of elements and words of parameters."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import raw_of, raw_reader, split
from fieldscribe.conversation.decode_state import PARAMETER, constant, named_item, without_variants
from fieldscribe.conversation.selection import absence
from fieldscribe.families import family
from fieldscribe.families.frame_results import Item
from fieldscribe.text import line
from fieldscribe.wording import address_text, fixed_text, title_text
from fieldscribe.wording.buses import counted, element_text, span_text, word_text, words_text
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.conversation.decode_state import Base, DecodeState, ItemMaker, PointTextCache
    from fieldscribe.families.decoded_frame import Element, Span, Word
    from fieldscribe.model import Command, Place, Point

_MOST_WORDS = 16
"""How many words without a point are printed."""

SpanKey = tuple[str, int, int, int, bool]
"""Space, address and count of a span, how many words the frame carries, and whether it writes them."""


def span_items(state: DecodeState, span: Span) -> list[Item]:
    """Return the items of a span; its points are settings for each other."""
    words = span.words or ()
    key = span.space, span.address, span.count, min(len(words), span.count), span.written
    layout = state.texts.layout(_SpanLayout, key)
    settings = state.settings
    if layout.settings:
        inside = state if span.learned else state.for_one_frame()
        inside.learn((point, read(words)) for point, read in layout.settings)
        settings = inside.settings
    return [make(words, settings) for make in layout.makers]


class _SpanLayout:
    """What stands at consecutive addresses: the points that are settings, and a maker of each item."""

    def __init__(self, texts: PointTextCache, key: SpanKey) -> None:
        self._texts, self._device, self._directory = texts, texts.device, texts.directory
        self._space, self._address, self._count, self._carried, self._written = key
        inside = range(self._address, self._address + self._count)
        self.settings = [
            (point, raw_reader(point, [at - self._address for at in place.addresses]))
            for at in inside[: self._carried]
            for point, place in self._directory.places(self._space, at)
            if at == place.addresses[0] and self._is_whole(point, place) and self._directory.teaches(point)
        ]
        self.makers = list(self._makers(inside))

    def _is_whole(self, point: Point, place: Place) -> bool:
        """Return True if the frame reads or writes the point here, and carries all its words."""
        return self._is_place(point, place) and all(0 <= at - self._address < self._carried for at in place.addresses)

    def _is_place(self, point: Point, place: Place) -> bool:
        """Return True if the point is read here, or written here, as the frame does."""
        return place is (point.written if self._written else point.place)

    def _makers(self, inside: range) -> Iterator[ItemMaker]:
        """Return a maker for each item, in order; neighbouring addresses without a point are one item."""
        unknown: list[int] = []
        for at in inside:
            places = self._directory.places(self._space, at)
            # a point that began before is not named again
            first = [entry for entry in places if at == min(one for one in entry[1].addresses if one >= self._address)]
            here = [self._point(point, place) for point, place in first]
            commands = self._device.commands if self._written else ()
            here += [self._command(one) for one in commands if (one.space, one.address) == (self._space, at)][:1]
            if not here and not places:
                unknown.append(at)
                continue
            yield from self._unknown(unknown)
            unknown = []
            yield from here
        yield from self._unknown(unknown)

    def _point(self, point: Point, place: Place) -> ItemMaker:
        offsets = [at - self._address for at in place.addresses if self._address <= at < self._address + self._count]
        base = (self._space, self._address + min(offsets), len(offsets))
        if not self._is_place(point, place):
            right = point.written if self._written else point.place
            verb = "written" if self._written else "read"
            return constant(named_item(point, base, finding=f"it is {verb} at {address_text(min(right.addresses))}"))
        finding = "" if self._carried and not self._written else absence(self._device, point)
        if len(offsets) != len(place.addresses):
            return self._part(point, place, base, finding)
        if max(offsets) >= self._carried:
            return constant(named_item(point, base, finding=finding))
        read, formatter = raw_reader(point, offsets), self._texts.formatter(point, base, written=self._written)
        return lambda words, settings: formatter.item(read(words), settings)

    def _part(self, point: Point, place: Place, base: Base, finding: str) -> ItemMaker:
        """Return the maker for a point of which the span has only some words."""
        inside = [at for at in place.addresses if 0 <= at - self._address < self._count]
        named = [(word_text(place.addresses, at), at - self._address) for at in inside]

        def make(words: Sequence[int], _settings: Settings) -> Item:
            texts = [name + (f" = {words[at]:04X}h" if at < self._carried else "") for name, at in named]
            return named_item(point, base, f"only the {', '.join(texts)}", finding=finding)

        return make

    def _unknown(self, addresses: Sequence[int]) -> Iterator[ItemMaker]:
        """Return the maker for neighbouring addresses without a point, and what they carry."""
        if not addresses:
            return
        low, high = addresses[0], addresses[-1]
        gaps = self._device.bus.gaps.get(self._space, ())
        gap = next((gap for gap in gaps if gap[0] <= high and low <= gap[1]), None)
        closed = "" if gap is None else f"the manual closes {hex_text(gap[0])} to {hex_text(gap[1])}"
        form = "{:04X}h" if family(self._device.family).spaces[self._space] == "word" else "{}"
        text = f"{span_text(low, high)}: no point is described here" + (f"; {closed}" if closed else "")
        item = Item(self._space, low, len(addresses), text, findings=(closed,) if closed else ())
        first, end = low - self._address, min(high + 1 - self._address, self._carried)
        more = " ..." if end - first > _MOST_WORDS else ""

        def make(words: Sequence[int], _settings: Settings) -> Item:
            carried = " ".join(map(form.format, words[first : min(end, first + _MOST_WORDS)]))
            return replace(item, summary=f"{text} (carries {carried}{more})")

        yield make if first < end else constant(item)

    def _command(self, command: Command) -> ItemMaker:
        at = command.address - self._address
        head = f"command {command.name}: {title_text(command.title)}"
        worn = f"; the memory stands {command.wears} writes" if command.wears else ""

        def make(words: Sequence[int], _settings: Settings) -> Item:
            raw = words[at] if at < self._carried else None
            wrong = command.value is not None and raw is not None and raw != command.value
            finding = f"it takes {command.value}, here is {raw}" if wrong else ""
            text = line(head + (f"; {finding}" if finding else "") + worn)
            return Item(self._space, command.address, 1, text, raw=raw, findings=(finding,) if finding else ())

        return make


def _element_points(texts: PointTextCache, key: tuple[int, int, bool]) -> list[Point]:
    """Return the points of a parameter's element; variants with other limits are told apart where they are written."""
    parameter, index, written = key
    return without_variants(texts.directory.at(PARAMETER, parameter, index), limits=written)


def element_items(state: DecodeState, element: Element) -> Iterator[Item]:
    """Return the items of one element of a parameter."""
    points = state.directory.at(PARAMETER, element.parameter, element.index)
    base = (PARAMETER, element.parameter, max(1, element.width))
    carried = f"carries {words_text(element.words)}"
    if element.refused:
        yield from (named_item(point, (PARAMETER, element.parameter, point.words)) for point in points)
    elif not points:
        text = element_text(element.parameter, element.index, alone=True)
        remark = f" ({carried})" if element.width or not element.in_request else ""
        yield Item(*base, f"{text}: no point is described here{remark}")
    elif not element.in_request and (element.width == 0 or element.counts):
        text = f"{element.value} elements" if element.counts else carried
        yield from (named_item(point, base, text) for point in points)
    else:
        distinct = state.texts.layout(_element_points, (element.parameter, element.index, element.in_request))
        yield from (_element_item(state, element, point, base, carried) for point in distinct)


def _element_item(state: DecodeState, element: Element, point: Point, base: Base, carried: str) -> Item:
    if element.value is None:
        return named_item(point, base, finding=absence(state.device, point) if element.in_request else "")
    if not point.generated:
        return named_item(point, base, f"{carried}; {point.reason or 'its meaning is open'}")
    if element.width != point.words:
        return named_item(point, base, carried, finding=_width_finding(point, element))
    raw = raw_of(point, split(element.value, element.width))
    if not element.in_request:
        state.learn([(point, raw)])
    return state.value(point, base, raw, written=element.in_request)


def _width_finding(point: Point, element: Element) -> str:
    """Return the finding that a value has another number of words than the parameter."""
    words = "a double word" if point.words == 2 else counted(point.words, "word")
    text = f"the parameter is {words}, the {'task' if element.in_request else 'response'} carries {element.width}"
    return f"{text}; a device answers with a wrong data type" if element.in_request else text


def word_items(state: DecodeState, word: Word) -> Iterator[Item]:
    """Return the items of one word of a parameter."""
    points = state.directory.at(PARAMETER, word.address)
    if word.learned and word.raw is not None and points:
        state.words[word.address] = word.raw
    if word.stale:
        state.forget(word.address)
    if word.learned:
        state.learn((point, raw) for point in points if (raw := _raw(point, state.words)) is not None)
    for point in state.texts.layout(_element_points, (word.address, 0, word.in_request)):
        yield _word_item(state, word, point)
    if not points:
        carried = "" if word.raw is None else f" ({words_text((word.raw,))})"
        yield Item(PARAMETER, word.address, 1, f"{address_text(word.address)}: no point is described here{carried}")


def _raw(point: Point, words: dict[int, int]) -> int | None:
    """Return the number of a point; None while words of it are not known."""
    known = [words[at] for at in point.addresses if at in words]
    return raw_of(point, known) if len(known) == len(point.addresses) else None


def _word_item(state: DecodeState, word: Word, point: Point) -> Item:
    base = (PARAMETER, word.address, 1)
    if word.raw is None:
        return named_item(point, base, finding=absence(state.device, point))
    if len(point.addresses) == 1:
        item = state.value(point, base, raw_of(point, (word.raw,)), written=word.in_request)
        finding = _fixed_finding(point, word.raw) if word.in_request else ""
        if not finding:
            return item
        return replace(item, summary=f"{item.summary}; {finding}", findings=(*item.findings, finding))
    words = {**state.words, word.address: word.raw}
    part = f"word {point.addresses.index(word.address) + 1} of {len(point.addresses)} = {words_text((word.raw,))}"
    raw = _raw(point, words)
    if raw is None:
        return named_item(point, base, f"{part}; {sum(at not in words for at in point.addresses)} more words to come")
    item = state.value(point, base, raw)
    return replace(item, summary=f"{item.summary}; here {part}")


def _fixed_finding(point: Point, word: int) -> str:
    """Return the finding that a written word lacks the constant bits beside a bit group."""
    if point.bits is None or point.fixed is None or word & point.fixed.mask == point.fixed.bits:
        return ""
    return f"the word breaks what is always written: {fixed_text(point)}"
