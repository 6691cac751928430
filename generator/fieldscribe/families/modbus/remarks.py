"""Sentences about Modbus frames for people: names of their numbers, findings and notes."""

from __future__ import annotations

from dataclasses import astuple
from typing import TYPE_CHECKING

from fieldscribe.families.modbus.facts import FAMILY
from fieldscribe.families.modbus.functions import BROADCAST, SPACES, profile_of
from fieldscribe.text import line
from fieldscribe.wording import label
from fieldscribe.wording.buses import counted, numbered, spaced, span_text, strange_unit
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.families.directory import Directory
    from fieldscribe.families.modbus.functions import Profile
    from fieldscribe.families.modbus.requests import Request
    from fieldscribe.families.spoken import Span
    from fieldscribe.model import Device

_FUNCTIONS: Mapping[int, str] = {
    0x01: "read coils",
    0x02: "read discrete inputs",
    0x03: "read holding registers",
    0x04: "read input registers",
    0x05: "write one coil",
    0x06: "write one register",
    0x08: "loopback test",
    0x0F: "write several coils",
    0x10: "write several registers",
}
_EXCEPTIONS: Mapping[int, str] = {
    0x01: "illegal function",
    0x02: "illegal data address",
    0x03: "illegal data value",
    0x04: "device failure",
    0x05: "acknowledged, still working",
    0x06: "device busy",
    0x08: "memory parity error",
    0x0A: "gateway path unavailable",
    0x0B: "gateway target did not answer",
}


def function_text(function: int) -> str:
    """A function with its common name: `06h write one register`."""
    name = _FUNCTIONS.get(function)
    return f"{hex_text(function, 2)} {name}" if name else f"{hex_text(function, 2)} (not a function known here)"


def exception_text(device: Device, code: int) -> str:
    """The meaning of an exception, from the manual, else from the protocol."""
    own = numbered(device.bus.exceptions, code)
    if own is not None:
        return line(f"{hex_text(code, 2)} {own.name}: {own.title['en']}")
    common = _EXCEPTIONS.get(code)
    meaning = (
        f"{common} (the protocol's meaning; the manual does not list it)" if common else "the manual does not list it"
    )
    return f"{hex_text(code, 2)}: {meaning}"


def span_said(request: Request) -> str:
    """The addresses of a request in words: `holding 1013h to 1014h (4115 to 4116), 2 words`."""
    if request.function == 0x08:
        return f"sub-function {hex_text(request.address)}"
    space = next(name for name, space in SPACES.items() if request.function in astuple(space))
    where = span_text(request.address, request.address + request.count - 1)
    return f"{space} {where}, {counted(request.count, FAMILY.spaces[space])}"


def request_findings(device: Device, request: Request) -> Iterator[str]:
    """Why the device refuses a request."""
    profile = profile_of(device.bus)
    most = profile.most.get(request.function)
    if most is None:
        yield f"the device does not know function {hex_text(request.function, 2)}"
    elif request.count > most:
        yield f"the device takes at most {most} of them in one request"
    if request.unit == profile.broadcast:
        yield from _broadcast_findings(request.function, profile)
    elif strange := strange_unit(device.bus, request.unit):
        yield strange
    if request.address + request.count > 0x10000:
        yield "it reaches beyond the last address"


def request_notes(device: Device, directory: Directory, request: Request, span: Span) -> Iterator[str]:
    """What to know about a request, and what looks like a mistake."""
    if request.unit == profile_of(device.bus).broadcast and not any(request_findings(device, request)):
        yield "broadcast: no unit answers"
    if request.function != 0x08:
        yield from _off_by_one(directory, span)


def _broadcast_findings(function: int, profile: Profile) -> Iterator[str]:
    if function not in BROADCAST:
        yield "broadcast: only writes may be sent to all units"
    elif function not in profile.broadcasts:
        yield f"broadcast: the device does not take function {hex_text(function, 2)} so"


def manual_notes(device: Device, data: bytes) -> Iterator[str]:
    """A note for a frame that the manual prints with this very error."""
    for frame in device.frames:
        if frame.printed == data and not frame.valid:
            known = f" (errata: {', '.join(frame.errata)})" if frame.errata else ""
            right = spaced(frame.corrected)
            yield line(f"the manual prints exactly these bytes as {frame.name}{known}; right is {right}")
            return


def framing_finding(device: Device, framing: str) -> str:
    """The finding that the device does not use this framing; empty if it does."""
    known = device.bus.framings
    return "" if not known or framing in known else f"the manual knows only {' and '.join(known).upper()} frames"


def _off_by_one(directory: Directory, span: Span) -> Iterator[str]:
    """A note if no point stands at the address, but one stands just below: probably a Modicon number (from 1)."""
    if span.address == 0 or directory.starting_at(span.space, span.address):
        return
    for point, place in directory.starting_at(span.space, span.address - 1):
        if len(place.addresses) > span.count:
            continue
        keys = [key for key, number in place.references.items() if number == span.address]
        called = f"{span.address} is its {line(keys[0]).capitalize()} number; " if keys else ""
        below = hex_text(span.address - 1)
        yield (
            f"no point starts at {hex_text(span.address)}, but one less, {below}, is {label(point)}: {called}on "
            "the wire addresses count from 0, so this frame may be one too high"
        )
