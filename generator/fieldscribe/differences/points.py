"""The facts of a point with their classes."""

from __future__ import annotations

from operator import itemgetter
from typing import TYPE_CHECKING, Any

from fieldscribe.differences.classes import API, BEHAVIOUR, COMPATIBLE, DOCS, WIRE
from fieldscribe.differences.table import Exported, Fact, Parts, said
from fieldscribe.model import TYPES, Variant, item_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.differences.table import Table


def items(device: Exported) -> Iterator[Exported]:
    """The points by their names in generated code, which tell those of several variants apart."""
    for point in device["points"]:
        yield point if point["variant"] is None else _varied(point)


def _varied(point: Exported) -> Exported:
    """A point of a variant with its names in generated code, the old ones too."""
    axis, _, value = point["variant"].partition("=")
    name, *old_names = (item_of(name, Variant(axis, value)) for name in (point["name"], *point["was"]))
    return {**point, "name": name, "was": old_names}


def grown(old: Any, new: Any) -> str:
    """The class of a list: more of it is compatible."""
    return API if set(old) - set(new) else COMPATIBLE


def _access(old: str, new: str) -> str:
    """Code reads and writes as before where there is only more that it may do."""
    kept = old == "none" or set(old) <= set(new)
    return COMPATIBLE if kept else API


def _settled(old: Any, _: Any) -> str:
    """The class of a fact that nobody can have relied on while it was open."""
    return COMPATIBLE if old is None else WIRE


def _type(old: str | None, _: str | None) -> str:
    """A point that gets its type is no longer among those that are reached raw alone."""
    return API if old is None else WIRE


def _generated(old: bool, _: bool) -> str:
    return API if old else COMPATIBLE


_OF_RAW = frozenset(
    {"group", "space", "telegram", "address", "order of words", "write address", "index", "variant", "type", "length"}
    | {"access", "generated", "reserved", "old names"}
)
"""Facts that code knows also of a point that is documented only."""


def in_code(old: Exported, new: Exported, fact: str, weight: str) -> str:
    """The class of a fact: what is documented only on the old side is no fact of code that exists."""
    if old["generated"] or fact in _OF_RAW or weight == DOCS:
        return weight
    return COMPATIBLE if new["generated"] else DOCS


def _address(point: Exported) -> object:
    """The lowest address; all of them where they are no neighbours."""
    addresses = sorted(point["addresses"])
    if addresses and addresses[-1] - addresses[0] < len(addresses):
        return addresses[0]
    return addresses or None


def _word_order(point: Exported) -> object:
    """The order of several words; None where it is the usual one."""
    addresses = point["addresses"]
    if addresses == sorted(addresses):
        return None
    return "low first" if addresses[::-1] == sorted(addresses) else [word - min(addresses) for word in addresses]


def _base(place: Exported) -> object:
    """How far the numbers that the manual prints lie above the address, by numbering."""
    first = min(place["addresses"], default=0)
    return {
        numbering: number - first if isinstance(number, int) else number
        for numbering, number in place["references"].items()
    }


def _written(point: Exported) -> object:
    return point["written"] and {**point["written"], "references": _base(point["written"])}


def _length(point: Exported) -> object:
    """How many words a text has, or what has no type; of others the type says it."""
    return point["words"] if point["type"] in (None, "text") else None


def _range(point: Exported) -> object:
    """The intervals that may be written; None for all that the bits hold."""
    ranges, wire_type = point["raw"]["ranges"], point["type"]
    if wire_type is None:
        return None if ranges == [[0, (1 << 16 * point["words"]) - 1]] else ranges
    info, bits = TYPES[wire_type], point["bits"]
    width = info.bits if bits is None else abs(bits[0] - bits[1]) + 1
    least, greatest = (-(1 << (width - 1)), (1 << (width - 1)) - 1) if info.signed else (0, (1 << width) - 1)
    return None if ranges == [[least, greatest]] else ranges


def entries(point: Exported) -> Iterator[Exported]:
    """The named numbers of a point, or of each of its digits."""
    named = point["enum"] if point["digits"] is None else point["digits"]["enum"]
    return ({**entry, "raw": int(raw)} for raw, entry in (named or {}).items())


def _values(flag: Exported) -> Iterator[Exported]:
    """The named numbers of a flag; not the one that only repeats the name of the flag."""
    for raw, value in flag["values"].items():
        if len(flag["values"]) > 1 or value["name"] != flag["name"]:
            yield {**value, "raw": int(raw)}


