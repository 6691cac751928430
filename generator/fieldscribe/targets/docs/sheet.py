"""The table of all points for spreadsheets, with a row for each point."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe import wording
from fieldscribe.targets.docs.subjects import reference_heads
from fieldscribe.text import csv_cell
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.model import Place, Point, Source
    from fieldscribe.targets.docs.subjects import Scope

_PLACE = ("space", "wire_hex", "wire", "words_high_first", "other_places", "index", "telegram")
_FACTS = (
    *("type", "words", "bits", "access", "raw_min", "raw_max", "raw_range", "range", "unit", "scale", "resolution"),
    *("default", "steps", "names", "flags", "specials", "fixed"),
    *("keeps", "conditions", "when", "since", "until", "changes", "changes_with", "record", "set", "was", "note"),
    *("errata", "document", "section", "page", "line", "generated", "reason"),
)


class _Kin(NamedTuple):
    """The cells that points have alike, those side by side as one text."""

    group: str
    space: str
    telegram: str
    meaning: str
    scale: str
    behaviour: str
    generated: str


def sheet_of(scope: Scope) -> str:
    """The lines of the table, its head first."""
    points = scope.device.points
    languages = tuple(dict.fromkeys(key for point in points for key in point.title))
    references = reference_heads(points)
    heads = ("code", "name", "variant", "group", *(f"title_{key}" for key in languages), *_PLACE, *references, *_FACTS)
    lines = [_joined(heads), *_lines(scope, languages, references)]
    return "\n".join(lines) + "\n"


def _lines(scope: Scope, languages: tuple[str, ...], references: tuple[str, ...]) -> Iterator[str]:
    kins: dict[int, _Kin] = {}
    for point, number, limits in scope.subjects:
        kin = kins.get(number)
        if kin is None:
            kin = kins[number] = _kin(scope, point)
        titles, printed = point.title, point.place.references
        cells = (
            csv_cell(point.code) if point.code else "",
            csv_cell(point.name),
            csv_cell(str(point.variant)) if point.variant else "",
            kin.group,
            *[csv_cell(titles.get(key, "")) for key in languages],
            kin.space,
            _place(point.place),
            "" if point.write_place is None else _written(point, point.write_place),
            "" if point.index is None else str(point.index),
            kin.telegram,
            *[_number(printed.get(key, "")) for key in references],
            kin.meaning,
            limits.sheet,
            kin.scale,
            "" if point.default is None and point.default_raw is None else _default(point),
            kin.behaviour,
            _own(point),
            _source(point.source),
            kin.generated,
        )
        yield ",".join(cells)


def _kin(scope: Scope, point: Point) -> _Kin:
    return _Kin(
        csv_cell(point.group),
        csv_cell(point.space),
        csv_cell(point.telegram or ""),
        _joined(_meaning(point)),
        _joined((point.unit.symbol, wording.scale_text(point, scope.by_name), wording.resolution_text(point))),
        _joined((wording.steps_text(point), *_names(point), *_behaviour(scope, point))),
        _joined(("yes" if point.generated else "no", point.reason or "")),
    )


def _joined(texts: Iterable[str]) -> str:
    return ",".join(map(csv_cell, texts))


def _number(number: int | str) -> str:
    return csv_cell(number) if isinstance(number, str) else str(number)


def _place(place: Place) -> str:
    """The lowest address in both notations, and all if there are several."""
    addresses = place.addresses
    if len(addresses) == 1:
        return f"{hex_text(addresses[0])},{addresses[0]},"
    return f"{hex_text(min(addresses))},{min(addresses)},{_hexes(place)}" if addresses else ",,"


def _written(point: Point, place: Place) -> str:
    return csv_cell(f"write: {point.space} {_hexes(place)}") if point.addresses else ""


def _hexes(place: Place) -> str:
    return " ".join(map(hex_text, place.addresses))


def _meaning(point: Point) -> tuple[str, ...]:
    bits = f"{point.bits[0]}..{point.bits[1]}" if point.bits else ""
    return point.type if point.untyped is None else wording.type_text(point), str(point.words), bits, point.access


def _names(point: Point) -> tuple[str, ...]:
    enum = point.enum or (point.digits and point.digits.enum)
    names = "; ".join(map(wording.entry_text, enum.entries)) if enum else ""
    flags = "; ".join(wording.flag_text(flag, point) for flag in point.flags)
    codes = [wording.special_text(special, point.width) for special in point.specials if special.own]
    specials = "; ".join((*codes, f"those of {point.specials_of}") if point.specials_of else codes)
    return names, flags, specials, wording.fixed_text(point)


def _behaviour(scope: Scope, point: Point) -> tuple[str, ...]:
    return (
        wording.keeps_text(scope.device, point),
        "; ".join(point.conditions),
        wording.condition_text(point.when, scope.by_name),
        point.since or "",
        point.until or "",
        point.changes or "",
        " ".join(point.changes_with),
    )


def _default(point: Point) -> str:
    return csv_cell(wording.default_text(point, unit=False))


def _own(point: Point) -> str:
    """What tells few points from others of their kin: record, set, former names, note and errata."""
    if not (point.record or point.was or point.note or point.errata) and point.set is None:
        return ",,,,"
    number = "" if point.set is None else str(point.set)
    note = wording.title_text(point.note) if point.note else ""
    return _joined((point.record or "", number, "; ".join(point.was), note, "; ".join(point.errata)))


def _source(source: Source) -> str:
    page = _page(source.document, source.section or "", source.page or "")
    return page if source.line is None else f"{page}{source.line}"


@lru_cache(maxsize=256)
def _page(*parts: str) -> str:
    """Where in which document, up to the number of the line."""
    return f"{_joined(parts)},"
