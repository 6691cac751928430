"""The facts of a point."""

from __future__ import annotations

from operator import itemgetter
from typing import TYPE_CHECKING, Any

from fieldscribe.facts.scales import bound_of, scale_of
from fieldscribe.facts.schema import (
    ADDRESS,
    BOOLEAN,
    COUNT,
    DIRECTION,
    INTEGER,
    STRING,
    TITLES,
    by_number,
    list_of,
    map_of,
    null_or,
    one_of,
    record,
    ref,
)
from fieldscribe.facts.table import API, BEHAVIOUR, COMPATIBLE, DOCS, WIRE, Context, Exported, Fact, Parts, View
from fieldscribe.families import family
from fieldscribe.model import TYPES, Variant, item_of
from fieldscribe.wording.exact import number_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from fieldscribe.conditions import Comparison, Condition
    from fieldscribe.facts.table import Table
    from fieldscribe.model import Allowed, Entry, Enum, Flag, Place, Point, Source

_MOST_VALUES = 4096
"""Longer lists of single numbers are exported as ranges only."""


def source_of(source: Source) -> dict[str, object]:
    """Return the place in the manual that a fact is taken from."""
    return {"document": source.document, "section": source.section, "page": source.page, "line": source.line}


# What the exported values are made of.


def _source(thing: Any, _: Context) -> dict[str, object] | None:
    return source_of(thing.source)


def _default(point: Point, _: Context) -> int | str | None:
    """The default as raw number, for f32 and f64 as value; null where the raw number depends on other points."""
    if point.info.floating:
        return None if point.default is None else number_text(point.default)
    return point.default_raw


def _default_value(point: Point, _: Context) -> str | None:
    known = point.default is None or point.default_raw is not None or point.info.floating
    return None if known or point.default is None else number_text(point.default)


def _condition(condition: Condition) -> dict[str, object]:
    """A condition: any of its clauses, all comparisons of a clause. Points are compared by raw number, axes by name."""
    return {"any": [{"all": [_comparison(comparison) for comparison in clause]} for clause in condition.clauses]}


def _comparison(comparison: Comparison) -> dict[str, object]:
    than = list(comparison.than) if comparison.test == "in" else comparison.than[0]
    return {"of": comparison.of, "is": comparison.test, "than": than}


def _places(point: Point, context: Context) -> list[dict[str, object]]:
    """Where it is read, and where it is written if that is elsewhere, or by which functions it is read and written."""
    tasks_of = getattr(family(context.device.family).part("bus_facts"), "tasks", None)
    tasks: Sequence[tuple[str, int]] = tasks_of(context.device.bus, point) if tasks_of else ()
    purposes = ("write",) if point.access == "w" else ("read", "write")
    usual = [(purpose, place, None) for purpose, place in zip(purposes, point.places, strict=False)]
    return [
        {"for": purpose, "space": point.space, "address": min(place.addresses), "function": function}
        for purpose, place, function in [(purpose, point.place, task) for purpose, task in tasks] or usual
    ]


def _place(place: Place) -> dict[str, object]:
    return {"addresses": list(place.addresses), "references": dict(place.references)}


def _raw(point: Point, _: Context) -> dict[str, object]:
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


def _repeat(point: Point, _: Context) -> str | None:
    """The name of the row that this point was expanded from: its own name without set and index."""
    name = point.name
    for word, number in (("index", point.index), ("set", point.set)):
        name = name.removesuffix(f"_{word}_{number}")
    return None if name == point.name else name


def _enum_of(point: Point) -> Enum | None:
    """The names of its numbers, or of its digits."""
    return point.enum if point.digits is None else point.digits.enum


def _entries_of(enum: Enum) -> dict[str, Entry]:
    return {str(entry.raw): entry for entry in enum.entries}


def _flag_values(flag: Flag, _: Context) -> Mapping[str, Entry | Flag]:
    """Its numbers; for a single bit without named numbers, the number that makes it true."""
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


def _access(old: str, new: str) -> str:
    """The class of access: code reads and writes as before if it may do more."""
    kept = old == "none" or set(old) <= set(new)
    return COMPATIBLE if kept else API


def _settled(old: Any, _: Any) -> str:
    """The class of an address: nobody can have relied on one that was not known."""
    return COMPATIBLE if old is None else WIRE


def _type(old: str | None, _: str | None) -> str:
    """The class of the type: a point that gets one is no longer among those that are only reached raw."""
    return API if old is None else WIRE


