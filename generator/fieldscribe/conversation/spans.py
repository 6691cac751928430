"""What a frame says about consecutive addresses, in order; neighbouring unknown addresses are one item."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import raw_of
from fieldscribe.conversation.items import named_item
from fieldscribe.conversation.selection import absence
from fieldscribe.families import family
from fieldscribe.families.answers import Item
from fieldscribe.text import line
from fieldscribe.wording import address_text, title_text
from fieldscribe.wording.buses import span_text, word_text
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from fieldscribe.conversation.hearing import Hearing
    from fieldscribe.families.spoken import Span
    from fieldscribe.model import Command, Device, Place, Point

_MOST_WORDS = 16


def span_items(hearing: Hearing, span: Span) -> Iterator[Item]:
    """The items of a span; its points are settings for each other."""
    words = dict(zip(range(span.address, span.address + span.count), span.words or (), strict=False))
    raws = _whole_points(hearing, span, words)
    if span.learned:
        hearing.learn(raws)
    inside = hearing if span.learned else hearing.beside(raws)
    unknown: list[int] = []
    for address in range(span.address, span.address + span.count):
        here = list(_items(inside, span, words, address))
        if here or hearing.directory.places(span.space, address):
            yield from _unknown(hearing.device, span, words, unknown)
            unknown = []
        else:
            unknown.append(address)
        yield from here
    yield from _unknown(hearing.device, span, words, unknown)


def _whole_points(hearing: Hearing, span: Span, words: dict[int, int]) -> Iterator[tuple[Point, int]]:
    """The points that the span carries whole, with their raw numbers."""
    for address in words:
        for point, place in hearing.directory.places(span.space, address):
            if (
                _is_meant(span, point, place)
                and address == place.addresses[0]
                and all(at in words for at in place.addresses)
            ):
                yield point, raw_of(point, [words[at] for at in place.addresses])


def _items(hearing: Hearing, span: Span, words: dict[int, int], address: int) -> Iterator[Item]:
    """The points whose first address in the span is this one, and the command with this address."""
    for point, place in hearing.directory.places(span.space, address):
        if address == min(at for at in place.addresses if at >= span.address):
            yield _point(hearing, span, words, point, place)
    for command in hearing.device.commands:
        if span.written and (command.space, command.address) == (span.space, address):
            yield _command(command, span, words.get(address))
            return


def _point(hearing: Hearing, span: Span, words: dict[int, int], point: Point, place: Place) -> Item:
    inside = [at for at in place.addresses if span.address <= at < span.address + span.count]
    base = (span.space, min(inside), len(inside))
    if not _is_meant(span, point, place):
        right = point.written if span.written else point.place
        verb = "written" if span.written else "read"
        return named_item(point, base, odd=f"it is {verb} at {address_text(min(right.addresses))}")
    odd = "" if words and not span.written else absence(hearing.device, point)
    if len(inside) != len(place.addresses):
        carried = [f" = {words[at]:04X}h" if at in words else "" for at in inside]
        texts = [word_text(place.addresses, at) + said for at, said in zip(inside, carried, strict=True)]
        return named_item(point, base, f"only the {', '.join(texts)}", odd=odd)
    if not all(at in words for at in inside):
        return named_item(point, base, odd=odd)
    return hearing.value(point, base, raw_of(point, [words[at] for at in place.addresses]), written=span.written)


def _is_meant(span: Span, point: Point, place: Place) -> bool:
    """Whether the point is read here, or written here, as the frame does."""
    return place is (point.written if span.written else point.place)


def _unknown(device: Device, span: Span, words: dict[int, int], addresses: Sequence[int]) -> Iterator[Item]:
    if not addresses:
        return
    low, high = addresses[0], addresses[-1]
    gap = next((gap for gap in device.bus.gaps.get(span.space, ()) if gap[0] <= high and low <= gap[1]), None)
    closed = "" if gap is None else f"the manual closes {hex_text(gap[0])} to {hex_text(gap[1])}"
    form = "{:04X}h" if family(device.family).spaces[span.space] == "word" else "{}"
    carried = [form.format(words[at]) for at in addresses if at in words]
    text = f"{span_text(low, high)}: no point is described here" + (f"; {closed}" if closed else "")
    if carried:
        text += f" (carries {' '.join(carried[:_MOST_WORDS])}{' ...' if len(carried) > _MOST_WORDS else ''})"
    yield Item(span.space, low, len(addresses), text, findings=(closed,) if closed else ())


def _command(command: Command, span: Span, raw: int | None) -> Item:
    wrong = command.value is not None and raw is not None and raw != command.value
    odd = f"it takes {command.value}, here is {raw}" if wrong else ""
    text = f"command {command.name}: {title_text(command.title)}" + (f"; {odd}" if odd else "")
    text += f"; the memory stands {command.wears} writes" if command.wears else ""
    return Item(span.space, command.address, 1, line(text), raw=raw, findings=(odd,) if odd else ())
