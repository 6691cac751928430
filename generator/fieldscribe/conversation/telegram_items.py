"""Items of telegrams: process data with masks, and telegrams in several frames."""

from collections.abc import Iterator, Sequence
from functools import lru_cache, partial
from operator import itemgetter

from fieldscribe.arithmetic.words import raw_of, reader_of
from fieldscribe.conversation.decode_state import DecodeState, Directory, Plan, Read, Step, named_item
from fieldscribe.conversation.point_items import PointFormatter
from fieldscribe.families.decoded_frame import Layout, Masks, Piece, ProcessData
from fieldscribe.families.frame_results import Item
from fieldscribe.model import Device, Point
from fieldscribe.text import line
from fieldscribe.wording.numbers import hex_words, word_text

_MOST_SOURCES = 16
"""How many sets of missing points are remembered for a point, with the text where they come from."""


def process_items(state: DecodeState, data: ProcessData) -> Iterator[Item]:
    """Return the items of process data, one or more for each word."""
    names, written = _telegrams(state.device, data.direction), data.direction == "request"
    for at, word in enumerate(data.words):
        base = (names[0] if names else "telegram", at, 1)
        points = [point for name in names for point in state.directory.at(name, at)]
        if not points:
            subject = f"word {at + 1} of process data"
            yield Item(*base, f"{subject} = {word:04X}h: no point is described here", subject=subject)
        for point in points:
            words = data.words[at : at + point.words]
            if point.addresses[0] != at or len(words) < point.words:
                continue
            if not point.generated and point.scale is None:
                yield named_item(point, base, f"carries {word:04X}h; {point.reason or 'its meaning is open'}")
                continue
            raw = raw_of(point, words)
            item = state.value(point, base, raw, written=written)
            # a master with nothing to write sends zeros
            yield item if raw or not item.findings else item.but(findings=())


def _telegrams(device: Device, direction: str) -> list[str]:
    return [telegram.name for telegram in device.telegrams if telegram.direction == direction]


def mask_items(state: DecodeState, masks: Masks) -> Iterator[Item]:
    """Return the items of masks: which words of process data are valid, and which bits of control words."""
    valid = [str(place) for place in range(1, 16) if masks.words[0] >> place & 1]
    which = " and ".join([", ".join(valid[:-1]), valid[-1]] if valid[1:] else valid)
    text = f"words {which} of process data count" if valid else "no word of process data counts"
    yield Item("mask", 0, 1, f"mask {masks.words[0]:04X}h: {text}", subject="mask")
    yield _mask_item(state, 0, 1, masks.words[1:2])
    yield _mask_item(state, 3, 2, masks.words[2:4])


def _mask_item(state: DecodeState, place: int, at: int, words: tuple[int, ...]) -> Item:
    """Return the item of one mask: which bits of the control word at a place are valid."""
    names = _telegrams(state.device, "request")
    point = next((point for name in names for point in state.directory.at(name, place)), None)
    about = line(point.code or point.name) if point is not None else f"word {place + 1}"
    if not any(words):
        text = f"no bit of {about} counts"
    elif set(words) == {0xFFFF}:
        text = f"every bit of {about} counts"
    else:
        flags = point.flags if point is not None and len(words) == 1 else ()
        named = [flag.name for flag in flags if words[0] >> flag.low & 1]
        text = f"only these bits of {about} count" + (f" ({', '.join(named)})" if named else "")
    return Item("mask", at, len(words), f"mask {hex_words(words)}: {text}", subject=f"mask of {about}")


