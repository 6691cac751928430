"""`fieldscribe import table`: draft a description from the tables of a file."""

import re
import sys
from argparse import ArgumentTypeError, Namespace
from hashlib import sha256

from fieldscribe.cli.common import Parser, StopError, add_repeated
from fieldscribe.cli.terminal import FINDINGS
from fieldscribe.families import FAMILIES, families
from fieldscribe.grouping import grouped
from fieldscribe.importing import Draft, compilable, draft
from fieldscribe.importing.draft_points import Options
from fieldscribe.importing.draft_text import Document, Head
from fieldscribe.importing.headings import ROLES
from fieldscribe.importing.readers import FORMATS, MOST_BYTES, read_tables
from fieldscribe.report import visible
from fieldscribe.safe_files import read_regular


def add_arguments(parser: Parser) -> None:
    """Add the options of this kind."""
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
        shown = ", ".join(lines[:12]) + (", …" if len(lines) > 12 else "")
        print(f"{len(lines)} table{verbs} left out (line {shown}); `--list` shows them", file=sys.stderr)
