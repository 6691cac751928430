"""Warnings about frames that all families share: a foreign framing, an address that counts from 1, a misprint."""

from __future__ import annotations

from collections.abc import Iterator

from fieldscribe.families.decoded_frame import DecodedFrame, Span
from fieldscribe.families.directory import Directory
from fieldscribe.model import Device, Frame
from fieldscribe.text import line
from fieldscribe.wording import label
from fieldscribe.wording.exact import hex_text
from fieldscribe.wording.frames import spaced


class FrameWarnings:
    """Finds what looks like a mistake in frames of one device."""

    def __init__(self, device: Device, directory: Directory) -> None:
        self._framings = device.bus.framings
        self._directory = directory
        misprinted = (frame for frame in reversed(device.frames) if not frame.valid and frame.family_facts is None)
        self._misprints = {frame.printed: frame for frame in misprinted}

    def findings(self, decoded: DecodedFrame) -> tuple[str, ...]:
        """Return the finding that the device does not use the framing, if so."""
        known = self._framings
        if not known or decoded.result.framing in known:
            return ()
        return (f"the manual knows only {' and '.join(known).upper()} frames",)

    def notes(self, decoded: DecodedFrame) -> tuple[str, ...]:
        """Return notes on what may be a mistake."""
        spans = [content for content in decoded.contents if isinstance(content, Span)] if decoded.request else []
        misprint = self._misprints.get(decoded.result.data)
        notes = [note for span in spans for note in _off_by_one(self._directory, span)]
        return (*notes, _misprint_text(misprint)) if misprint is not None else tuple(notes)


def _off_by_one(directory: Directory, span: Span) -> Iterator[str]:
    """Return a note if a point starts one below the address, and none at it: probably a Modicon number (from 1)."""
    if span.address == 0 or directory.starting_at(span.space, span.address):
        return
    for point, place in directory.starting_at(span.space, span.address - 1):
        if len(place.addresses) > span.count:
            continue
        keys = [key for key, number in place.references.items() if number == span.address]
        named = f"{span.address} is its {line(keys[0]).capitalize()} number; " if keys else ""
        below = hex_text(span.address - 1)
        yield (
            f"no point starts at {hex_text(span.address)}, but one less, {below}, is {label(point)}: {named}on "
            "the wire addresses count from 0, so this frame may be one too high"
        )


def _misprint_text(frame: Frame) -> str:
    """Return the note for a frame that the manual prints with this very error."""
    known = f" (errata: {', '.join(frame.errata)})" if frame.errata else ""
    return line(f"the manual prints exactly these bytes as {frame.name}{known}; right is {spaced(frame.corrected)}")
