"""`fieldscribe encode`: a value into its raw number, or into the whole request frame."""

import sys
from argparse import ArgumentParser, Namespace
from fractions import Fraction

from fieldscribe.cli.common import StopError, add_device, add_format, open_device, print_json
from fieldscribe.cli.frame_options import add_family_options, add_framing, add_with, options_of, placed, settings_of
from fieldscribe.cli.terminal import FINDINGS, FINE, USAGE, print_lines
from fieldscribe.conversation.encoding import Encoded, encode_point, frames_for
from fieldscribe.conversation.selection import choose_point
from fieldscribe.diagnostics import RefusedError, visible
from fieldscribe.families.frame_results import BuiltFrames, Options
from fieldscribe.model import Device

EXAMPLE = """examples:
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


def add_arguments(parser: ArgumentParser) -> None:
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


def run(arguments: Namespace) -> int:
    """Encode a value and print it; return the exit code."""
    device = placed(open_device(arguments), arguments)
    options = options_of(device, arguments)
    settings = settings_of(device, arguments)
    try:
        encoded, sent = _encoded(device, arguments, options, settings)
    except RefusedError as error:
        if arguments.format == "json":
            print_json({"refused": {"status": error.status, "message": error.message, "hint": error.hint}})
        raise StopError(error.message, error.hint, USAGE if error.status == "missing" else FINDINGS) from error
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
