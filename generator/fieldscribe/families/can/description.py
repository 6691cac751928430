"""The keys that only this family has, and the text of a new description."""

from collections.abc import Collection

from fieldscribe.families.can.frames import LONGEST
from fieldscribe.language.keys import forms, places
from fieldscribe.language.keys.places import BUS, DIRECTION, FRAME, MESSAGE, NAMED
from fieldscribe.schema_types import Key, Text, ValueShape, Whole, by

_BITS = Whole(choices=(11, 29))

KEYS = (
    Key("identifier_bits", BUS, "CAN: how many bits the identifiers have.").takes([11], _BITS),
    Key(
        "direction",
        MESSAGE,
        "Who sends it: the master (request), the device when asked (response), the device by itself (cyclic).",
        required=True,
    ).takes(["request"], DIRECTION),
    Key("answers", MESSAGE, "The message that this one answers.").takes(["read_request"], NAMED),
    Key("can_id", MESSAGE, "The identifier: a number, or a number `+ unit`.").takes(
        ["33Fh", "320h + unit"], Whole(), Text(80)
    ),
    Key(
        "layout",
        MESSAGE,
        "What the bytes hold, by number: a constant, `unit`, `address`, `raw`, `multiplexer`, `telegram`, or "
        "`xor 0..5`, the high byte first. Without it the message holds signals.",
    ).takes(
        [{"0": "FFh", "1": "unit", "2..3": "address", "4..5": "raw", "6..7": "xor 0..5"}],
        by(forms.BITS, ValueShape("What these bytes hold.", ["FFh", "xor 0..5"], Whole(), Text(40)), least=1),
    ),
    Key("length", MESSAGE, "With signals: the number of bytes; 8 by default, more take CAN FD.").takes(
        [8], Whole(0, LONGEST)
    ),
    Key("identifier_bits", MESSAGE, "The bits of the identifier if they are not those of the bus.").takes([29], _BITS),
    Key("every", MESSAGE, "How often it is sent.").takes(["100 ms"], Text(40)),
    Key("pgn", MESSAGE, "J1939: the parameter group, in place of `can_id`.").takes(
        [61444, "0F004h"], Whole(), Text(40)
    ),
    Key("priority", MESSAGE, "J1939: the priority; 6 by default.", needs=("pgn",)).takes([3], Whole(0, 7)),
    Key("source_address", MESSAGE, "J1939: who sends it: a number, or `unit`; 0 by default.", needs=("pgn",)).takes(
        ["unit", 0], Whole(0, 255), Text(40)
    ),
    Key(
        "destination", MESSAGE, "J1939: who receives it, for groups below 0F000h; all by default.", needs=("pgn",)
    ).takes([3], Whole(0, 255)),
    Key("message", places.GROUP, "In the space `signal`: the message whose signals are the points.").takes(
        ["engine"], NAMED
    ),
    Key("can_id", FRAME, "CAN: the identifier of the frame.").takes(["33Fh"], Whole(), Text(40)),
)


SERVES = "messages on CAN: signals as CAN databases have them, J1939, or a maker's own layouts byte by byte"
_BUS = """\
bus: {bitrate: 125000, identifier_bits: 11, units: 0..30}
messages:
- name: read_request
  direction: request               # request (by the master), response, cyclic (by the device)
  can_id: 33Fh
  layout: {0: FFh, 1: unit, 2..3: address, 4..5: 0, 6..7: xor 0..5}
- name: read_answer
  direction: response
  answers: read_request
  can_id: 320h + unit
  layout: {0: FFh, 1: unit, 2..3: address, 4..5: raw, 6..7: xor 0..5}
"""
_WRITING = """\
- name: write_request
  direction: request
  can_id: 33Fh
  layout: {0: EEh, 1: unit, 2..3: address, 4..5: raw, 6..7: xor 0..5}
- name: write_answer
  direction: response
  answers: write_request
  can_id: 320h + unit
  layout: {0: EEh, 1: unit, 2..3: address, 4..5: raw, 6..7: xor 0..5}
"""
_FRAMES = """\
frames:                            # frames that the manual prints: each is compared with the messages and points
- {name: read_first, direction: request, can_id: 33Fh, bytes: FF 05 00 01 00 00 FF 04}
- {name: read_first_answer, direction: response, can_id: 325h, answers: read_first,
   bytes: FF 05 00 01 01 F4 FE F0, says: {first_value: 50.0}}
"""
DEVICE = _BUS + _FRAMES
GROUP = """\
group: main
title: {en: Main}
space: parameter                   # parameter, or telegram for the words of a cyclic message
access: r                          # r, w, rw, none; a point may say otherwise
source: {document: manual, section: "1"}
points:
- name: first_value                # replace it by the manual's first parameter
  title: {en: First value}
  at: 1                            # the id of the parameter
  range: 0..1000                   # raw, as it travels
  scale: value = raw * 0.1
  unit: "%"
"""


def bus_of(_spaces: Collection[str]) -> str:
    """Return the `bus` of a draft, with messages that read and write."""
    return _BUS + _WRITING
