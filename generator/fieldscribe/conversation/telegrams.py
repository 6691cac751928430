"""Explains words of telegrams: process data, their masks, and telegrams that come in several frames."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import raw_of, raw_reader
from fieldscribe.conversation.items import named_item
from fieldscribe.families.decoded_frame import BoundedMemo
from fieldscribe.families.frame_results import Item
from fieldscribe.wording.buses import word_text, words_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.conversation.decode_state import DecodeState
    from fieldscribe.conversation.items import Base, Saying
    from fieldscribe.conversation.point_formatter import PointTextCache
    from fieldscribe.families.decoded_frame import Masks, Piece, ProcessData
    from fieldscribe.model import Device, Point

_MOST_MISSING = 64
"""How many ways to miss points are remembered of a stretch."""


def _names(device: Device, direction: str) -> list[str]:
    return [telegram.name for telegram in device.telegrams if telegram.direction == direction]


def process_items(hearing: DecodeState, data: ProcessData) -> list[Item]:
    """The items of process data."""
    sayings = hearing.told.process_data[data.direction, len(data.words)]
    return [say(data.words, hearing.settings) for say in sayings]


def process_sayings(told: PointTextCache, key: tuple[str, int]) -> list[Saying]:
    """What says the items of so many words of process data of a direction."""
    direction, count = key
    names = _names(told.device, direction)
    result = []
    for place in range(count):
        points = [point for name in names for point in told.directory.at(name, place)]
        base = (names[0] if names else "telegram", place, 1)
        whole = [point for point in points if point.addresses[0] == place and place + point.words <= count]
        result += [_process_saying(told, point, base, written=direction == "request") for point in whole]
        result += [] if points else [_undescribed(base)]
    return result


def _process_saying(told: PointTextCache, point: Point, base: Base, *, written: bool) -> Saying:
    """What says a point of process data."""
    place = base[1]
    if not point.generated and point.scale is None:
        why = point.reason or "its meaning is open"
        return lambda words, _: named_item(point, base, f"carries {words[place]:04X}h; {why}")
    read, voice = raw_reader(point, range(place, place + point.words)), told.voice(point, base, written=written)

    def say(words: Sequence[int], settings: Settings) -> Item:
        raw = read(words)
        item = voice.item(raw, settings)
        # a master that has nothing to say sends words of zero
        return item if raw or not item.findings else replace(item, findings=())

    return say


def _undescribed(base: Base) -> Saying:
    head = f"word {base[1] + 1} of process data"
    return lambda words, _: Item(*base, f"{head} = {words[base[1]]:04X}h: no point is described here")


def mask_items(hearing: DecodeState, masks: Masks) -> Iterator[Item]:
    """The items of masks: which words of process data are valid, and which bits of control words."""
    counts = [str(place) for place in range(1, 16) if masks.words[0] >> place & 1]
    which = " and ".join([", ".join(counts[:-1]), counts[-1]] if counts[1:] else counts)
    said = f"words {which} of process data count" if counts else "no word of process data counts"
    yield Item("mask", 0, 1, f"mask {masks.words[0]:04X}h: {said}")
    yield _mask(hearing, 0, 1, masks.words[1:2])
    yield _mask(hearing, 3, 2, masks.words[2:4])


def _mask(hearing: DecodeState, place: int, at: int, words: tuple[int, ...]) -> Item:
    """The item of one mask: which bits of a control word are valid."""
    names = _names(hearing.device, "request")
    point = next((point for name in names for point in hearing.directory.at(name, place)), None)
    about = point.code or point.name if point is not None else f"word {place + 1}"
    text = f"mask {words_text(words)}"
    if not any(words):
        return Item("mask", at, len(words), f"{text}: no bit of {about} counts")
    if set(words) == {0xFFFF}:
        return Item("mask", at, len(words), f"{text}: every bit of {about} counts")
    flags = point.flags if point is not None and len(words) == 1 else ()
    named = [flag.name for flag in flags if words[0] >> flag.low & 1]
    said = f" ({', '.join(named)})" if named else ""
    return Item("mask", at, len(words), f"{text}: only these bits of {about} count{said}")


class _Part:
    """A point that has words of a stretch, and what makes its raw number: from the stretch, or from several."""

    def __init__(self, told: PointTextCache, key: StretchKey, point: Point) -> None:
        telegram, positions, _ = key
        self.point, self.name, self.addresses = point, point.item, point.addresses
        self.base = telegram, min(point.addresses), len(point.addresses)
        self.voice = told.voice(point, self.base)
        self.teaches = told.directory.teaches(point)
        self.start = min(at for at in point.addresses if at in positions)
        inside = [at - positions.start for at in point.addresses if at in positions]
        self.whole = len(inside) == len(point.addresses)
        self._read = raw_reader(point, inside if self.whole else range(len(point.addresses)))

    def raw(self, piece: Piece) -> int | None:
        """The raw number; None while words that other frames bring are not known."""
        if self.whole:
            return self._read(piece.words)
        status, words = piece.pieces.words(self.addresses)
        return self._read(words) if status == "ok" else None


StretchKey = tuple[str, range, int]
"""A telegram, neighbouring words of it, and how many words one frame brings."""


class Stretch:
    """Neighbouring words of a telegram: the points that have one of them, in order, and the words that no point has."""

    def __init__(self, told: PointTextCache, key: StretchKey) -> None:
        telegram, positions, per_frame = key
        at = {place: told.directory.at(telegram, place) for place in positions}
        points = {point.item: point for here in at.values() for point in here}.values()
        parts = [_Part(told, key, point) for point in points]
        comes = BoundedMemo(_MOST_MISSING, partial(_multiplexers, told, telegram, per_frame))
        for part in parts:
            part.voice.comes = comes.__getitem__
        self.parts = sorted(parts, key=lambda part: part.start)
        self.teaching = [number for number, part in enumerate(self.parts) if part.teaches]
        self.alone = [place for place, here in at.items() if not here]


def piece_items(hearing: DecodeState, piece: Piece) -> Iterable[Item]:
    """The items of a frame of a telegram, and of earlier points whose missing values it brings."""
    stretch = hearing.told.stretches[piece.telegram.name, piece.positions, piece.pieces.per_frame]
    raws = [part.raw(piece) for part in stretch.parts]
    if stretch.teaching:
        known = [(stretch.parts[number].point, raws[number]) for number in stretch.teaching]
        hearing.learn((point, raw) for point, raw in known if raw is not None)
    items, lacking = [], {}
    for part, raw in zip(stretch.parts, raws, strict=True):
        if raw is None:
            items.append(named_item(part.point, part.base, _incomplete_text(hearing, piece, part)))
            continue
        if hearing.waiting:
            hearing.waiting.pop(part.name, None)
        item = part.voice.item(raw, hearing.settings)
        if item.missing:
            lacking[part.name] = part.voice, raw
        items.append(item)
    for at in stretch.alone:
        said = words_text((piece.words[at - piece.positions.start],))
        alone = Item(piece.telegram.name, at, 1, f"word {at}: no point is described here ({said})")
        items.insert(sum(part.start < at for part in stretch.parts) + stretch.alone.index(at), alone)
    if hearing.fresh:
        items += _completed_points(hearing)
    hearing.waiting.update(lacking)
    return items


def _multiplexers(told: PointTextCache, telegram: str, per_frame: int, missing: tuple[str, ...]) -> str:
    """Where missing points come in a telegram; empty if they do not."""
    firsts = [told.directory.first(telegram, name) for name in missing]
    slots = sorted({first // per_frame for first in firsts if first is not None})
    return f"; it comes with multiplexer {' and '.join(map(str, slots))}" if slots else ""


def _incomplete_text(hearing: DecodeState, piece: Piece, part: _Part) -> str:
    """What is known of a number whose words come in two frames and may not belong together."""
    words = [piece.pieces.words((at,)) for at in part.addresses]
    if any(status != "ok" for status, _ in words):
        return _waiting_text(part.point, [came for _, came in words], piece.pieces.per_frame)
    would = part.voice.value(raw_of(part.point, [came[0] for _, came in words]), hearing.settings)
    high = part.addresses[0] // piece.pieces.per_frame
    return (
        f"its words are in two frames and may be torn; {would} if the high word stayed as it is: "
        f"the next frame with multiplexer {high} tells"
    )


def _waiting_text(point: Point, parts: Sequence[Sequence[int]], per_frame: int) -> str:
    """Which words of a number have come, and which multiplexers carry the others."""
    places = list(zip(point.addresses, parts, strict=True))
    came = [f"only the {word_text(point.addresses, at)} = {words[0]:04X}h" for at, words in places if words]
    slots = dict.fromkeys(str(at // per_frame) for at, words in places if not words)
    return f"{', '.join(came)}; the rest comes with multiplexer {' and '.join(slots)}"


def _completed_points(hearing: DecodeState) -> Iterator[Item]:
    """Points of earlier frames whose missing values came with this frame."""
    for name, (voice, raw) in list(hearing.waiting.items()):
        if not hearing.fresh.isdisjoint(voice.needs) and not voice.lacks(hearing.settings):
            del hearing.waiting[name]
            item = voice.item(raw, hearing.settings)
            yield replace(item, summary=f"from a frame before: {item.summary}")
    hearing.fresh.clear()
