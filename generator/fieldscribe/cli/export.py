"""`fieldscribe export` and `schema`: a device for other tools, the keys of descriptions for editors and people."""

import sys
from argparse import ArgumentParser, Namespace

from fieldscribe.cli.common import StopError, add_device, open_device, print_json
from fieldscribe.cli.terminal import FINE
from fieldscribe.export import ExportError, export_form, export_model
from fieldscribe.export import schema_text as export_schema_text
from fieldscribe.families import families
from fieldscribe.language.key_tables import keys_markdown, schema_text

EXPORT_EXAMPLE = """examples:
  fieldscribe export json hitachi_l200
  fieldscribe export json hitachi_l200 | jq '.points[] | select(.code == "A020")'
  fieldscribe export dbc woodward_mpu2s --unit 3 > mpu2s_3.dbc

ends with 1 when the description has errors, with 2 when the form cannot express the device"""

_JSON = "json"


def _forms() -> tuple[str, ...]:
    """Return all forms: the model of any device, and those of some families only."""
    return (_JSON, *(form for family in families() for form in family.exports))


def add_export_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the command."""
    add = parser.add_argument
    add("form", choices=_forms(), metavar="FORM", help=f"the form: {' or '.join(_forms())}")
    add_device(parser)
    add("--unit", type=int, metavar="N", help="dbc: the unit that sends (default: 1 or the lowest)")


def run_export(arguments: Namespace) -> int:
    """Print the export; return the exit code."""
    for option, value in (("unit", arguments.unit), ("variant", arguments.variant or None)):
        if value is not None and arguments.form == _JSON:
            hint = "leave it out: the model has all variants, and belongs to no unit"
            raise StopError(f"--{option} is not for the form {_JSON}", hint)
    device = open_device(arguments)
    try:
        if arguments.form == _JSON:
            print_json(export_model(device))
        else:
            sys.stdout.buffer.write(export_form(arguments.form, device, arguments.unit))
    except ExportError as error:
        raise StopError(f"{device.id} cannot be exported as {arguments.form}: {error}") from error
    return FINE


SCHEMA_EXAMPLE = """examples:
  fieldscribe schema > schema.json
  fieldscribe schema --page > KEYS.md
  fieldscribe schema --export > exported-model.json

An editor with yaml-language-server completes and checks keys when a description starts with the line
# yaml-language-server: $schema=schema.json
(`fieldscribe init` writes both; `fieldscribe fmt` keeps the schema up to date)

ends with 0: it reads no description"""


def add_schema_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--page", action="store_true", help="as a page of Markdown, with a table for each place")
    form.add_argument("--export", action="store_true", help="the JSON Schema of what `fieldscribe export json` prints")


def run_schema(arguments: Namespace) -> int:
    """Print the keys and return the exit code."""
    text = export_schema_text if arguments.export else keys_markdown if arguments.page else schema_text
    sys.stdout.write(text())
    return FINE
