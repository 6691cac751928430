"""`fieldscribe decode` and `encode`: frames into meaning, values into raw numbers and frames."""

from __future__ import annotations

import gc
import json
import sys
from argparse import ArgumentParser, Namespace
from codecs import BOM_UTF8
from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from io import BufferedIOBase
from itertools import groupby
from typing import cast

from fieldscribe.cli.common import (
    StopError,
    add_device,
    add_format,
    add_repeated,
    open_device,
    print_json,
    usage_error,
)
from fieldscribe.cli.frame_options import add_family_options, add_framing, add_with, options_of, placed, settings_of
from fieldscribe.cli.terminal import FINDINGS, FINE, USAGE, collect_rarely, print_lines, row_writer
from fieldscribe.conversation.decoder import StreamDecoder, frame_decoder
from fieldscribe.conversation.encoding import Encoded, encode_point, frames_for
from fieldscribe.conversation.selection import choose_point
from fieldscribe.diagnostics import RefusedError, UnclearError, visible
from fieldscribe.families.frame_results import BuiltFrames, FrameResult, Options, bits_label
from fieldscribe.model import Device
from fieldscribe.wording.numbers import spaced

DECODE_EXAMPLE = """examples:
  fieldscribe decode hitachi_l200 "05 06 10 28 01 F4 0C 91"
  fieldscribe decode hitachi_l200 0801000600051C91 --format json
  fieldscribe decode hitachi_l200 "08 01 01 17 12 1A" --request "08 01 00 06 00 05 1C 91"
  fieldscribe decode woodward_mpu2s 321#DD00051513880064 321#DD010302000007D0
  fieldscribe decode woodward_mpu2s "DD 00 05 15 13 88 00 64" --can-id 321
  fieldscribe decode woodward_mpu2s --log candump.log
  fieldscribe decode hitachi_l200 --log gateway.log    (what the Python or Rust package logs)
  candump -L can0 | fieldscribe decode woodward_mpu2s - --format jsonl
  fieldscribe decode siemens_mm4 "02 0E 01 143A 0000 0000 0000 047F 3333 58"
  fieldscribe decode siemens_mm4 --framing pkw "143A 0000 0000 0000" "243A 0000 4248 0000"
  fieldscribe decode siemens_mm4 --framing pzd --direction response "FA31 0000"

A FRAME argument holds one frame, or several whole frames in a row. A reply is decoded with the request before it.
A stream is decoded line by line as it arrives. --format json prints one object, which is whole after the last frame;
--format jsonl prints one object for each frame.

ends with 0 when no frame is wrong; notes do not count, and neither do raw numbers in replies: a device may send any
ends with 1 when a frame
  - is damaged or foreign (length, checksum, header), or does not answer the request before it
  - asks for what the device does not have: unit, function, task, count, multiplexer, address
  - writes what the device does not accept: out of range, read only, or against bits that are always written
ends with 2 when a line of a stream is not a frame; the other lines are decoded"""

_MOST_MESSAGES = 10
"""The most lines without a frame that get a message each."""
_LONGEST_LINE = 1 << 16
"""The most bytes of a line that are read; a longer line ends in dots and so is not a frame."""


def add_decode_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add_device(parser)
    add(
        "frames",
        nargs="*",
        metavar="FRAME",
        help='bytes in hexadecimal: "05 06 10 28", 05061028, 0x05,0x06, 05:06; CAN: 321#DD00, lines of candump; '
        "- reads frames from standard input, one a line",
    )
    add_repeated(parser, "--log", "FILE", "read frames from a file, one a line")
    add("--request", metavar="FRAME", help="the request that the frames answer")
    add_framing(parser, "rtu or tcp by the bytes; uss")
    add("--unit", type=int, metavar="N", help="only frames to or from this unit")
    add_family_options(parser, "decode")
    add_with(parser)
    add(
        "-v",
        "--verbose",
        action="store_true",
        help="say which numbers are out of range, and which other readings are not",
    )
    add_format(parser, ("jsonl",), "; json is one object, jsonl one object a line")


