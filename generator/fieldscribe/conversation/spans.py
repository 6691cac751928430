"""What a frame says about consecutive addresses, in order; neighbouring unknown addresses are one item."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import raw_reader
from fieldscribe.conversation.items import always, named_item
from fieldscribe.conversation.selection import absence
from fieldscribe.families import family
from fieldscribe.families.frame_results import Item
from fieldscribe.text import line
from fieldscribe.wording import address_text, title_text
from fieldscribe.wording.buses import span_text, word_text
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.conversation.decode_state import DecodeState
    from fieldscribe.conversation.items import Base, Saying
    from fieldscribe.conversation.point_formatter import PointTextCache
    from fieldscribe.families.decoded_frame import Span
    from fieldscribe.model import Command, Place, Point

_MOST_WORDS = 16

SpanKey = tuple[str, int, int, int, bool]
"""Space, address and count of a span, how many words the frame brings, and whether it writes them."""


def span_items(hearing: DecodeState, span: Span) -> list[Item]:
    """The items of a span; its points are settings for each other."""
    words = span.words or ()
    layout = hearing.told.spans[span.space, span.address, span.count, min(len(words), span.count), span.written]
    settings = hearing.settings
    if layout.teaching:
        raws = [(point, read(words)) for point, read in layout.teaching]
        inside = hearing if span.learned else hearing.beside()
        inside.learn(raws)
        settings = inside.settings
    return [say(words, settings) for say in layout.sayings]


class SpanLayout:
    """What stands at consecutive addresses, worked out once: what teaches settings, and what says each item."""

    def __init__(self, told: PointTextCache, key: SpanKey) -> None:
        self._told = told
        self._space, self._address, self._count, self._carried, self._written = key
        inside = range(self._address, self._address + self._count)
        self.teaching = [
            (point, raw_reader(point, [at - self._address for at in place.addresses]))
            for at in inside[: self._carried]
            for point, place in told.directory.places(self._space, at)
            if at == place.addresses[0] and self._is_whole(point, place) and told.directory.teaches(point)
        ]
        self.sayings = list(self._sayings())

    def _is_whole(self, point: Point, place: Place) -> bool:
        """Whether the point is read or written here, as the frame does, and the frame brings all its words."""
        return self._is_meant(point, place) and all(0 <= at - self._address < self._carried for at in place.addresses)

    def _sayings(self) -> Iterator[Saying]:
        """What says each item, in order; unknown addresses wait for the end of their run."""
        unknown: list[int] = []
        for at in range(self._address, self._address + self._count):
            here = [self._point(point, place) for point, place in self._beginning(at)]
            here += [self._command(command) for command in self._commands(at)]
            if here or self._told.directory.places(self._space, at):
                yield from self._unknown(unknown)
                unknown = []
            else:
                unknown.append(at)
            yield from here
        yield from self._unknown(unknown)

    def _beginning(self, at: int) -> Iterator[tuple[Point, Place]]:
        """The points whose first address in the span is this one."""
        for point, place in self._told.directory.places(self._space, at):
            if at == min(address for address in place.addresses if address >= self._address):
                yield point, place

    def _commands(self, at: int) -> list[Command]:
        """The command with this address, where the frame writes it."""
        commands = self._told.device.commands if self._written else ()
        return [command for command in commands if (command.space, command.address) == (self._space, at)][:1]

    def _point(self, point: Point, place: Place) -> Saying:
        places = [at - self._address for at in place.addresses if self._address <= at < self._address + self._count]
        base = (self._space, self._address + min(places), len(places))
        if not self._is_meant(point, place):
            right = point.written if self._written else point.place
            verb = "written" if self._written else "read"
            return always(named_item(point, base, odd=f"it is {verb} at {address_text(min(right.addresses))}"))
        odd = "" if self._carried and not self._written else absence(self._told.device, point)
        if len(places) != len(place.addresses):
            return self._part(point, place, base, odd)
        if max(places) >= self._carried:
            return always(named_item(point, base, odd=odd))
        read, voice = raw_reader(point, places), self._told.voice(point, base, written=self._written)
        return lambda words, settings: voice.item(read(words), settings)

    def _is_meant(self, point: Point, place: Place) -> bool:
        """Whether the point is read here, or written here, as the frame does."""
        return place is (point.written if self._written else point.place)

    def _part(self, point: Point, place: Place, base: Base, odd: str) -> Saying:
        """What says a point of which the span has some words only."""
        inside = [at for at in place.addresses if 0 <= at - self._address < self._count]
        named = [(word_text(place.addresses, at), at - self._address) for at in inside]

        def say(words: Sequence[int], settings: Settings) -> Item:
            del settings
            texts = [name + (f" = {words[at]:04X}h" if at < self._carried else "") for name, at in named]
            return named_item(point, base, f"only the {', '.join(texts)}", odd=odd)

        return say

    def _unknown(self, addresses: Sequence[int]) -> Iterator[Saying]:
        """What says that no point is at these addresses, and what they carry."""
        if not addresses:
            return
        low, high, device = addresses[0], addresses[-1], self._told.device
        gap = next((gap for gap in device.bus.gaps.get(self._space, ()) if gap[0] <= high and low <= gap[1]), None)
        closed = "" if gap is None else f"the manual closes {hex_text(gap[0])} to {hex_text(gap[1])}"
        form = "{:04X}h" if family(device.family).spaces[self._space] == "word" else "{}"
        text = f"{span_text(low, high)}: no point is described here" + (f"; {closed}" if closed else "")
        item = Item(self._space, low, len(addresses), text, findings=(closed,) if closed else ())
        first, end = low - self._address, min(high + 1 - self._address, self._carried)
        more = " ..." if end - first > _MOST_WORDS else ""

        def say(words: Sequence[int], settings: Settings) -> Item:
            del settings
            shown = " ".join(map(form.format, words[first : min(end, first + _MOST_WORDS)]))
            return replace(item, summary=f"{text} (carries {shown}{more})")

        yield say if first < end else always(item)

    def _command(self, command: Command) -> Saying:
        at = command.address - self._address
        head, worn = f"command {command.name}: {title_text(command.title)}", ""
        if command.wears:
            worn = f"; the memory stands {command.wears} writes"

        def say(words: Sequence[int], settings: Settings) -> Item:
            del settings
            raw = words[at] if at < self._carried else None
            wrong = command.value is not None and raw is not None and raw != command.value
            odd = f"it takes {command.value}, here is {raw}" if wrong else ""
            text = line(head + (f"; {odd}" if odd else "") + worn)
            return Item(self._space, command.address, 1, text, raw=raw, findings=(odd,) if odd else ())

        return say
