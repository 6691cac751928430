"""`fieldscribe decode`: frames into meaning."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from fieldscribe.dialogue import Heard

HELP = "say what frames from the line mean"
EXAMPLE = """examples:
  fieldscribe decode hitachi_l200 "05 06 10 28 01 F4 0C 91"
  fieldscribe decode hitachi_l200 0801000600051C91 --format json
  fieldscribe decode hitachi_l200 "08 01 01 17 12 1A" --request "08 01 00 06 00 05 1C 91"

Each FRAME is one argument; a reply is read by the request before it."""


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import add_device, add_format

    add_device(parser)
    parser.add_argument(
        "frames", nargs="+", metavar="FRAME", help='bytes in hexadecimal: "05 06 10 28", 05061028, 0x05,0x06, 05:06'
    )
    parser.add_argument("--request", metavar="FRAME", help="the request that the frames answer")
    parser.add_argument(
        "--framing", choices=("rtu", "tcp"), help="how frames are wrapped (default: seen from the bytes)"
    )
    parser.add_argument("--unit", type=int, metavar="N", help="only frames to or from this unit")
    parser.add_argument(
        "--with",
        dest="given",
        action="append",
        default=[],
        metavar="POINT=VALUE",
        help="what another point holds, where a scale or range depends on it; may be repeated",
    )
    add_format(parser)


def run(arguments: Namespace) -> int:
    """Decode; the exit code: 1 when a frame is wrong."""
    from fieldscribe.cli import FINDINGS, FINE
    from fieldscribe.cli.common import open_device, print_json, settings_of
    from fieldscribe.dialogue import listener

    frames = [_bytes(text) for text in _frames(arguments.frames)]
    request = None if arguments.request is None else _bytes(arguments.request)
    device = open_device(arguments)
    listening = listener(device, settings_of(device, arguments.given), arguments.framing)
    heard = [] if request is None else [listening.expect_reply_to(request)]
    heard += [listening.hear(data) for data in frames]
    heard = [one for one in heard if arguments.unit is None or one.unit == arguments.unit]
    if arguments.format == "json":
        print_json({"device": device.id, "frames": [one.as_data() for one in heard]})
    else:
        _print(heard)
    return FINDINGS if any(one.faults for one in heard) else FINE


def _frames(words: list[str]) -> list[str]:
    """The frames that the arguments are; when each is a single byte, somebody forgot the quotes."""
    if len(words) > 2 and all(len(word.strip()) == 2 for word in words):
        return [" ".join(words)]
    return words


def _bytes(text: str) -> bytes:
    from fieldscribe.cli.common import StopError
    from fieldscribe.dialogue.hexadecimal import HexError, parse_hex

    try:
        return parse_hex(text)
    except HexError as error:
        raise StopError(
            f"not a frame: {error}", 'write the bytes in hexadecimal, as in "05 06 10 28 01 F4 0C 91"'
        ) from error


def _print(heard: list[Heard]) -> None:
    from fieldscribe.cli.terminal import print_lines, print_rows
    from fieldscribe.dialogue.hexadecimal import spaced
    from fieldscribe.report import visible

    for place, one in enumerate(heard):
        if place:
            print_lines([[]])
        rows = [("Frame", one.summary)]
        rows += [("Says", item.text) for item in one.items]
        rows += [("Checksum" if one.framing == "rtu" else "Header", one.checks)] if one.checks else []
        rows += [("Wrong", fault) for fault in one.faults]
        rows += [("Note", note) for note in one.notes]
        print_rows(spaced(one.data), [(label, visible(text)) for label, text in rows])
    if not heard:
        print_lines([[("", "no frame of that unit")]])