def run_decode(arguments: Namespace) -> int:
    """Decode and print frames; return the exit code."""
    if not arguments.frames and not arguments.log:
        raise StopError("there is nothing to decode", "give frames, - for standard input, or --log FILE")
    device = placed(open_device(arguments), arguments)
    options = options_of(device, arguments)
    settings = settings_of(device, arguments)
    decoder = StreamDecoder(device, settings, frame_decoder(device, options), doubting=arguments.verbose)
    output = _Output(decoder, _PRINTERS[arguments.format](device), arguments.unit)
    requests = decoder.requests(options)
    for is_input, frames in groupby(arguments.frames, key=lambda word: word == "-"):
        output.follow_input() if is_input else output.print([*requests, *decoder.pasted(list(frames))])
        requests = []
    output.print(requests)
    for name in arguments.log:
        with open(name, "rb") as log:
            output.follow(log, name)
    return output.end()


class _Output:
    """Prints decoded frames as they come, and records what decides the exit code."""

    def __init__(self, decoder: StreamDecoder, printer: _Printer, unit: int | None) -> None:
        self._decoder = decoder
        self._printer = printer
        self._unit = unit
        self._wrong = False
        self._unread = 0

    def print(self, frames: Iterable[FrameResult]) -> None:
        """Print the frames that are to or from the chosen unit."""
        for frame in frames:
            if self._unit is None or frame.unit == self._unit:
                self._printer.frame(frame)
                self._wrong = self._wrong or frame.wrong

    def follow_input(self) -> None:
        """Decode the lines of standard input."""
        if sys.stdin is None:
            raise StopError("standard input is closed", "give frames, or --log FILE")
        self.follow(cast("BufferedIOBase", sys.stdin.buffer), "standard input")

    def follow(self, stream: BufferedIOBase, name: str) -> None:
        """Decode the lines of a stream, and print each before waiting for the next; skip lines without a frame."""
        collect_rarely()
        for number, text in enumerate(_lines(stream), 1):
            try:
                self.print(self._decoder.pasted([text]) if text else ())
            except UnclearError as error:
                self._unread += 1
                if self._unread <= _MOST_MESSAGES:
                    usage_error(f"{name}:{number}: {error.message}", error.hint if self._unread == 1 else "")
        gc.disable()

    def end(self) -> int:
        """Print the end of the output and return the exit code."""
        self._printer.end("no frame" if self._unit is None else "no frame of that unit")
        if self._unread > _MOST_MESSAGES:
            usage_error(f"{self._unread - _MOST_MESSAGES} more lines are no frames")
        return USAGE if self._unread else FINDINGS if self._wrong else FINE


def _lines(stream: BufferedIOBase) -> Iterator[str]:
    """Yield the lines of a stream without their blanks, in constant memory; print what is due before waiting."""
    rest, chunk = b"", b"\n"
    while chunk:
        sys.stdout.flush()
        chunk = stream.read1(_LONGEST_LINE)
        *lines, rest = (rest + chunk).split(b"\n")
        if not chunk and rest:
            lines, rest = [rest], b""
        for line in lines:
            text = line[:_LONGEST_LINE].removeprefix(BOM_UTF8).decode("utf-8", "replace").strip()
            yield text if len(line) <= _LONGEST_LINE else f"{text}..."
        rest = rest[: _LONGEST_LINE + 1]


class _Printer:
    """Prints frames as rows of label and text. The labels of all frames have the same width, so streams line up."""

    def __init__(self, device: Device) -> None:
        flags = [(flag, point.bits[1] if point.bits else 0) for point in device.points for flag in point.flags]
        labels = {bits_label(lowest + flag.low + flag.width - 1, lowest + flag.low) for flag, lowest in flags}
        self._title, self._row = row_writer(max(map(len, labels | {"Checksum"})))
        self._device = device.id
        self._separator = ""

    def frame(self, result: FrameResult) -> None:
        """Print the next frame."""
        frame = result.frame
        heading = spaced(frame) if isinstance(frame, bytes) else visible(frame.text)
        sys.stdout.write("\n".join([self._separator + self._title(heading), *_rows(result, self._row), ""]))
        self._separator = "\n"

    def end(self, nothing: str) -> None:
        """Print the end of the output; `nothing` is a text for an output without frames."""
        if not self._separator:
            sys.stdout.write(f"{nothing}\n")


def _rows(result: FrameResult, row: Callable[[str, str], str]) -> list[str]:
    """Return what is printed of a frame, each as the row that `row` makes of its label and text."""
    rows = [row("Frame", visible(result.summary))]
    for item in result.items:
        rows.append(row("Says", item.summary))
        if item.bit_texts is not None and item.raw is not None:
            rows += item.bit_texts.lines(item.raw, row)
        for doubt in item.doubts:
            rows.append(row("Doubt", visible(doubt)))
    if result.checks:
        rows.append(row("Header" if result.framing == "tcp" else "Checksum", visible(result.checks)))
    for label, texts in (("Wrong", result.faults), ("Wrong", result.findings), ("Note", result.notes)):
        for text in texts:
            rows.append(row(label, visible(text)))
    return rows


