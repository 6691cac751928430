"""The keys of points: what identifies a point, how it may be used, and what is nested inside its facts.

`meaning.py` has what its number means.
"""

from fieldscribe.language.keys import forms, places
from fieldscribe.language.keys.places import (
    CITED,
    DEVICE,
    FACTS,
    GROUP,
    LAST_LINE,
    LINES_OF,
    MEMBER,
    NAME,
    NAMED,
    NOTE,
    POINT,
    POINTS,
    PRINTED_NUMBER,
    SET,
    TITLE,
    USE,
    VARIANT,
    in_words,
)
from fieldscribe.model import TYPES
from fieldscribe.schema_types import (
    BOOLEAN,
    NOTHING,
    NUMBER,
    YES_NO,
    Items,
    Key,
    Place,
    Places,
    Text,
    ValueShape,
    Whole,
    by,
    one_of,
)

_TITLED = (places.FLAG, places.RECORD, places.CODE, *CITED)
_NAMED = (places.ENTRY, places.FLAG, places.SPECIAL_CODE, places.CODE, *CITED)
_CITING = Places(*POINTS, USE, *CITED, places.ERRATUM, places.SOURCE, inherited=(USE,))

WHICH = (
    Key("name", (POINT, USE, *_NAMED), NAME, required=True, identity=True),
    Key("code", Places(*POINTS, USE, inherited=(USE,)), "The manual's own short name.", identity=True).takes(
        ["A020"], Text(40)
    ),
    Key("record", (POINT, USE), "The name of one of `records`; `at` is its base.", identity=True).takes(
        ["trip"], NAMED
    ),
    Key(
        "at",
        (POINT, SET, VARIANT, USE, MEMBER),
        "The address on the wire. For a text: its words in reading order (`739..732`); of words that are not "
        "neighbours: all, the high part first. In a record: counted from `base`. In a group with `addressing`: the "
        "`number` of its rule. ~ if the manual prints none.",
        identity=True,
    ).takes(["1028h", 4136, "739..732", "base + 6", [604, 700]], Whole(), Text(200), Items(PRINTED_NUMBER, 1), NOTHING),
    Key(
        "write_at",
        (POINT, SET, VARIANT, MEMBER),
        "The address for writing, if it differs from `at`; it is counted as `at` is. ~ for a set, a variant or a "
        "member that is written where it is read.",
    ).takes(["2028h", 8232, "base + 106"], Whole(), Text(200), NOTHING),
    Key(
        "members",
        (POINT, USE),
        "What differs for single members of the record here, by their names.",
        needs=("record",),
        identity=True,
    ).takes([{"error": {"line": 701}}], by(forms.NAME, MEMBER.shape)),
    Key("bits", POINT, "The bits of the word that belong to this point, if it does not have all.").takes(
        ["15..14", 3], Text(20), Whole()
    ),
    Key("space", POINT, "The address space, if it differs from the group's.").takes(["coil"], Text(40)),
    Key(
        "sets",
        POINT,
        "The parameter sets of the point: a count from 1, or `0..3`, with addresses by the group's rule; or the "
        "further sets by number, each with its facts. Each set named here becomes a point `<name>_set_N`; the "
        "point's own set keeps the plain name.",
        identity=True,
    ).takes([4, "0..3", {"2": {"code": "A220", "at": "150Eh"}}], Whole(), Text(40), by(forms.SET, SET.shape, least=1)),
    Key(
        "indices",
        POINT,
        "The elements of the array: a count from 1, or `0..1`. Each becomes a point `<name>_index_N`. `1..phases`: the "
        "point `phases` holds the last index; `to end`: up to the end of the found block.",
        identity=True,
    ).takes([3, "0..1", "1..phases", "to end"], Whole(), Text(40)),
    Key(
        "most", POINT, "The greatest index that is described, if the device decides how many elements there are."
    ).takes([20], Whole(1, 4096)),
    Key(
        "set",
        (POINT, VARIANT),
        "The only set of the point; it adds no suffix. Beside `sets` by number: the point's own set, 1 by default.",
        identity=True,
    ).takes([2], Whole(0, 999)),
    Key(
        "index",
        (POINT, SET, VARIANT),
        "The only element of the array that is described; it adds no suffix.",
        identity=True,
    ).takes([1], Whole(0, 65535)),
    Key(
        "each",
        POINT,
        "What differs in single elements: by index; by set if there are no indices; by set/index if there are both.",
    ).takes(
        [{"0": {"default": 52, "line": 377}}, {"1/2": {"line": 322}}], by(forms.ELEMENT, places.ELEMENT.shape, least=1)
    ),
    Key("variants", POINT, "What differs by variant: `axis=value` and the facts of that variant.").takes(
        [{"voltage=400V": {"range": "660..780"}}], by(forms.VARIANT, VARIANT.shape, least=1)
    ),
    Key(
        "cases",
        POINT,
        "What the same address means under different conditions: each case becomes a point `<name>_<case>` with the "
        "facts of the row and its own, among them `when`.",
    ).takes(
        [{"speed": {"when": "mode == 1", "unit": "rpm"}, "torque": {"when": "mode == 2", "unit": "%"}}],
        by(forms.NAME, VARIANT.shape, least=1),
    ),
    Key("view_of", POINT, "Another point that has the same words, or some of them; both always exist.").takes(
        ["outputs"], Text(80)
    ),
    Key("was", POINT, "Former names; each stays usable as a deprecated alias.").takes(
        [["main_frequency"]], Items(NAME, 1)
    ),
    Key("title", (DEVICE, GROUP, *POINTS, USE, *_TITLED), TITLE, required=(DEVICE,), identity=True),
    Key("note", (DEVICE, GROUP, *POINTS, USE, places.BUS, places.COMMAND), NOTE),
    Key("document", places.SOURCE, "One of the documents that device.yaml names.").takes(["manual"], Text()),
    Key(
        "line",
        Places(*POINTS, USE, *_NAMED, places.BUS, places.SOURCE, inherited=(USE,)),
        "The line in the text extracted from the manual.",
    ).takes([780], Whole(1, LAST_LINE)),
    Key("section", _CITING, "The section of the manual; quote it if it looks like a number.").takes(
        ["4.2.10"], Text(200)
    ),
    Key("page", _CITING, "The printed page number.").takes([21], Whole(), Text()),
    Key("lines", Places(*FACTS, USE, places.CODE, *CITED, places.ERRATUM, inherited=(USE,)), places.LINES.shape),
    Key("printed", POINTS, places.PRINTED.shape, identity=True),
    Key("format", POINT, "The name of one of `formats`.").takes(["percent_tenth"], NAMED),
)
"""The keys that identify a point and cite the manual."""

