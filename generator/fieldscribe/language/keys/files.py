"""The keys at the top of a file (device.yaml, parts, groups), of sections that declare things, of behaviour.yaml."""

from fieldscribe.families import FAMILIES
from fieldscribe.language.keys import forms, places
from fieldscribe.language.keys.places import A_NAME, BEHAVIOUR, DEVICE, FILES, GROUP, NAME, NAMED, TITLE
from fieldscribe.schema_types import BOOLEAN, NUMBER, Items, Key, Place, Places, Text, ValueShape, Whole, by, one_of

_DOCUMENT = Place().means("One manual.", [{"title": "ModBus", "language": "de"}])
_AXIS = Place().means("One axis.", [{"values": {"200V": {}}}])
_UNIT = Place().means("One unit.", [{"name": "hertz", "quantity": "frequency"}])
_PROPERTY = ValueShape(
    "A property of the variant. `pzd` (family uss): the most words of process data that it takes.",
    [3],
    *(Text(200), NUMBER),
)
_GIVEN = Place().means("One number.", [{"range": "1..15"}])
_FOUND = Place().means("One chain of blocks.", [{"text": "SunS", "at": [40000, 0, 50000], "then": ["id", "length"]}])
_HELD = ValueShape("One of several.", [3], Whole(), Text(250))
_VALUE = Place(by_form={forms.ANY: _PROPERTY}).means(
    "One value of the axis, and its properties.", [{"title": "200 V class"}]
)

HEADS = (
    Key("fieldscribe", DEVICE, "The version of the language.", required=True).takes([1], Whole(choices=(1,))),
    Key(
        "device",
        DEVICE,
        "The device's name in snake_case: the folder's name, and the prefix of all generated names.",
        required=True,
    ).takes(["hitachi_l200"], A_NAME),
    Key("version", DEVICE, "The version of this description; quote it if it looks like a number.", required=True).takes(
        ["1.0.0"], Text(form=forms.VERSION)
    ),
    Key("vendor", DEVICE, "The maker of the device.", required=True).takes(["Hitachi"], Text(200)),
    Key("model", DEVICE, "The name of the product; quote it if it looks like a number.", required=True).takes(
        ["L200"], Text(200)
    ),
    Key("family", DEVICE, "The rules of addressing and framing that the device follows.", required=True).takes(
        ["modbus"], one_of(*FAMILIES)
    ),
    Key(
        "identify",
        (DEVICE, _VALUE),
        "The points that identify this device, or this variant: by code or name, in the order of reading, each "
        "with its raw number, name or text, or a list of them.",
    ).takes(
        [{"signature": "MAP12E", "hardware": [3, 4]}],
        by(forms.ANY, ValueShape("What the point holds.", ["MAP12E", 3], Whole(), Text(250), Items(_HELD, 1)), least=1),
    ),
    Key(
        "given", DEVICE, "Numbers that a client is given when it opens a device, by name; a `base` may count with them."
    ).takes([{"slot": {"range": "1..15"}}], by(forms.NAME, _GIVEN.shape, least=1)),
    Key("range", _GIVEN, "What the number can be.", required=True).takes(["1..15"], Text(40)),
    Key(
        "found",
        DEVICE,
        "A chain of blocks that a client searches for, by its name. Each block starts with its id and its length.",
    ).takes(
        [{"models": {"text": "SunS", "at": [40000, 0, 50000], "then": ["id", "length"]}}],
        by(forms.NAME, _FOUND.shape, least=1),
    ),
    Key("text", _FOUND, "The text before the first block, two characters a word.", required=True).takes(
        ["SunS"], Text(16)
    ),
    Key("at", _FOUND, "The addresses where it may stand, in the order of the search.", required=True).takes(
        [[40000, 0, 50000]], Items(ValueShape("An address.", [40000], Whole(), Text(40)), 1)
    ),
    Key(
        "then", _FOUND, "The words that each block starts with. The length counts the words after them.", required=True
    ).takes([["id", "length"]], Items(ValueShape("A word.", ["id"], one_of("id", "length")), 2)),
    Key("space", _FOUND, "The space of the blocks; `holding` by default.").takes(["input"], Text(40)),
    Key("end", _FOUND, "The id that ends the chain; FFFFh by default.").takes(["FFFFh"], Whole(0, 65535), Text(40)),
    Key("group", GROUP, NAME, required=True),
    Key("points", (GROUP, places.RECORD), "The points in the manual's order.", required=True).takes(
        [[{"name": "base_frequency", "at": "1028h"}]], Items(places.POINT.shape)
    ),
    Key("space", Places(GROUP, inherited=(GROUP,)), "The address space of the group's points.", required=True).takes(
        ["holding"], Text(40)
    ),
    Key("telegram", GROUP, "In the space `telegram`: the telegram whose words are the points.").takes(
        ["visualisation"], NAMED
    ),
    Key(
        "addressing", GROUP, "The formula of an address: of `number` (what `at` says), index, set, sets and indices."
    ).takes(["number * 64 + (index - 1) * sets + (set - 1)"], Text(200)),
    Key(
        "base",
        GROUP,
        "The base of the addresses: a formula of numbers under `given`. `at` and `addressing` are relative to it. "
        "With a `block`: the number of words after its start, a formula of points of the block that count.",
    ).takes(["slot * 1000"], Whole(), Text(200)),
    Key("block", GROUP, "The found block that the addresses count from, by its id: its first word is 0.").takes(
        [103], Whole(0, 65535), Text(40)
    ),
    Key("numbering", GROUP, "How the printed numbers follow from the address on the wire.").takes(
        [{"modicon": "wire + 1", "reference": "400000 + modicon"}],
        by(forms.NAME, ValueShape("A formula of `wire` or of a numbering above.", ["wire + 1"], Text(200))),
    ),
    Key("source", Places(GROUP, places.BUS, inherited=(GROUP,)), places.SOURCE.shape),
)
"""The keys at the top of a file: those of the device and of groups."""


