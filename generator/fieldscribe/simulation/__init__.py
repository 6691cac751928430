"""Simulated devices: made from the model alone, they hold numbers, obey the rules of the manual and answer a bus.

    layout      which words of which area each point takes, found chains laid out: one for all devices of a kind
    memory      the words of one device, with a plausible number for each point at the start, and the values by name
    device      a memory with the rules: access, ranges, conditions, commands, what survives a restart; and its clock
    faults      what can happen to an answer on its way
    line        devices that share a line: requests in, answers with faults and delays out, and the trace; and what the
                part `simulation` of a family offers for that
    servers     sockets, serial lines and CAN buses around a line
    bench       lines with their devices, made from a file, the command line or a test; what a person may say to them
    library     `simulated("hitachi_l200")`, for tests

A behaviour file moves the numbers: `behaviour` implements `device.Behaviour`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fieldscribe.simulation.library import Simulated as Simulated
    from fieldscribe.simulation.library import simulated as simulated


def __getattr__(name: str) -> Any:
    """Return what tests use, imported on first use: `check` reads behaviour files without servers."""
    if name not in ("Simulated", "simulated"):
        raise AttributeError(name)
    from fieldscribe.simulation import library

    return getattr(library, name)
