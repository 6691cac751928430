"""`fieldscribe encode`: a value into raw, or the whole frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Mapping

    from fieldscribe.conversation.encoding import Encoded
    from fieldscribe.families.frame_results import BuiltFrames

HELP = "turn a value into its raw number, or into the whole request frame"
EXAMPLE = """examples:
  fieldscribe encode hitachi_l200 A020 "50 Hz"
  fieldscribe encode hitachi_l200 A020 50 --unit 5 --frame
  fieldscribe encode hitachi_l200 A061 50 --with A062=10 --with A004=60
  fieldscribe encode hitachi_l200 A061 inactive
  fieldscribe encode woodward_mpu2s fault_text_terminal_62 "OIL PRESSURE" --frame
  fieldscribe encode woodward_mpu2s power_measurement_phases three_phase --with-word 0400h --frame
  fieldscribe encode siemens_mm4 P1082 40 --unit 3 --pkw 4 --keep --frame
  fieldscribe encode siemens_mm4 HSW 40 --with P2000=50 --with P2009=0 --with STW=047Fh --frame

With --frame only the frames go to stdout, one a line; what they mean goes to stderr.
Ends with 1 when the value is refused: outside its range, no name of the point, a point that cannot be written, a frame
that the device does not take. Ends with 2 when something is missing (--with) or is no value at all. That a value was
rounded is a note."""


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import add_device, add_format
    from fieldscribe.cli.link import add_framing, add_own, add_with

    add_device(parser)
    parser.add_argument(
        "point", metavar="POINT", help="its code, name or address; with .raw behind it VALUE is a raw number"
    )
    parser.add_argument(
        "value",
        metavar="VALUE",
        help='50, "50 Hz", a name from its list, on, off, flags joined by |, digits with commas between, a text',
    )
    add_with(parser)
    parser.add_argument("--frame", action="store_true", help="the whole request frame, or all that it takes")
    parser.add_argument(
        "--unit", type=int, metavar="N", help="the unit that the frame goes to (default: 1 or the lowest)"
    )
    add_framing(parser, "default: the device's first")
    parser.add_argument("--index", type=int, metavar="N", help="uss: the element of an array")
    add_own(parser, "encode")
    add_format(parser)


def run(arguments: Namespace) -> int:
    """Encode; the exit code: 1 when the value is refused."""
    from fieldscribe.cli import FINDINGS, FINE, USAGE
    from fieldscribe.cli.common import StopError, open_device, print_json, settings_of
    from fieldscribe.cli.link import options_of
    from fieldscribe.conversation.encoding import encode_point
    from fieldscribe.conversation.options import asks_for_frames
    from fieldscribe.conversation.requests import frames_for
    from fieldscribe.conversation.selection import choose_point
    from fieldscribe.user_errors import RefusedError, UnclearError

    device = open_device(arguments)
    options = options_of(device, arguments)
    settings = settings_of(device, arguments.given)
    try:
        name = arguments.point.removesuffix(".raw")
        point = choose_point(device, name, index=options.index)
        encoded = encode_point(device, point, arguments.value, settings, as_raw=name != arguments.point)
        framed = arguments.frame or asks_for_frames(options)
        sent = frames_for(device, point, encoded.raw, settings, options) if framed else None
    except UnclearError as error:
        raise StopError(error.message, error.hint) from error
    except RefusedError as error:
        if arguments.format == "json":
            print_json({"refused": {"status": error.status, "message": error.message, "hint": error.hint}})
        raise StopError(error.message, error.hint, USAGE if error.status == "missing" else FINDINGS) from error
    _tell(arguments.format, encoded, sent)
    return FINE


def _tell(form: str, encoded: Encoded, sent: BuiltFrames | None) -> None:
    import sys

    from fieldscribe.cli.common import print_json
    from fieldscribe.cli.terminal import print_lines
    from fieldscribe.report import visible

    notes = (*encoded.notes, *(() if sent is None else sent.notes))
    if form == "json":
        frames = [] if sent is None else list(sent.frames)
        result: Mapping[str, object] = encoded.as_data()
        print_json({**result, "notes": list(notes), "frame": frames[0] if len(frames) == 1 else None, "frames": frames})
        return
    for frame in () if sent is None else sent.frames:
        print(frame, flush=True)
    print_lines([[("", visible(encoded.text))]], sys.stdout if sent is None else sys.stderr)
    print_lines(([("hint", f"note: {visible(note)}")] for note in notes), sys.stderr)