def _listed(name: str, item: Place, meaning: str) -> Key:
    """Return the key of a list of such items in a file."""
    return Key(name, FILES, meaning).takes([item.shape.examples], Items(item.shape))


_WORD = ValueShape("A word.", ["Parameter"], Text(200))

SECTIONS = (
    Key("documents", DEVICE, "The manuals that the facts are taken from.", required=True).takes(
        [{"manual": {"title": "ModBus Netzwerk Kommunikation", "language": "de"}}],
        by(forms.NAME, _DOCUMENT.shape, least=1),
    ),
    Key("title", _DOCUMENT, "Its title.", required=True).takes(["ModBus Netzwerk Kommunikation"], Text(300)),
    Key("language", _DOCUMENT, "Its language, in two letters.", required=True).takes(["de"], Text(form=forms.LANGUAGE)),
    Key("file", _DOCUMENT, "The file that its text was extracted to.").takes(["hitachi_l200_modbus.txt"], Text(200)),
    Key("sha256", _DOCUMENT, "The checksum of that file.").takes(
        ["d36f991273b448ca6194f1f650c71ce801bb1611e731db2e4a367a2e9977df55"], Text(form=forms.SHA256)
    ),
    Key("edition", _DOCUMENT, "Its edition or date.").takes(["2003-11"], Text(80)),
    Key(
        "writes",
        _DOCUMENT,
        "For the audit: how the manual writes what a description writes otherwise (letters of codes, bits, numbers, "
        "titles, the `default`). An empty list: it does not print the title.",
    ).takes(
        [{"P": ["Parameter"], "15..8": ["Highbyte"], "0": ["Null"], "Basisfrequenz": ["Basisfrequ."], "Ausgang 2": []}],
        by(forms.WRITTEN, ValueShape("Its words.", [["Parameter"]], Items(_WORD))),
    ),
    Key("access", _DOCUMENT, "For the audit: how the manual prints each access.").takes(
        [{"r": ["R/O"], "rw": ["R/W"]}],
        by(
            forms.ACCESS,
            ValueShape("Its notations.", [["R/W"]], Items(ValueShape("A notation.", ["R/W"], Text(20)), least=1)),
        ),
    ),
    Key("names", _DOCUMENT, "For the audit: names with digits in them that are no facts.").takes(
        [["CRC-16", "RS485", "MICROMASTER 4"]], Items(ValueShape("A name.", ["CRC-16"], Text(80)))
    ),
    Key("variants", DEVICE, "What is chosen when a device object is made, by axis.").takes(
        [{"voltage": {"values": {"200V": {}, "400V": {}}}}], by(forms.NAME, _AXIS.shape)
    ),
    Key("title", (_AXIS, _VALUE, _GIVEN, _FOUND), TITLE),
    Key("values", _AXIS, "The values, by name.", required=True).takes(
        [{"200V": {"title": "200 V class"}}], by(forms.VARIANT_VALUE, _VALUE.shape, least=1)
    ),
    Key("parts", DEVICE, "The other files of the folder, in reading order.").takes(
        [["bus.yaml", "standard_a.yaml"]],
        Items(ValueShape("A file name.", ["bus.yaml"], Text(form=forms.PART_FILE)), 1),
    ),
    Key("units", FILES, "Units that are not shipped with the compiler, by symbol.").takes(
        [{"rpm": {"name": "revolution per minute", "quantity": "speed"}}], by(forms.ANY, _UNIT.shape)
    ),
    Key("name", _UNIT, "Its English name.", required=True).takes(["hertz"], Text(80)),
    Key("quantity", _UNIT, "What it measures.", required=True).takes(["frequency"], Text(80)),
    Key("enums", FILES, "Enums that several points share, by name.").takes(
        [{"contact": {"0": "open", "1": "closed"}}],
        by(
            forms.NAME,
            ValueShape(
                "Numbers with their names, in the manual's order.",
                [{"0": "keypad", "1": "terminal"}],
                by(forms.NUMBER, places.ENTRY.shape, least=1),
            ),
        ),
    ),
    Key("formats", FILES, "Meanings that points share, by name.").takes(
        [{"percent_tenth": {"unit": "%"}}], by(forms.NAME, places.FORMAT.shape)
    ),
    Key("records", FILES, "Groups of points that repeat together, by name.").takes(
        [{"trip": {"points": [{"name": "error", "at": "base"}]}}], by(forms.NAME, places.RECORD.shape)
    ),
    Key("bus", FILES, places.BUS.shape),
    _listed("telegrams", places.TELEGRAM, "The cyclic telegrams: layouts of words."),
    _listed("messages", places.MESSAGE, "The messages: layouts of the bytes of a frame."),
    _listed("commands", places.COMMAND, "The commands: what is written under a name."),
    _listed("frames", places.FRAME, "The worked examples of the manual."),
    _listed("errata", places.ERRATUM, "The places where the manual is wrong, unclear or silent."),
    _listed("looked_through", places.LOOKED_THROUGH, "Lines of the manual that hold no facts; the audit ignores them."),
)
"""The sections in which a file declares things."""


