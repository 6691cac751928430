"""`fieldscribe identify`: find out which device a unit is, by the `identify` of descriptions."""

from argparse import ArgumentParser, Namespace
from collections.abc import Iterator

from fieldscribe.cli.common import StopError, add_format, open_device, print_json, searched_devices
from fieldscribe.cli.live_options import (
    LINES,
    Progress,
    add_live,
    add_unit,
    connected,
    line_of,
    model_of,
    print_requests,
)
from fieldscribe.cli.terminal import FINDINGS, FINE, print_lines
from fieldscribe.diagnostics import Line, visible
from fieldscribe.live.connection import FieldscribeError
from fieldscribe.live.lines import families_of
from fieldscribe.model import Device

EXAMPLE = f"""examples:
  fieldscribe identify --line tcp://192.168.0.20
  fieldscribe identify fronius_datamanager --line tcp://192.168.0.20 --unit 1
  fieldscribe identify pump

reads what the descriptions name under `identify`: those of all devices that such a line can have, or only of DEVICE

{LINES}

ends with 1 when no description fits the unit"""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_live(parser, optional=True)
    add_unit(parser)
    add_format(parser)


def run(arguments: Namespace) -> int:
    """Compare a unit with descriptions and print which fit; return the exit code."""
    line = line_of(arguments)
    fits: dict[str, dict[str, str]] = {}
    others: dict[str, str] = {}
    silent: list[str] = []
    requests = 0
    progress = Progress()
    with connected(arguments, line) as (connection, _):
        known = {family.name for family in families_of(line)}
        for model in _models(arguments):
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
        print_lines(_lines(fits, others, silent))
    return FINE if fits else FINDINGS


def _models(arguments: Namespace) -> Iterator[Device]:
    """Yield the device of the command line, or all known devices; one with errors is left out with a message."""
    if arguments.device:
        yield model_of(arguments)
        return
    for file in searched_devices(arguments).values():
        try:
            yield open_device(Namespace(**{**vars(arguments), "device": str(file), "variant": [], "format": "text"}))
        except StopError:
            continue


def _lines(fits: dict[str, dict[str, str]], others: dict[str, str], silent: list[str]) -> Iterator[Line]:
    for name, variants in fits.items():
        chosen = "".join(f", {axis}={value}" for axis, value in variants.items())
        yield [("strong", f"it is {name}"), ("", visible(chosen))]
    for name, why in others.items():
        yield [("", f"it is not {name}: {visible(why)}")]
    if silent:
        yield [("hint", f"not asked for, as their descriptions have no `identify`: {', '.join(silent)}")]
    if not (fits or others or silent):
        yield [("", "no known device has such a line")]
