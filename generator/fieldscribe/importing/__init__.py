"""Drafts a description from the tables of a file: `import table`.

The tables come from `readers`, their columns from `headings`, points from `draft_points`, YAML from `draft_text`.
Whatever is uncertain becomes a question in the draft, not a fact. The compiler decides last: `compilable` turns each
fact that it rejects into a question.
"""

import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from fieldscribe.diagnostics import Report
from fieldscribe.families import Family, families
from fieldscribe.families import family as family_of_name
from fieldscribe.importing.cells import one_line, space_in
from fieldscribe.importing.draft_points import Options, points_of
from fieldscribe.importing.draft_text import DraftGroup, DraftPoint, Head, Line, Names, draft_lines, snake
from fieldscribe.importing.headings import Columns, columns_of, is_column_number, same_heading, upright
from fieldscribe.importing.readers import Table, UnreadableError
from fieldscribe.pipeline import DEVICE_FILE, load_device

_OVERLAPS = ("address-taken", "bits-overlap")
"""Errors about points with equal names."""


class Draft(NamedTuple):
    """The drafted groups, all tables that were read, and the family of their spaces."""

    groups: list[DraftGroup]
    tables: list[Columns]
    family: Family


def draft(tables: Iterable[Table], options: Options) -> Draft:
    """Draft groups of points from the tables that hold points. Raises UnreadableError for an unknown column."""
    read: list[Columns] = []
    for table in (upright(table) for table in tables if _is_chosen(table, options)):
        read.append(columns_of(table, options.columns, read[-1] if read else None))
    _refuse_unknown(read, [name for names in options.columns.values() for name in names])
    with_points = [columns for columns in read if columns.hold_points]
    family = _family_of(with_points, options)
    groups: dict[tuple[str, str], DraftGroup] = {}
    homeless = [text for columns in with_points for text in _add_to_groups(groups, columns, family, options)]
    for group in list(groups.values())[:1]:
        group.comments += homeless
    _ask_about_doubles(point for group in groups.values() for point in group.points)
    _give_names(groups.values())
    return Draft(list(groups.values()), read, family)


def _family_of(tables: Iterable[Columns], options: Options) -> Family:
    """Return the family that the user names, or the first with the most of these spaces."""
    if options.family:
        return family_of_name(options.family)
    spaces = {options.space or _space_of(columns) or "holding" for columns in tables}
    return max(families(), key=lambda family: len(spaces & family.spaces.keys()))


def _is_chosen(table: Table, options: Options) -> bool:
    first, last = options.lines or (table.line, table.line)
    return first <= table.line <= last and (not options.tables or table.number in options.tables)


def _refuse_unknown(tables: Sequence[Columns], names: Iterable[str]) -> None:
    """Raise UnreadableError for a heading or a column number that no table has."""
    rows = (columns.headings if any(columns.headings) else columns.table.rows[0].cells for columns in tables)
    headings = list(dict.fromkeys(one_line(heading) for row in rows for heading in row if heading))
    widest = max((columns.table.width for columns in tables), default=0)
    for name in names:
        is_number = is_column_number(name) and int(name) <= widest
        if not is_number and same_heading(name) not in map(same_heading, headings):
            hint = f"there are {', '.join(f'`{heading[:60]}`' for heading in headings[:60])}"
            raise UnreadableError(f"no table has a column `{name}`", hint=hint)


