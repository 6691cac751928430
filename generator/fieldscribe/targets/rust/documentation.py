"""The doc comments. They have only names and numbers; titles, notes and texts of errata are in the documentation.

So a corrected title changes neither code nor digest.
"""

import re
from collections.abc import Iterator, Mapping

from fieldscribe import wording
from fieldscribe.lowered import Lowered
from fieldscribe.model import Device, Point
from fieldscribe.text import humanised, rust_code

_WIDTH = 104
_BEGINS = re.compile(r"[`(\[]|[^\W\d]|\d+(?![\d.)])")
"""The characters with which a line may begin."""


def sentence(name: str) -> str:
    """Return a name as the first sentence of a doc comment: `base_frequency` as `Base frequency.`."""
    return f"{humanised(name)}."


class PointDoc:
    """Builds doc comments: all except name, code, address and range follow from the template of a point."""

    def __init__(self, point: Point, lowered: Lowered) -> None:
        self._before, self._behind = _around_address(point)
        self._type, self._facts = f"`{point.shape.wire_type}`", tuple(_facts(point, lowered.points))
        self._size = _size(point)
        self._tail = "".join(f"    ///\n{_comment(paragraph)}" for paragraph in _paragraphs(point, lowered))

    def of(self, item: str, code: str, address: int, limits: str) -> str:
        """Return the lines of a point's doc comment; `code` and `limits` are ready for Markdown."""
        place = f"{self._before} {wording.address_text(address)}{self._behind}"
        size = self._size or (limits and f"raw {limits}")
        start = f"{code} at {place}" if code else f"At {place}"
        facts = ", ".join((start, self._type, size, *self._facts) if size else (start, self._type, *self._facts))
        return f"{_comment(sentence(item))}    ///\n{_comment(f'{facts}.')}{self._tail}"[:-1]


def _comment(paragraph: str) -> str:
    if not is_long(paragraph):
        return f"    /// {paragraph}\n"
    return "".join(f"    /// {line}\n" for line in wrapped(paragraph))


def _paragraphs(point: Point, lowered: Lowered) -> Iterator[str]:
    """Yield the constant bits of a point, its special codes, and its errata."""
    if point.fixed is not None:
        yield f"Constant bits when written: {wording.fixed_text(point)}."
    if point.specials:
        yield f"{wording.codes_text(point, '`')}."
    yield from (f"{rust_code(text[0].upper() + text[1:])}." for text in wording.write_texts(point))
    errata, doubts = lowered.errata_of(point)
    if errata:
        yield f"Errat{'a' if len(errata) > 1 else 'um'}: {', '.join(f'`{name}`' for name in errata)}."
    if doubts:
        yield f"The {wording.open_text(doubts, rust_code)}."


def is_long(text: str) -> bool:
    """Return True if the text may take several lines."""
    return len(text) > _WIDTH


def wrapped(text: str) -> Iterator[str]:
    """Yield the text in lines; no line begins like a list or a heading."""
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


def left_out(device: Device, lowered: Lowered) -> tuple[tuple[str, ...], ...]:
    """Return the lines for each point that is only documented: its address if it has one, and what is open."""
    return tuple(
        tuple(wrapped(", ".join((f"`{point.item}`", *_whereabouts(point, lowered)))))
        for point in device.points
        if not point.generated
    )


def _whereabouts(point: Point, lowered: Lowered) -> Iterator[str]:
    if point.code:
        yield rust_code(point.code)
    if point.addresses:
        before, after = _around_address(point)
        yield f"{before} {wording.address_text(min(point.addresses))}{after}"
    _, doubts = lowered.errata_of(point)
    if doubts:
        yield f"the {wording.open_text(doubts, rust_code)}"


def _around_address(point: Point) -> tuple[str, str]:
    """Return the texts before and after the address of a point."""
    space = point.space if point.telegram is None else f"telegram {rust_code(point.telegram)} word"
    written = point.write_place
    after = "" if written is None else f" (written at {wording.address_text(min(written.addresses))})"
    after += "" if point.index is None else f" index {point.index}"
    return space, after + (f" bits {point.bits[0]} to {point.bits[1]}" if point.bits else "")


def _size(point: Point) -> str:
    """Return the size of a text or of a word of digits; empty for numbers."""
    if point.form == "text" and point.text is not None:
        count, encoding, *others = wording.characters_text(point.text).split(", ")
        return ", ".join((f"{count} of {rust_code(encoding)}", *others))
    if point.form == "digits" and point.digits is not None:
        return f"{point.digits.count} decimal digits"
    return ""


def _facts(point: Point, points: Mapping[str, Point]) -> Iterator[str]:
    yield from _resolution(point)
    if point.display is not None:
        yield wording.display_text(point)
    if point.epoch:
        yield wording.epoch_text(point)
    yield wording.access_text(point.access)
    if point.variant:
        yield f"for {rust_code(str(point.variant))}"
    if point.when:
        yield f"exists only when {rust_code(wording.condition_text(point.when, points))}"


def _resolution(point: Point) -> Iterator[str]:
    """Yield the unit of a raw step and of a count."""
    if point.form not in ("scaled", "float"):
        return
    resolution, scale = wording.resolution_text(point), wording.scale_text(point)
    count = wording.count_text(point) if point.form == "scaled" else ""
    if resolution and resolution != count:
        yield f"steps of {rust_code(resolution)}{' (for information, not checked)' if point.steps else ''}"
    elif scale and not resolution:
        yield f"value {rust_code(scale)}"
    if count:
        yield f"one count is {rust_code(count)}"
    yield from (*wording.width_texts(point), *map(rust_code, wording.overflow_texts(point)))