_QUANTITY = Place(before=(NUMBER,)).means("One quantity.", [{"start": 40, "unit": "%"}])
_MOVE = ValueShape("A move.", ["set 1 while external_trip == trip"], Text(2000))

MOVING = (
    Key("behaviour", BEHAVIOUR, "The device that it belongs to.", required=True).takes(["hitachi_l200"], A_NAME),
    Key(
        "plant",
        BEHAVIOUR,
        "Quantities that no point holds, by name: of the machine, its surroundings, or a state inside the device.",
    ).takes([{"load": {"start": 40, "unit": "%"}, "emergency_stop": 0}], by(forms.NAME, _QUANTITY.shape)),
    Key("start", _QUANTITY, "Its value when the simulation starts; 0 by default.").takes([40], NUMBER),
    Key("unit", _QUANTITY, "Its unit.").takes(["%"], Text(20)),
    Key("title", _QUANTITY, TITLE),
    Key(
        "start",
        BEHAVIOUR,
        "What points hold when the simulation starts, in the unit or as the name of an enum entry. Other points hold "
        "their default, or a plausible number.",
    ).takes(
        [{"F002": 10.0, "A001": "network"}],
        by(forms.ANY, ValueShape("The value in the unit, or a name.", [10.0], Text(80), NUMBER, BOOLEAN)),
    ),
    Key(
        "moves",
        BEHAVIOUR,
        "What points and quantities do, by name, code, or `point.flag`: one move or several. Of those whose condition "
        "holds (`while`), the first one counts; without one, the number stays. `when` happens once, each time that its "
        "condition becomes true.",
        required=True,
    ).takes(
        [
            {
                "output_frequency": "ramp to A020 at 10 Hz/s while run_command == run",
                "alarm": ["set 1 while external_trip == trip after 2 s", "set 0 while trip_reset == reset"],
                "trip_count": "set trip_count + 1 when alarm == tripped",
            }
        ],
        by(forms.ANY, ValueShape("What it does.", ["set load"], Text(2000), Items(_MOVE, 1)), least=1),
    ),
)
