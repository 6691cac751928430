"""Prints decoded frames one by one, in each format of `decode`."""

from __future__ import annotations

import json
import sys
from typing import Protocol

from fieldscribe.cli.terminal import print_rows
from fieldscribe.families.frame_results import FrameResult, bits_label
from fieldscribe.model import Device
from fieldscribe.report import visible
from fieldscribe.wording.frames import spaced


class FramePrinter(Protocol):
    """Prints frames in one format."""

    def __init__(self, device: Device) -> None: ...

    def frame(self, result: FrameResult) -> None:
        """Print the next frame."""

    def end(self, nothing: str) -> None:
        """Print what follows the last frame; `nothing` says in words that there was no frame."""


def frame_printer(form: str, device: Device) -> FramePrinter:
    """Return the printer of a format: `text`, `json` or `jsonl`."""
    printers: dict[str, type[FramePrinter]] = {"text": _TextPrinter, "json": _JsonPrinter, "jsonl": _JsonLinesPrinter}
    return printers[form](device)


class _TextPrinter:
    """Prints rows of label and text; the labels of all frames have the same width, so that streams line up."""

    def __init__(self, device: Device) -> None:
        labels = {bits_label(flag.low + flag.width - 1, flag.low) for point in device.points for flag in point.flags}
        self._width = max(map(len, labels | {"Checksum"}))
        self._separator = ""

    def frame(self, result: FrameResult) -> None:
        heading = spaced(result.data) if result.captured is None else visible(result.captured.text)
        sys.stdout.write(self._separator)
        print_rows(heading, _rows(result), width=self._width)
        self._separator = "\n"

    def end(self, nothing: str) -> None:
        if not self._separator:
            sys.stdout.write(f"{nothing}\n")


def _rows(result: FrameResult) -> list[tuple[str, str]]:
    rows = [("Frame", visible(result.summary))]
    for item in result.items:
        rows.append(("Says", visible(item.summary)))
        if item.bit_texts:
            rows += [bits.row for bits in item.flags]
    if result.checks:
        rows.append(("Header" if result.framing == "tcp" else "Checksum", visible(result.checks)))
    rows += [("Wrong", visible(fault)) for fault in (*result.faults, *result.findings)]
    return rows + [("Note", visible(note)) for note in result.notes]


class _JsonLinesPrinter:
    """Prints one object a line for each frame."""

    def __init__(self, device: Device) -> None:
        self._device = device.id

    def frame(self, result: FrameResult) -> None:
        sys.stdout.write(f"{json.dumps({'device': self._device, **result.as_data()})}\n")

    def end(self, nothing: str) -> None:
        """Print nothing: each line is whole."""


class _JsonPrinter:
    """Prints one object with all frames, each as it comes; the object is whole after the last frame."""

    def __init__(self, device: Device) -> None:
        self._device = device.id
        self._separator = ""

    def frame(self, result: FrameResult) -> None:
        begin = self._separator or f'{{\n  "device": {json.dumps(self._device)},\n  "frames": ['
        frame = json.dumps(result.as_data(), indent=2).replace("\n", "\n    ")
        sys.stdout.write(f"{begin}\n    {frame}")
        self._separator = ","

    def end(self, nothing: str) -> None:
        del nothing  # the list of frames is empty then
        if self._separator:
            sys.stdout.write("\n  ]\n}\n")
        else:
            sys.stdout.write(json.dumps({"device": self._device, "frames": []}, indent=2) + "\n")