def _add_to_groups(
    groups: dict[tuple[str, str], DraftGroup], columns: Columns, family: Family, options: Options
) -> list[str]:
    """Add the points of a table to the groups of its title, one group for each space.

    The comments about the table go to the group of its first point; without points, they are returned.
    """
    table = columns.table
    known = options.space or _space_of(columns)
    usual = "holding" if "holding" in family.spaces else next(iter(family.spaces))
    points, comments = points_of(columns, known or usual, options)
    title = columns.title or table.heading or "Points"
    if not columns.first:
        comments.append(f"the table at line {table.line} has no headings: it was read as the one above")
    if unread := columns.unread:
        comments.append(f"not read at line {table.line}: {', '.join(unread)}")
    if known is None and options.base is not None:
        comments.append(f"nothing names the space: is it {usual}?")
    if options.base == 0 and any(point.wire for point in points) and all(map(_may_be_reference, points)):
        comments.append("are the addresses Modicon references? Then import with `--base modicon`")
    for point in points:
        if point.space not in family.spaces:
            point.questions.append(f"the family {family.name} has no space {point.space}: is it {usual}?")
            point.space = usual
        group = groups.setdefault((title, point.space), DraftGroup(title, point.space, table.section))
        group.comments += [text for text in comments if text not in group.comments]
        comments = []
        point.section = table.section
        group.points.append(point)
    return comments


def _may_be_reference(point: DraftPoint) -> bool:
    return point.wire is None or re.fullmatch("[134][0-9]{4,5}", str(point.wire)) is not None


def _space_of(columns: Columns) -> str | None:
    """Return the space named by the heading of the addresses, or by the title or the heading of the table."""
    return next(filter(None, map(space_in, (columns.heading("address"), columns.title, columns.table.heading))), None)


def _ask_about_doubles(points: Iterable[DraftPoint]) -> None:
    """Turn the address of a point into a question if a point above has the same address."""
    first: dict[tuple[str, int | None, str | None], DraftPoint] = {}
    for point in points:
        above = first.setdefault((point.space, point.wire, point.facts.get("bits")), point)
        if point.wire is not None and above is not point:
            point.withdraw("at", f"`{above.title or above.code}` at line {above.line} has the same address")


def _give_names(groups: Iterable[DraftGroup]) -> None:
    """Give every group and every point a unique name."""
    of_groups, of_points = Names(), Names()
    for group in groups:
        group.name = of_groups.give(snake(group.title, "points"), group.space)
        for point in group.points:
            place = "unknown" if point.wire is None else str(point.wire)
            point.title = point.title or point.code or f"{group.space} {place}"
            otherwise = snake(point.code, "point")
            name = f"reserved_{place}" if "reserved" in point.facts else snake(point.title, otherwise)
            point.name = of_points.give(name, otherwise if point.code else place)


def compilable(groups: Sequence[DraftGroup], head: Head, *, with_head: bool) -> str:
    """Return the drafted groups as YAML that compiles, below the head of a device or as groups alone.

    Facts that the compiler rejects become questions, until it rejects none.
    """
    while True:
        top, head_lines, group_lines = draft_lines(groups, head)
        lines = [*top, *head_lines, *group_lines]
        if not _withdraw_rejected(lines):
            printed = lines if with_head else [*top, *group_lines[1:]]
            return "".join(f"{line.text}\n" for line in printed)


def _withdraw_rejected(lines: Sequence[Line]) -> bool:
    """Compile the lines, and turn rejected facts into questions. Return True if there were any.

    Raises ValueError for an error that no question can mend.
    """
    report = Report()
    with TemporaryDirectory() as folder:
        path = Path(folder, DEVICE_FILE)
        path.write_text("".join(f"{line.text}\n" for line in lines), "utf-8", newline="\n")
        load_device(path, report)
    errors = [finding for finding in report.findings if finding.severity == "error"]
    withdrawn: set[tuple[int, str]] = set()
    for finding in errors:
        spans = [finding.span, *(span for span, _ in finding.related)]
        owned = [line for span in spans if (line := lines[span.line - 1]).owner is not None]
        if not owned or (owner := owned[0].owner) is None:
            raise ValueError(finding.message)
        key = owned[0].key
        if (id(owner), key) in withdrawn:  # one fact may have several errors
            continue
        withdrawn.add((id(owner), key))
        other = owned[1].owner if finding.rule in _OVERLAPS and len(owned) > 1 else None
        if isinstance(owner, DraftPoint) and isinstance(other, DraftPoint):
            owner.share(other, key, finding.message)
        else:
            owner.withdraw(key, finding.message)
    return bool(errors)
