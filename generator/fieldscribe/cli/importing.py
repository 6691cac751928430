"""`fieldscribe import`: draft a description from a file of another kind.

Kinds are tables of a file, CAN databases, models of SunSpec and templates of a gateway. For each kind, a function adds
its options to the parser, and one returns the draft and the lines of a report from the arguments.
"""

import re
import sys
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Callable
from hashlib import sha256
from typing import Any, NamedTuple

from fieldscribe.cli.common import Parser, StopError, add_repeated, some_path, write_draft
from fieldscribe.cli.terminal import FINDINGS, FINE
from fieldscribe.diagnostics import visible
from fieldscribe.families import FAMILIES, families
from fieldscribe.grouping import grouped
from fieldscribe.importing import Draft, compilable, draft
from fieldscribe.importing.dbc import DbcDraft
from fieldscribe.importing.draft_points import Options
from fieldscribe.importing.draft_text import Document, Head, WholeDraft
from fieldscribe.importing.headings import ROLES
from fieldscribe.importing.readers import FORMATS, MOST_BYTES, UnreadableError, read_tables
from fieldscribe.importing.sunspec import draft_models
from fieldscribe.importing.sunspec.models import read_models
from fieldscribe.importing.wb import draft_template
from fieldscribe.safe_files import read_regular
from fieldscribe.text import counted, line

