"""The keys that only this family has."""

from __future__ import annotations

from fieldscribe.families.modbus.facts import FAMILY
from fieldscribe.kinds import Items, Key, Shape, one_of
from fieldscribe.language.keys.places import BUS

KEYS = (
    Key(
        "framings",
        BUS,
        "The framings the device speaks (modbus).",
        [["rtu"]],
        Items(Shape("One framing.", ["rtu"], one_of(*FAMILY.framings)), 1),
    ),
    Key("pad_coil_bytes", BUS, "Function 0Fh carries an even number of data bytes.", ["even"], one_of("even")),
)
