"""`fieldscribe export`: a device for other tools."""

import sys
from argparse import ArgumentParser, Namespace

from fieldscribe.cli import FINE
from fieldscribe.cli.common import StopError, add_device, open_device, print_json
from fieldscribe.export import ExportError, export_form, export_model
from fieldscribe.families import families

EXAMPLE = """examples:
  fieldscribe export json hitachi_l200
  fieldscribe export json hitachi_l200 | jq '.points[] | select(.code == "A020")'
  fieldscribe export dbc woodward_mpu2s --unit 3 > mpu2s_3.dbc

ends with 1 when the description has errors, with 2 when the form cannot express the device"""

_JSON = "json"


def _forms() -> tuple[str, ...]:
    """Return all forms: the model of any device, and those of some families only."""
    return (_JSON, *(form for family in families() for form in family.exports))


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the command."""
    add = parser.add_argument
    add("form", choices=_forms(), metavar="FORM", help=f"the form: {' or '.join(_forms())}")
    add_device(parser)
    add("--unit", type=int, metavar="N", help="dbc: the unit that sends (default: 1 or the lowest)")


def run(arguments: Namespace) -> int:
    """Print the export; return the exit code."""
    for option, value in (("unit", arguments.unit), ("variant", arguments.variant or None)):
        if value is not None and arguments.form == _JSON:
            raise StopError(
                f"--{option} is not for the form {_JSON}", "leave it out: the model has all variants, no unit"
            )
    device = open_device(arguments)
    try:
        if arguments.form == _JSON:
            print_json(export_model(device))
        else:
            sys.stdout.buffer.write(export_form(arguments.form, device, arguments.unit))
    except ExportError as error:
        raise StopError(f"{device.id} cannot be exported as {arguments.form}: {error}") from error
    return FINE
