# ruff: noqa: N999  # a command's module has the command's name
"""`fieldscribe import`: a draft of a description from tables of a manual."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from pathlib import Path

    from fieldscribe.importing import Drafted, Wishes
    from fieldscribe.importing.draft_text import Head
    from fieldscribe.importing.tables import Table

EXAMPLE = """examples:
  fieldscribe import table registers.csv --device heat_pump --out heat_pump/device.yaml
  fieldscribe import table manual.txt --list
  fieldscribe import table manual.txt --lines 650..1050 --space holding > registers.yaml
  fieldscribe import table list.csv --columns code=1,address=3,range=6

In a text the tables are rows between bars (|) or lines parted by tabs. What the cells leave open is left out, and
`# ?` asks for it; numbers that contradict each other become errata to be confirmed. XLSX needs the extra `import`.
Without --device only groups are written, to be parts of a device.

ends with 1 when the file holds no table of points, or cannot be read"""

_KINDS = ("table",)


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import some_path
    from fieldscribe.families import FAMILIES, families

    spaces = dict.fromkeys(space for family in families() for space in family.spaces)
    parser.add_argument("kind", choices=_KINDS, metavar="KIND", help=f"what to import: {' or '.join(_KINDS)}")
    parser.add_argument("file", type=some_path, metavar="FILE", help="the file with the tables")
    parser.add_argument("--device", metavar="ID", help="write a whole device of this name")
    parser.add_argument("--family", choices=tuple(FAMILIES), help="the device's family (default: by its spaces)")
    parser.add_argument(
        "--space", choices=tuple(spaces), help="the space of all points (default: by heads and headings)"
    )
    parser.add_argument("--columns", metavar="ROLE=N,...", default="", help="what columns hold, counted from 1")
    parser.add_argument(
        "--table", type=int, action="append", default=[], metavar="N", help="only this table; may be repeated"
    )
    parser.add_argument("--lines", metavar="A..B", help="only tables that begin in these lines (or rows)")
    parser.add_argument("--list", action="store_true", help="list the tables and their columns, and draft nothing")
    parser.add_argument("--out", type=some_path, metavar="FILE", help="where to write (default: standard output)")


def run(arguments: Namespace) -> int:
    """Import; the exit code."""
    from fieldscribe.cli import FINDINGS, FINE
    from fieldscribe.cli.common import StopError
    from fieldscribe.importing import draft
    from fieldscribe.importing.draft_text import draft_text

    wishes = _wishes(arguments)
    _refuse_call(arguments)
    drafted = draft(_tables(arguments.file), wishes)
    if arguments.list:
        _list(drafted)
        return FINE
    _tell_left_out(drafted)
    if not drafted.groups:
        hint = "`--list` shows the tables; `--columns` says what their columns hold"
        raise StopError(f"`{arguments.file}` holds no table of points", hint, FINDINGS)
    _write(draft_text(drafted, _head(arguments, drafted)), arguments.out)
    return FINE


def _wishes(arguments: Namespace) -> Wishes:
    from fieldscribe.cli.common import StopError
    from fieldscribe.importing import Wishes
    from fieldscribe.importing.columns import said_columns

    try:
        columns = said_columns(arguments.columns) if arguments.columns else {}
    except ValueError as error:
        raise StopError(f"--columns: {error}") from error
    return Wishes(columns, arguments.space, tuple(arguments.table), _lines(arguments.lines))


def _lines(said: str | None) -> tuple[int, int] | None:
    """`650..1050`, `650-1050` or one line."""
    from fieldscribe.cli.common import StopError

    if said is None:
        return None
    first, _, last = said.replace("..", "-").partition("-")
    if not all(end.isascii() and end.isdigit() and len(end) < 10 for end in (first, last or first)):
        raise StopError(f"--lines: `{said[:40]}` is no range of lines", "write the first and the last: 650..1050")
    return int(first), int(last or first)


def _refuse_call(arguments: Namespace) -> None:
    """What is wrong with the call before anything is read."""
    import re

    from fieldscribe.cli.common import StopError
    from fieldscribe.importing.reading import FORMS

    if arguments.file.suffix.lower() not in FORMS:
        raise StopError(f"`{arguments.file}`: no reader takes such a file", f"the name ends in {', '.join(FORMS)}")
    if arguments.device is not None and not re.fullmatch(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)*", arguments.device[:80]):
        raise StopError(f"--device: `{arguments.device[:80]}` is no name", "names have a to z, digits and single _")
    if arguments.out is not None and arguments.out.exists():
        raise StopError(f"`{arguments.out}` is there already", "name another file, or remove it first")


def _tables(path: Path) -> list[Table]:
    from fieldscribe.cli import FINDINGS
    from fieldscribe.cli.common import StopError
    from fieldscribe.importing.reading import read_tables
    from fieldscribe.importing.tables import MissingExtraError, UnreadableError

    try:
        return read_tables(path)
    except UnreadableError as error:
        where = f"{path}:{error.line}" if error.line else str(path)
        raise StopError(f"{where}: {error.message}", code=FINDINGS) from error
    except MissingExtraError as error:
        hint = f'pip install "fieldscribe[{error.extra}]"'
        raise StopError(f"`{path}` needs the extra `{error.extra}`, which is not installed", hint) from error


def _head(arguments: Namespace, drafted: Drafted) -> Head | None:
    """The head of the device, if one is wanted."""
    from hashlib import sha256

    from fieldscribe.families import families
    from fieldscribe.importing.draft_text import Head
    from fieldscribe.importing.tables import MOST_BYTES
    from fieldscribe.safe_files import read_regular

    if arguments.device is None:
        return None
    spaces = {group.space for group in drafted.groups}
    fitting = max(families(), key=lambda family: len(spaces & family.spaces.keys()))
    digest = sha256(read_regular(arguments.file, MOST_BYTES).data).hexdigest()
    return Head(arguments.device, arguments.file.name, digest, arguments.family or fitting.name)


def _write(text: str, out: Path | None) -> None:
    """To a new file, or to standard output. A file that has come meanwhile is not overwritten."""
    if out is None:
        sys.stdout.write(text)
        return
    out.parent.mkdir(parents=True, exist_ok=True)
    with open(out, "x", encoding="utf-8", newline="\n") as stream:
        stream.write(text)


def _list(drafted: Drafted) -> None:
    """A line for each table: where it is, what its columns hold, whether points are drafted from it."""
    from fieldscribe.report import visible

    for table, columns, taken in drafted.seen:
        roles = [f"{place + 1} {role}" for role, places in columns.places.items() for place in places]
        said = ", ".join(sorted(roles, key=lambda role: int(role.split()[0]))) or "no column is known"
        title = columns.title or table.heading or "(no heading)"
        mark = "points " if taken else "no points"
        print(visible(f"{table.number:4}  {table.line}..{table.last}  {mark:9}  {title[:60]}: {said}"))


def _tell_left_out(drafted: Drafted) -> None:
    """Say on stderr how many tables were not taken."""
    left = [seen.table for seen in drafted.seen if not seen.taken]
    if left:
        lines = ", ".join(str(table.line) for table in left[:12]) + (", …" if len(left) > 12 else "")
        count = f"{len(left)} table{'s hold' if len(left) > 1 else ' holds'}"
        print(
            f"{count} no points and {'are' if len(left) > 1 else 'is'} left out (line {lines}); `--list` shows them",
            file=sys.stderr,
        )
