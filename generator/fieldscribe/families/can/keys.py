"""The keys that only this family has."""

from __future__ import annotations

from fieldscribe.kinds import Key, Shape, Text, Whole, by
from fieldscribe.language.keys import forms
from fieldscribe.language.keys.places import BUS, FRAME, MESSAGE
from fieldscribe.language.keys.shapes import DIRECTION, NAMED

KEYS = (
    Key("identifier_bits", BUS, "CAN: how many bits the identifiers have.", [11], Whole(choices=(11, 29))),
    Key(
        "direction",
        MESSAGE,
        "Who sends it: the master (request), the device when asked (response), the device by itself (cyclic).",
        ["request"],
        DIRECTION,
        required=True,
    ),
    Key("answers", MESSAGE, "The message that this one answers.", ["read_request"], NAMED),
    Key(
        "can_id",
        MESSAGE,
        "The identifier: a number, or a number `+ unit`.",
        ["33Fh", "320h + unit"],
        Whole(),
        Text(80),
        required=True,
    ),
    Key(
        "layout",
        MESSAGE,
        "What the bytes hold, by number: a constant, `unit`, `address`, `raw`, `multiplexer`, `telegram`, or "
        "`xor 0..5`, the high byte first.",
        [{"0": "FFh", "1": "unit", "2..3": "address", "4..5": "raw", "6..7": "xor 0..5"}],
        by(forms.BITS, Shape("What these bytes hold.", ["FFh", "xor 0..5"], Whole(), Text(40)), least=1),
        required=True,
    ),
    Key("can_id", FRAME, "CAN: the identifier of the frame.", ["33Fh"], Whole(), Text(40)),
)
