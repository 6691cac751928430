"""The keys that only this family has, and the text of a new description."""

from collections.abc import Collection

from fieldscribe.families.modbus import FAMILY
from fieldscribe.language.keys.places import BUS
from fieldscribe.schema_types import Items, Key, ValueShape, one_of

KEYS = (
    Key("framings", BUS, "The framings the device speaks (modbus).").takes(
        [["rtu"]], Items(ValueShape("One framing.", ["rtu"], one_of(*FAMILY.framings)), 1)
    ),
    Key("pad_coil_bytes", BUS, "Function 0Fh carries an even number of data bytes.").takes(["even"], one_of("even")),
)


SERVES = "registers and coils, over RTU or TCP"
DEVICE = """\
bus:
  framings: [rtu]                  # rtu, tcp, or both
  units: 1..247
  functions:                       # what the device answers, with the most words (or bits) of one request
    03h: {name: read_holding_registers, max: 125}
    06h: write_register
frames:                            # requests and answers that the manual prints: each is compared with the points
- {name: read_first, direction: request, bytes: 01 03 00 00 00 01 84 0A}
- {name: read_first_reply, answers: read_first, bytes: 01 03 02 01 F4 B8 53, says: {first_value: 50.0}}
"""
GROUP = """\
group: main
title: {en: Main}
space: holding                     # holding, input, coil, discrete
access: rw                         # r, w, rw, none; a point may say otherwise
source: {document: manual, section: "1"}
points:
- name: first_value                # replace it by the manual's first row
  title: {en: First value}
  at: 0000h                        # the address on the wire
  range: 0..1000                   # raw, as it travels
  scale: value = raw * 0.1
  unit: "%"
"""

_FUNCTIONS = {
    "coil": ("01h: read_coils", "05h: write_coil", "0Fh: write_coils"),
    "discrete": ("02h: read_discrete_inputs",),
    "holding": ("03h: read_holding_registers", "06h: write_register", "10h: write_registers"),
    "input": ("04h: read_input_registers",),
}


def bus_of(spaces: Collection[str]) -> str:
    """Return the `bus` of a draft, with the functions that reach points of these spaces."""
    wanted = _FUNCTIONS.keys() & spaces or {"holding"}
    functions = sorted(line for space in wanted for line in _FUNCTIONS[space])
    return "\n".join(
        ("bus:", "  framings: [rtu]", "  units: 1..247", "  functions:", *(f"    {line}" for line in functions))
    )
