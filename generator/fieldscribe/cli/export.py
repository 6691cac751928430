"""`fieldscribe export`: the resolved model for other tools."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

HELP = "print the resolved model of a device as JSON"
EXAMPLE = """examples:
  fieldscribe export json hitachi_l200
  fieldscribe export json hitachi_l200 | jq '.points[] | select(.code == "A020")'"""


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import add_device

    parser.add_argument("form", choices=("json",), metavar="json", help="the form: json")
    add_device(parser, variants=False)


def run(arguments: Namespace) -> int:
    """Print the model; the exit code."""
    from fieldscribe.cli import FINE
    from fieldscribe.cli.common import StopError, open_device, print_json
    from fieldscribe.export import export_model
    from fieldscribe.export.rules import ExportError

    device = open_device(arguments)
    try:
        print_json(export_model(device))
    except ExportError as error:
        raise StopError(f"the model of {device.id} cannot be exported: {error}") from error
    return FINE