_EVERYWHERE = Places(GROUP, *POINTS, USE, inherited=(GROUP, USE))

USING = (
    Key("access", _EVERYWHERE, "What a master may do: read, write, both, or nothing over this bus.").takes(
        ["rw"], one_of("r", "w", "rw", "none")
    ),
    Key(
        "keeps",
        _EVERYWHERE,
        "Says if a written value survives power-off: `no`, `yes` (each write wears the memory), or `choice` (the "
        "caller chooses with each write).",
    ).takes(["yes"], BOOLEAN, one_of("no", "yes", "choice")),
    Key(
        "keep_with",
        _EVERYWHERE,
        "The command that stores a written value so that it survives power-off; given in place of `keeps`.",
    ).takes(["enter"], NAMED),
    Key(
        "changes", _EVERYWHERE, "How often the value changes by itself; polling and run-time factors depend on it."
    ).takes(["never"], one_of("never", "rarely", "always")),
    Key("conditions", _EVERYWHERE, "What must be true before a write.").takes(
        [["stopped"]], Items(ValueShape("One condition in one or two words.", ["stopped"], Text(80)), 1)
    ),
    Key(
        "takes_effect",
        _EVERYWHERE,
        "When the device uses a written value: `at once` (the default), or only `after a restart`.",
    ).takes(["after a restart"], one_of("at once", "after a restart")),
    Key(
        "write_with",
        FACTS,
        "Points that must be written together with this one: all are written in one request.",
    ).takes([["minute", "second"]], Items(ValueShape("A point by code or name.", ["minute"], Text(80)), 1)),
    Key("when", _EVERYWHERE, "The point exists only if this is true: comparisons joined by and, or, not.").takes(
        ["phases >= 2 and meter != none"], Text(500)
    ),
    Key(
        "select",
        Places(GROUP, POINT, inherited=(GROUP,)),
        "What other points must hold before the address means this point: a number or a name of each, or a formula of "
        "number, index, set, sets and indices. Clients write it first, unless it is there already.",
    ).takes(
        [{"page": 3, "parameter_index": "index - 1"}],
        by(forms.ANY, ValueShape("What the point must hold.", [3, "index - 1"], Whole(), Text(200)), least=1),
    ),
    Key("since", _EVERYWHERE, "The first firmware that has the point.").takes(["firmware 2.1.0"], Text(80)),
    Key("until", _EVERYWHERE, "The last firmware that has the point.").takes(["firmware 3.7"], Text(80)),
    Key(
        "certainty",
        Places(DEVICE, *_EVERYWHERE.all, inherited=_EVERYWHERE.inherited),
        "Where the facts come from: compared with the manual (the default), `imported` and compared by nobody, or seen "
        "on `hardware`.",
    ).takes(["imported"], one_of("manual", "imported", "hardware")),
    Key("reserved", Places(GROUP, *POINTS, inherited=(GROUP,)), "The maker reserves this address.").takes(
        ["yes"], *YES_NO
    ),
)
"""The keys that say how a point may be used, and when it exists."""


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

NESTED = (
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
