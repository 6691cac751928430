"""One point of the exported model."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.export.rules import PointsByName, bound_of, scale_of
from fieldscribe.wording.exact import number_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.conditions import Comparison, Condition
    from fieldscribe.model import Allowed, Entry, Enum, Flag, Place, Point, Source, Special

_MOST_VALUES = 4096
"""Longer lists of single numbers are exported as ranges only."""


def export_point(
    point: Point, by_name: PointsByName, direction: str | None = None, tasks: Sequence[tuple[str, int]] = ()
) -> dict[str, object]:
    """All facts of a point, in the order of the schema.

    `direction` is that of its telegram; `tasks` are the purposes and functions that its family has for it.
    """
    enum = point.enum if point.digits is None else point.digits.enum
    return {
        "name": point.name,
        "code": point.code,
        "group": point.group,
        "space": point.space,
        "telegram": point.telegram,
        "direction": direction,
        "address": point.address,
        "index": point.index,
        "addresses": list(point.addresses),
        "references": dict(point.references),
        "places": _places(point, tasks),
        "written": None if point.write_place is None else _written(point.write_place),
        "type": point.type if point.untyped is None else None,
        "untyped": point.untyped,
        "words": point.words,
        "access": point.access,
        "bits": None if point.bits is None else list(point.bits),
        "variant": None if point.variant is None else str(point.variant),
        "when": None if point.when is None else _condition(point.when),
        "since": point.since,
        "until": point.until,
        "record": point.record,
        "set": point.set,
        "repeat": _repeat(point),
        "format": None,
        "unit": point.unit.symbol,
        "unit_name": point.unit.name,
        "quantity": point.unit.quantity,
        "display": None if point.display is None else {"decimals": point.display},
        "decimals": point.decimals,
        "default": _default(point),
        "step": [{"from": start, "step": step} for start, step in point.steps] or None,
        "special": [_special(special) for special in point.specials],
        "special_of": point.specials_of,
        "fixed": {} if point.fixed is None else {"mask": point.fixed.mask, "bits": point.fixed.bits},
        "changes": point.changes,
        "changes_with": list(point.changes_with),
        "together": None,
        "scale": scale_of(point, by_name),
        "raw": _raw(point),
        "enum": None if point.enum is None else _names(point.enum),
        "enum_name": None if enum is None else enum.name,
        "enum_was": [] if enum is None else list(enum.was),
        "open": _is_open(point.enum),
        "flags": [_flag(flag) for flag in point.flags],
        "digits": None if point.digits is None else {"count": point.digits.count, "enum": _names(point.digits.enum)},
        "encoding": None if point.text is None else point.text.encoding,
        "persistence": point.keeps,
        "conditions": list(point.conditions),
        "title": dict(point.title),
        "note": dict(point.note),
        "source": source_of(point.source),
        "errata": list(point.errata),
        "was": list(point.was),
        "reserved": point.reserved,
        "generated": point.generated,
        "reason": point.reason,
    }


def source_of(source: Source) -> dict[str, object]:
    """The place in the manual that a fact is taken from."""
    return {"document": source.document, "section": source.section, "page": source.page, "line": source.line}


def _default(point: Point) -> int | str | None:
    """The default as raw number, for f32 and f64 as value; null where the raw number depends on other points."""
    if point.info.floating:
        return None if point.default is None else number_text(point.default)
    return point.default_raw


def _condition(condition: Condition) -> dict[str, object]:
    """A condition: any of its clauses, all comparisons of a clause. Points are compared by raw number, axes by name."""
    return {"any": [{"all": [_comparison(comparison) for comparison in clause]} for clause in condition.clauses]}


def _comparison(comparison: Comparison) -> dict[str, object]:
    return {
        "of": comparison.of,
        "is": comparison.test,
        "than": list(comparison.than) if comparison.test == "in" else comparison.than[0],
    }


def _places(point: Point, tasks: Sequence[tuple[str, int]]) -> list[dict[str, object]]:
    """Where it is read, and where it is written if that is elsewhere, or by which functions it is read and written."""
    purposes = ("write",) if point.access == "w" else ("read", "write")
    usual = [(purpose, place, None) for purpose, place in zip(purposes, point.places, strict=False)]
    return [
        {"for": purpose, "space": point.space, "address": min(place.addresses), "function": function}
        for purpose, place, function in [(purpose, point.place, task) for purpose, task in tasks] or usual
    ]


def _written(place: Place) -> dict[str, object]:
    return {"addresses": list(place.addresses), "references": dict(place.references)}


def _special(special: Special) -> dict[str, object]:
    return {
        "raw": [special.low, special.high],
        "name": special.name,
        "title": dict(special.title),
        "no_value": special.no_value,
        "writable": special.writable,
    }


def _raw(point: Point) -> dict[str, object]:
    allowed = point.allowed
    if point.info.floating:
        return {"ranges": [[number_text(low), number_text(high)] for low, high in allowed.units], "values": None}
    ranges = [
        [bound_of(interval.low, True, point), bound_of(interval.high, False, point)] for interval in allowed.intervals
    ]
    return {"ranges": ranges, "values": _values(allowed) if allowed.listed else None}


def _values(allowed: Allowed) -> list[int] | None:
    """The numbers that the author listed one by one."""
    spans = [(interval.low, interval.high) for interval in allowed.intervals]
    fixed = [(low, high) for low, high in spans if isinstance(low, int) and isinstance(high, int)]
    if len(fixed) < len(spans) or sum(high - low + 1 for low, high in fixed) > _MOST_VALUES:
        return None
    return [number for low, high in fixed for number in range(low, high + 1)]


def _is_open(enum: Enum | None) -> bool:
    return enum is not None and not enum.closed


def _repeat(point: Point) -> str | None:
    """The name of the row that this point was expanded from: its own name without set and index."""
    name = point.name
    for word, number in (("index", point.index), ("set", point.set)):
        name = name.removesuffix(f"_{word}_{number}")
    return None if name == point.name else name


def _names(enum: Enum) -> dict[str, object]:
    return {str(entry.raw): _entry(entry) for entry in enum.entries}


def _entry(entry: Entry) -> dict[str, object]:
    return {"name": entry.name, "title": dict(entry.title), "quantity": entry.quantity}


def _flag(flag: Flag) -> dict[str, object]:
    """One flag. For a single bit without named numbers, the number that makes it true is exported."""
    values = {
        str(flag_value.raw): {"name": flag_value.name, "title": dict(flag_value.title)} for flag_value in flag.values
    }
    if not values and flag.width == 1:
        values = {str(flag.active): {"name": flag.name, "title": dict(flag.title)}}
    return {
        "bits": [flag.low + flag.width - 1, flag.low],
        "name": flag.name,
        "title": dict(flag.title),
        "active": flag.active,
        "values": values,
    }
