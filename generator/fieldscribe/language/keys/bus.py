"""The keys under `bus`, and the keys of its codes."""

from fieldscribe.language.keys import forms
from fieldscribe.language.keys.places import BUS, CODE, LINES_OF, SEVERAL, WORD_ORDER
from fieldscribe.model import TYPES
from fieldscribe.schema_types import NUMBER, YES_NO, Items, Key, Place, Text, ValueShape, Whole, by

_BY_TYPE = Place()
_PRINTED = Place().means(
    "What the manual prints a second time: `bytes`, the largest amount of data; `answers` and `refusals`, if one "
    "list contradicts another.",
    [{"bytes": 8}],
)
_SETTING = ValueShape(
    "One setting.",
    [{"4": 4800}],
    Text(200),
    Whole(),
    Items(ValueShape("One choice.", [8], Text(80), Whole())),
    by(forms.ANY, ValueShape("What the code means.", [4800], Text(80), Whole())),
)
CODES = by(forms.NUMBER, CODE.shape, least=1)

KEYS = (
    Key("units", BUS, "The unit addresses that a device can have.", required=True).takes(["1..32"], Text(40)),
    Key("broadcast", BUS, "The unit address that means all devices.").takes([0], Whole(0, 255)),
    Key("bitrate", BUS, "CAN: the bit rate in bit/s.").takes([125000], Whole(1, 1_000_000_000)),
    Key("functions", BUS, "The function codes with their limits; for a USS drive the task ids, with 0.").takes(
        [{"03h": {"name": "read_holding_registers", "max": 4}}], CODES
    ),
    Key("exceptions", BUS, "The exception codes with their meanings.").takes(
        [{"21h": {"name": "value_out_of_range", "en": "Value out of range"}}], CODES
    ),
    Key("words", BUS, "The order of the words of a value that has several, for all types or by type.").takes(
        ["high first", {"f32": "low first"}], Text(form=forms.WORD_ORDER), _BY_TYPE
    ),
    Key("bytes", BUS, "The order of the two bytes in each word, for all types or by type.").takes(
        ["high first", {"f32": "low first"}], Text(form=forms.WORD_ORDER), _BY_TYPE
    ),
    *(
        Key(name, _BY_TYPE, "The order in points of this type.").takes(["low first"], WORD_ORDER)
        for name, info in TYPES.items()
        if info.bits >= 16
    ),
    Key("gaps", BUS, "Addresses that no request may touch, by space.").takes(
        [{"holding": ["0030h..08FFh"]}],
        by(
            forms.ANY,
            ValueShape(
                "Intervals of wire addresses.",
                [["0030h..08FFh"]],
                Items(ValueShape("One interval, or one address.", ["0030h..08FFh", 2000], Text(40), Whole()), 1),
            ),
        ),
    ),
    Key(
        "timing", BUS, "Times as the manual gives them. A number, and a time in ms or s at the start, are macros in C."
    ).takes(
        [{"silent_characters": 3.5, "response_delay": "0..1000 ms"}],
        by(forms.ANY, ValueShape("A time in words.", ["0..1000 ms"], Text(200), NUMBER)),
    ),
    Key("serial", BUS, "Settings of the serial line: lists of choices, or codes with their meanings.").takes(
        [{"baud": {"4": 4800}, "stop_bits": [1, 2]}], by(forms.ANY, _SETTING)
    ),
    Key(
        "lines",
        BUS,
        "For the audit: the lines of the manual's text with single facts of the bus, by their keys here, under "
        "`serial` and under `timing`.",
    ).takes([{"units": 32, "parity": 28}], by(forms.ANY, LINES_OF)),
    Key("max", CODE, "The largest count of items in one request.").takes([4], Whole(1, 2000)),
    Key(
        "broadcast",
        CODE,
        "Say `yes` if a function may be sent to all units at once; by default only 05h, 06h, 0Fh and 10h may.",
    ).takes(["no"], *YES_NO),
    Key(
        "answers",
        CODE,
        "USS: for a task the responses that it can get; for a response or an error the tasks that can get it.",
    ).takes([[1, 2, 14]], SEVERAL),
    Key("refusals", CODE, "USS: for a task the responses that refuse it.").takes([[1, 2, 14]], SEVERAL),
    Key("printed", CODE, _PRINTED.shape),
    Key("bytes", _PRINTED, "The most data bytes in one request, as printed.").takes([8], Whole(0, 1_000_000_000)),
    *(Key(name, _PRINTED, "The list as printed.").takes([[1, 2, 14]], SEVERAL) for name in ("answers", "refusals")),
)
