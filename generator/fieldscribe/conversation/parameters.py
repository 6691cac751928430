"""What frames say about parameters: a whole element, or one word of it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import raw_of, split
from fieldscribe.conversation.decode_state import odd_item
from fieldscribe.conversation.items import named_item
from fieldscribe.conversation.point_formatter import PARAMETER
from fieldscribe.conversation.selection import absence
from fieldscribe.families.frame_results import Item
from fieldscribe.wording import address_text, fixed_text
from fieldscribe.wording.buses import counted, element_text, words_text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.conversation.decode_state import DecodeState
    from fieldscribe.conversation.items import Base
    from fieldscribe.families.decoded_frame import Element, Word
    from fieldscribe.model import Point


def element_items(hearing: DecodeState, element: Element) -> Iterator[Item]:
    """What a frame says about one element of a parameter."""
    points = hearing.directory.at(PARAMETER, element.parameter, element.index)
    base = (PARAMETER, element.parameter, max(1, element.width))
    carried = f"carries {words_text(element.words)}"
    if element.refused:
        yield from (named_item(point, (PARAMETER, element.parameter, point.words)) for point in points)
    elif not points:
        text = element_text(element.parameter, element.index, alone=True)
        carried_text = f" ({carried})" if element.width or not element.in_request else ""
        yield Item(*base, f"{text}: no point is described here{carried_text}")
    elif not element.in_request and (element.width == 0 or element.counts):
        said = f"{element.value} elements" if element.counts else carried
        yield from (named_item(point, base, said) for point in points)
    else:
        shown = hearing.told.elements[element.parameter, element.index, element.in_request]
        yield from (_element(hearing, element, point, base, carried) for point in shown)


def _element(hearing: DecodeState, element: Element, point: Point, base: Base, carried: str) -> Item:
    if element.value is None:
        return named_item(point, base, odd=absence(hearing.device, point) if element.in_request else "")
    if not point.generated:
        return named_item(point, base, f"{carried}; {point.reason or 'its meaning is open'}")
    if element.width != point.words:
        return odd_item(point, base, carried, _width_finding(point, element))
    raw = raw_of(point, split(element.value, element.width))
    if not element.in_request:
        hearing.learn([(point, raw)])
    return hearing.value(point, base, raw, written=element.in_request)


def _width_finding(point: Point, element: Element) -> str:
    """The finding that a value has a different number of words than the parameter."""
    words = "a double word" if point.words == 2 else counted(point.words, "word")
    said = f"the parameter is {words}, the {'task' if element.in_request else 'response'} carries {element.width}"
    return f"{said}; a device answers with a wrong data type" if element.in_request else said


def word_items(hearing: DecodeState, word: Word) -> Iterator[Item]:
    """What a frame says about one word of a parameter."""
    points = hearing.directory.at(PARAMETER, word.address)
    if word.learned and word.raw is not None and points:
        hearing.words[word.address] = word.raw
    if word.stale:
        hearing.forget(word.address)
    if word.learned:
        hearing.learn((point, _heard(hearing, point)) for point in points if _whole(hearing, point))
    for point in hearing.told.elements[word.address, 0, word.in_request]:
        yield _word(hearing, word, point)
    if not points:
        brings = "" if word.raw is None else f" ({words_text((word.raw,))})"
        yield Item(PARAMETER, word.address, 1, f"{address_text(word.address)}: no point is described here{brings}")


def _whole(hearing: DecodeState, point: Point) -> bool:
    return all(at in hearing.words for at in point.addresses)


def _heard(hearing: DecodeState, point: Point) -> int:
    return raw_of(point, [hearing.words[at] for at in point.addresses])


def _word(hearing: DecodeState, word: Word, point: Point) -> Item:
    base = (PARAMETER, word.address, 1)
    if word.raw is None:
        return named_item(point, base, odd=absence(hearing.device, point))
    if len(point.addresses) == 1:
        item = hearing.value(point, base, raw_of(point, (word.raw,)), written=word.in_request)
        odd = _fixed_finding(point, word.raw) if word.in_request else ""
        return replace(item, summary=f"{item.summary}; {odd}", findings=(*item.findings, odd)) if odd else item
    now = replace(hearing, words={**hearing.words, word.address: word.raw})
    part = f"word {point.addresses.index(word.address) + 1} of {len(point.addresses)} = {words_text((word.raw,))}"
    if not _whole(now, point):
        left = sum(at not in now.words for at in point.addresses)
        return named_item(point, base, f"{part}; {left} more words to come")
    item = hearing.value(point, base, _heard(now, point))
    return replace(item, summary=f"{item.summary}; here {part}")


def _fixed_finding(point: Point, word: int) -> str:
    """The finding that a written word lacks the constant bits that belong beside a bit group."""
    if point.bits is None or point.fixed is None or word & point.fixed.mask == point.fixed.bits:
        return ""
    return f"the word breaks what is always written: {fixed_text(point)}"
