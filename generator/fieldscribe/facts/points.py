"""The facts of a point, in the order in which people read them."""

from functools import partial
from operator import itemgetter

from fieldscribe import wording
from fieldscribe.facts import point_values as values
from fieldscribe.facts import texts
from fieldscribe.facts.schema import (
    ADDRESS,
    BOOLEAN,
    COUNT,
    DIRECTION,
    INTEGER,
    INTEGER_OR_NULL,
    STRING,
    TEXT_OR_NULL,
    TEXTS,
    TITLES,
    by_number,
    list_of,
    map_of,
    null_or,
    one_of,
    record,
    ref,
)
from fieldscribe.facts.table import API, BEHAVIOUR, DOCS, WIRE, Fact, FactTable, Parts, View
from fieldscribe.model import TYPE_PATTERN

_CERTAINTIES = {"imported": "imported, not compared with a manual", "hardware": "seen on hardware"}

_RAW_NUMBER = View("raw", WIRE, itemgetter("raw"))

_by_raw = partial(Parts, same_by=("raw",), added=BEHAVIOUR)
"""Meanings of raw numbers: equal numbers are the same part, and a new one changes behaviour."""


def _always_null(key: str, doc: str) -> Fact:
    """Return a key of the exported model that no description fills."""
    return Fact(key, doc, TEXT_OR_NULL, value=lambda _point, _: None, derived="it is always empty")


NAME = Fact("name", "Its name.", STRING)

TITLE = Fact("title", "What it means, for people.", TITLES, DOCS, for_people=True)

NOTE = Fact("note", "A remark for people; empty without one.", TITLES, DOCS, for_people=True)

SOURCE = Fact(
    "source",
    "Where the manual says so.",
    ref("source"),
    DOCS,
    for_people=True,
    yaml=("line", "lines", "page", "section"),
).of(values.source_value)

ERRATA = Fact("errata", "The errata that touch it.", TEXTS, derived="the errata name it")

FLAG_VALUE: FactTable = (NAME, TITLE)

ENTRY: FactTable = (
    *FLAG_VALUE,
    Fact("quantity", "The quantity that it means: `0.37 kW`.", TEXT_OR_NULL, BEHAVIOUR),
)

FLAG: FactTable = (
    Fact("bits", "Which bits.", ref("bits"), WIRE, value=lambda flag, _: [flag.low + flag.width - 1, flag.low]),
    *FLAG_VALUE,
    Fact("active", "The value of a single bit while its name is true.", one_of(0, 1), WIRE),
    Fact(
        "values",
        "Names of its numbers, by number as decimal text. Of a bit without texts of its own, only the number that "
        "makes it true.",
        by_number(ref("flag_value")),
        table=FLAG_VALUE,
    )
    .differs(_by_raw("value", "value", values.flag_value_parts, FLAG_VALUE, (_RAW_NUMBER,)))
    .of(values.flag_values),
    Fact("enum", "The shared enum that has these names.", TEXT_OR_NULL, API, value=lambda flag, _: flag.enum or None),
)

SPECIAL: FactTable = (
    Fact("raw", "The first and the last raw number (f32, f64: bit pattern).", list_of(INTEGER, 2, 2), BEHAVIOUR).of(
        lambda special, _: [special.low, special.high]
    ),
    *FLAG_VALUE,
    Fact("no_value", "Whether it means that there is no value.", BOOLEAN, BEHAVIOUR),
    Fact("writable", "Whether it may be written.", BOOLEAN, BEHAVIOUR),
    Fact("hexadecimal", "Whether the manual prints it so.", BOOLEAN, published=False),
    Fact("shared", "Whether the point gets it from a type, a group or a format.", BOOLEAN, published=False),
)

DIGITS: FactTable = (
    Fact("count", "How many there are.", {**COUNT, "maximum": 5}),
    Fact(
        "enum",
        "Names of the numbers that a digit may be, by number as decimal text.",
        by_number(ref("entry")),
        table=ENTRY,
    ).of(lambda digits, _: values.entries_of(digits.enum)),
)

