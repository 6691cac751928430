"""The doc comments. They have names and numbers only; titles, notes and the texts of errata are in the documentation.

So a corrected title changes neither code nor digest.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from fieldscribe.text import rust_code
from fieldscribe.wording import (
    access_text,
    address_text,
    codes_text,
    condition_text,
    display_text,
    resolution_text,
    scale_text,
    width_texts,
    with_unit,
)

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from fieldscribe.model import Device, Point
    from fieldscribe.targets.rust.identity import Words

_WIDTH = 104
_BEGINS = re.compile(r"[`(\[\ufdd0-\ufdef]|[^\W\d]|\d+(?![\d.)])")
"""What a line may begin with; also a blank, since all words of a point that are blanked may."""


def sentence(name: str) -> str:
    """A name as the first sentence of a doc comment: `base_frequency` as `Base frequency.`."""
    return f"{name.replace('_', ' ').capitalize()}."


def facts_text(point: Point, words: Words) -> str:
    """The paragraph with the facts of a point."""
    return f"{', '.join(_facts(point, words))}."


def point_doc(point: Point, title: str, facts: str, errata: Collection[str]) -> tuple[str, ...]:
    """The lines of a point's doc comment, without `///`; an empty line separates paragraphs. `errata` may be named."""
    paragraphs = [title, facts]
    if point.specials:
        paragraphs.append(f"{codes_text(point, '`')}.")
    named = [f"`{name}`" for name in point.errata if name in errata]
    if named:
        paragraphs.append(f"Errat{'a' if len(named) > 1 else 'um'}: {', '.join(named)}.")
    lines = [line for paragraph in paragraphs for line in ("", *(f" {text}" for text in wrapped(paragraph)))]
    return tuple(lines[1:])


def is_long(text: str) -> bool:
    """Whether the text may take several lines."""
    return len(text) > _WIDTH


def wrapped(text: str) -> Iterator[str]:
    """The text in lines, none of which begins like a list or a heading."""
    if not is_long(text):
        yield text
        return
    line = ""
    for word in text.split(" "):
        if len(line) + len(word) >= _WIDTH and _BEGINS.match(word):
            yield line
            line = word
        else:
            line += f" {word}" if line else word
    yield line


def left_out(device: Device) -> tuple[str, ...]:
    """One line for each point that is only documented, with its address on the wire if it has one."""
    return tuple(
        f"`{point.item}`" + "".join(f", {fact}" for fact in _whereabouts(point))
        for point in device.points
        if not point.generated
    )


def _whereabouts(point: Point) -> Iterator[str]:
    if point.code:
        yield rust_code(point.code)
    if point.addresses:
        yield _place(point, address_text(min(point.addresses)), "" if point.index is None else str(point.index))


def _place(point: Point, address: str, index: str) -> str:
    space = point.space if point.telegram is None else f"telegram {rust_code(point.telegram)} word"
    where = f"{space} {address}"
    where += "" if point.write_place is None else f" (written at {address_text(min(point.write_place.addresses))})"
    where += f" index {index}" if index else ""
    return where + (f" bits {point.bits[0]} to {point.bits[1]}" if point.bits else "")


def _facts(point: Point, words: Words) -> Iterator[str]:
    where = _place(point, f"{words.hexadecimal} {words.decimal}", words.element)
    yield f"{words.code_shown} at {where}" if words.code else f"At {where}"
    yield f"`{point.type}`"
    if point.form == "text" and point.text is not None:
        yield f"{point.text.characters} characters of {rust_code(point.text.encoding)}"
    elif point.form == "digits" and point.digits is not None:
        yield f"{point.digits.count} decimal digits"
    elif words.span:
        yield f"raw {words.span}"
    yield from _resolution(point)
    if point.display is not None:
        yield display_text(point)
    yield access_text(point.access)
    if point.variant:
        yield f"for {rust_code(str(point.variant))}"
    if point.when:
        yield f"only when {rust_code(condition_text(point.when))}"


def _resolution(point: Point) -> Iterator[str]:
    """The unit of a raw step and of a count."""
    if point.form not in ("scaled", "float"):
        return
    resolution, scale, count = resolution_text(point), scale_text(point), _count(point)
    if resolution and resolution != count:
        yield f"steps of {rust_code(resolution)}{' (for information, not checked)' if point.steps else ''}"
    elif scale and not resolution:
        yield f"value {rust_code(scale)}"
    if count:
        yield f"one count is {rust_code(count)}"
    yield from width_texts(point)


def _count(point: Point) -> str:
    """The unit of one count of a scaled point; empty if it has no counts."""
    if point.form != "scaled" or point.decimals is None:
        return ""
    return with_unit(f"0.{'1':0>{point.decimals}}" if point.decimals else "1", point)