IMPORT_EXAMPLE = f"""examples:
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


def add_import_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add("kind", choices=tuple(KINDS), metavar="KIND", help=f"what to import: {', '.join(KINDS)}")
    add("file", type=some_path, metavar="FILE", help="the file (or folder) to read")
    add("--device", metavar="ID", help="write a whole device of this name")
    add("--out", type=some_path, metavar="FILE", help="where to write (default: standard output)")
    for name, kind in KINDS.items():
        kind.add_arguments(parser.add_argument_group(f"import {name}", kind.reads))


def run_import(arguments: Namespace) -> int:
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


# Tables.


def add_table_arguments(parser: Parser) -> None:
    """Add the options of `import table`."""
    spaces = dict.fromkeys(space for family in families() for space in family.spaces if space != "telegram")
    add = parser.add_argument
    add("--family", choices=tuple(FAMILIES), help="the device's family (default: by its spaces)")
    add("--space", choices=tuple(spaces), help="the space of all points (default: by headings)")
    what = "what the column with this heading or number holds"
    add_repeated(parser, "--column", "ROLE=HEADING|N", what, type=_column)
    base = "the number printed for wire address 0 (default: 0), or `modicon` for references such as 40001"
    add("--base", type=_base, default=0, metavar="N|modicon", help=base)
    add("--hex", dest="is_hex", action="store_true", help="addresses without a mark are hexadecimal")
    add(
        "--address-part",
        type=int,
        choices=range(1, 9),
        metavar="N",
        help="which number is the address in cells that print several",
    )
    add("--ranges", choices=("raw", "units"), help="what ranges hold: raw numbers, or values in the unit")
    add("--language", default="en", metavar="CODE", help="the language of the tables, two letters (default: en)")
    add_repeated(parser, "--table", "N", "only this table", type=int, dest="tables")
    add("--lines", type=_lines, metavar="A..B", help="only tables that begin in these lines (or rows)")
    add("--list", action="store_true", help="list the tables and their columns, and draft nothing")


def from_tables(arguments: Namespace) -> tuple[str, list[str]] | None:
    """Return the draft of the tables, and no report; None if they are only listed.

    Raises UnreadableError and StopError.
    """
    _refuse_arguments(arguments)
    names = ("space", "family", "language", "tables", "lines", "base", "is_hex", "address_part", "ranges")
    options = Options(grouped(arguments.column), **{name: getattr(arguments, name) for name in names})
    try:
        drafted = draft(read_tables(arguments.file), options)
    except ModuleNotFoundError as error:
        message = f"`{arguments.file}` needs the extra `import`, which is not installed"
        raise StopError(message, 'pip install "fieldscribe[import]"') from error
    if arguments.list:
        _print_list(drafted)
        return None
    _print_left_out(drafted)
    if not drafted.groups:
        raise _nothing_drafted(arguments, drafted)
    digest = sha256(read_regular(arguments.file, MOST_BYTES).data).hexdigest()
    head = Head(
        arguments.device or "draft", [Document(arguments.file.name, digest)], drafted.family.name, arguments.language
    )
    return compilable(drafted.groups, head, with_head=arguments.device is not None), []


def _nothing_drafted(arguments: Namespace, drafted: Draft) -> StopError:
    """Return the error for a file whose tables hold no points, or for options that leave out all tables."""
    if drafted.tables:
        hint = "`--list` shows the tables; `--column` says what their columns hold"
        return StopError(f"`{arguments.file}` holds no table of points", hint, FINDINGS)
    if arguments.tables or arguments.lines:
        message = f"`{arguments.file}` has no table that --{'table' if arguments.tables else 'lines'} chooses"
        return StopError(message, "`--list` without it shows the tables", FINDINGS)
    return StopError(f"`{arguments.file}` holds no table", "a table has headings, and a row for each point", FINDINGS)


def _column(text: str) -> tuple[str, str]:
    """Return the role and the heading or number of `ROLE=HEADING`."""
    role, _, name = text.partition("=")
    if role not in ROLES or not name.strip():
        raise ArgumentTypeError(f"`{text}` is not ROLE=HEADING or ROLE=NUMBER, with one of {', '.join(ROLES)}")
    return role, name


def _base(text: str) -> int | None:
    """Return the number printed for wire address 0; None for Modicon references."""
    if text != "modicon" and not re.fullmatch("[0-9]{1,7}", text):
        raise ArgumentTypeError(f"`{text}` is neither the number printed for wire address 0 nor `modicon`")
    return None if text == "modicon" else int(text)


def _lines(text: str) -> tuple[int, int]:
    """Return the first and the last line of `650..1050`, `650-1050` or `650`."""
    match = re.fullmatch(r"([0-9]{1,9})(?:(?:\.\.|-)([0-9]{1,9}))?", text)
    if match is None:
        raise ArgumentTypeError(f"`{text}` is no range of lines: write the first and the last, as 650..1050")
    return int(match[1]), int(match[2] or match[1])


def _refuse_arguments(arguments: Namespace) -> None:
    """Raise StopError for arguments that are wrong before anything is read."""
    if arguments.file.suffix.lower() not in FORMATS:
        raise StopError(f"`{arguments.file}`: no reader takes such a file", f"the name ends in {', '.join(FORMATS)}")
    if not re.fullmatch("[a-z]{2}", arguments.language):
        raise StopError(
            f"--language: `{arguments.language[:80]}` is no code of a language", "write two letters, as `de`"
        )


def _print_list(drafted: Draft) -> None:
    """Print a line for each table: its place, whether it holds points, and the roles of its columns."""
    for columns in drafted.tables:
        table = columns.table
        roles = sorted((place + 1, role) for role, places in columns.places.items() for place in places)
        listed = ", ".join(f"{number} {role}" for number, role in roles) or "no column is known"
        title = columns.title or table.heading or "(no heading)"
        mark = "points " if columns.hold_points else "no points"
        print(visible(f"{table.number:4}  {table.line}..{table.last}  {mark:9}  {title[:60]}: {listed}"))


def _print_left_out(drafted: Draft) -> None:
    """Print to stderr how many tables hold no points."""
    lines = [str(columns.table.line) for columns in drafted.tables if not columns.hold_points]
    if lines:
        verbs = "s hold no points and are" if len(lines) > 1 else " holds no points and is"
        line_numbers = ", ".join(lines[:12]) + (", …" if len(lines) > 12 else "")
        print(f"{len(lines)} table{verbs} left out (line {line_numbers}); `--list` shows them", file=sys.stderr)


# CAN databases.


def add_database_arguments(parser: Parser) -> None:
    """Add the options of `import dbc`."""
    parser.add_argument("--node", metavar="NAME", help="the device: it sends its messages, and receives all others")


def from_database(arguments: Namespace) -> tuple[str, list[str]]:
    """Return the draft of a CAN database, and a report of it. Raises UnreadableError and StopError."""
    data = read_regular(arguments.file, MOST_BYTES).data
    text = text_of(data)
    drafted = DbcDraft(database_of(text), text, arguments.node)
    if not drafted.groups:
        raise StopError(f"`{arguments.file}` holds no signals", "a CAN database has messages with signals", FINDINGS)
    document = Document(arguments.file.name, sha256(data).hexdigest(), "database")
    head = Head(
        arguments.device or "draft", [document], "can", facts=drafted.head(), kind="a CAN database", bus=drafted.bus()
    )
    return compilable(drafted.groups, head, with_head=arguments.device is not None), list(drafted.report())


def text_of(data: bytes) -> str:
    """Return the text of a database: UTF-8 if valid, else Windows-1252."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace")


