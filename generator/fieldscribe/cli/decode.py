"""`fieldscribe decode`: frames into meaning."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from fieldscribe.families.answers import Heard

HELP = "say what frames from the line mean"
EXAMPLE = """examples:
  fieldscribe decode hitachi_l200 "05 06 10 28 01 F4 0C 91"
  fieldscribe decode hitachi_l200 0801000600051C91 --format json
  fieldscribe decode hitachi_l200 "08 01 01 17 12 1A" --request "08 01 00 06 00 05 1C 91"
  fieldscribe decode woodward_mpu2s 321#DD00051E13880064 321#DD010302000007D0
  fieldscribe decode woodward_mpu2s "DD 00 05 1E 13 88 00 64" --can-id 321
  fieldscribe decode woodward_mpu2s - < candump.log
  fieldscribe decode siemens_mm4 "02 0E 01 143A 0000 0000 0000 047F 3333 72"
  fieldscribe decode siemens_mm4 --framing pkw "143A 0000 0000 0000" "243A 0000 4248 0000"
  fieldscribe decode siemens_mm4 --framing pzd --direction response "FA31 0000"

Each FRAME is one argument; a reply is read by the request before it.

Ends with 1 when a frame is damaged, is no frame of the device (wrong length, checksum, header) or does not answer the
request before it; when it asks for what the device does not do (a unit, function, task, count, multiplexer, framing or
address that it has not, an address that the manual closes), or writes what it does not take (a value outside its range,
a point that is read only, other bits than those always written). What a reply brings is never a finding: any raw number
may come. Notes are no findings."""


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import add_device, add_format
    from fieldscribe.cli.link import add_framing, add_own, add_with

    add_device(parser)
    parser.add_argument(
        "frames",
        nargs="+",
        metavar="FRAME",
        help='bytes in hexadecimal: "05 06 10 28", 05061028, 0x05,0x06, 05:06; CAN: 321#DD00, lines of candump; '
        "- reads frames from standard input, one a line",
    )
    parser.add_argument("--request", metavar="FRAME", help="the request that the frames answer")
    add_framing(parser, "default: seen from the bytes; uss")
    parser.add_argument("--unit", type=int, metavar="N", help="only frames to or from this unit")
    add_own(parser, "decode")
    add_with(parser)
    add_format(parser)


def run(arguments: Namespace) -> int:
    """Decode; the exit code: 1 when there is a fault or a finding."""
    from fieldscribe.asked import UnclearError
    from fieldscribe.cli import FINDINGS, FINE
    from fieldscribe.cli.common import StopError, open_device, print_json, settings_of
    from fieldscribe.cli.link import options_of
    from fieldscribe.conversation.listener import decode

    device = open_device(arguments)
    options = options_of(device, arguments)
    settings = settings_of(device, arguments.given)
    try:
        heard = decode(device, settings, _frames(arguments.frames), options)
    except UnclearError as error:
        raise StopError(error.message, error.hint) from error
    heard = [reading for reading in heard if arguments.unit is None or reading.unit == arguments.unit]
    if arguments.format == "json":
        print_json({"device": device.id, "frames": [reading.as_data() for reading in heard]})
    else:
        _print(heard)
    return FINDINGS if any(reading.wrong for reading in heard) else FINE


def _frames(words: list[str]) -> list[str]:
    """The frames that were given; `-` stands for the lines of standard input."""
    import sys

    frames: list[str] = []
    for word in words:
        if word == "-":
            if hasattr(sys.stdin, "reconfigure"):
                sys.stdin.reconfigure(errors="replace")
            frames += [line for line in sys.stdin.read().splitlines() if line.strip()]
        else:
            frames.append(word)
    return frames


def _print(heard: list[Heard]) -> None:
    from fieldscribe.cli.terminal import print_lines, print_rows
    from fieldscribe.report import visible
    from fieldscribe.wording.buses import spaced

    for place, reading in enumerate(heard):
        if place:
            print_lines([[]])
        rows = [("Frame", reading.summary)]
        rows += [("Says", item.text) for item in reading.items]
        rows += [("Header" if reading.framing == "tcp" else "Checksum", reading.checks)] if reading.checks else []
        rows += [("Wrong", fault) for fault in (*reading.faults, *reading.findings)]
        rows += [("Note", note) for note in reading.notes]
        print_rows(visible(reading.shown) or spaced(reading.data), [(label, visible(text)) for label, text in rows])
    if not heard:
        print_lines([[("", "no frame of that unit")]])
