"""`fieldscribe encode`: a value into raw, or the whole frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Mapping

    from fieldscribe.dialogue.encoding import Encoded

HELP = "turn a value into its raw number, or into the whole request frame"
EXAMPLE = """examples:
  fieldscribe encode hitachi_l200 A020 "50 Hz"
  fieldscribe encode hitachi_l200 A020 50 --unit 5 --frame
  fieldscribe encode hitachi_l200 A061 50 --with A062=10 --with A004=60

With --frame only the frame goes to stdout; what it means goes to stderr."""


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import add_device, add_format

    add_device(parser)
    parser.add_argument("point", metavar="POINT", help="its code, name or address")
    parser.add_argument("value", metavar="VALUE", help='50, "50 Hz", a name from its list, on, off, flags joined by |')
    parser.add_argument(
        "--with",
        dest="given",
        action="append",
        default=[],
        metavar="POINT=VALUE",
        help="what another point holds, where a scale or range depends on it; may be repeated",
    )
    parser.add_argument("--frame", action="store_true", help="the whole request frame")
    parser.add_argument(
        "--unit", type=int, metavar="N", help="the unit that the frame goes to (default: 1 or the lowest)"
    )
    parser.add_argument(
        "--framing", choices=("rtu", "tcp"), help="how the frame is wrapped (default: the device's first)"
    )
    add_format(parser)


def run(arguments: Namespace) -> int:
    """Encode; the exit code: 1 when the value is refused."""
    from fieldscribe.cli import FINDINGS, FINE, USAGE
    from fieldscribe.cli.common import StopError, open_device, print_json, settings_of
    from fieldscribe.dialogue.encoding import encode_point, frame_for
    from fieldscribe.dialogue.refusals import RefusedError
    from fieldscribe.dialogue.selection import UnclearError, choose_point

    device = open_device(arguments)
    settings = settings_of(device, arguments.given)
    try:
        point = choose_point(device, arguments.point)
        encoded = encode_point(device, point, arguments.value, settings)
        framed = arguments.frame or arguments.unit is not None or arguments.framing is not None
        data = frame_for(device, point, encoded.raw, arguments.unit, arguments.framing) if framed else None
    except UnclearError as error:
        raise StopError(error.message, error.hint) from error
    except RefusedError as error:
        if arguments.format == "json":
            print_json({"refused": {"status": error.status, "message": error.message, "hint": error.hint}})
        raise StopError(error.message, error.hint, USAGE if error.status == "missing" else FINDINGS) from error
    _tell(arguments.format, encoded, data)
    return FINE


def _tell(form: str, encoded: Encoded, data: bytes | None) -> None:
    import sys

    from fieldscribe.cli.common import print_json
    from fieldscribe.cli.terminal import print_lines
    from fieldscribe.dialogue.hexadecimal import spaced
    from fieldscribe.report import visible

    if form == "json":
        result: Mapping[str, object] = encoded.as_data()
        print_json({**result, "frame": None if data is None else spaced(data)})
        return
    if data is not None:
        print(spaced(data), flush=True)
    print_lines([[("", visible(encoded.text))]], sys.stdout if data is None else sys.stderr)
    print_lines(([("hint", f"note: {visible(note)}")] for note in encoded.notes), sys.stderr)
