"""The keys that say what the number of a point means: type, scale, unit, limits, names."""

from fieldscribe.language.keys import forms, places
from fieldscribe.language.keys.places import FACTS, GROUP, NAMED, PRINTED_NUMBER, WORD_ORDER
from fieldscribe.schema_types import (
    NOTHING,
    NUMBER,
    NUMBERS,
    TEXTS,
    WHOLE_NUMBERS,
    YES_NO,
    Items,
    Key,
    Places,
    Text,
    ValueShape,
    Whole,
    by,
    one_of,
)

_GROUPED = Places(GROUP, *FACTS, inherited=(GROUP,))
_OF_TEXTS = Places(GROUP, *FACTS, places.OF_TEXTS, inherited=(GROUP,))

KEYS = (
    Key(
        "type",
        _GROUPED,
        "The type on the wire; u16 by default. A number without (u) or with a sign (s) has up to 64 bits (u24, s48), "
        "right-aligned in as many words as it needs. ~ if the manual leaves it open: the point is then documented and "
        "not generated.",
    ).takes(["u16", "s16", "u32", "f32", "u48", "text", "bytes"], Text(form=forms.TYPE), NOTHING),
    Key(
        "untyped",
        FACTS,
        "An encoding that no `type` covers (logarithmic, two numbers in a word), in words: the point is then "
        "documented and not generated; its words can be read raw.",
    ).takes(["two numbers, base 60"], Text(80)),
    Key(
        "length",
        FACTS,
        "The number of words of bytes, or of a point that is `untyped` or whose type is open; 1 by default.",
    ).takes([3], Whole(1, 125)),
    Key(
        "coding",
        _GROUPED,
        "How the bits hold a number if not as usual: decimal digits of four bits each (u types), or the sign in the "
        "highest bit and the magnitude in the others (s types).",
        of=WHOLE_NUMBERS,
    ).takes(["bcd", "sign and magnitude"], one_of("bcd", "sign and magnitude")),
    Key(
        "notation",
        FACTS,
        "How people write bytes, hex by default; or the date from which a whole number counts seconds.",
    ).takes(
        ["ipv4", "ipv6", "eui48", "eui64", "hex", "version", "version of nibbles", "time since 1970-01-01"],
        Text(form=forms.NOTATION),
    ),
    Key(
        "parts",
        FACTS,
        "The parts of a date and time: a list of them in reading order, a byte each, or a word with `per_word: 1`; or "
        "the place of each. A year says what its 0 means (2000 if it has at most 8 bits), a weekday where it begins.",
    ).takes(
        [
            ["year", "month", "day", "hour", "minute", "second"],
            {"year from 1980": "bits 15..9", "month": "bits 8..5", "day": "bits 4..0", "hour": "word 2"},
        ],
        Items(ValueShape("A part.", ["year"], Text(form=forms.DATE_PART)), 1),
        by(forms.DATE_PART, ValueShape("Its place.", ["bits 6..0 of word 2"], Text(form=forms.PART_PLACE)), 1),
    ),
    Key(
        "bit_numbers",
        _GROUPED,
        "How the manual numbers the bits of a word in `bits`, `flags` and `fixed`: from 0 or 1 at the lowest, which is "
        "usual, or at the top.",
    ).takes(["from 1"], one_of("from 0", "from 1", "from 0 at the top", "from 1 at the top")),
    Key("words", _GROUPED, "The order of the words of a value that has several.").takes(["low first"], WORD_ORDER),
    Key(
        "bytes",
        _OF_TEXTS,
        "The order of the bytes in each word, or of a signal (CAN); of a text, low first if its first character stands "
        "in the low byte.",
    ).takes(["low first"], WORD_ORDER),
    Key(
        "range",
        Places(GROUP, *FACTS, places.PRINTED, inherited=(GROUP,)),
        "The raw numbers that may be written: an interval, several intervals, or a list; a limit may name another "
        "point.",
        of=NUMBERS,
    ).takes(
        ["0..4000", "-99..-70 | 70..100", "0, 1, 2, 3, 10", "30..A004"], Text(500), Whole(), Items(PRINTED_NUMBER, 1)
    ),
    Key(
        "range_in_units",
        (*FACTS, places.PRINTED),
        "The values in the unit that may be written: an interval, several intervals, or a list; a limit may name "
        "another point.",
        of=NUMBERS,
    ).takes(["40..70", "0.5..2.5", "30..A004"], Text(500), Whole(), Items(PRINTED_NUMBER, 1)),
    Key(
        "scale",
        _GROUPED,
        "The rule between raw number and value, as the manual writes it; a name is a point that is read at run time. "
        "~ if the manual leaves it open: the point is then documented and not generated.",
        of=WHOLE_NUMBERS,
    ).takes(["value = raw * 0.1", "raw = value * 256"], Text(500), Items(places.CASE.shape, 1), NOTHING),
    Key("unit", _GROUPED, "The symbol of the unit; `units` declares further ones.").takes(["Hz", "%"], Text(20)),
    Key("display", _GROUPED, places.DISPLAY.shape),
    Key(
        "decimals",
        FACTS,
        "The resolution of integer code: it counts in 10^-decimals units. Computed from the scale by default. An f32 "
        "with it has counts in C.",
        of=NUMBERS,
    ).takes([3], Whole(0, 12)),
    Key(
        "enum",
        (*FACTS, places.DIGITS),
        "Names for numbers: the name of one of `enums`, or the numbers with their names.",
        required=(places.DIGITS,),
        of=WHOLE_NUMBERS,
    ).takes(["contact", {"0": "keypad", "3": "modbus"}], NAMED, by(forms.NUMBER, places.ENTRY.shape, least=1)),
    Key("open", FACTS, "Say `yes` if numbers without a name may be written too.").takes(["yes"], *YES_NO),
    Key(
        "special",
        (places.DEVICE, GROUP, *FACTS, places.OF_TYPE),
        "Special codes: raw numbers that are no quantity, with their names; `a..b` is a band. For f32 and f64: bit "
        "patterns.",
        of=NUMBERS,
    ).takes(
        [
            {"0FFFCh": "transducer_fault"},
            {"7FFFh": {"name": "not_available", "no_value": "yes"}},
            {"0FFF8h..0FFFFh": "reserved"},
        ],
        by(forms.NUMBER, places.SPECIAL_CODE.shape, least=1),
    ),
    Key("types", (places.DEVICE, GROUP), places.TYPES.shape),
    Key(
        "flags",
        FACTS,
        "Names for bits by number, `5..4` for several bits. Bit 0 is the lowest bit of the word, even if the point "
        "has only some of its bits.",
        of=WHOLE_NUMBERS,
    ).takes([{"0": "ready", "3": {"name": "fault", "active": 0}}], by(forms.BITS, places.FLAG.shape, least=1)),
    Key("characters", FACTS, "The number of characters of a text; it has at most 500 words.", of=TEXTS).takes(
        [16], Whole(1)
    ),
    Key(
        "encoding",
        _OF_TEXTS,
        "The encoding of a text; ascii by default. With utf-8 `characters` counts bytes, with utf-16 words.",
        of=TEXTS,
    ).takes(["latin-1"], one_of("ascii", "latin-1", "utf-8", "utf-16")),
    Key(
        "per_word",
        _OF_TEXTS,
        "How many characters of a text, or bytes, stand in a word: 2, or 1 in the low byte beside a 00h.",
        of=TEXTS,
    ).takes([1], Whole(1, 2)),
    Key(
        "padding",
        _OF_TEXTS,
        "What fills the rest of a text: blanks (20h, by default), or 00h, the first of which ends it. Blanks at the "
        "end are no part of a text that is read.",
        of=TEXTS,
    ).takes(["00h"], one_of("20h", "00h")),
    Key("digits", FACTS, places.DIGITS.shape, of=WHOLE_NUMBERS),
    Key("fixed", FACTS, places.FIXED.shape, of=WHOLE_NUMBERS),
    Key(
        "changes_with", FACTS, "Points whose writes change this one: as a run-time factor it is read again after them."
    ).takes(
        [["transformer_primary"]], Items(ValueShape("A point by code or name.", ["transformer_primary"], Text(80)), 1)
    ),
    Key(
        "default",
        FACTS,
        "The factory setting as a raw number, or as a name from the enum or of a special code.",
        of=NUMBERS,
    ).takes([500, "terminal"], Whole(), Text(64)),
    Key("default_in_units", FACTS, "The factory setting in the unit.", of=NUMBERS).takes([50.0], NUMBER, Text(64)),
    Key(
        "steps",
        FACTS,
        "The steps that the device keeps: from each raw number on, only every n-th number.",
        of=WHOLE_NUMBERS,
    ).takes(
        [{"1": 1, "10000": 10}],
        by(forms.NUMBER, ValueShape("The step in raw numbers.", [10], Whole(1, 1_000_000_000)), least=1),
    ),
)
