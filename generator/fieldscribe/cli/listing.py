"""`fieldscribe list`: the known devices, or the points of one."""

from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterable, Mapping, Sequence
from fnmatch import fnmatchcase

from fieldscribe import wording
from fieldscribe.cli import common
from fieldscribe.cli.terminal import FINDINGS, FINE, print_lines
from fieldscribe.conversation.selection import points_by_name, present
from fieldscribe.diagnostics import visible
from fieldscribe.model import Device, Point
from fieldscribe.search import summary_of
from fieldscribe.text import csv_cell, line
from fieldscribe.wording.numbers import hex_text

EXAMPLE = """examples:
  fieldscribe list
  fieldscribe list --family modbus --format json
  fieldscribe list hitachi_l200
  fieldscribe list hitachi_l200 --matching "A0*" --access w
  fieldscribe list woodward_mpu2s --unit Hz --space telegram
  fieldscribe list siemens_mm4 --group parameters --format csv

ends with 1 when the list is empty"""

_COLUMNS = ("code", "name", "space", "address", "access", "type", "unit", "range", "group", "title")
_DEVICE_COLUMNS = ("device", "family", "version", "points", "vendor", "model", "title")


def _same(value: str | None, given: str) -> bool:
    return (value or "").casefold() == given.casefold()


_FILTERS: dict[str, tuple[str, str, Callable[[Point, str], bool]]] = {
    "group": ("NAME", "of this group", lambda point, given: _same(point.group, given)),
    "access": (
        "r|w",
        "that can be read (r), written (w) or both (rw)",
        lambda point, given: set(given) <= set(point.access),
    ),
    "space": (
        "NAME",
        "of this space: coil, holding, parameter, telegram, ...",
        lambda point, given: _same(point.space, given),
    ),
    "unit": ("SYMBOL", "in this unit, as in Hz", lambda point, given: point.unit.symbol == given),
    "type": ("TYPE", "of this type, as in u16", lambda point, given: _same(point.type, given)),
}
"""The options that choose points: metavar, help text, and the test of a point."""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    common.add_device(parser, optional=True)
    common.add_repeated(parser, "--matching", "GLOB", "only names or codes like this")
    add("--family", metavar="NAME", help="only devices of this family")
    for option, (metavar, which, _) in _FILTERS.items():
        add(f"--{option}", metavar=metavar, help=f"only points {which}")
    common.add_format(parser, ("csv",))


def run(arguments: Namespace) -> int:
    """List devices or points; return the exit code."""
    return _devices(arguments) if arguments.device is None else _points(arguments)


def _devices(arguments: Namespace) -> int:
    about_points = [f"--{name}" for name in (*_FILTERS, "variant") if getattr(arguments, name)]
    if about_points:
        raise common.StopError(f"{about_points[0]} chooses points", "name their DEVICE, too")
    data = [
        summary.as_data()
        for file in common.searched_devices(arguments).values()
        if (summary := summary_of(file)) is not None
        and arguments.family in (None, summary.family)
        and _matches(arguments.matching, (summary.device,))
    ]
    rows = [{**device, "title": " / ".join(dict.fromkeys(device["title"].values()))} for device in data]
    cells = [[str(row[column]) for column in _DEVICE_COLUMNS] for row in rows]
    return _print(arguments.format, _DEVICE_COLUMNS, cells, {"devices": data})


def _points(arguments: Namespace) -> int:
    if arguments.family is not None:
        raise common.StopError("--family chooses devices", "leave out DEVICE, or --family")
    device = common.open_device(arguments)
    tests = [
        (test, given) for name, (_, _, test) in _FILTERS.items() if (given := getattr(arguments, name)) is not None
    ]
    points = [
        point
        for point in present(device, device.points)
        if all(test(point, value) for test, value in tests)
        and _matches(arguments.matching, (point.item, point.name, point.code or ""))
    ]
    rows = [_cells(device, point) for point in points]
    data = [
        {
            **dict(zip(_COLUMNS, row, strict=True)),
            "code": point.code,
            "address": point.address,
            "title": dict(point.title),
        }
        for point, row in zip(points, rows, strict=True)
    ]
    return _print(arguments.format, _COLUMNS, rows, {"device": device.id, "points": data})


def _cells(device: Device, point: Point) -> list[str]:
    """Return the cells of a point's row, in the order of `_COLUMNS`."""
    address = "" if point.address is None else hex_text(point.address)
    values = wording.range_text(point, points_by_name(device)) or wording.raw_range_text(point)
    space = point.space if point.telegram is None else f"{point.space} {point.telegram}"
    cells = (point.code or "", point.item, space, address, point.access, wording.type_text(point), point.unit.symbol,
             values, point.group, wording.title_text(point.title))  # fmt: skip
    return [line(cell) for cell in cells]


def _matches(globs: Iterable[str], names: Iterable[str]) -> bool:
    """Return True if each glob matches one of the names, in any case."""
    known = [name.casefold() for name in names if name]
    return all(any(fnmatchcase(name, glob.casefold()) for name in known) for glob in globs)


def _print(form: str, head: Sequence[str], rows: Sequence[Sequence[str]], data: Mapping[str, object]) -> int:
    """Print the list; return the exit code."""
    if form == "json":
        common.print_json(data)
    elif form == "csv":
        print_lines([[("", ",".join(map(csv_cell, row)))] for row in (head, *rows)])
    elif rows:
        widths = [max(len(row[place]) for row in (head, *rows)) for place in range(len(head))]
        for number, row in enumerate((head, *rows)):
            cells = "  ".join(f"{visible(cell):<{width}}" for cell, width in zip(row, widths, strict=True))
            print_lines([[("" if number else "strong", cells.rstrip())]])
    else:
        common.usage_error("nothing matches", "the list without options shows how its values are written")
    return FINE if rows else FINDINGS