def piece_items(state: DecodeState, piece: Piece) -> list[Item]:
    """Return the items of a frame of a telegram, and of earlier points whose missing settings it has."""
    layout, words = piece
    plan = state.plans.get(layout) or state.planned(layout, _plan(state, layout))
    plan.teach(state, words)
    items: list[Item] = []
    for formatter, read, place in plan.steps:
        raw = read(words)
        if formatter is None:
            items.append(_nameless_item(layout, place, raw))
            continue
        if raw is None:
            text = _incomplete_text(state, layout, formatter)
            items.append(named_item(formatter.point, formatter.base, text, rests_on=formatter.rests_on))
            continue
        item = formatter.item(raw, state.settings)
        items.append(item)
        number = (formatter, raw) if item.missing else None
        if state.incomplete.get(formatter.name) != number:
            state.incomplete.pop(formatter.name, None)  # those of the last frames come last
            if number is not None:
                state.incomplete[formatter.name] = number
            state.touch(formatter.name)
    if state.changed:
        items += _completed_items(state)
    return items


def _plan(state: DecodeState, layout: Layout) -> Plan:
    """Return the plan for the frames of a telegram with these words."""
    telegram, positions, directory = layout.telegram.name, layout.positions, state.directory
    steps: list[Step] = []
    for place in positions:
        points = directory.at(telegram, place)
        if not points:
            steps.append((None, itemgetter(place - positions.start), place))
        for point in points:
            if place == min(position for position in point.addresses if position in positions):
                formatter = state.formatter(point, (telegram, min(point.addresses), len(point.addresses)))
                formatter.sources = lru_cache(_MOST_SOURCES)(partial(_source_text, directory, layout))
                steps.append((formatter, _reader(layout, point), place))
    taught = [(one.point, read) for one, read, _ in steps if one is not None and directory.teaches(one.point)]
    return Plan(taught, steps)


def _reader(layout: Layout, point: Point) -> Read:
    """Return the function that reads the number of a point from the words of a frame, and if need be of others."""
    positions, pieces = layout.positions, layout.pieces
    if pieces is None or all(at in positions for at in point.addresses):
        return reader_of(point, [at - positions.start for at in point.addresses])

    def read(_words: Sequence[int]) -> int | None:
        status, words = pieces.words(point.addresses)
        return raw_of(point, words) if status == "ok" else None

    return read


def _nameless_item(layout: Layout, place: int, word: int) -> Item:
    subject = f"word {place}"
    text = f"{subject}: no point is described here ({hex_words((word,))})"
    return Item(layout.telegram.name, place, 1, text, subject=subject)


def _source_text(directory: Directory, layout: Layout, missing: tuple[str, ...]) -> str:
    """Return the places of missing points in the telegram; empty if it has none of them."""
    if layout.pieces is None:
        return ""
    firsts = [directory.first(layout.telegram.name, name) for name in missing]
    slots = sorted({first // layout.pieces.per_frame for first in firsts if first is not None})
    return f"; it comes with multiplexer {' and '.join(map(str, slots))}" if slots else ""


def _incomplete_text(state: DecodeState, layout: Layout, formatter: PointFormatter) -> str:
    """Return a text about a number whose words are in several frames and may not belong together."""
    point, pieces = formatter.point, layout.pieces
    assert pieces is not None
    words = [(at, *pieces.words((at,))) for at in point.addresses]
    if any(status != "ok" for _, status, _ in words):
        came = [f"only the {word_text(point.addresses, at)} = {here[0]:04X}h" for at, _, here in words if here]
        slots = dict.fromkeys(str(at // pieces.per_frame) for at, _, here in words if not here)
        return f"{', '.join(came)}; the rest comes with multiplexer {' and '.join(slots)}"
    would = formatter.value(raw_of(point, [here[0] for _, _, here in words]), state.settings)
    return (
        f"its words are in two frames and may be torn; {would} if the high word stayed as it is: "
        f"the next frame with multiplexer {point.addresses[0] // pieces.per_frame} tells"
    )


def _completed_items(state: DecodeState) -> Iterator[Item]:
    """Return points of earlier frames whose missing settings this frame has."""
    for name, (formatter, raw) in list(state.incomplete.items()):
        if state.changed.isdisjoint(formatter.needs):
            continue
        if not formatter.meanings.of(raw, state.settings).missing:
            del state.incomplete[name]
            item = formatter.item(raw, state.settings)
            yield item.but(statement=f"from a frame before: {item.summary}")
    state.changed.clear()
