"""The places where keys stand, in the order of KEYS.md; before them the shapes of values that several keys share."""

from fieldscribe.language.keys import forms
from fieldscribe.schema_types import NOTHING, NUMBER, Items, Place, Text, ValueShape, Whole, by, one_of

LAST_LINE = 1_000_000_000

A_NAME = Text(80, forms.NAME)
NAMED = Text(form=forms.NAME)
"""A name that is declared elsewhere."""

NAME = ValueShape(
    "A name in English, in snake_case. It becomes the identifier in every language and is never reused for another "
    "thing.",
    ["base_frequency"],
    A_NAME,
)
PRINTED_NUMBER = ValueShape(
    "A number as the manual writes it: 4136, 0x1028, 1028h, H'33F, 0b0101, 0.1.", [4136, "1028h", 0.1], NUMBER, Text(64)
)
ANYTHING = ValueShape("Your own; nothing reads it.", ())


def in_language(example: str) -> ValueShape:
    """Return the shape of a text in one of several languages."""
    return ValueShape("The text in this language.", [example], Text(2000))


def in_words(example: str, *required: str) -> tuple[Text, Place]:
    """Return the kinds of a text: in English, or by language; `required` are the languages that it must have."""
    return Text(2000), by(forms.LANGUAGE, in_language(example), required=required)


TITLE = ValueShape(
    "A title: one English text, or a text for each language, with English among them.",
    [{"en": "Base frequency", "de": "Basisfrequenz"}, "Base frequency"],
    *in_words("Basisfrequenz", "en"),
)
NOTE = ValueShape(
    "A remark of your own, in English or for each language.",
    [{"en": "Takes some time."}, "Takes some time."],
    *in_words("Takes some time.", "en"),
)
LINE_OR_LINES = (Whole(1, LAST_LINE), Text(form=forms.LINES))
LINES_OF = ValueShape(
    "A line of the manual's text, several as `2553..2652`, or a list of these.",
    [215, "2553..2652", [130, 140]],
    *LINE_OR_LINES,
    Items(ValueShape("A line, or several as `2553..2652`.", [780, "2553..2652"], *LINE_OR_LINES), 1),
)
SEVERAL = Items(ValueShape("A number, or several as `11..14`.", [7, "11..14"], Whole(), Text(20)))
WORD_ORDER = one_of("high first", "low first")
DIRECTION = one_of("request", "response", "cyclic")

# The places, in the order of KEYS.md.

_PRIVATE = {forms.PRIVATE: ANYTHING}