class _JsonLinesPrinter(_Printer):
    """Prints one object a line for each frame."""

    def frame(self, result: FrameResult) -> None:
        sys.stdout.write(f"{json.dumps({'device': self._device, **result.as_data()})}\n")

    def end(self, nothing: str) -> None:
        """Print nothing: each line is whole."""


class _JsonPrinter(_Printer):
    """Prints one object with all frames, each as it comes; the object is whole after the last frame."""

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


_PRINTERS = {"text": _Printer, "json": _JsonPrinter, "jsonl": _JsonLinesPrinter}


ENCODE_EXAMPLE = """examples:
  fieldscribe encode hitachi_l200 A020 "50 Hz"
  fieldscribe encode hitachi_l200 A020 50 --unit 5 --frame
  fieldscribe encode hitachi_l200 A061 50 --with A062=10 --with A004=60
  fieldscribe encode hitachi_l200 A061 inactive
  fieldscribe encode woodward_mpu2s fault_text_terminal_62 "OIL PRESSURE" --frame
  fieldscribe encode woodward_mpu2s power_measurement_phases three_phase --with-word 0400h --frame
  fieldscribe encode siemens_mm4 P1082 40 --unit 3 --pkw 4 --keep --frame
  fieldscribe encode siemens_mm4 HSW 40 --with P2000=50 --with P2009=0 --with STW=047Fh --frame

With --frame only the frames go to stdout, one a line; their meaning goes to stderr. A rounded value is a note there.

ends with 1 when the value is refused: it is out of range or not a name of the point, a frame would write a point that
is read only, or the device does not accept such a frame
ends with 2 when the command lacks something (such as --with), or VALUE is not a value"""


def add_encode_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add_device(parser)
    add("point", metavar="POINT", help="its code, name or address; POINT.raw takes a raw number")
    add(
        "value",
        metavar="VALUE",
        help='50, "50 Hz", a name from its list, on, off, flags joined by |, digits joined by commas, a text',
    )
    add_with(parser)
    add("--frame", action="store_true", help="print the request frame, or all frames that it takes")
    add("--unit", type=int, metavar="N", help="the unit that the frame goes to (default: 1, or the lowest)")
    add_framing(parser, "the device's first")
    add("--index", type=int, metavar="N", help="uss: the element of an array")
    add_family_options(parser, "encode")
    add_format(parser)


def run_encode(arguments: Namespace) -> int:
    """Encode a value and print it; return the exit code."""
    device = placed(open_device(arguments), arguments)
    options = options_of(device, arguments)
    settings = settings_of(device, arguments)
    try:
        encoded, sent = _encoded(device, arguments, options, settings)
    except RefusedError as error:
        if arguments.format == "json":
            print_json({"refused": {"status": error.status, "message": error.message, "hint": error.hint}})
        raise
    frames = [] if sent is None else list(sent.frames)
    notes = [*encoded.notes, *(() if sent is None else sent.notes)]
    if arguments.format == "json":
        frame = frames[0] if len(frames) == 1 else None
        print_json({**encoded.as_data(), "notes": notes, "frame": frame, "frames": frames})
        return FINE
    sys.stdout.writelines(f"{frame}\n" for frame in frames)
    sys.stdout.flush()
    print_lines([[("", visible(encoded.text))]], sys.stdout if sent is None else sys.stderr)
    print_lines(([("hint", f"note: {visible(note)}")] for note in notes), sys.stderr)
    return FINE


def _encoded(
    device: Device, arguments: Namespace, options: Options, settings: dict[str, int | Fraction]
) -> tuple[Encoded, BuiltFrames | None]:
    """Return the raw number, and the frames if `--frame` or an option about frames was given."""
    name = arguments.point.removesuffix(".raw")
    point = choose_point(device, name, index=options.index)
    wants_frames = arguments.frame or options != Options(index=options.index)
    encoded = encode_point(device, point, arguments.value, settings, as_raw=name != arguments.point)
    return encoded, frames_for(device, point, encoded.raw, settings, options) if wants_frames else None
