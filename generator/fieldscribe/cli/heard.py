"""Prints decoded frames one by one, in each of the forms that `decode` has."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from functools import lru_cache
from json.encoder import encode_basestring_ascii
from typing import TYPE_CHECKING, Protocol

from fieldscribe.cli.terminal import is_coloured, print_lines, print_rows
from fieldscribe.families.decoded_frame import BoundedMemo
from fieldscribe.families.frame_results import Item, bits_label
from fieldscribe.report import visible
from fieldscribe.wording.buses import spaced

if TYPE_CHECKING:
    from fieldscribe.families.frame_results import FrameResult
    from fieldscribe.model import Device

_MOST_LABELS = 256
"""How many labels of rows are remembered."""
_STEP = 2
"""How far each depth of JSON stands in."""


class Shown(Protocol):
    """Prints what has been heard."""

    def __init__(self, device: Device) -> None: ...

    def frame(self, heard: FrameResult) -> None:
        """Print the next frame."""

    def end(self) -> None:
        """Print what belongs behind the last frame."""


def shown_as(form: str, device: Device) -> Shown:
    """What prints frames of the device as `text`, `json` or `jsonl`."""
    kinds: dict[str, type[Shown]] = {"text": _Text, "json": _Json, "jsonl": _JsonLines}
    return kinds[form](device)


class _Text:
    """Frames as rows of label and text; the labels of all frames have the same width, so that streams line up."""

    def __init__(self, device: Device) -> None:
        places = {bits_label(flag.low + flag.width - 1, flag.low) for point in device.points for flag in point.flags}
        width = max(map(len, places | {"Checksum"}))
        self._margins: BoundedMemo[str, str] = BoundedMemo(_MOST_LABELS, lambda label: f"\n  {label:<{width}}  ")
        self._coloured = is_coloured(sys.stdout)
        self._between = ""

    def frame(self, heard: FrameResult) -> None:
        heading = spaced(heard.data) if heard.captured is None else visible(heard.captured.text)
        rows = _rows(heard)
        if self._coloured:
            sys.stdout.write(self._between)
            print_rows(heading, rows)
        else:
            margins = self._margins
            lines = [margins[label] + text for label, text in rows]
            sys.stdout.write(f"{self._between}{heading}{''.join(lines)}\n")
        self._between = "\n"

    def end(self) -> None:
        if not self._between:
            print_lines([[("", "no frame of that unit")]])


def _rows(heard: FrameResult) -> list[tuple[str, str]]:
    rows = [("Frame", visible(heard.summary))]
    for item in heard.items:
        rows.append(("Says", visible(item.summary)))
        if item.bit_texts:
            rows += [bits.row for bits in item.flags]
    if heard.checks:
        rows.append(("Header" if heard.framing == "tcp" else "Checksum", visible(heard.checks)))
    rows += [("Wrong", visible(fault)) for fault in (*heard.faults, *heard.findings)]
    return rows + [("Note", visible(note)) for note in heard.notes]


class _JsonLines:
    def __init__(self, device: Device) -> None:
        self._device = device.id

    def frame(self, heard: FrameResult) -> None:
        sys.stdout.write(f"{json.dumps({'device': self._device, **heard.as_data()})}\n")

    def end(self) -> None:
        """A line is whole by itself."""


class _Json:
    """One object with all frames, written as they come: it is whole when the last frame has come."""

    def __init__(self, device: Device) -> None:
        self._device = device.id
        self._before = ""

    def frame(self, heard: FrameResult) -> None:
        begin = self._before or f'{{\n  "device": {json.dumps(self._device)},\n  "frames": ['
        sys.stdout.write(f"{begin}\n    {_indented({**heard.as_data(), 'items': heard.items}, 2 * _STEP)}")
        self._before = ","

    def end(self) -> None:
        if self._before:
            sys.stdout.write("\n  ]\n}\n")
        else:
            sys.stdout.write(json.dumps({"device": self._device, "frames": []}, indent=2) + "\n")


def _indented(value: object, depth: int) -> str:
    """JSON as `json.dumps` indents it, whose code for that is slow; what items say is remembered."""
    if isinstance(value, str):
        return encode_basestring_ascii(value)
    if isinstance(value, Item):
        return _item_text(value, depth)
    if not value or not isinstance(value, Mapping | list | tuple):
        return json.dumps(value)
    margin = "\n" + " " * (depth + _STEP)
    if isinstance(value, Mapping):
        parts = [f"{encode_basestring_ascii(key)}: {_indented(part, depth + _STEP)}" for key, part in value.items()]
        return f"{{{margin}{f',{margin}'.join(parts)}{margin[:-_STEP]}}}"
    parts = [_indented(part, depth + _STEP) for part in value]
    return f"[{margin}{f',{margin}'.join(parts)}{margin[:-_STEP]}]"


@lru_cache(maxsize=4096)
def _item_text(item: Item, depth: int) -> str:
    return _indented(item.as_data(), depth)
