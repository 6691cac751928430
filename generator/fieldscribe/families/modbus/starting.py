"""What a new description says of the bus, until somebody looks it up."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection

_FUNCTIONS = {
    "coil": ("01h: read_coils", "05h: write_coil", "0Fh: write_coils"),
    "discrete": ("02h: read_discrete_inputs",),
    "holding": ("03h: read_holding_registers", "06h: write_register", "10h: write_registers"),
    "input": ("04h: read_input_registers",),
}


def bus_of(spaces: Collection[str]) -> list[str]:
    """The lines below `bus`, with the functions that reach points of these spaces."""
    wanted = _FUNCTIONS.keys() & spaces or {"holding"}
    functions = sorted(line for space in wanted for line in _FUNCTIONS[space])
    return ["framings: [rtu]", "units: 1..247", "functions:", *(f"  {line}" for line in functions)]
