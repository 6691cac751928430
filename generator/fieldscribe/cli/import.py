# ruff: noqa: N999  # a command's module has the command's name
"""`fieldscribe import`: draft a description from a file of another kind; `import_kinds` knows the kinds."""

import re
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from typing import NamedTuple

from fieldscribe.cli.common import Parser, StopError, some_path, write_draft
from fieldscribe.cli.import_kinds import (
    add_database_arguments,
    add_model_arguments,
    add_table_arguments,
    from_database,
    from_models,
    from_tables,
    from_template,
)
from fieldscribe.cli.terminal import FINDINGS, FINE
from fieldscribe.diagnostics import visible
from fieldscribe.importing.headings import ROLES
from fieldscribe.importing.readers import UnreadableError

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


class _Kind(NamedTuple):
    """A kind of file: what returns a draft with the lines of a report, and what adds its own options."""

    reads: str
    drafted: Callable[[Namespace], tuple[str, list[str]] | None]
    add_arguments: Callable[[Parser], None] = lambda _: None


KINDS = {
    "dbc": _Kind("CAN databases", from_database, add_database_arguments),
    "table": _Kind(
        "tables of CSV, TSV, XLSX, Markdown, HTML, or the text of a manual",
        from_tables,
        add_table_arguments,
    ),
    "sunspec": _Kind(
        "models of SunSpec: a file `model_103.json`, or a folder of them",
        from_models,
        add_model_arguments,
    ),
    "wb": _Kind("a device template of wb-mqtt-serial: `.json`, `.json.jinja`", from_template),
}


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add("kind", choices=tuple(KINDS), metavar="KIND", help=f"what to import: {', '.join(KINDS)}")
    add("file", type=some_path, metavar="FILE", help="the file (or folder) to read")
    add("--device", metavar="ID", help="write a whole device of this name")
    add("--out", type=some_path, metavar="FILE", help="where to write (default: standard output)")
    for name, kind in KINDS.items():
        kind.add_arguments(parser.add_argument_group(f"import {name}", kind.reads))


def run(arguments: Namespace) -> int:
    """Import, and return the exit code."""
    for name, kind in KINDS.items():
        if name != arguments.kind:
            _refuse_options(name, kind, arguments)
    if arguments.device is not None and not re.fullmatch(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)*", arguments.device[:80]):
        raise StopError(f"--device: `{arguments.device[:80]}` is no name", "names have a to z, digits and single _")
    if arguments.out is not None and arguments.out.exists():
        raise StopError(f"`{arguments.out}` is there already", "name another file, or remove it first")
    try:
        drafted = KINDS[arguments.kind].drafted(arguments)
    except UnreadableError as error:
        where = f"{arguments.file}:{error.line}" if error.line else str(arguments.file)
        raise StopError(f"{where}: {error.message}", error.hint, FINDINGS) from error
    if drafted is not None:
        text, report = drafted
        write_draft(text, arguments.out)
        for line in report:
            print(visible(line), file=sys.stderr)
    return FINE


def _refuse_options(name: str, kind: _Kind, arguments: Namespace) -> None:
    """Raise StopError for an option that belongs to another kind."""
    parser = ArgumentParser(add_help=False)
    kind.add_arguments(parser)
    for action in parser._actions:  # argparse offers no other way
        if getattr(arguments, action.dest) != action.default:
            raise StopError(f"{action.option_strings[0]} is for `import {name}`", f"`import {arguments.kind}` has none")
