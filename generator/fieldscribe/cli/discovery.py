"""`fieldscribe scan` and `identify`: which units answer on a line, and which known device one is."""

from argparse import ArgumentParser, Namespace
from collections.abc import Iterator

from fieldscribe.cli.common import StopError, add_format, open_device, print_json, searched_devices
from fieldscribe.cli.frame_options import model_of
from fieldscribe.cli.live_options import (
    LINES,
    Progress,
    add_live,
    connected,
    line_of,
    print_requests,
)
from fieldscribe.cli.terminal import FINDINGS, FINE, print_lines
from fieldscribe.diagnostics import Line, visible
from fieldscribe.live.connection import Answer, FieldscribeError, Scanner, read_units
from fieldscribe.live.lines import families_of
from fieldscribe.model import Device

SCAN_EXAMPLE = f"""examples:
  fieldscribe scan --line "rtu:///dev/ttyUSB0?baud=19200"
  fieldscribe scan --line rtu:///dev/ttyUSB0 --units 1-4,247 --timeout 0.5
  fieldscribe scan hitachi_l200 --line tcp://192.168.0.20

Each unit is asked once for something that is only read; a refusal counts as an answer. With DEVICE, that is what
`identify` of its description names, or its first point that is only read.

{LINES}

ends with 1 when no unit answers"""

_TIMEOUT = 0.3


def add_scan_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_live(parser, optional=True, unit=False)
    parser.add_argument("--units", metavar="LIST", help="which units, as in 1-31,40 (default: all that there may be)")
    add_format(parser)


def run_scan(arguments: Namespace) -> int:
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
                _print_answer(answer, arguments, progress)
            progress.show(f"unit {answer.unit}, {units.index(answer.unit) + 1} of {len(units)}; {len(found)} answered")
        progress.clear()
        print_requests(arguments, scanner.requests)
    if arguments.format == "json":
        print_json({"line": line.text, "asked": units, "answers": [_answer_data(answer) for answer in found]})
    elif not found:
        print("no unit answers")
    return FINE if found else FINDINGS


def _answer_data(answer: Answer) -> dict[str, object]:
    return {"unit": answer.unit, "text": answer.text, "is_other": answer.is_other}


def _print_answer(answer: Answer, arguments: Namespace, progress: Progress) -> None:
    if arguments.format == "text":
        progress.clear()
        style = "warning" if answer.is_other else ""
        print_lines([[("strong", f"unit {answer.unit}"), ("", "  "), (style, visible(answer.text))]])


IDENTIFY_EXAMPLE = f"""examples:
  fieldscribe identify --line tcp://192.168.0.20
  fieldscribe identify fronius_datamanager --line tcp://192.168.0.20 --unit 1
  fieldscribe identify pump

reads what the descriptions name under `identify`: those of all devices that such a line can have, or only of DEVICE

{LINES}

ends with 1 when no description fits the unit"""


def add_identify_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_live(parser, optional=True)
    add_format(parser)


def run_identify(arguments: Namespace) -> int:
    """Compare a unit with descriptions and print which fit; return the exit code."""
    line = line_of(arguments)
    fits: dict[str, dict[str, str]] = {}
    others: dict[str, str] = {}
    silent: list[str] = []
    requests = 0
    progress = Progress()
    with connected(arguments, line) as (connection, _):
        known = {family.name for family in families_of(line)}
        for model in _candidates(arguments):
            progress.show(f"{model.id}, {len(fits)} fit")
            if model.family not in known and not arguments.device:
                continue
            if not model.identifications:
                silent.append(model.id)
                continue
            unit = model.bus.usual_unit if arguments.unit is None else arguments.unit
            device = connection.device(model, unit, arguments.retries)
            try:
                fits[model.id] = device.identify()
            except FieldscribeError as error:
                if error.lost:
                    raise
                others[model.id] = str(error)
            finally:
                requests += device.traffic.requests
        progress.clear()
        print_requests(arguments, requests)
    if arguments.format == "json":
        print_json({"line": line.text, "fits": fits, "others": others, "without_identify": silent})
    else:
        print_lines(_lines_of_fits(fits, others, silent))
    return FINE if fits else FINDINGS


def _candidates(arguments: Namespace) -> Iterator[Device]:
    """Yield the device of the command line, or all known devices; one with errors is left out with a message."""
    if arguments.device:
        yield model_of(arguments)
        return
    for file in searched_devices(arguments).values():
        try:
            yield open_device(Namespace(**{**vars(arguments), "device": str(file), "variant": [], "format": "text"}))
        except StopError:
            continue


def _lines_of_fits(fits: dict[str, dict[str, str]], others: dict[str, str], silent: list[str]) -> Iterator[Line]:
    for name, variants in fits.items():
        chosen = "".join(f", {axis}={value}" for axis, value in variants.items())
        yield [("strong", f"it is {name}"), ("", visible(chosen))]
    for name, why in others.items():
        yield [("", f"it is not {name}: {visible(why)}")]
    if silent:
        yield [("hint", f"not asked for, as their descriptions have no `identify`: {', '.join(silent)}")]
    if not (fits or others or silent):
        yield [("", "no known device has such a line")]
