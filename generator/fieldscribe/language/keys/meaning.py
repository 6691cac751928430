"""The keys that say what the number of a point means."""

from __future__ import annotations

from fieldscribe.language.keys import forms, places
from fieldscribe.language.keys.places import FACTS, GROUP
from fieldscribe.language.keys.shapes import NAMED, PRINTED_NUMBER, WORD_ORDER
from fieldscribe.model import TYPES
from fieldscribe.schema_types import (
    NOTHING,
    NUMBER,
    NUMBERS,
    TEXTS,
    WHOLE_NUMBERS,
    YES_NO,
    Items,
    Key,
    Shape,
    Text,
    Whole,
    by,
    one_of,
)

_GROUPED = (GROUP, *FACTS)

KEYS = (
    Key(
        "type",
        _GROUPED,
        "The wire type; u16 unless said. ~ where the manual does not settle it: the point is then documented only.",
        ["s16", "u32"],
        one_of(*TYPES),
        NOTHING,
        inherited=(GROUP,),
    ),
    Key(
        "untyped",
        FACTS,
        "What the manual says of an encoding that no `type` says (48 bits, sign and magnitude, logarithmic): the "
        "point is then documented only, its words reachable raw.",
        ["48-bit counter, the high word first"],
        Text(80),
    ),
    Key(
        "length",
        FACTS,
        "How many words a point has that is `untyped`, or whose type is not settled; 1 unless said.",
        [3],
        Whole(1, 125),
    ),
    Key(
        "words",
        _GROUPED,
        "The order of the words of a value of more than one word.",
        ["low first"],
        WORD_ORDER,
        inherited=(GROUP,),
    ),
    Key(
        "range",
        (*_GROUPED, places.PRINTED),
        "Raw numbers that may be written: an interval, several, or a list; limits may name other points.",
        ["0..4000", "-99..-70 | 70..100", "0, 1, 2, 3, 10", "30..A004"],
        Text(500),
        Whole(),
        Items(PRINTED_NUMBER, 1),
        inherited=(GROUP,),
        of=NUMBERS,
    ),
    Key(
        "range_in_units",
        (*FACTS, places.PRINTED),
        "Values in the unit that may be written: an interval, several, or a list; limits may name other points.",
        ["40..70", "0.5..2.5", "30..A004"],
        Text(500),
        Whole(),
        Items(PRINTED_NUMBER, 1),
        of=NUMBERS,
    ),
    Key(
        "scale",
        _GROUPED,
        "How raw number and value follow from each other, as the manual says it; names are points read at run time. ~ "
        "where the manual does not settle it: the point is then documented only.",
        ["value = raw * 0.1", "raw = value * 256"],
        Text(500),
        Items(places.CASE.shape, 1),
        NOTHING,
        inherited=(GROUP,),
        of=WHOLE_NUMBERS,
    ),
    Key(
        "unit",
        _GROUPED,
        "The unit's symbol; more are declared under `units`.",
        ["Hz", "%"],
        Text(20),
        inherited=(GROUP,),
    ),
    Key("display", _GROUPED, places.DISPLAY.shape, inherited=(GROUP,)),
    Key(
        "decimals",
        FACTS,
        "The integer path counts in 10^-decimals units; computed unless said.",
        [3],
        Whole(0, 12),
        of=WHOLE_NUMBERS,
    ),
    Key(
        "enum",
        (*FACTS, places.DIGITS),
        "Names for numbers: the name of one of `enums`, or the numbers with their names.",
        ["contact", {"0": "keypad", "3": "modbus"}],
        NAMED,
        by(forms.NUMBER, places.ENTRY.shape, least=1),
        required=(places.DIGITS,),
        of=WHOLE_NUMBERS,
    ),
    Key("open", FACTS, "Whether numbers without a name may be written too.", ["yes"], *YES_NO),
    Key(
        "special",
        (places.DEVICE, *_GROUPED, places.OF_TYPE),
        "Special codes: raw numbers that are no quantity, with their names; `a..b` names a band. Of f32 and f64 the "
        "bit patterns.",
        [
            {"0FFFCh": "transducer_fault"},
            {"7FFFh": {"name": "not_available", "no_value": "yes"}},
            {"0FFF8h..0FFFFh": "reserved"},
        ],
        by(forms.NUMBER, places.SPECIAL_CODE.shape, least=1),
        of=NUMBERS,
    ),
    Key("types", (places.DEVICE, GROUP), places.TYPES.shape),
    Key(
        "flags",
        FACTS,
        "Bits by number, `5..4` for several; bit 0 is the lowest of the word, also where the point takes only some of "
        "its bits.",
        [{"0": "ready", "3": {"name": "fault", "active": 0}}],
        by(forms.BITS, places.FLAG.shape, least=1),
        of=WHOLE_NUMBERS,
    ),
    Key(
        "characters",
        FACTS,
        "How many characters a text has; two stand in a word, and 125 words at most travel at once.",
        [16],
        Whole(2),
        of=TEXTS,
    ),
    Key(
        "encoding", FACTS, "The encoding of a text; ascii unless said.", ["ascii"], one_of("ascii", "latin-1"), of=TEXTS
    ),
    Key("digits", FACTS, places.DIGITS.shape, of=WHOLE_NUMBERS),
    Key("fixed", FACTS, places.FIXED.shape, of=WHOLE_NUMBERS),
    Key(
        "changes_with",
        FACTS,
        "Read as a run-time factor, the value must be read again after one of these points was written.",
        [["transformer_primary"]],
        Items(Shape("A point by code or name.", ["transformer_primary"], Text(80)), 1),
    ),
    Key(
        "default",
        FACTS,
        "The factory setting as it travels: a raw number, or the name of an enum's number or of a special code.",
        [500, "terminal"],
        Whole(),
        Text(64),
        of=NUMBERS,
    ),
    Key("default_in_units", FACTS, "The factory setting in the unit.", [50.0], NUMBER, Text(64), of=NUMBERS),
    Key(
        "steps",
        FACTS,
        "From which raw number on the device keeps only every n-th.",
        [{"1": 1, "10000": 10}],
        by(forms.NUMBER, Shape("The step in raw numbers.", [10], Whole(1, 1_000_000_000)), least=1),
        of=WHOLE_NUMBERS,
    ),
)