TITLE, NOTE, SOURCE = said("title", DOCS), said("note", DOCS), said("source", DOCS)

_NUMBER: Table = {"raw": said("raw", WIRE), "title": TITLE}
_ENTRY: Table = {**_NUMBER, "quantity": said("quantity", BEHAVIOUR)}
_FLAG: Table = {
    "bits": said("bits", WIRE),
    "active": said("active", WIRE),
    "title": TITLE,
    "value": Parts("value", _values, _NUMBER, ("values",), ("raw",), added=BEHAVIOUR),
}
_CODE: Table = {
    "raw": said("raw", BEHAVIOUR),
    "no value": said("no_value", BEHAVIOUR),
    "writable": said("writable", BEHAVIOUR),
    "title": TITLE,
}

POINT: Table = {
    "code": said("code", WIRE),
    "group": said("group", API, refers="group"),
    "space": said("space", WIRE),
    "telegram": said("telegram", WIRE, refers="telegram"),
    "address": Fact(_settled, _address, ("address", "addresses")),
    "order of words": Fact(WIRE, _word_order, ("addresses",)),
    "base": Fact(WIRE, _base, ("references",)),
    "write address": Fact(WIRE, _written, ("written",)),
    "index": said("index", WIRE),
    "variant": said("variant", API),
    "set": said("set", API),
    "record": said("record", DOCS),
    "bits": said("bits", WIRE),
    "type": said("type", _type),
    "untyped": said("untyped", DOCS, "type"),
    "length": Fact(WIRE, _length, ("words",), ("type",)),
    "encoding": said("encoding", WIRE, "type"),
    "access": said("access", _access),
    "unit": said("unit", WIRE),
    "name of the unit": said("unit_name", DOCS, "unit"),
    "quantity": said("quantity", DOCS, "unit"),
    "scale": said("scale", WIRE, refers="point"),
    "decimals": said("decimals", API, "scale", "type"),
    "display": said("display", BEHAVIOUR),
    "range": Fact(BEHAVIOUR, _range, ("raw",), refers="point"),
    "listed": Fact(DOCS, lambda point: point["raw"]["values"], ("raw",), ("range", "type")),
    "step": said("step", BEHAVIOUR),
    "default": said("default", BEHAVIOUR),
    "special": Parts("code", itemgetter("special"), _CODE, ("special",), ("raw",), added=BEHAVIOUR),
    "codes of": said("special_of", API, "special"),
    "fixed": said("fixed", WIRE),
    "digits": Fact(WIRE, lambda point: point["digits"] and point["digits"]["count"], ("digits",)),
    "enum": Parts("entry", entries, _ENTRY, ("enum", "digits"), ("raw",), added=BEHAVIOUR, whole=API),
    "name of the enum": said("enum_name", API, "enum as a whole"),
    "open": said("open", BEHAVIOUR, "enum as a whole"),
    "flag": Parts("flag", itemgetter("flags"), _FLAG, ("flags",), ("bits",), whole=API),
    "when": said("when", BEHAVIOUR, refers="point"),
    "since": said("since", BEHAVIOUR),
    "until": said("until", BEHAVIOUR),
    "changes": said("changes", BEHAVIOUR),
    "changes with": said("changes_with", BEHAVIOUR, refers="point"),
    "kept": said("persistence", BEHAVIOUR, "access", refers="command"),
    "conditions": said("conditions", BEHAVIOUR, "access"),
    "old names": Fact(grown, itemgetter("was"), ("was",)),
    "reserved": said("reserved", API),
    "generated": Fact(_generated, itemgetter("generated"), ("generated",), ("access", "type", "reserved", "address")),
    "reason": said("reason", DOCS, "generated", "access", "type", "reserved", "address"),
    "title": TITLE,
    "note": NOTE,
    "source": SOURCE,
}

POINT_FOLLOWS = {
    "enum_was": "follows from the old names",
    "name": "tells the point",
    "direction": "is a fact of the telegram",
    "places": "repeats the address; the functions follow from type and access",
    "repeat": "is a part of the name",
    "format": "is always empty",
    "together": "is always empty",
    "errata": "are told as errata",
}
"""Keys of the contract that say nothing of their own, and why."""

ALIKE = ("space", "telegram", "address", "order of words", "index", "bits", "type", "variant")
"""The facts by which a point is the same under another name."""
