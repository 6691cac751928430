"""The facts of a point as labelled texts for people, where a text is more than the value.

The context gives the names of other points.
"""

from collections.abc import Iterable, Iterator

from fieldscribe import wording
from fieldscribe.facts.table import Context, Row
from fieldscribe.families import family
from fieldscribe.model import Device, Point, Source
from fieldscribe.text import counted
from fieldscribe.wording.numbers import hex_text

_KINDS = {"u": "unsigned", "s": "signed, two's complement", "f": "IEEE 754 floating point"}


def group_text(point: Point, context: Context) -> str:
    """Return the group with its title."""
    group = next((group for group in context.device.groups if group.name == point.group), None)
    return f"{point.group}: {wording.title_text(group.title)}" if group else point.group


def address_text(point: Point, context: Context) -> str:
    """Return the address with what it needs beside it: index and space, or the telegram."""
    if point.address is None:
        return f"not printed in the manual, space {point.space}" if point.telegram is None else ""
    if point.place.bit is not None:
        return ""
    if point.telegram is not None:
        return f"word {point.address} of the telegram {point.telegram}, counted from 0"
    first = point.addresses[0] if point.text is not None else point.address
    index = f", index {point.index}" if _index_travels(point, context) else ""
    return f"{wording.address_text(first)}{index}, space {point.space}"


def base_text(point: Point, context: Context) -> str:
    """Return the base of the addresses."""
    base = context.device.base_of(point)
    return "" if base is None else wording.base_text(base)


def words_text(point: Point, _: Context) -> str:
    """Return the words of a point that has several."""
    return wording.words_text(point) if len(point.addresses) > 1 and point.place.bit is None else ""


def signal_text(point: Point, _: Context) -> str:
    """Return the bits of a signal in its message; empty for other points."""
    return "" if point.place.bit is None else f"{wording.bits_in_message(point)} of the message {point.telegram}"


def index_text(point: Point, context: Context) -> str:
    """Return the index if it is not beside the address."""
    return "" if point.index is None or _index_travels(point, context) else str(point.index)


def _index_travels(point: Point, context: Context) -> bool:
    return point.index is not None and point.space in family(context.device.family).indexed


def reference_rows(point: Point, _: Context) -> Iterator[Row]:
    """Yield what the manual prints for people, a row for each numbering."""
    for key, printed in point.references.items():
        as_hex = f" ({hex_text(printed)})" if isinstance(printed, int) and printed <= 0x10000 else ""
        yield key.capitalize(), f"{printed}{as_hex}"


def type_text(point: Point, _: Context) -> str:
    """Return the type with what kind of number it is."""
    if point.untyped is not None or point.type == "bit" or point.text is not None:
        return wording.type_text(point)
    kind = f"{_KINDS[point.shape.wire_type[0]]}, {counted(point.width, 'bit')}"
    if point.digits is not None:
        return f"{wording.type_text(point)} ({kind})"
    if point.place.bit is not None:
        return f"{wording.type_text(point)} ({kind})"
    if point.bits is None:
        return f"{point.shape.wire_type} ({kind})"
    return f"{wording.type_text(point)} of a shared word ({kind})"


def scale_rows(point: Point, context: Context) -> Iterator[Row]:
    """Yield the scale, its resolution, and the points that it needs."""
    yield "Scale", wording.scale_text(point, context.points)
    yield "Resolution", wording.resolution_text(point)
    yield "Scale needs", _needed(point.scale_arguments)


def range_rows(point: Point, context: Context) -> Iterator[Row]:
    """Yield the limits in the unit and as raw numbers, and the points that they need."""
    yield "Range", "" if point.flags else wording.range_text(point, context.points)
    yield "Raw range", wording.raw_range_text(point)
    yield "Limits need", _needed([name for name in point.limit_arguments if name not in point.scale_arguments])


def _needed(names: Iterable[str]) -> str:
    names = list(names)
    return f"{', '.join(names)} (read {'it' if len(names) == 1 else 'them'} first)" if names else ""


def enum_rows(point: Point, _: Context) -> Iterator[Row]:
    """Yield a row for each name of a number."""
    if point.enum is not None:
        written = "only these may be written" if point.enum.closed else "the range says what may be written"
        yield "Names", written if point.writable else ""
        for entry in point.enum.entries:
            number = wording.entry_number(entry, patterns=point.patterns)
            yield f"{'Value' if point.patterns else 'Raw'} {number}", wording.entry_meaning(entry)
    if point.digits is not None:
        for entry in point.digits.enum.entries:
            yield f"Digit {entry.raw}", wording.entry_meaning(entry)


def special_rows(point: Point, _: Context) -> Iterator[Row]:
    """Yield a row for each special code."""
    for special in point.specials:
        yield f"Raw {wording.special_numbers(special, point.width)}", wording.special_meaning(special)


def flag_rows(point: Point, _: Context) -> Iterator[Row]:
    """Yield a row for each flag."""
    for flag in point.flags:
        yield f"Bit{'s' if flag.width > 1 else ''} {wording.flag_bits(flag, point)}", wording.flag_meaning(flag)


def unit_text(point: Point, _: Context) -> str:
    """Return the unit with its name."""
    return f"{point.unit.symbol} ({point.unit.name})" if point.unit.symbol else ""


def place_in_manual(source: Source, device: Device) -> str:
    """Return the place of a fact: document, section, page and line."""
    titles = {document.id: document.title for document in device.documents}
    parts = [titles.get(source.document, source.document), source.section or ""]
    parts.append(f"page {source.page}" if source.page else "")
    parts.append("" if source.line is None else f"line {source.line} of its text")
    return ", ".join(filter(None, parts))
