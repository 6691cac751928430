"""The keys under `bus` and of its codes, and those of telegrams, messages, commands, worked examples and errata."""

from fieldscribe.families import families
from fieldscribe.language.keys import forms
from fieldscribe.language.keys.places import (
    BUS,
    CODE,
    COMMAND,
    DIRECTION,
    ERRATUM,
    FRAME,
    LINE_OR_LINES,
    LINES_OF,
    LOOKED_THROUGH,
    NAMED,
    PRINTED_NUMBER,
    SEVERAL,
    STEP,
    TELEGRAM,
    WORD_ORDER,
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
    Text,
    ValueShape,
    Whole,
    by,
    one_of,
)

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
_BY_POINT = by(
    forms.ANY, ValueShape("The value in the unit, or the name of an enum entry.", [50.0], Text(80), NUMBER, BOOLEAN)
)
"""Values by point, as a worked example or a step gives them."""
_PRINTED_VALUE = (Text(), NUMBER, Items(PRINTED_NUMBER), NOTHING)

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
    Key(
        "direction",
        TELEGRAM,
        "Who sends it: the master (`request`), the device in answer (`response`), or the device by itself (`cyclic`).",
        required=True,
    ).takes(["cyclic"], DIRECTION),
    Key("length", TELEGRAM, "The number of its words.", required=True).takes([69], Whole(1, 65536)),
    Key("message", TELEGRAM, "The message whose frames carry its words.").takes(["visualisation"], NAMED),
    Key("space", (COMMAND, STEP), "The address space.").takes(["holding"], Text(40)),
    Key("at", (COMMAND, STEP), "The address on the wire; of the first word.").takes(["0900h"], Whole(), Text(64)),
    Key("function", (COMMAND, STEP), "The function code that writes it.").takes(["06h"], Whole(), Text(20)),
    Key("value", COMMAND, "The constant, or `any`.").takes(["any", 1], Whole(), Text(64)),
    Key("wears", COMMAND, "How many such writes the memory survives.").takes([100000], Whole(1, 1_000_000_000)),
    Key("busy", COMMAND, "The point that says that the command is still running.").takes(["writing_data"], Text(80)),
    Key(
        "run",
        COMMAND,
        "When clients carry out the steps: `first` (before all else), `before write` (of any point), `every 10 s`, or "
        "`by caller` (the default). Only the first two need no call.",
        needs=("steps",),
    ).takes(["first", "every 10 s"], Text(form=forms.RUN)),
    Key(
        "arguments",
        COMMAND,
        "The numbers that the caller chooses, by name, each with its range.",
        needs=("steps",),
    ).takes(
        [{"unit": "1..32"}],
        by(forms.NAME, ValueShape("The least and the greatest number.", ["1..32"], Text(64), Whole())),
    ),
    Key("steps", COMMAND, "Requests in order, in place of `at`, `function` and `value`.").takes(
        [[{"at": 4104, "words": ["unit", 2, "65535 - unit"]}, {"wait": {"result": 0}, "within": "2 s"}]],
        Items(STEP.shape, 1),
    ),
    Key(
        "write",
        STEP,
        "Values to write, by point: as under `says` of a worked example. Points of one step follow each other. A raw "
        "number may be a formula of arguments.",
    ).takes([{"A020": 50.0}, {"slave.raw": "unit"}], _BY_POINT),
    Key(
        "words",
        STEP,
        "The words (or bits) to write at `at`: numbers, and formulas of one argument each.",
        needs=("at",),
    ).takes(
        [["unit", 2, "65535 - unit"]],
        Items(ValueShape("A number, or a formula of an argument.", ["65535 - unit", 2], Whole(), Text(200)), 1),
    ),
    Key("wait", STEP, "Values that points must reach before the next step.", needs=("within",)).takes(
        [{"result": 0}], _BY_POINT
    ),
    Key("within", STEP, "The longest time to wait.", needs=("wait",)).takes(["2 s"], Text(form=forms.TIME)),
    Key("when", STEP, "The step is skipped if this is false: a condition, written like `when` of a point.").takes(
        ["unit_mode == celsius"], Text(500)
    ),
    Key(
        "framing",
        FRAME,
        "The framing; by default `can`, `uss`, or for Modbus the first one of the device. For USS also the words of "
        "one part alone: `pkw`, `pzd`, or `broadcast` (mask words, then process data).",
    ).takes(["rtu"], one_of(*(way for bus_family in families() for way in bus_family.framings))),
    Key("direction", FRAME, "Who sends it; `answers` makes it a response.").takes(["request"], DIRECTION),
    Key("answers", FRAME, "The request that this response answers.").takes(["write_base_frequency"], NAMED),
    Key("bytes", FRAME, "The bytes as printed, in hexadecimal.", required=True).takes(
        ["05 06 10 28 01 F4 0C 91"], Text(1200, forms.BYTES)
    ),
    Key("says", FRAME, "What the frame means: values by point (code or name), or raw numbers (`P0700.raw: 2`).").takes(
        [{"A020": 50.0}], _BY_POINT
    ),
    Key("with", FRAME, "The values of other points that values under `says` depend on, by point.").takes(
        [{"P2000": 50.0, "P2009": 0}], _BY_POINT
    ),
    Key("error", FRAME, "The exception code or error value of an answer that refuses.").takes([17], Whole(0, 65535)),
    Key("id", ERRATUM, "A name that is never reused.", required=True).takes(["f004_wire_decimal"], Text(80, forms.ID)),
    Key("point", ERRATUM, "The point that it is about, by code or name.").takes(["F004"], Text(80)),
    Key("points", ERRATUM, "The points that it is about.").takes(
        [["A061", "A261"]], Items(ValueShape("Code or name.", ["A061"], Text(80)), 1)
    ),
    Key("flag", ERRATUM, "The flag of the point that it is about.").takes(["ready"], NAMED),
    Key("frame", ERRATUM, "The worked example that it is about.").takes(["write_base_frequency"], NAMED),
    Key("function", ERRATUM, "The function code that it is about.").takes(["03h"], Text(), Whole()),
    Key("response", ERRATUM, "The response id that it is about.").takes([3], Text(), Whole()),
    Key("exception", ERRATUM, "The exception or error value that it is about.").takes([106], Text(), Whole()),
    Key("message", ERRATUM, "The message that it is about.").takes(["read_request"], NAMED),
    Key("telegram", ERRATUM, "The telegram that it is about.").takes(["visualisation"], NAMED),
    Key("where", ERRATUM, "Any other subject, in words.").takes(["table of coils"], Text(200)),
    Key(
        "printed", ERRATUM, "What is printed: keys of `printed` with the wrong values, or a sentence.", required=True
    ).takes(
        [{"wire": 4219}, "no address"],
        Text(1000),
        by(forms.ANY, ValueShape("The printed value.", [4219], *_PRINTED_VALUE), least=1),
    ),
    Key(
        "taken", ERRATUM, "What was taken instead: the same keys with the right values, or a sentence.", required=True
    ).takes(
        [{"wire": 4119}, "documented only"],
        Text(1000),
        by(forms.ANY, ValueShape("The value taken.", [4119], *_PRINTED_VALUE), least=1),
    ),
    Key("why", ERRATUM, "Why it was taken.", required=True).takes(["Both neighbours say so."], Text(2000)),
    Key("certainty", ERRATUM, "How sure that is: `certain`, `likely` or `unknown`.", required=True).takes(
        ["certain"], one_of("certain", "likely", "unknown")
    ),
    Key(
        "leaves_open",
        ERRATUM,
        "What the manual leaves open, by the key of the fact: the rest of a sentence that begins with `the manual "
        "leaves open`. Code and documentation say it beside the fact. Required if `certainty` is `unknown`.",
    ).takes(
        [{"range": "whether 5 may be written in a 200 V unit"}],
        by(forms.NAME, ValueShape("What is open.", ["whether 5 may be written in a 200 V unit"], Text(200)), least=1),
    ),
    Key("document", (ERRATUM, LOOKED_THROUGH), "The document, if it is not the first one.").takes(["manual"], Text()),
    Key("line", ERRATUM, "The line in the text extracted from the manual, or several as `780..790`.").takes(
        [780, "2553..2652"], *LINE_OR_LINES
    ),
)