def database_of(text: str) -> Any:
    """Return the database that cantools reads. Raises UnreadableError and StopError."""
    try:
        from cantools.database import load_string
    except ModuleNotFoundError as error:
        message = "CAN databases need the extra `dbc`, which is not installed"
        raise StopError(message, 'pip install "fieldscribe[dbc]"') from error
    try:
        return load_string(text, "dbc", strict=False)
    except Exception as error:  # cantools raises whatever its parsers do
        reason = line(str(error))[:200] or type(error).__name__
        raise UnreadableError(f"this is no CAN database: {reason}", hint="cantools must be able to read it") from error


# Models of SunSpec, and templates.


def add_model_arguments(parser: Parser) -> None:
    """Add the options of `import sunspec`; `import wb` has none."""
    what = "which models of a folder the device has, as 1,103,120 (default: all)"
    parser.add_argument("--models", type=_numbers, default=(), metavar="N,N", help=what)
    what = "how many elements of a group are described, if the device says how many there are (default: 10)"
    parser.add_argument("--most", type=int, choices=range(1, 1001), default=10, metavar="N", help=what)
    what = "how far scale factors lie from 0 at most (default: 10): with 6, points of 16 bits have integer counts"
    parser.add_argument("--exponents", type=int, choices=range(1, 11), default=10, metavar="N", help=what)
    what = "what a point that counts elements holds in the device, for what lies after them"
    add_repeated(parser, "--count", "POINT=N", what, type=_count)


def from_models(arguments: Namespace) -> tuple[str, list[str]]:
    """Return the draft of models of SunSpec, and a report of it. Raises UnreadableError."""
    models = read_models(arguments.file, arguments.models)
    name, counts = arguments.device or "sunspec", dict(arguments.count)
    drafted = draft_models(models, name, arguments.most, counts, arguments.exponents)
    return _with_report(drafted, f"{counted(len(models), 'model')}, {counted(len(drafted.points), 'point')}")


def from_template(arguments: Namespace) -> tuple[str, list[str]]:
    """Return the draft of a template of wb-mqtt-serial, and a report of it. Raises UnreadableError."""
    drafted = draft_template(arguments.file, arguments.device or "draft")
    return _with_report(drafted, counted(len(drafted.points), "row"))


def _numbers(text: str) -> tuple[int, ...]:
    """Return the numbers of `1,103,120`."""
    if not re.fullmatch(r"[0-9]{1,5}(?:,[0-9]{1,5}){0,999}", text):
        raise ArgumentTypeError(f"`{text}` are no numbers of models: write them as 1,103,120")
    return tuple(map(int, text.split(",")))


def _count(text: str) -> tuple[str, int]:
    """Return the name and the number of `NPt=4`."""
    name, _, number = text.partition("=")
    if not name or not re.fullmatch("[0-9]{1,4}", number):
        raise ArgumentTypeError(f"`{text}` is no number of elements: write it as NPt=4")
    return name, int(number)


def _with_report(drafted: WholeDraft, counts: str) -> tuple[str, list[str]]:
    """Return the text of a draft, and the report of what is carried and what is not."""
    whole = sum(not point.questions for point in drafted.points)
    lost = (f"not carried: {what} ({times})" for what, times in drafted.not_carried.most_common())
    return compilable(drafted.groups, drafted.head, with_head=True), ["; ".join((f"{counts}, {whole} whole", *lost))]


# All kinds.

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
