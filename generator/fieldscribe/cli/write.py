"""`fieldscribe write`: write points of a device, or give a command, once the user agrees."""

import sys
from argparse import ArgumentParser, Namespace

from fieldscribe.cli.common import StopError, add_format, print_json
from fieldscribe.cli.live_options import LINES, Live, add_live, add_unit, add_writing, opened
from fieldscribe.cli.terminal import FINDINGS, FINE, USAGE, print_lines
from fieldscribe.diagnostics import Line, RefusedError, visible
from fieldscribe.live.writing import Planner, Write, carry_out, in_requests

EXAMPLE = f"""examples:
  fieldscribe write hitachi_l200 A020=50 --line tcp://192.168.0.20
  fieldscribe write hitachi_l200 "A003=50 Hz" A002=modbus --keep --line rtu:///dev/ttyUSB0 --unit 3
  fieldscribe write hitachi_l200 run_command=run --yes --line tcp://192.168.0.20
  fieldscribe write hitachi_l200 enter --line tcp://192.168.0.20
  fieldscribe write siemens_mm4 P1082=40 --keep --line "uss:///dev/ttyUSB0?pkw=4&pzd=2"
  fieldscribe write pump network_frequency_setpoint=12.5

values are as in `encode`. All of them are checked, with what their limits depend on in the device, before the first is
sent. A value may move what the device drives, and no description knows that: each write is asked for, with all that
the manual says of it, unless --yes is given.

{LINES}

ends with 1 when a value or the device refuses it, or the answer is no; with 2 when the line or the device does not
answer, and where nobody can be asked"""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_live(parser)
    parser.add_argument(
        "words",
        nargs="+",
        metavar="POINT=VALUE|COMMAND",
        help="a point with a value as for `encode`, or a command; arguments follow it, as in dim:percent=50",
    )
    add_unit(parser)
    add_writing(parser)
    add_format(parser)


def run(arguments: Namespace) -> int:
    """Write, if the user agrees; return the exit code."""
    with opened(arguments) as live:
        try:
            with live.progress():
                writes = Planner(live.model, live.device, keep=arguments.keep).plan(arguments.words)
        except RefusedError as error:
            raise StopError(error.message, error.hint, FINDINGS) from error
        if arguments.yes:
            notes = [note for write in writes for note in write.notes]
            print_lines(([("hint", f"note: {visible(note)}")] for note in notes), sys.stderr)
        else:
            ask(live, writes)
        live.work.left = [write.reading.label for write in writes]
        with live.progress():
            for request in in_requests(live.model, writes):
                with live.work.writing([write.reading.label for write in request]):
                    carry_out(request, live.device)
    if arguments.format == "json":
        print_json({**live.head, "written": [write.reading.as_data() for write in writes]})
    else:
        print_lines([[("", f"written: {visible(write.text)}")] for write in writes])
    return FINE


def ask(live: Live, writes: list[Write]) -> None:
    """Show what is to be written, and ask. Raises StopError if nobody can be asked, or the answer is no."""
    lines: list[Line] = [[("strong", f"{live.model.id}, unit {live.device.unit}, {visible(live.line.text)}:")]]
    for write in writes:
        lines.append([("", f"  {visible(write.text)}")])
        lines += [[("hint", f"    {visible(remark)}")] for remark in (*write.notes, *write.remarks)]
    print_lines(lines, sys.stderr)
    if not sys.stdin.isatty():
        raise StopError("nobody can be asked here: nothing was written", "give --yes if this is meant", USAGE)
    print("Write this? [y/N] ", end="", file=sys.stderr, flush=True)
    if sys.stdin.readline().strip().lower() not in ("y", "yes"):
        raise StopError("nothing was written", code=FINDINGS)
