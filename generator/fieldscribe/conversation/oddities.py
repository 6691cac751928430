"""What is odd about a frame, whatever its family: a foreign framing, an address that counts from 1, a misprint."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.spoken import Span
from fieldscribe.text import line
from fieldscribe.wording import label
from fieldscribe.wording.buses import spaced
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.families.directory import Directory
    from fieldscribe.families.spoken import Spoken
    from fieldscribe.model import Device


def findings(device: Device, spoken: Spoken) -> Iterator[str]:
    """The finding that the device does not use the framing."""
    known = device.bus.framings
    if known and spoken.heard.framing not in known:
        yield f"the manual knows only {' and '.join(known).upper()} frames"


def notes(device: Device, directory: Directory, spoken: Spoken) -> Iterator[str]:
    """Notes on what looks like a mistake."""
    for carried in spoken.carried:
        if spoken.asks is not None and isinstance(carried, Span):
            yield from _off_by_one(directory, carried)
    yield from _misprint(device, spoken.heard.data)


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


def _misprint(device: Device, data: bytes) -> Iterator[str]:
    """A note for a frame that the manual prints with this very error, where the bytes alone make the frame."""
    for frame in device.frames:
        if frame.printed == data and not frame.valid and frame.own is None:
            known = f" (errata: {', '.join(frame.errata)})" if frame.errata else ""
            right = spaced(frame.corrected)
            yield line(f"the manual prints exactly these bytes as {frame.name}{known}; right is {right}")
            return