DATE_PART: FactTable = (
    Fact("name", "What it is: `year`, ..., `millisecond`, `weekday`.", STRING),
    Fact("word", "Which word of the point has it, the first of which is 0.", COUNT),
    Fact("high", "Its highest bit there.", COUNT).of(lambda part, _: part.bits[0]),
    Fact("low", "Its lowest bit there.", COUNT).of(lambda part, _: part.bits[1]),
    Fact("zero", "The year that a 0 means; of a weekday the number of Sunday.", COUNT).of(lambda part, _: part.base),
)
LAYOUT: FactTable = (
    Fact("characters", "How many there are.", COUNT),
    Fact("per_word", "How many a word holds; a single one is in its low byte.", COUNT),
    Fact("padding", "The byte that pads the text; a 0 ends it.", COUNT),
    Fact("low_first", "True if the bytes of each word are swapped.", BOOLEAN),
    Fact(
        "parts",
        "The parts of a date and time; null of what is none.",
        null_or(list_of(ref("date_part"))),
        table=DATE_PART,
    ).of(lambda layout, _: layout.parts or None),
)

_REFERENCES = (
    "What the manual prints for people, by numbering (`modicon`, ...).",
    map_of({"type": ["integer", "string"]}),
)

POINT: FactTable = (
    Fact("name", "English snake_case; unique except for variants.", STRING),
    Fact("code", "The manual's own short name.", TEXT_OR_NULL, WIRE).says(column="the code that the manual prints"),
    Fact("group", "The group in which the manual presents it.", STRING, API, refers="group").says(
        "Group", text=texts.group_text, column="the group in the description"
    ),
    Fact("variant", "The variant that has these facts: `axis=value`.", TEXT_OR_NULL, API, attribute="variant")
    .of(lambda point, _: None if point.variant is None else str(point.variant))
    .says("Variant", remark="only {}", column="for which devices the row holds, where they differ"),
    Fact("record", "The record it belongs to.", TEXT_OR_NULL, DOCS, for_people=True).says(
        "Record", remark="record {}", column="the record that it belongs to"
    ),
    Fact("set", "The parameter set it belongs to.", INTEGER_OR_NULL, API).says(
        "Set", remark="set {}", column="the number of its parameter set"
    ),
    Fact(
        "repeat",
        "The name of the row of the manual that describes this point and others: one for each set, index or both.",
        TEXT_OR_NULL,
        derived="it is a part of the name",
    ).of(values.repeat),
    _always_null("format", "The named format it follows."),
    Fact("space", "The space in which its addresses count: `coil`, `holding`, ...", STRING, WIRE).says(
        column="where the address counts: `coil`, `holding`, `parameter`, `telegram`, ..."
    ),
    Fact("telegram", "The telegram that carries it.", TEXT_OR_NULL, WIRE, refers="telegram").says(
        remark="telegram {}", column="in which telegram a word is"
    ),
    Fact("direction", "The direction of that telegram.", null_or(DIRECTION), derived="it is a fact of the telegram").of(
        lambda point, context: context.directions.get(point.telegram), shared="terms"
    ),
    Fact(
        "address",
        "The lowest address on the wire, counted from zero; null when the manual prints none.",
        null_or(ADDRESS),
        derived="it is the lowest of the addresses",
    ).says("Wire address", text=texts.address_text),
    Fact(
        "index",
        "The element of an array: the index beside the address, or the one in the addressing rule.",
        INTEGER_OR_NULL,
        WIRE,
    ).says("Index", text=texts.index_text, column="the index of an element"),
    Fact("addresses", "All words, the one that holds the high part (or the first characters) first.", list_of(ADDRESS))
    .differs(
        View("address", values.address_class, values.address_view, yaml=("at",)),
        View("order of words", WIRE, values.word_order_view, yaml=("words",)),
    )
    .says("Addresses", text=texts.words_text),
    Fact(
        "byte_order",
        "The order of the two bytes in each word, if it is not the usual one: `low first`.",
        null_or(one_of("low first")),
        WIRE,
        yaml=("bytes",),
    )
    .of(lambda point, _: "low first" if point.swapped else None, shared="shape")
    .says("Order of bytes", text=lambda point, _: "low byte first" if point.swapped else "", remark="{}"),
    Fact(
        "coding",
        "How the bits hold the raw number, if not plainly or in two's complement.",
        null_or(one_of("bcd", "sign and magnitude")),
        WIRE,
    )
    .of(lambda point, _: values.coding_of(point) or None, shared="shape")
    .says(
        "Coding",
        text=lambda point, _: "decimal digits of 4 bits (BCD)" if values.coding_of(point) == "bcd" else point.coding,
        remark="{}",
    ),
    Fact("base", "The base of its addresses, by name; null: they count from 0.", TEXT_OR_NULL)
    .differs(View("counted from", WIRE, itemgetter("base"), refers="base", yaml=("base", "block")))
    .says("Counted from", text=texts.base_text, column="the base of the address, if it does not count from 0"),
    Fact(
        "to_end", "Whether it exists only where the found block is long enough.", BOOLEAN, BEHAVIOUR, yaml=("indices",)
    ).says(
        "Exists when", text=lambda point, _: "the block is long enough" if point.to_end else "", remark="exists when {}"
    ),
    Fact(
        "signal",
        "Of a signal of a message: its first bit, as CAN databases count them, and whether the low byte comes first; "
        "its addresses are words of the telegram of the message.",
        null_or(record(("bit", "The bit.", ADDRESS), ("low_first", "Whether the low byte comes first.", BOOLEAN))),
    )
    .differs(View("order of bytes", WIRE, values.byte_order_view, yaml=("bytes",)))
    .of(values.signal)
    .says("Bits", text=texts.signal_text, column="the bits of a signal in its message"),
    Fact("references", *_REFERENCES, attribute="place.references")
    .differs(View("base", WIRE, values.base_view, yaml=("numbering",)))
    .says(rows=texts.reference_rows),
    Fact(
        "places",
        "Where it is, by purpose; the first repeats `space` and `address`.",
        list_of(ref("place")),
        derived="it repeats the address; the functions follow from type and access",
    ).of(values.places),
    Fact(
        "written",
        "Where it is written, if that is not where it is read.",
        null_or(record(("addresses", "As the point's own.", list_of(ADDRESS)), ("references", *_REFERENCES))),
        attribute="write_place",
    )
    .differs(View("write address", WIRE, values.written_view, yaml=("write_at",)))
    .of(lambda point, _: None if point.write_place is None else values.place(point.write_place))
    .says(
        "Written at",
        text=lambda point, _: wording.write_place_text(point) if point.addresses else "",
        remark="written at {}",
    ),
    Fact(
        "type",
        "The type on the wire; null where the manual does not settle it.",
        null_or({"type": "string", "pattern": TYPE_PATTERN}),
        values.type_class,
    )
    .of(lambda point, _: point.shape.wire_type if point.untyped is None else None, shared="shape and terms")
    .says("Type", text=texts.type_text, column="the wire type; empty where the manual does not settle it"),
    Fact(
        "untyped",
        "The text that the manual gives instead of a type: empty if it leaves the type open.",
        TEXT_OR_NULL,
        DOCS,
        follows=("type",),
    ),
    Fact("words", "How many words (or single bits) it takes.", COUNT).differs(
        View("length", WIRE, values.length_view, follows=("type",), yaml=("length", "characters"))
    ),
    Fact("access", "What a master may do with it.", one_of("r", "w", "rw", "none"), values.access_class).says(
        "Access",
        text=lambda point, _: wording.access_text(point.access),
        column="`r`, `w`, `rw`; `none` if no bus reaches it",
    ),
    Fact("unit", "The symbol of the unit; empty for a plain number.", STRING, WIRE, attribute="unit.symbol").says(
        "Unit", text=texts.unit_text, column="the unit of values"
    ),
    Fact("unit_name", "The name of the unit.", STRING, attribute="unit.name").differs(
        View("name of the unit", DOCS, itemgetter("unit_name"), follows=("unit",))
    ),
    Fact("quantity", "What the unit measures.", STRING, DOCS, attribute="unit.quantity", follows=("unit",)),
    Fact(
        "scale",
        "Cases of raw = value * num / den + offset; null where raw is the value.",
        null_or(list_of(ref("scale_case"), 1)),
        WIRE,
        refers="point",
    )
    .of(lambda point, context: values.scale_of(point, context.by_name if point.scale_arguments else {}), shared="shape")
    .says(rows=texts.scale_rows),
    Fact("bits", "Its bits in a shared word; null if it has whole words.", null_or(ref("bits")), WIRE).says(
        text=lambda point, _: wording.shared_text(point), remark="{}"
    ),
    Fact(
        "fixed",
        "Bits of the word that are always written as a constant: those in `mask` get their value from `bits`; empty "
        "when there are none.",
        {**map_of(ADDRESS), "propertyNames": {"enum": ["mask", "bits"]}},
        WIRE,
    )
    .of(
        lambda point, _: {} if point.fixed is None else {"mask": point.fixed.mask, "bits": point.fixed.bits},
        shared="shape",
    )
    .says("Fixed bits", text=lambda point, _: wording.fixed_text(point), remark="{}"),
    Fact(
        "special",
        "Special codes: raw numbers that are not quantities, and what they mean.",
        list_of(ref("special")),
        attribute="specials",
        table=SPECIAL,
    )
    .differs(_by_raw("special", "code", itemgetter("special"), SPECIAL, yaml=("special", "code")))
    .says(rows=texts.special_rows),
    Fact(
        "special_of",
        "The type, group or format whose special codes the point shares; empty if it shares none.",
        STRING,
        attribute="specials_of",
    )
    .differs(View("codes of", API, itemgetter("special_of"), follows=("special",), yaml=("special",)))
    .says(remark="special codes of {}"),
    Fact(
        "step",
        "Which raw steps the device keeps, from which raw number on; null for every number.",
        null_or(list_of(record(("from", "The first raw number.", INTEGER), ("step", "The step in raw.", INTEGER)))),
        BEHAVIOUR,
        yaml=("steps",),
    )
    .of(lambda point, _: [{"from": start, "step": step} for start, step in point.steps] or None, shared="terms")
    .says("Steps", text=lambda point, _: wording.steps_text(point), remark="steps: {}"),
    Fact(
        "display",
        "How people should see the value; null if the description does not say.",
        null_or(
            record(
                (
                    "decimals",
                    "The number of decimals, rounded to nearest, halves away from zero; trailing zeros stay.",
                    {**ADDRESS, "maximum": 12},
                )
            )
        ),
        BEHAVIOUR,
    )
    .of(lambda point, _: None if point.display is None else {"decimals": point.display}, shared="shape")
    .says("Shown with", text=lambda point, _: wording.decimals_text(point), remark="shown with {}"),
    Fact(
        "epoch",
        "The date from which the value counts seconds; null if it is not a time.",
        TEXT_OR_NULL,
        BEHAVIOUR,
        yaml=("notation",),
    )
    .of(lambda point, _: point.epoch or None, shared="shape")
    .says("Time", text=lambda point, _: wording.epoch_text(point), remark="{}"),
    Fact(
        "decimals",
        "k of the integer path, which counts 10^-k units; null where the point has none.",
        INTEGER_OR_NULL,
        API,
        follows=("scale", "type"),
    ).says(
        "Widths",
        text=lambda point, _: "; ".join((*wording.width_texts(point), *wording.overflow_texts(point))),
        remark="{}",
    ),
    Fact(
        "raw",
        "Which raw numbers may be written.",
        record(
            (
                "ranges",
                "Closed ranges, ascending; for f32, f64 and unknown scales in the unit.",
                list_of(list_of(ref("range_end"), 2, 2)),
            ),
            ("values", "The same as single numbers where the manual lists them; else null.", null_or(list_of(INTEGER))),
        ),
    )
    .differs(
        View("range", BEHAVIOUR, values.range_view, refers="point", yaml=("range", "range_in_units", "enum")),
        View("listed", DOCS, lambda point: point["raw"]["values"], follows=("range", "type"), yaml=("range",)),
    )
    .of(values.raw, shared="limits")
    .says(rows=texts.range_rows),
    Fact(
        "default",
        "The default as raw number; for f32 and f64 the value as text; null when unknown or when other points decide.",
        {"anyOf": [INTEGER, ref("number_text"), {"type": "null"}]},
        BEHAVIOUR,
        attribute="default_raw",
        yaml=("default", "default_in_units"),
    )
    .of(values.default_raw)
    .says("Default", text=lambda point, _: wording.default_text(point)),
    Fact(
        "default_value",
        "The default in the unit, where other points decide about its raw number.",
        null_or(ref("number_text")),
        attribute="default",
        published=False,
    ).of(values.default_value),
    Fact("enum", "Names of raw numbers, by number as decimal text.", null_or(by_number(ref("entry"))), table=ENTRY)
    .differs(_by_raw("enum", "entry", values.entry_parts, ENTRY, (_RAW_NUMBER,), whole=API, yaml=("enum",)))
    .of(lambda point, _: None if point.enum is None else values.entries_of(point.enum), shared="shape")
    .says(rows=texts.enum_rows),
    Fact("enum_name", "The name of the enum, or of that of `digits`: its type in generated code.", TEXT_OR_NULL)
    .differs(View("name of the enum", API, itemgetter("enum_name"), follows=("enum as a whole",), yaml=("enum",)))
    .of(lambda point, _: None if (enum := point.named_numbers) is None else enum.name, shared="shape"),
    Fact(
        "enum_was",
        "The names that the enum had when its point had its old ones: generated code keeps them, too.",
        TEXTS,
        derived="it follows from the old names",
    ).of(lambda point, _: [] if (enum := point.named_numbers) is None else list(enum.was), shared="shape"),
    Fact(
        "open",
        "True if numbers without a name are possible in addition to those of `enum`.",
        BOOLEAN,
        BEHAVIOUR,
        follows=("enum as a whole",),
    ).of(lambda point, _: point.enum is not None and not point.enum.closed, shared="shape"),
    Fact("flags", "Named bits of the word.", list_of(ref("flag")), table=FLAG)
    .differs(Parts("flag", "flag", itemgetter("flags"), FLAG, same_by=("bits",), whole=API, yaml=("flags",)))
    .says(rows=texts.flag_rows),
    Fact(
        "digits",
        "The decimal digits of a word that each have a meaning, the highest first.",
        null_or(ref("digits")),
        table=DIGITS,
    ).differs(View("digits", WIRE, lambda point: point["digits"] and point["digits"]["count"])),
    Fact(
        "encoding",
        "The encoding of a text, or the notation of bytes.",
        TEXT_OR_NULL,
        WIRE,
        follows=("type",),
        yaml=("encoding", "notation"),
    ).of(lambda point, _: None if point.text is None else point.text.encoding, shared="shape"),
    Fact(
        "layout",
        "How words hold the characters of a text; null if each word has two, the first in the high byte, and "
        "blanks pad the text.",
        null_or(ref("layout")),
        WIRE,
        table=LAYOUT,
        follows=("type",),
        yaml=("characters", "per_word", "padding", "bytes", "parts"),
    )
    .of(lambda point, _: None if point.text is None or point.text.is_plain else point.text, shared="shape")
    .says("Parts", text=lambda point, _: wording.parts_text(point.text) if point.text is not None else "", remark="{}"),
    Fact(
        "persistence",
        "Whether a written value is kept: `no`, `yes`, the command that keeps it, or `choice` (the function that "
        "writes it decides).",
        TEXT_OR_NULL,
        attribute="keeps",
    )
    .differs(
        View(
            "kept",
            BEHAVIOUR,
            itemgetter("persistence"),
            follows=("access",),
            refers="command",
            yaml=("keep_with", "keeps"),
        )
    )
    .says("Kept", text=lambda point, context: wording.keeps_text(context.device, point)),
    Fact("conditions", "When it may be written: `stopped`.", TEXTS, BEHAVIOUR, follows=("access",)).says(
        "Write only when", remark="write only when: {}", column="what must hold to write it"
    ),
    Fact(
        "takes_effect",
        "When the device uses a written value, if not at once.",
        TEXT_OR_NULL,
        BEHAVIOUR,
        follows=("access",),
    ).says("Takes effect", remark="takes effect {}"),
    Fact(
        "write_with",
        "The points that are written in the same request.",
        TEXTS,
        BEHAVIOUR,
        refers="point",
        follows=("access",),
    ).says("Write together with", remark="write it in one request with {}"),
    Fact("when", "The condition under which it exists.", null_or(ref("condition")), BEHAVIOUR, refers="point")
    .of(lambda point, _: None if point.when is None else values.condition(point.when), shared="terms")
    .says(
        "Exists when",
        text=lambda point, context: wording.condition_text(point.when, context.points),
        remark="exists when {}",
    ),
    Fact(
        "selects",
        "Points that must hold a raw number before the address means this one, each with its number.",
        list_of(record(("point", "The point.", STRING), ("raw", "What it holds.", INTEGER))),
        WIRE,
        refers="point",
        yaml=("select",),
    )
    .of(lambda point, _: [{"point": name, "raw": raw} for name, raw in point.selects])
    .says(
        "Selected by",
        text=lambda point, _: ", ".join(f"{name} = {raw}" for name, raw in point.selects),
        remark="write {} before",
    ),
    Fact("since", "The first firmware that has it.", TEXT_OR_NULL, BEHAVIOUR).says("Since", remark="since {}"),
    Fact("until", "The last firmware that has it.", TEXT_OR_NULL, BEHAVIOUR).says("Until", remark="until {}"),
    Fact("changes", "How often it changes: `never`, `rarely`, `always`.", TEXT_OR_NULL, BEHAVIOUR).says(
        "Changes", remark="changes {}", column="how often it changes"
    ),
    Fact(
        "changes_with",
        "The points whose writing changes this one.",
        TEXTS,
        BEHAVIOUR,
        refers="point",
        yaml=("changes_with",),
    ).says("Changes with", remark="read it again after writing {}"),
    Fact("view_of", "The point that has the same words.", TEXT_OR_NULL, DOCS, refers="point", for_people=True).says(
        "A view of", remark="another view of {}"
    ),
    Fact(
        "certainty",
        "Where the facts come from: `imported` (not compared with a manual), `hardware` (seen on it); null: manual.",
        null_or(one_of("imported", "hardware")),
        DOCS,
        for_people=True,
    ).says(
        "Certainty",
        text=lambda point, _: _CERTAINTIES.get(point.certainty or "", ""),
        remark="{}",
        column="where the facts come from, if not from the manual",
    ),
    _always_null("together", "What must be read or written in one telegram."),
    Fact("was", "Former names, which remain as deprecated aliases.", TEXTS)
    .differs(View("old names", values.grown, itemgetter("was"), yaml=("was",)))
    .says("Old names", remark="was {}"),
    Fact("reserved", "Whether the maker reserves it.", BOOLEAN, API).says(remark="reserved"),
    TITLE,
    NOTE.says("Note", text=lambda point, _: wording.title_text(point.note) if point.note else "", remark="{}"),
    ERRATA.says(column="where the manual is wrong, unclear or silent: ids of errata"),
    SOURCE.says("Source", text=lambda point, context: texts.place_in_manual(point.source, context.device)),
    Fact(
        "generated",
        "False for a point that is only documented.",
        BOOLEAN,
        values.generated_class,
        follows=("access", "type", "reserved", "address"),
    ),
    Fact(
        "reason",
        "Why it is only documented.",
        TEXT_OR_NULL,
        DOCS,
        follows=("generated", "access", "type", "reserved", "address"),
    ).says(
        "Not generated",
        text=lambda point, _: "" if point.generated else point.reason or "no reason given",
        remark="not generated: {}",
        column="why not",
    ),
)

POINTS = Parts(
    "point",
    "point",
    values.items,
    POINT,
    same_by=("space", "telegram", "address", "order of words", "index", "bits", "type", "variant"),
    in_code=values.class_in_code,
)
