"""The places where keys stand, in the order of KEYS.md."""

from __future__ import annotations

from fieldscribe.language.keys import forms
from fieldscribe.language.keys.shapes import A_NAME, ANYTHING, PRINTED_NUMBER, in_language
from fieldscribe.schema_types import NOTHING, Items, Place, Shape, Text, Whole

_PRIVATE = {forms.PRIVATE: ANYTHING}

DEVICE = Place(
    "device_file",
    "The head of device.yaml",
    "What device.yaml starts with: what the device is, and which files its parts are. Parts may also follow below, "
    "each after a line `---`.",
    [
        {
            "fieldscribe": 1,
            "device": "hitachi_l200",
            "version": "1.0.0",
            "vendor": "Hitachi",
            "model": "L200",
            "title": "Frequency inverter",
            "family": "modbus",
            "documents": {"manual": {"title": "ModBus", "language": "de"}},
        }
    ],
    by_form=_PRIVATE,
)
GROUP = Place(
    "group",
    "A group, in a part",
    "What the points of a part share, with its `points`: a part holds one group at most.",
    [
        {
            "group": "standard_a",
            "space": "holding",
            "access": "rw",
            "source": {"document": "manual", "section": "Gruppe A"},
            "points": [],
        }
    ],
    by_form=_PRIVATE,
)
PART = Place(
    "part_file",
    "A part",
    "A document of a file that device.yaml lists under `parts`, or of device.yaml itself below `---`: one group (the "
    "keys of the next table), shared facts, or both.",
    [
        {"group": "standard_a", "space": "holding", "points": []},
        {"enums": {"contact": {"0": "open", "1": "closed"}}},
    ],
    by_form=_PRIVATE,
    may_be=GROUP,
)
POINT = Place(
    "point", "A point", "One point.", [{"code": "A020", "name": "base_frequency", "at": "1028h"}], by_form=_PRIVATE
)
SET = Place(
    "set",
    "A point in a further set, under `sets`",
    "The same point in another parameter set: only what differs.",
    [{"code": "A220", "at": "150Eh"}],
)
ELEMENT = Place(
    "element",
    "A point in one element of an array, under `each`",
    "What is different in this element of an array.",
    [{"default": 52, "line": 377}],
)
VARIANT = Place(
    "variant_facts", "A point in a variant, under `variants`", "The facts of this variant.", [{"range": "660..780"}]
)
USE = Place(
    "use",
    "A use of a record: a point with `record`",
    "Different points that repeat together: what is said here holds for all of them, single ones stand under "
    "`members`.",
    [{"name": "trip_1", "record": "trip", "at": "0012h"}],
    by_form=_PRIVATE,
)
MEMBER = Place(
    "member",
    "A member of a record, under `members`",
    "What differs for one member of a record at this place.",
    [{"line": 701}],
)
FORMAT = Place(
    "format",
    "A format, under `formats`",
    "What a point means, to be shared by name.",
    [{"scale": "value = raw * 0.1", "unit": "%"}],
)
FIXED = Place(
    "fixed",
    "Fixed bits, under `fixed`",
    "Bits of the word that are always written as this constant, `7..3` for several.",
    [{"10": 1}],
    by_form={forms.BITS: Shape("What the bits are written as.", [1], Whole(), Text(40))},
    least=1,
)
DIGITS = Place(
    "digits",
    "Decimal digits, under `digits`",
    "The decimal digits of the word mean something each, the highest first: how many there are, and the names of their "
    "numbers.",
    [{"count": 4, "enum": "input_delay"}],
)
DISPLAY = Place(
    "display",
    "How a value is shown, under `display`",
    "How a person should see a value. What is encoded, decoded and checked does not change.",
    [{"decimals": 2}],
)
RECORD = Place(
    "record",
    "A record, under `records`",
    "Points that stand together at several places; `at` of each counts from `base`.",
    [{"points": [{"name": "error", "at": "base"}]}],
)
CASE = Place(
    "scale_case",
    "A case of a scale",
    "One rule of a scale that another point chooses.",
    [{"when": "unit_mode == 0", "rule": "raw = value * 100"}],
)
ENTRY = Place(
    "entry",
    "An entry of an enum",
    "A name for this number, or a name with titles by language and a quantity.",
    ["terminal", {"name": "terminal", "en": "Terminal", "de": "Eingang"}],
    before=(A_NAME,),
    by_form={forms.LANGUAGE: in_language("Eingang")},
)
SPECIAL_CODE = Place(
    "special_code",
    "A special code, under `special`",
    "A name for this code, or a name with titles by language and what the code means; ~ takes away a code that a "
    "format, the group or the device gives.",
    ["transducer_fault", {"name": "not_available", "no_value": "yes", "en": "Not available"}],
    before=(A_NAME,),
    after=(NOTHING,),
    by_form={forms.LANGUAGE: in_language("Eingang")},
)
TYPES = Place(
    "types",
    "Types, under `types` of a group or the device",
    "What holds for all points of a type in this device or group.",
    [{"s16": {"special": {"7FFFh": "fault"}}}],
    least=1,
)
OF_TYPE = Place(
    "of_type",
    "What holds for all points of a type",
    "What holds for all points of this type.",
    [{"special": {"7FFFh": "fault"}}],
    least=1,
)
FLAG = Place(
    "flag",
    "A flag",
    "A bit, or several, inside the word.",
    ["ready", {"name": "fault", "active": 0}],
    before=(A_NAME,),
)
PRINTED = Place(
    "printed",
    "What is printed twice, under `printed`",
    "What the manual prints redundantly: each number in every numbering (one or a list of notations), ranges, "
    "resolution, number of choices. It must agree with the facts, or an erratum says why not.",
    [{"modicon": ["1029h", 4137], "wire": ["1028h", 4136], "range_in_units": "0.0..400.0"}],
    by_form={
        forms.ANY: Shape(
            "A printed number in the numbering of this name (`wire`, those of `numbering`, and `low_` before them for "
            "the second word).",
            [["1029h", 4137]],
            *(Whole(), Text(64), Items(PRINTED_NUMBER, 1)),
        )
    },
)
SOURCE = Place(
    "source",
    "A source",
    "Where in the manual the facts stand.",
    [{"document": "manual", "section": "Gruppe A"}],
)
LINES = Place(
    "lines",
    "Where single facts stand, under `lines`",
    "Where in the manual's text single facts stand, if not at `line`; the audit reads it.",
    [{"range": 215, "enum": "2553..2652", "scale": [130, 140]}],
    least=1,
)
LOOKED_THROUGH = Place(
    "looked_through",
    "Lines that hold nothing, under `looked_through`",
    "Lines of the manual's text that hold nothing for the description, and why.",
    [{"lines": "9..33", "why": "Wiring."}],
)
BUS = Place(
    "bus",
    "The bus",
    "What the family's frames need to know of this device.",
    [{"framings": ["rtu"], "units": "1..32", "functions": {"03h": "read_holding_registers"}}],
    by_form=_PRIVATE,
)
CODE = Place(
    "code_entry",
    "A function, a response or an exception",
    "A code of the protocol: its name, titles; of a function the largest count of items in one request and whether it "
    "may be broadcast; of USS codes what belongs to them.",
    [{"name": "read_holding_registers", "max": 4}],
    before=(A_NAME,),
    by_form={forms.LANGUAGE: in_language("Adresse unbekannt")},
)
TELEGRAM = Place(
    "telegram",
    "A telegram",
    "A layout of words that is sent again and again.",
    [{"name": "visualisation", "direction": "cyclic", "length": 69, "message": "visualisation"}],
    by_form=_PRIVATE,
)
MESSAGE = Place(
    "message",
    "A message",
    "A layout of eight bytes with an identifier.",
    [
        {
            "name": "read_request",
            "direction": "request",
            "can_id": "33Fh",
            "layout": {"0": "FFh", "1": "unit", "2..3": "address", "4..5": 0, "6..7": "xor 0..5"},
        }
    ],
    by_form=_PRIVATE,
)
COMMAND = Place(
    "command",
    "A command",
    "A named constant write.",
    [{"name": "enter", "at": "0900h", "function": "06h", "value": "any"}],
    by_form=_PRIVATE,
)
FRAME = Place(
    "frame",
    "A frame",
    "A worked example of the manual.",
    [{"name": "write_base_frequency", "direction": "request", "bytes": "05 06 10 28 01 F4 0C 91"}],
    by_form=_PRIVATE,
)
ERRATUM = Place(
    "erratum",
    "An erratum",
    "A place where the manual is wrong, unclear or silent, and what was taken instead.",
    [
        {
            "id": "f004_wire_decimal",
            "point": "F004",
            "printed": {"wire": 4219},
            "taken": {"wire": 4119},
            "why": "Both neighbours say so.",
            "certainty": "certain",
        }
    ],
    by_form=_PRIVATE,
)

FILES = (DEVICE, PART)
REPEATED = (SET, ELEMENT, VARIANT, MEMBER)
"""The places that repeat a point and only say what differs."""
POINTS = (POINT, *REPEATED)
FACTS = (FORMAT, *POINTS)
"""The places whose keys say what a point means."""
CITED = (COMMAND, FRAME, MESSAGE, TELEGRAM)
"""The places, other than points, that cite the manual."""

PLACES = (
    *(DEVICE, PART, GROUP, POINT, SET, ELEMENT, VARIANT, USE, MEMBER, FORMAT, FIXED, DIGITS, DISPLAY, RECORD, CASE),
    *(ENTRY, SPECIAL_CODE, TYPES, OF_TYPE, FLAG, PRINTED, SOURCE, LINES, LOOKED_THROUGH, BUS, CODE, TELEGRAM, MESSAGE),
    *(COMMAND, FRAME, ERRATUM),
)
"""All that have a table of their own in KEYS.md, in its order."""