def _generated(old: bool, _: bool) -> str:
    return API if old else COMPATIBLE


_KNOWN_WITHOUT_CODE = frozenset(
    {"group", "space", "telegram", "address", "order of words", "write address", "index", "variant", "type", "length"}
    | {"access", "generated", "reserved", "old names"}
)
"""Facts that code also knows of a point that is only documented."""


def _in_code(old: Exported, new: Exported, label: str, weight: str) -> str:
    """The class of a fact of a point; those of a point that was only documented break no code."""
    if old["generated"] or label in _KNOWN_WITHOUT_CODE or weight == DOCS:
        return weight
    return COMPATIBLE if new["generated"] else DOCS


def _address(point: Exported) -> object:
    """The lowest address; all of them where they are not neighbours."""
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
    """How far the printed numbers are above the address, by numbering."""
    first = min(place["addresses"], default=0)
    return {
        numbering: number - first if isinstance(number, int) else number
        for numbering, number in place["references"].items()
    }


def _written(point: Exported) -> object:
    return point["written"] and {**point["written"], "references": _base(point["written"])}


def _length(point: Exported) -> object:
    """How many words a text or a point without a type has; of others the type says it."""
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


def _entries(point: Exported) -> Iterator[Exported]:
    """The named numbers of a point, or of each of its digits."""
    named = point["enum"] if point["digits"] is None else point["digits"]["enum"]
    return ({**entry, "raw": int(raw)} for raw, entry in (named or {}).items())


def _values_of_flag(flag: Exported) -> Iterator[Exported]:
    """The named numbers of a flag, without one that only repeats the name of the flag."""
    for raw, value in flag["values"].items():
        if len(flag["values"]) > 1 or value["name"] != flag["name"]:
            yield {**value, "raw": int(raw)}


_RAW_NUMBER = View("raw", WIRE, itemgetter("raw"))

NAME = Fact("name", "Its name.", STRING)
TITLE = Fact("title", "What it means, for people.", TITLES, weight=DOCS, for_people=True)
NOTE = Fact("note", "A remark for people; empty without one.", TITLES, weight=DOCS, for_people=True)
SOURCE = Fact(
    "source",
    "Where the manual says so.",
    ref("source"),
    value=_source,
    weight=DOCS,
    for_people=True,
    yaml=("line", "lines", "page", "section"),
)
ERRATA = Fact("errata", "The errata that touch it.", list_of(STRING), derived="the errata name it")

FLAG_VALUE: Table = (NAME, TITLE)
ENTRY: Table = (
    *FLAG_VALUE,
    Fact("quantity", "The quantity that it stands for: `0.37 kW`.", null_or(STRING), weight=BEHAVIOUR),
)
FLAG: Table = (
    Fact(
        "bits",
        "Which bits.",
        ref("bits"),
        value=lambda flag, _: [flag.low + flag.width - 1, flag.low],
        weight=WIRE,
    ),
    *FLAG_VALUE,
    Fact("active", "The value of a single bit while its name is true.", one_of(0, 1), weight=WIRE),
    Fact(
        "values",
        "Names of its numbers, by number as decimal text. Of a bit without texts of its own, only the number that "
        "makes it true.",
        by_number(ref("flag_value")),
        table=FLAG_VALUE,
        value=_flag_values,
        views=(
            Parts("value", "value", _values_of_flag, FLAG_VALUE, (_RAW_NUMBER,), same_by=("raw",), added=BEHAVIOUR),
        ),
    ),
)
SPECIAL: Table = (
    Fact(
        "raw",
        "The first and the last raw number; of f32 and f64 the pattern.",
        list_of(INTEGER, 2, 2),
        value=lambda special, _: [special.low, special.high],
        weight=BEHAVIOUR,
    ),
    *FLAG_VALUE,
    Fact("no_value", "Whether it says that there is no value.", BOOLEAN, weight=BEHAVIOUR),
    Fact("writable", "Whether it may be written.", BOOLEAN, weight=BEHAVIOUR),
    Fact("hexadecimal", "Whether the manual prints it so.", BOOLEAN, published=False),
    Fact(
        "shared",
        "Whether the point gets it from a type, a group or a format.",
        BOOLEAN,
        value=lambda special, _: not special.own,
        published=False,
    ),
)
DIGITS: Table = (
    Fact("count", "How many there are.", {**COUNT, "maximum": 5}),
    Fact(
        "enum",
        "Names of the numbers that a digit may be, by number as decimal text.",
        by_number(ref("entry")),
        table=ENTRY,
        value=lambda digits, _: _entries_of(digits.enum),
    ),
)
_REFERENCES = (
    "What the manual prints for people, by numbering (`modicon`, ...).",
    map_of({"type": ["integer", "string"]}),
)

