"""The table of all points for spreadsheets, with a row for each point."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from fieldscribe import text, wording
from fieldscribe.targets.docs.alike import Alike
from fieldscribe.targets.docs.points import reference_heads
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from fieldscribe.model import Device, Point

_cell = lru_cache(maxsize=65536)(text.csv_cell)


def sheet_of(device: Device) -> list[str]:
    """The lines of the table, its head first."""
    languages = tuple(dict.fromkeys(key for point in device.points for key in point.title))
    references = reference_heads(device.points)
    by_name = {point.name: point for point in device.points}
    heads = ("code", "name", "variant", "group", *(f"title_{key}" for key in languages), *_PLACE, *references, *_FACTS)
    meanings = Alike(lambda point: _meaning(device, point, by_name))
    lines = [",".join(map(_cell, heads))]
    for point in device.points:
        titles = [_cell(point.title.get(key, "")) for key in languages]
        printed = [_cell(str(point.references.get(key, ""))) for key in references]
        meaning, reason = meanings.of(point)
        lines.append(",".join((*_identity(point), *titles, *_place(point), *printed, meaning, *_source(point), reason)))
    return lines


_PLACE = ("space", "wire_hex", "wire", "words_high_first", "other_places", "index", "telegram")
_FACTS = (
    *("type", "words", "bits", "access", "raw_min", "raw_max", "raw_range", "range", "unit", "scale", "resolution"),
    *("default", "steps", "names", "flags", "specials", "fixed"),
    *("keeps", "conditions", "when", "since", "until", "changes", "changes_with", "record", "set", "was", "note"),
    *("errata", "document", "section", "page", "line", "generated", "reason"),
)


def _identity(point: Point) -> tuple[str, ...]:
    return _cell(point.code or ""), _cell(point.name), _cell(str(point.variant or "")), _cell(point.group)


def _place(point: Point) -> tuple[str, ...]:
    addresses = point.addresses
    beside = "" if point.index is None else str(point.index), _cell(point.telegram or "")
    if not addresses:
        return _cell(point.space), "", "", "", "", *beside
    lowest = min(addresses)
    others = "" if point.write_place is None else f"write: {point.space} {_hexes(point.write_place.addresses)}"
    words = _hexes(addresses) if len(addresses) > 1 else ""
    return _cell(point.space), hex_text(lowest), str(lowest), words, _cell(others) if others else "", *beside


def _hexes(addresses: tuple[int, ...]) -> str:
    return " ".join(map(hex_text, addresses))


def _meaning(device: Device, point: Point, by_name: dict[str, Point]) -> tuple[str, str]:
    """The cells before and behind the place in the manual."""
    cells = (
        *_numbers(point, by_name),
        *_names(point),
        *_behaviour(device, point, by_name),
        _cell("; ".join(point.errata)),
    )
    return ",".join(cells), f"{'yes' if point.generated else 'no'},{_cell(point.reason or '')}"


def _numbers(point: Point, by_name: dict[str, Point]) -> tuple[str, ...]:
    outer = None if point.info.floating else wording.outer_raw(point)
    return (
        point.type if point.untyped is None else _cell(wording.type_text(point)),
        str(point.words),
        f"{point.bits[0]}..{point.bits[1]}" if point.bits else "",
        point.access,
        str(outer[0]) if outer else "",
        str(outer[1]) if outer else "",
        _cell(wording.raw_range_text(point)),
        _cell(wording.range_text(point, by_name)),
        _cell(point.unit.symbol),
        _cell(wording.scale_text(point, by_name)),
        _cell(wording.resolution_text(point)),
        _cell(wording.default_text(point, unit=False)),
        _cell(wording.steps_text(point)),
    )


def _names(point: Point) -> tuple[str, ...]:
    enum = point.enum or (point.digits and point.digits.enum)
    names = "; ".join(map(wording.entry_text, enum.entries)) if enum else ""
    flags = "; ".join(wording.flag_text(flag, point) for flag in point.flags)
    codes = [wording.special_text(special, point.width) for special in point.specials if special.own]
    specials = "; ".join((*codes, f"those of {point.specials_of}") if point.specials_of else codes)
    return _cell(names), _cell(flags), _cell(specials), _cell(wording.fixed_text(point))


def _behaviour(device: Device, point: Point, by_name: dict[str, Point]) -> tuple[str, ...]:
    return (
        _cell(wording.keeps_text(device, point)),
        _cell("; ".join(point.conditions)),
        _cell(wording.condition_text(point.when, by_name)),
        _cell(point.since or ""),
        _cell(point.until or ""),
        _cell(point.changes or ""),
        _cell(" ".join(point.changes_with)),
        _cell(point.record or ""),
        "" if point.set is None else str(point.set),
        _cell("; ".join(point.was)),
        _cell(wording.title_text(point.note)) if point.note else "",
    )


def _source(point: Point) -> tuple[str, ...]:
    source = point.source
    line = "" if source.line is None else str(source.line)
    return _cell(source.document), _cell(source.section or ""), _cell(source.page or ""), line
