"""`fieldscribe scan`: list the units that answer on a line, and their answers."""

from argparse import ArgumentParser, Namespace

from fieldscribe.cli.common import add_format, print_json
from fieldscribe.cli.live_options import LINES, Progress, add_live, connected, line_of, model_of, print_requests
from fieldscribe.cli.terminal import FINDINGS, FINE, print_lines
from fieldscribe.diagnostics import visible
from fieldscribe.live.connection import Answer, Scanner, read_units

EXAMPLE = f"""examples:
  fieldscribe scan --line "rtu:///dev/ttyUSB0?baud=19200"
  fieldscribe scan --line rtu:///dev/ttyUSB0 --units 1-4,247 --timeout 0.5
  fieldscribe scan hitachi_l200 --line tcp://192.168.0.20

Each unit is asked once for something that is only read; a refusal counts as an answer. With DEVICE, that is what
`identify` of its description names, or its first point that is only read.

{LINES}

ends with 1 when no unit answers"""

_TIMEOUT = 0.3


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_live(parser, optional=True)
    parser.add_argument("--units", metavar="LIST", help="which units, as in 1-31,40 (default: all that there may be)")
    add_format(parser)


def run(arguments: Namespace) -> int:
    """Ask all units and print who answers; return the exit code."""
    line = line_of(arguments)
    model = model_of(arguments) if arguments.device else None
    arguments.timeout = _TIMEOUT if arguments.timeout is None else arguments.timeout
    found: list[Answer] = []
    progress = Progress()
    with connected(arguments, line) as (connection, _):
        scanner = Scanner(connection, model)
        units = read_units(arguments.units, scanner.ends)
        for answer in scanner.answers(units):
            if answer.answers:
                found.append(answer)
                _print(answer, arguments, progress)
            progress.show(f"unit {answer.unit}, {units.index(answer.unit) + 1} of {len(units)}; {len(found)} answered")
        progress.clear()
        print_requests(arguments, scanner.requests)
    if arguments.format == "json":
        print_json({"line": line.text, "asked": units, "answers": [_data(answer) for answer in found]})
    elif not found:
        print("no unit answers")
    return FINE if found else FINDINGS


def _data(answer: Answer) -> dict[str, object]:
    return {"unit": answer.unit, "text": answer.text, "is_other": answer.is_other}


def _print(answer: Answer, arguments: Namespace, progress: Progress) -> None:
    if arguments.format == "text":
        progress.clear()
        style = "warning" if answer.is_other else ""
        print_lines([[("strong", f"unit {answer.unit}"), ("", "  "), (style, visible(answer.text))]])