POINT: Table = (
    Fact("name", "English snake_case; unique but for variants.", STRING),
    Fact("code", "The manual's own short name.", null_or(STRING), weight=WIRE),
    Fact(
        "group",
        "The group in which the manual presents it.",
        STRING,
        shared="terms",
        weight=API,
        refers="group",
    ),
    Fact(
        "space", "The space in which its addresses count: `coil`, `holding`, ...", STRING, shared="terms", weight=WIRE
    ),
    Fact(
        "telegram",
        "The telegram that carries it.",
        null_or(STRING),
        shared="terms",
        weight=WIRE,
        refers="telegram",
    ),
    Fact(
        "direction",
        "The direction of that telegram.",
        null_or(DIRECTION),
        shared="terms",
        value=lambda point, context: context.directions.get(point.telegram),
        derived="it is a fact of the telegram",
    ),
    Fact(
        "address",
        "The lowest address on the wire, counted from zero; null when the manual prints none.",
        null_or(ADDRESS),
        derived="it is the lowest of the addresses",
    ),
    Fact(
        "index",
        "The element of an array: the index beside the address, or what the addressing rule counts.",
        null_or(INTEGER),
        weight=WIRE,
    ),
    Fact(
        "addresses",
        "All words, the one that holds the high part (or the first characters) first.",
        list_of(ADDRESS),
        views=(
            View("address", _settled, _address, yaml=("at",)),
            View("order of words", WIRE, _word_order, yaml=("words",)),
        ),
    ),
    Fact(
        "references",
        *_REFERENCES,
        attribute="place.references",
        views=(View("base", WIRE, _base, yaml=("numbering",)),),
    ),
    Fact(
        "places",
        "Where it is, by purpose; the first repeats `space` and `address`.",
        list_of(ref("place")),
        value=_places,
        derived="it repeats the address; the functions follow from type and access",
    ),
    Fact(
        "written",
        "Where it is written, if that is not where it is read.",
        null_or(record({"addresses": ("As the point's own.", list_of(ADDRESS)), "references": _REFERENCES})),
        value=lambda point, _: None if point.write_place is None else _place(point.write_place),
        views=(View("write address", WIRE, _written, yaml=("write_at",)),),
    ),
    Fact(
        "type",
        "The type on the wire; null where the manual does not settle it.",
        null_or(one_of(*TYPES)),
        shared="shape and terms",
        value=lambda point, _: point.type if point.untyped is None else None,
        weight=_type,
    ),
    Fact(
        "untyped",
        "What the manual says in place of a type: empty if it leaves the type open.",
        null_or(STRING),
        shared="terms",
        weight=DOCS,
        follows=("type",),
    ),
    Fact(
        "words",
        "How many words (or single bits) it takes.",
        COUNT,
        views=(View("length", WIRE, _length, follows=("type",), yaml=("length", "characters")),),
    ),
    Fact("access", "What the bus may do with it.", one_of("r", "w", "rw", "none"), shared="shape", weight=_access),
    Fact(
        "bits",
        "Its bits in a shared word; null when it has its words to itself.",
        null_or(ref("bits")),
        shared="terms",
        weight=WIRE,
    ),
    Fact(
        "variant",
        "The variant in which it is so: `axis=value`.",
        null_or(STRING),
        value=lambda point, _: None if point.variant is None else str(point.variant),
        weight=API,
    ),
    Fact(
        "when",
        "The condition under which it exists.",
        null_or(ref("condition")),
        shared="terms",
        value=lambda point, _: None if point.when is None else _condition(point.when),
        weight=BEHAVIOUR,
        refers="point",
    ),
    Fact("since", "The firmware that brought it.", null_or(STRING), shared="terms", weight=BEHAVIOUR),
    Fact("until", "The last firmware that has it.", null_or(STRING), shared="terms", weight=BEHAVIOUR),
    Fact("record", "The record it belongs to.", null_or(STRING), weight=DOCS),
    Fact("set", "The parameter set it belongs to.", null_or(INTEGER), weight=API),
    Fact(
        "repeat",
        "The name of the row of the manual that stands for this point and others: one for each set, index or both.",
        null_or(STRING),
        value=_repeat,
        derived="it is a part of the name",
    ),
    Fact(
        "format",
        "The named format it follows.",
        null_or(STRING),
        value=lambda _point, _: None,
        derived="it is always empty",
    ),
    Fact(
        "unit",
        "The symbol of the unit; empty for a plain number.",
        STRING,
        shared="terms",
        attribute="unit.symbol",
        weight=WIRE,
    ),
    Fact(
        "unit_name",
        "The name of the unit.",
        STRING,
        shared="terms",
        attribute="unit.name",
        views=(View("name of the unit", DOCS, itemgetter("unit_name"), follows=("unit",)),),
    ),
    Fact(
        "quantity",
        "What the unit measures.",
        STRING,
        shared="terms",
        attribute="unit.quantity",
        weight=DOCS,
        follows=("unit",),
    ),
    Fact(
        "display",
        "How a person should see the value; null where nothing says it.",
        null_or(
            record(
                {
                    "decimals": (
                        "With how many decimals, rounded to nearest, halves away from zero; zeros at the end stay.",
                        {**ADDRESS, "maximum": 12},
                    )
                }
            )
        ),
        shared="shape",
        value=lambda point, _: None if point.display is None else {"decimals": point.display},
        weight=BEHAVIOUR,
    ),
    Fact(
        "decimals",
        "k of the integer path, which counts 10^-k units; null where the point has none.",
        null_or(INTEGER),
        shared="shape",
        weight=API,
        follows=("scale", "type"),
    ),
    Fact(
        "default",
        "The default as raw number; for f32 and f64 the value as text; null when unknown or when other points decide.",
        {"anyOf": [INTEGER, ref("number_text"), {"type": "null"}]},
        value=_default,
        weight=BEHAVIOUR,
        yaml=("default", "default_in_units"),
    ),
    Fact(
        "default_value",
        "The default in the unit, where other points decide about its raw number.",
        null_or(ref("number_text")),
        value=_default_value,
        published=False,
    ),
    Fact(
        "step",
        "Which raw steps the device keeps, from which raw number on; null for every number.",
        null_or(list_of(record({"from": ("The first raw number.", INTEGER), "step": ("The step in raw.", INTEGER)}))),
        shared="terms",
        value=lambda point, _: [{"from": start, "step": step} for start, step in point.steps] or None,
        weight=BEHAVIOUR,
        yaml=("steps",),
    ),
    Fact(
        "special",
        "Special codes: raw numbers that are no quantity, and what they mean.",
        list_of(ref("special")),
        shared="shape",
        attribute="specials",
        table=SPECIAL,
        views=(
            Parts(
                "special",
                "code",
                itemgetter("special"),
                SPECIAL,
                same_by=("raw",),
                added=BEHAVIOUR,
                yaml=("special", "code"),
            ),
        ),
    ),
    Fact(
        "special_of",
        "The type, group or format whose special codes the point shares; empty if it shares none.",
        STRING,
        shared="shape",
        attribute="specials_of",
        views=(View("codes of", API, itemgetter("special_of"), follows=("special",), yaml=("special",)),),
    ),
    Fact(
        "fixed",
        "Bits of the word that are always written as a constant: those in `mask` get their value from `bits`; empty "
        "when there are none.",
        {**map_of(ADDRESS), "propertyNames": {"enum": ["mask", "bits"]}},
        shared="shape",
        value=lambda point, _: {} if point.fixed is None else {"mask": point.fixed.mask, "bits": point.fixed.bits},
        weight=WIRE,
    ),
    Fact(
        "changes",
        "How often it changes: `never`, `rarely`, `always`.",
        null_or(STRING),
        shared="terms",
        weight=BEHAVIOUR,
    ),
    Fact(
        "changes_with",
        "The points whose writing changes this one.",
        list_of(STRING),
        shared="terms",
        weight=BEHAVIOUR,
        refers="point",
        yaml=("changes_with",),
    ),
    Fact(
        "together",
        "What must be read or written in one telegram.",
        null_or(STRING),
        value=lambda _point, _: None,
        derived="it is always empty",
    ),
    Fact(
        "scale",
        "Cases of raw = value * num / den + offset; null where raw is the value.",
        null_or(list_of(ref("scale_case"), 1)),
        shared="shape",
        value=lambda point, context: scale_of(point, context.by_name),
        weight=WIRE,
        refers="point",
    ),
    Fact(
        "raw",
        "Which raw numbers may be written.",
        record(
            {
                "ranges": (
                    "Closed ranges, ascending; for f32 and f64 in the unit.",
                    list_of(list_of(ref("range_end"), 2, 2)),
                ),
                "values": (
                    "The same as single numbers where the manual lists them; else null.",
                    null_or(list_of(INTEGER)),
                ),
            }
        ),
        shared="limits",
        value=_raw,
        views=(
            View("range", BEHAVIOUR, _range, refers="point", yaml=("range", "range_in_units", "enum")),
            View("listed", DOCS, lambda point: point["raw"]["values"], follows=("range", "type"), yaml=("range",)),
        ),
    ),
    Fact(
        "enum",
        "Names of raw numbers, by number as decimal text.",
        null_or(by_number(ref("entry"))),
        shared="shape",
        table=ENTRY,
        value=lambda point, _: None if point.enum is None else _entries_of(point.enum),
        views=(
            Parts(
                "enum",
                "entry",
                _entries,
                ENTRY,
                (_RAW_NUMBER,),
                same_by=("raw",),
                added=BEHAVIOUR,
                whole=API,
                yaml=("enum",),
            ),
        ),
    ),
    Fact(
        "enum_name",
        "The name of the enum, also of that of `digits`: generated code calls its type so.",
        null_or(STRING),
        shared="shape",
        value=lambda point, _: None if (enum := _enum_of(point)) is None else enum.name,
        views=(View("name of the enum", API, itemgetter("enum_name"), follows=("enum as a whole",), yaml=("enum",)),),
    ),
    Fact(
        "enum_was",
        "The names that the enum had when its point had its old ones: generated code keeps them, too.",
        list_of(STRING),
        shared="shape",
        value=lambda point, _: [] if (enum := _enum_of(point)) is None else list(enum.was),
        derived="it follows from the old names",
    ),
    Fact(
        "open",
        "True when numbers without a name are possible beside those of `enum`.",
        BOOLEAN,
        shared="shape",
        value=lambda point, _: point.enum is not None and not point.enum.closed,
        weight=BEHAVIOUR,
        follows=("enum as a whole",),
    ),
    Fact(
        "flags",
        "Named bits of the word.",
        list_of(ref("flag")),
        shared="shape",
        table=FLAG,
        views=(Parts("flag", "flag", itemgetter("flags"), FLAG, same_by=("bits",), whole=API, yaml=("flags",)),),
    ),
    Fact(
        "digits",
        "The decimal digits of a word that mean something each, the highest first.",
        null_or(ref("digits")),
        shared="shape",
        table=DIGITS,
        views=(View("digits", WIRE, lambda point: point["digits"] and point["digits"]["count"]),),
    ),
    Fact(
        "encoding",
        "The encoding of a text; two characters stand in a word.",
        null_or(STRING),
        shared="shape",
        value=lambda point, _: None if point.text is None else point.text.encoding,
        weight=WIRE,
        follows=("type",),
    ),
    Fact(
        "persistence",
        "Whether a written value is kept: `no`, `yes`, the command that keeps it, or `choice` (as the function that "
        "writes it says).",
        null_or(STRING),
        shared="terms",
        attribute="keeps",
        views=(
            View(
                "kept",
                BEHAVIOUR,
                itemgetter("persistence"),
                follows=("access",),
                refers="command",
                yaml=("keep_with", "keeps"),
            ),
        ),
    ),
    Fact(
        "conditions",
        "When it may be written: `stopped`.",
        list_of(STRING),
        shared="terms",
        weight=BEHAVIOUR,
        follows=("access",),
    ),
    TITLE,
    NOTE,
    SOURCE,
    ERRATA,
    Fact(
        "was",
        "Former names, which stay alive as deprecated aliases.",
        list_of(STRING),
        views=(View("old names", grown, itemgetter("was"), yaml=("was",)),),
    ),
    Fact("reserved", "Whether the maker reserves it.", BOOLEAN, shared="terms", weight=API),
    Fact(
        "generated",
        "False for what is only documented.",
        BOOLEAN,
        shared="terms",
        weight=_generated,
        follows=("access", "type", "reserved", "address"),
    ),
    Fact(
        "reason",
        "Why it is only documented.",
        null_or(STRING),
        shared="terms",
        weight=DOCS,
        follows=("generated", "access", "type", "reserved", "address"),
    ),
)

POINTS = Parts(
    "point",
    "point",
    items,
    POINT,
    same_by=("space", "telegram", "address", "order of words", "index", "bits", "type", "variant"),
    in_code=_in_code,
)
