"""Simulated devices, made from the model alone: they hold numbers, obey the rules of the manual and answer on a bus.

layout      the words of each point by area, with found chains laid out: once for all devices of a kind
memory      the words of one device, at first a plausible number for each point; and the values by name
device      a memory with the rules: access, ranges, conditions, commands, what survives a restart; and its clock
line        devices that share a line: requests in, answers with faults and delays out, and the trace; and the
            interface of a family's module `simulation`
servers     sockets, serial lines and CAN buses for a line; `simulated("hitachi_l200")`, for tests
bench       lines with their devices, from a file, the command line or a test; and the console's commands

A behaviour file changes the numbers over time: `behaviour_file` reads its rules, and `behaviour` applies them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fieldscribe.simulation.servers import Simulated as Simulated
    from fieldscribe.simulation.servers import simulated as simulated


def __getattr__(name: str) -> Any:
    """Import what tests use on first use: `check` reads behaviour files without servers."""
    if name not in ("Simulated", "simulated"):
        raise AttributeError(name)
    from fieldscribe.simulation import servers

    return getattr(servers, name)