DEVICE = Place("device_file", "The head of device.yaml", by_form=_PRIVATE).means(
    "The start of device.yaml: what the device is, and which files are its parts. Parts may also follow below, each "
    "after a line `---`.",
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
)
GROUP = Place("group", "A group, in a part", by_form=_PRIVATE).means(
    "The points of a part, and what they share. A part has at most one group.",
    [
        {
            "group": "standard_a",
            "space": "holding",
            "access": "rw",
            "source": {"document": "manual", "section": "Gruppe A"},
            "points": [],
        }
    ],
)
PART = Place("part_file", "A part", by_form=_PRIVATE, may_be=GROUP).means(
    "A document in a file that device.yaml lists under `parts`, or below a `---` in device.yaml itself: one group "
    "(with the keys of the next table), shared facts, or both.",
    [{"group": "standard_a", "space": "holding", "points": []}, {"enums": {"contact": {"0": "open", "1": "closed"}}}],
)
POINT = Place("point", "A point", by_form=_PRIVATE).means(
    "One point.", [{"code": "A020", "name": "base_frequency", "at": "1028h"}]
)
SET = Place("set", "A point in a further set, under `sets`").means(
    "The same point in another parameter set: only what differs.", [{"code": "A220", "at": "150Eh"}]
)
ELEMENT = Place("element", "A point in one element of an array, under `each`").means(
    "What differs in this element of an array.", [{"default": 52, "line": 377}]
)
VARIANT = Place("variant_facts", "A point in a variant or a case, under `variants` or `cases`").means(
    "What differs in this variant or case.", [{"range": "660..780"}]
)
USE = Place("use", "A use of a record: a point with `record`", by_form=_PRIVATE).means(
    "A record at one of its places: what is said here holds for all its members; `members` has what differs.",
    [{"name": "trip_1", "record": "trip", "at": "0012h"}],
)
MEMBER = Place("member", "A member of a record, under `members`").means(
    "What differs for one member of a record at this place.", [{"line": 701}]
)
FORMAT = Place("format", "A format, under `formats`").means(
    "What a point means, shared by name.", [{"scale": "value = raw * 0.1", "unit": "%"}]
)
FIXED = Place(
    "fixed",
    "Fixed bits, under `fixed`",
    by_form={forms.BITS: ValueShape("The constant.", [1], Whole(), Text(40))},
    least=1,
).means("Bits of the word that are always written as a constant, `7..3` for several bits.", [{"10": 1}])
DIGITS = Place("digits", "Decimal digits, under `digits`").means(
    "A word whose decimal digits each have a meaning, the highest first: how many digits, and the names of their "
    "numbers.",
    [{"count": 4, "enum": "input_delay"}],
)
DISPLAY = Place("display", "How a value is shown, under `display`").means(
    "How a value is shown to people. Encoding, decoding and limits do not change.", [{"decimals": 2}]
)
RECORD = Place("record", "A record, under `records`").means(
    "Points that repeat together at several places; the `at` of each counts from `base`.",
    [{"points": [{"name": "error", "at": "base"}]}],
)
CASE = Place("scale_case", "A case of a scale").means(
    "One rule of a scale, if another point has a certain raw number.",
    [{"when": "unit_mode == 0", "rule": "raw = value * 100"}],
)
ENTRY = Place("entry", "An entry of an enum", before=(A_NAME,), by_form={forms.LANGUAGE: in_language("Eingang")}).means(
    "A name for this number, or a name with titles by language and a quantity.",
    ["terminal", {"name": "terminal", "en": "Terminal", "de": "Eingang"}],
)
SPECIAL_CODE = Place(
    "special_code",
    "A special code, under `special`",
    before=(A_NAME,),
    after=(NOTHING,),
    by_form={forms.LANGUAGE: in_language("Eingang")},
).means(
    "A name for this code, or a name with titles by language and what the code means; ~ removes a code that the "
    "format, the group or the device defines.",
    ["transducer_fault", {"name": "not_available", "no_value": "yes", "en": "Not available"}],
)
TYPES = Place("types", "Types, under `types` of a group or the device", least=1).means(
    "Facts that all points of a type share, in this device or group.", [{"s16": {"special": {"7FFFh": "fault"}}}]
)
OF_TYPE = Place("of_type", "What holds for all points of a type", least=1).means(
    "Facts that all points of this type share.", [{"special": {"7FFFh": "fault"}}]
)
OF_TEXTS = Place("of_texts", "What holds for all texts", least=1).means(
    "Facts that all texts share.", [{"encoding": "latin-1", "padding": "00h"}]
)
FLAG = Place("flag", "A flag", before=(A_NAME,)).means(
    "A bit, or several bits, inside the word.", ["ready", {"name": "fault", "active": 0}]
)
PRINTED = Place(
    "printed",
    "What is printed twice, under `printed`",
    by_form={
        forms.ANY: ValueShape(
            "The printed number in this numbering: `wire` or a name under `numbering`; with `low_` in front for the "
            "second word.",
            [["1029h", 4137]],
            *(Whole(), Text(64), Items(PRINTED_NUMBER, 1)),
        )
    },
).means(
    "What the manual prints a second time: a number in each numbering (one or a list of notations), ranges, "
    "resolution, number of choices. It must agree with the facts, unless an erratum says why not.",
    [{"modicon": ["1029h", 4137], "wire": ["1028h", 4136], "range_in_units": "0.0..400.0"}],
)
SOURCE = Place("source", "A source").means(
    "The place in the manual that the facts are taken from.", [{"document": "manual", "section": "Gruppe A"}]
)
LINES = Place("lines", "Where single facts stand, under `lines`", least=1).means(
    "For the audit: the lines of the manual's text that hold single facts, if they differ from `line`.",
    [{"range": 215, "enum": "2553..2652", "scale": [130, 140]}],
)
LOOKED_THROUGH = Place("looked_through", "Lines that hold nothing, under `looked_through`").means(
    "Lines of the manual's text without facts for the description, and what they are about.",
    [{"lines": "9..33", "why": "Wiring."}],
)
BUS = Place("bus", "The bus", by_form=_PRIVATE).means(
    "What the frames of the family need to know about this device.",
    [{"framings": ["rtu"], "units": "1..32", "functions": {"03h": "read_holding_registers"}}],
)
CODE = Place(
    "code_entry",
    "A function, a response or an exception",
    before=(A_NAME,),
    by_form={forms.LANGUAGE: in_language("Adresse unbekannt")},
).means(
    "A code of the protocol: its name and titles; for a function also the largest request and if it may be "
    "broadcast; for USS the codes that belong to it.",
    [{"name": "read_holding_registers", "max": 4}],
)
TELEGRAM = Place("telegram", "A telegram", by_form=_PRIVATE).means(
    "A layout of words that is sent cyclically.",
    [{"name": "visualisation", "direction": "cyclic", "length": 69, "message": "visualisation"}],
)
MESSAGE = Place("message", "A message", by_form=_PRIVATE).means(
    "A layout of the eight bytes of a CAN frame, with its identifier.",
    [
        {
            "name": "read_request",
            "direction": "request",
            "can_id": "33Fh",
            "layout": {"0": "FFh", "1": "unit", "2..3": "address", "4..5": 0, "6..7": "xor 0..5"},
        }
    ],
)
COMMAND = Place("command", "A command", by_form=_PRIVATE).means(
    "A constant that is written under a name, or several requests in order (`steps`).",
    [{"name": "enter", "at": "0900h", "function": "06h", "value": "any"}],
)
STEP = Place("step", "A step of a command, under `steps`", least=1).means(
    "One request: words to write by points (`write`) or by address (`at`, `words`), or points to wait for (`wait`).",
    [{"write": {"A020": 50.0}}],
)
FRAME = Place("frame", "A frame", by_form=_PRIVATE).means(
    "A worked example from the manual.",
    [{"name": "write_base_frequency", "direction": "request", "bytes": "05 06 10 28 01 F4 0C 91"}],
)
ERRATUM = Place("erratum", "An erratum", by_form=_PRIVATE).means(
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
)
BEHAVIOUR = Place("behaviour_file", "The behaviour of a simulated device, behaviour.yaml", by_form=_PRIVATE).means(
    "What a simulated device does, in a file beside device.yaml; it is no part of the description.",
    [{"behaviour": "hitachi_l200", "moves": {"output_frequency": "ramp to A020 at 10 Hz/s while run_command == run"}}],
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
    *(
        ENTRY,
        SPECIAL_CODE,
        TYPES,
        OF_TYPE,
        OF_TEXTS,
        FLAG,
        PRINTED,
        SOURCE,
        LINES,
        LOOKED_THROUGH,
        BUS,
        CODE,
        TELEGRAM,
        MESSAGE,
    ),
    *(COMMAND, STEP, FRAME, ERRATUM, BEHAVIOUR),
)
"""The places that have a table in KEYS.md, in its order."""
