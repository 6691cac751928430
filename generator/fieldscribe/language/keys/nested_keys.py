"""The keys nested inside facts of points: of enums, flags, special codes, printed facts and sources."""

from fieldscribe.language.keys import forms, places
from fieldscribe.language.keys.places import LINES_OF, NAMED, PRINTED_NUMBER, in_words
from fieldscribe.model import TYPES
from fieldscribe.schema_types import NUMBER, YES_NO, Items, Key, Place, Text, ValueShape, Whole, by

_FLAG_PRINTED = Place(least=1).means(
    "What the manual prints a second time about the flag, in bits of the word.",
    [{"mask": "0x0002"}, {"bit": 4}, {"active": 0}],
)
_ONE_BIT = Whole(choices=(0, 1))
_CITED = (
    *("code", "section", "address", "range", "scale", "bits", "flags", "enum", "resolution", "choices", "printed"),
    *("bytes", "number", "answers", "refusals", "title", "values", "access", "default", "special", "max"),
)
"""The facts that `lines` can place."""

KEYS = (
    Key("count", places.DIGITS, "The number of digits.", required=True).takes([4], Whole(1, 5)),
    Key(
        "decimals",
        places.DISPLAY,
        "The number of decimals that are shown: rounded to nearest, halves away from zero, with zeros at the end.",
        required=True,
    ).takes([2], Whole(0, 12)),
    Key("when", places.CASE, "A comparison of a point with a constant.", required=True).takes(
        ["unit_mode == 0"], Text(200)
    ),
    Key("rule", places.CASE, "The rule if the comparison is true.", required=True).takes(
        ["raw = value * 100"], Text(500)
    ),
    Key("quantity", places.ENTRY, "The quantity that the number stands for.").takes(["0.37 kW", "100 ms"], Text(80)),
    Key("no_value", places.SPECIAL_CODE, "The code means that there is no value.").takes(["yes"], *YES_NO),
    Key("writable", places.SPECIAL_CODE, "The code may be written; by default it is only read.").takes(
        ["yes"], *YES_NO
    ),
    *(Key(name, places.TYPES, places.OF_TYPE.shape) for name in TYPES if name not in ("bit", "text")),
    Key("text", places.TYPES, places.OF_TEXTS.shape),
    Key("active", places.FLAG, "The value of the bit that makes the name true; 0 for an inverted bit.").takes(
        [0], _ONE_BIT
    ),
    Key("zero", places.FLAG, "What 0 means, in words.").takes([{"en": "not ready"}], *in_words("nicht bereit")),
    Key("one", places.FLAG, "What 1 means, in words.").takes([{"en": "ready"}], *in_words("bereit")),
    Key(
        "values",
        places.FLAG,
        "Names for the numbers of several bits: the name of one of `enums`, or the numbers with their names.",
    ).takes(["relay_event", {"0": "stop", "1": "run"}], NAMED, by(forms.NUMBER, places.ENTRY.shape, least=1)),
    Key("printed", places.FLAG, _FLAG_PRINTED.shape),
    Key("mask", _FLAG_PRINTED, PRINTED_NUMBER),
    Key("bit", _FLAG_PRINTED, "The number of the bit, or of the lowest one.").takes([4], Whole(0, 63)),
    Key("active", _FLAG_PRINTED, "The printed value that makes the name true.").takes([0], _ONE_BIT),
    Key("resolution", places.PRINTED, "The resolution as printed, with its unit.").takes(["0.1 Hz"], Text(80), NUMBER),
    Key("choices", places.PRINTED, "The number of choices that the manual gives.").takes([5], Whole(0, 1_000_000_000)),
    Key("pairs", places.PRINTED, "Raw numbers with their values in the unit, as printed beside each other.").takes(
        [{"FF9Eh": -0.98, "0064h": 1.0}],
        by(forms.NUMBER, ValueShape("The value in the unit.", [-0.98], NUMBER, Text(64)), least=1),
    ),
    *(Key(fact, places.LINES, LINES_OF) for fact in _CITED),
    Key("lines", places.LOOKED_THROUGH, LINES_OF, required=True),
    Key(
        "numbers",
        places.LOOKED_THROUGH,
        "If the lines hold facts too: the numbers in them that are no facts. The audit ignores these.",
    ).takes([[1, 2, "1028h"]], Items(PRINTED_NUMBER, 1)),
    Key("why", places.LOOKED_THROUGH, "What the lines are about, in a few words.", required=True).takes(
        ["Wiring."], Text(500)
    ),
)
