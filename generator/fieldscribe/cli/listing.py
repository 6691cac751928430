"""`fieldscribe list`: the devices there are, and the points of one."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Callable, Iterable, Sequence

    from fieldscribe.model import Device, Point

HELP = "list the devices there are, or the points of one"
EXAMPLE = """examples:
  fieldscribe list
  fieldscribe list --family modbus --format json
  fieldscribe list hitachi_l200
  fieldscribe list hitachi_l200 --matching "A0*" --access w
  fieldscribe list woodward_mpu2s --unit Hz --space telegram
  fieldscribe list siemens_mm4 --group parameters --format csv

ends with 1 when nothing is like that"""

_COLUMNS = ("code", "name", "space", "address", "access", "type", "unit", "range", "group", "title")


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import add_descriptions, add_format

    parser.add_argument(
        "device", nargs="?", metavar="DEVICE", help="a device's id, or the path of its folder or device.yaml"
    )
    add_descriptions(parser)
    parser.add_argument(
        "--matching", action="append", default=[], metavar="GLOB", help="only names or codes like this; may be repeated"
    )
    parser.add_argument("--family", metavar="NAME", help="only devices of this family")
    for option, what in _FILTERS.items():
        parser.add_argument(f"--{option}", metavar=what[0], help=f"only points {what[1]}")
    parser.add_argument(
        "--variant",
        action="append",
        default=[],
        metavar="AXIS=VALUE",
        help="only points of this variant; may be repeated",
    )
    add_format(parser, ("csv",))


def _starts(have: str | None, asked: str) -> bool:
    return (have or "").casefold() == asked.casefold()


_FILTERS: dict[str, tuple[str, str, Callable[[Point, str], bool]]] = {
    "group": ("NAME", "of this group", lambda point, asked: _starts(point.group, asked)),
    "access": (
        "r|w",
        "that can be read (r), written (w) or both (rw)",
        lambda point, asked: set(asked) <= set(point.access),
    ),
    "space": (
        "NAME",
        "of this space: coil, holding, parameter, telegram, ...",
        lambda point, asked: _starts(point.space, asked),
    ),
    "unit": ("SYMBOL", "in this unit, as in Hz", lambda point, asked: point.unit.symbol == asked),
    "type": ("TYPE", "of this type, as in u16", lambda point, asked: _starts(point.type, asked)),
}
"""The options that choose points: what they take, what they mean, and whether a point is meant."""


def run(arguments: Namespace) -> int:
    """List them; the exit code."""
    return _devices(arguments) if arguments.device is None else _points(arguments)


def _devices(arguments: Namespace) -> int:
    from fieldscribe.cli.common import StopError, devices_asked
    from fieldscribe.search.summaries import outlines_of

    about_points = [f"--{name}" for name in (*_FILTERS, "variant") if getattr(arguments, name)]
    if about_points:
        raise StopError(f"{about_points[0]} chooses points", "name their DEVICE, too")
    outlines = [
        outline
        for outline in outlines_of(devices_asked(arguments).values())
        if arguments.family in (None, outline.family) and _is_like(arguments.matching, (outline.id,))
    ]
    rows = [[outline.id, outline.family, outline.version, str(outline.points), outline.vendor, outline.model,
             " / ".join(dict.fromkeys(outline.title.values()))] for outline in outlines]  # fmt: skip
    head = ("device", "family", "version", "points", "vendor", "model", "title")
    return _print(arguments.format, head, rows, {"devices": [outline.as_data() for outline in outlines]})


def _points(arguments: Namespace) -> int:
    from fieldscribe.cli.common import StopError, open_device
    from fieldscribe.conversation.selection import present

    if arguments.family is not None:
        raise StopError("--family chooses devices", "leave out DEVICE, or --family")
    device = open_device(arguments)
    chosen = [
        (holds, asked) for name, (_, _, holds) in _FILTERS.items() if (asked := getattr(arguments, name)) is not None
    ]
    points = [
        point
        for point in present(device, device.points)
        if all(holds(point, asked) for holds, asked in chosen)
        and _is_like(arguments.matching, (point.item, point.name, point.code or ""))
    ]
    described = [_described(device, point) for point in points]
    data = [
        {
            **dict(zip(_COLUMNS, row, strict=True)),
            "code": point.code,
            "address": point.address,
            "title": dict(point.title),
        }
        for point, row in zip(points, described, strict=True)
    ]
    return _print(arguments.format, _COLUMNS, described, {"device": device.id, "points": data})


def _described(device: Device, point: Point) -> list[str]:
    from fieldscribe import wording
    from fieldscribe.conversation.selection import points_by_name
    from fieldscribe.text import line
    from fieldscribe.wording.exact import hex_text

    where = "" if point.address is None else hex_text(point.address)
    allowed = wording.range_text(point, points_by_name(device)) or wording.raw_range_text(point)
    space = point.space if point.telegram is None else f"{point.space} {point.telegram}"
    cells = (point.code or "", point.item, space, where, point.access, wording.type_text(point), point.unit.symbol,
             allowed, point.group, wording.title_text(point.title))  # fmt: skip
    return [line(cell) for cell in cells]


def _is_like(globs: Iterable[str], names: Iterable[str]) -> bool:
    """Whether some name is like every glob, whatever the case; without any glob all are."""
    from fnmatch import fnmatchcase

    known = [name.casefold() for name in names if name]
    return all(any(fnmatchcase(name, glob.casefold()) for name in known) for glob in globs)


def _print(form: str, head: Sequence[str], rows: Sequence[Sequence[str]], data: dict[str, object]) -> int:
    from fieldscribe.cli import FINDINGS, FINE
    from fieldscribe.cli.common import print_json
    from fieldscribe.cli.terminal import print_lines
    from fieldscribe.report import visible
    from fieldscribe.text import csv_cell

    if form == "json":
        print_json(data)
    elif form == "csv":
        print_lines([[("", ",".join(map(csv_cell, row)))] for row in (head, *rows)])
    elif rows:
        widths = [max(len(row[place]) for row in (head, *rows)) for place in range(len(head))]
        for number, row in enumerate((head, *rows)):
            cells = "  ".join(f"{visible(cell):<{width}}" for cell, width in zip(row, widths, strict=True))
            print_lines([[("" if number else "strong", cells.rstrip())]])
    return FINE if rows else FINDINGS
