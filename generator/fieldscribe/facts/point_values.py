"""The values of the facts of a point: as they are exported, and as `diff` compares them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fieldscribe.facts.scales import bound_of
from fieldscribe.facts.table import API, COMPATIBLE, DOCS, WIRE
from fieldscribe.families import family
from fieldscribe.model import TYPES, Variant, item_of
from fieldscribe.wording.exact import number_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from fieldscribe.conditions import Comparison, Condition
    from fieldscribe.facts.table import Context, Exported
    from fieldscribe.model import Allowed, Entry, Enum, Flag, Place, Point, Source

_MOST_VALUES = 4096
"""Longer lists of single numbers are exported as ranges only."""


# What the exported values are made of.


def source_value(thing: Any, _: Context) -> dict[str, object] | None:
    """Return the place in the manual of a thing."""
    source: Source = thing.source
    return {"document": source.document, "section": source.section, "page": source.page, "line": source.line}


def default_raw(point: Point, _: Context) -> int | str | None:
    """Return the default as raw number, for f32 and f64 as value; null where the raw number depends on other points."""
    if point.info.floating:
        return None if point.default is None else number_text(point.default)
    return point.default_raw


def default_value(point: Point, _: Context) -> str | None:
    """Return the default in the unit where other points decide about its raw number."""
    known = point.default is None or point.default_raw is not None or point.info.floating
    return None if known or point.default is None else number_text(point.default)


def condition(condition: Condition) -> dict[str, object]:
    """Return a condition: any of its clauses, all comparisons of a clause."""
    return {"any": [{"all": [_comparison(comparison) for comparison in clause]} for clause in condition.clauses]}


def _comparison(comparison: Comparison) -> dict[str, object]:
    than = list(comparison.than) if comparison.test == "in" else comparison.than[0]
    return {"of": comparison.of, "is": comparison.test, "than": than}


def places(point: Point, context: Context) -> list[dict[str, object]]:
    """Return where and by which functions it is read and written; its place once if that is all."""
    tasks_of = getattr(family(context.device.family).part("bus_facts"), "tasks", None)
    tasks: Sequence[tuple[str, int]] = tasks_of(context.device.bus, point) if tasks_of else ()
    purposes = ("write",) if point.access == "w" else ("read", "write")
    usual = [(purpose, place, None) for purpose, place in zip(purposes, point.places, strict=False)]
    return [
        {"for": purpose, "space": point.space, "address": min(place.addresses), "function": function}
        for purpose, place, function in [(purpose, point.place, task) for purpose, task in tasks] or usual
    ]


def place(place: Place) -> dict[str, object]:
    """Return the addresses of a place and what the manual prints for it."""
    return {"addresses": list(place.addresses), "references": dict(place.references)}


def raw(point: Point, _: Context) -> dict[str, object]:
    """Return which raw numbers may be written; of f32 and f64 which values."""
    allowed = point.allowed
    if point.info.floating:
        return {"ranges": [[number_text(low), number_text(high)] for low, high in allowed.units], "values": None}
    ranges = [
        [bound_of(interval.low, True, point), bound_of(interval.high, False, point)] for interval in allowed.intervals
    ]
    return {"ranges": ranges, "values": listed_values(allowed) if allowed.listed else None}


def listed_values(allowed: Allowed) -> list[int] | None:
    """Return the numbers that the author listed one by one."""
    spans = [(interval.low, interval.high) for interval in allowed.intervals]
    fixed = [(low, high) for low, high in spans if isinstance(low, int) and isinstance(high, int)]
    if len(fixed) < len(spans) or sum(high - low + 1 for low, high in fixed) > _MOST_VALUES:
        return None
    return [number for low, high in fixed for number in range(low, high + 1)]


def repeat(point: Point, _: Context) -> str | None:
    """Return the name of the row that this point was expanded from: its own name without set and index."""
    name = point.name
    for word, number in (("index", point.index), ("set", point.set)):
        name = name.removesuffix(f"_{word}_{number}")
    return None if name == point.name else name


def enum_of(point: Point) -> Enum | None:
    """Return the names of its numbers, or of its digits."""
    return point.enum if point.digits is None else point.digits.enum


def entries_of(enum: Enum) -> dict[str, Entry]:
    """Return the named numbers of an enum by number."""
    return {str(entry.raw): entry for entry in enum.entries}


def flag_values(flag: Flag, _: Context) -> Mapping[str, Entry | Flag]:
    """Return its numbers; for a single bit without named numbers, the number that makes it true."""
    if not flag.values and flag.width == 1:
        return {str(flag.active): flag}
    return {str(entry.raw): entry for entry in flag.values}


# What `diff` compares where that is not the exported value, and how grave a difference is.


def items(device: Exported) -> Iterator[Exported]:
    """Yield the points by their names in generated code, which tell those of several variants apart."""
    for point in device["points"]:
        yield point if point["variant"] is None else _with_names_of_variant(point)


def _with_names_of_variant(point: Exported) -> Exported:
    axis, _, value = point["variant"].partition("=")
    name, *old_names = (item_of(name, Variant(axis, value)) for name in (point["name"], *point["was"]))
    return {**point, "name": name, "was": old_names}


def grown(old: Any, new: Any) -> str:
    """Return the class of a list: more items are compatible."""
    return API if set(old) - set(new) else COMPATIBLE


def access_class(old: str, new: str) -> str:
    """Return the class of access: code reads and writes as before if it may do more."""
    kept = old == "none" or set(old) <= set(new)
    return COMPATIBLE if kept else API


def address_class(old: Any, _: Any) -> str:
    """Return the class of an address: nobody can have relied on one that was not known."""
    return COMPATIBLE if old is None else WIRE


def type_class(old: str | None, _: str | None) -> str:
    """Return the class of the type: a point that gets one is no longer among those that are only reached raw."""
    return API if old is None else WIRE


def generated_class(old: bool, _: bool) -> str:
    """Return the class of being generated: code that goes breaks."""
    return API if old else COMPATIBLE


_KNOWN_WITHOUT_CODE = frozenset(
    {"group", "space", "telegram", "address", "order of words", "write address", "index", "variant", "type", "length"}
    | {"access", "generated", "reserved", "old names"}
)
"""Facts that code also knows of a point that is only documented."""


def class_in_code(old: Exported, new: Exported, label: str, weight: str) -> str:
    """Return the class of a fact of a point; those of a point that was only documented break no code."""
    if old["generated"] or label in _KNOWN_WITHOUT_CODE or weight == DOCS:
        return weight
    return COMPATIBLE if new["generated"] else DOCS


def address_view(point: Exported) -> object:
    """Return the lowest address; all of them where they are not neighbours."""
    addresses = sorted(point["addresses"])
    if addresses and addresses[-1] - addresses[0] < len(addresses):
        return addresses[0]
    return addresses or None


def word_order_view(point: Exported) -> object:
    """Return the order of several words; None where it is the usual one."""
    addresses = point["addresses"]
    if addresses == sorted(addresses):
        return None
    return "low first" if addresses[::-1] == sorted(addresses) else [word - min(addresses) for word in addresses]


def base_view(place: Exported) -> object:
    """Return how far the printed numbers are above the address, by numbering."""
    first = min(place["addresses"], default=0)
    return {
        numbering: number - first if isinstance(number, int) else number
        for numbering, number in place["references"].items()
    }


def written_view(point: Exported) -> object:
    """Return where else the point is written, its numbers as distances from the address."""
    return point["written"] and {**point["written"], "references": base_view(point["written"])}


def length_view(point: Exported) -> object:
    """Return how many words a text or a point without a type has; of others the type says it."""
    return point["words"] if point["type"] in (None, "text") else None


def range_view(point: Exported) -> object:
    """Return the intervals that may be written; None for all that the bits hold."""
    ranges, wire_type = point["raw"]["ranges"], point["type"]
    if wire_type is None:
        return None if ranges == [[0, (1 << 16 * point["words"]) - 1]] else ranges
    info, bits = TYPES[wire_type], point["bits"]
    width = info.bits if bits is None else abs(bits[0] - bits[1]) + 1
    least, greatest = (-(1 << (width - 1)), (1 << (width - 1)) - 1) if info.signed else (0, (1 << width) - 1)
    return None if ranges == [[least, greatest]] else ranges


def entry_parts(point: Exported) -> Iterator[Exported]:
    """Yield the named numbers of a point, or of each of its digits."""
    named = point["enum"] if point["digits"] is None else point["digits"]["enum"]
    return ({**entry, "raw": int(raw)} for raw, entry in (named or {}).items())


def flag_value_parts(flag: Exported) -> Iterator[Exported]:
    """Yield the named numbers of a flag, without one that only repeats the name of the flag."""
    for raw, value in flag["values"].items():
        if len(flag["values"]) > 1 or value["name"] != flag["name"]:
            yield {**value, "raw": int(raw)}
