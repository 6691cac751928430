# ruff: noqa: N999  # a command's module has the command's name
"""`fieldscribe import`: draft a description from a file of another kind; each kind has a module `import_<kind>`."""

import re
from argparse import ArgumentParser, Namespace
from types import ModuleType

from fieldscribe.cli import import_dbc, import_sunspec, import_table, import_wb
from fieldscribe.cli.common import StopError, some_path
from fieldscribe.importing.headings import ROLES

EXAMPLE = f"""examples:
  fieldscribe import table registers.csv --device heat_pump --out heat_pump/device.yaml
  fieldscribe import table manual.txt --list
  fieldscribe import table manual.txt --lines 650..1050 --space holding --address-part 2 > registers.yaml
  fieldscribe import table list.csv --column code=1 --column address=3 --column range=6
  fieldscribe import sunspec models --models 1,103,160 --device inverter --out inverter/device.yaml
  fieldscribe import wb config-heater.json --device heater --out heater/device.yaml

The usual headings are known in English and German; --column names other columns, as one of
{", ".join(ROLES)}.
In a text, tables are rows between bars (|) or lines with tabs. An unclear cell becomes a comment `# ?` and not a
fact of the draft. A draft compiles. Without --device only groups are written, to be parts of a device.
XLSX needs the extra `import`.
Models of SunSpec and a template make a whole device; the last line on standard error counts what is not carried.

ends with 1 when the file holds no table of points (no model, no template), has no such column, or cannot be read"""

KINDS: dict[str, tuple[ModuleType, str]] = {
    "dbc": (import_dbc, "CAN databases"),
    "table": (import_table, "tables of CSV, TSV, XLSX, Markdown, HTML, or the text of a manual"),
    "sunspec": (import_sunspec, "models of SunSpec: a file `model_103.json`, or a folder of them"),
    "wb": (import_wb, "a device template of wb-mqtt-serial: `.json`, `.json.jinja`"),
}
"""The module of each kind of file, with its help text. It has `add_arguments` for its own options, and `run`."""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add("kind", choices=tuple(KINDS), metavar="KIND", help=f"what to import: {', '.join(KINDS)}")
    add("file", type=some_path, metavar="FILE", help="the file (or folder) to read")
    add("--device", metavar="ID", help="write a whole device of this name")
    add("--out", type=some_path, metavar="FILE", help="where to write (default: standard output)")
    for kind, (module, reads) in KINDS.items():
        module.add_arguments(parser.add_argument_group(f"import {kind}", reads))


def run(arguments: Namespace) -> int:
    """Import, and return the exit code."""
    for kind, (module, _) in KINDS.items():
        if kind != arguments.kind:
            _refuse_options(kind, module, arguments)
    if arguments.device is not None and not re.fullmatch(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)*", arguments.device[:80]):
        raise StopError(f"--device: `{arguments.device[:80]}` is no name", "names have a to z, digits and single _")
    if arguments.out is not None and arguments.out.exists():
        raise StopError(f"`{arguments.out}` is there already", "name another file, or remove it first")
    code: int = KINDS[arguments.kind][0].run(arguments)
    return code


def _refuse_options(kind: str, module: ModuleType, arguments: Namespace) -> None:
    """Raise StopError for an option that belongs to another kind."""
    parser = ArgumentParser(add_help=False)
    module.add_arguments(parser)
    for action in parser._actions:  # argparse offers no other way
        if getattr(arguments, action.dest) != action.default:
            raise StopError(f"{action.option_strings[0]} is for `import {kind}`", f"`import {arguments.kind}` has none")
