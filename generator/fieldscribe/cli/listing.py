"""`fieldscribe list`, `search` and `units`: devices, points, words in descriptions, and units."""

from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterable, Mapping, Sequence
from fnmatch import fnmatchcase

from fieldscribe import wording
from fieldscribe.cli import common
from fieldscribe.cli.common import add_format, print_json, usage_error
from fieldscribe.cli.terminal import FINDINGS, FINE, print_lines
from fieldscribe.conversation.selection import points_by_name, present
from fieldscribe.diagnostics import Report, did_you_mean, place_text, visible
from fieldscribe.grouping import grouped
from fieldscribe.language.units import Known, shipped, shipped_unit, unit_hint
from fieldscribe.model import Device, Point
from fieldscribe.pipeline import load_analysis
from fieldscribe.search import Entry, Hit, entries_of, near_words, search, summary_of
from fieldscribe.text import csv_cell, line, shortened
from fieldscribe.wording.numbers import hex_text

LIST_EXAMPLE = """examples:
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


def add_list_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    common.add_device(parser, optional=True)
    common.add_repeated(parser, "--matching", "GLOB", "only names or codes like this")
    add("--family", metavar="NAME", help="only devices of this family")
    for option, (metavar, which, _) in _FILTERS.items():
        add(f"--{option}", metavar=metavar, help=f"only points {which}")
    common.add_format(parser, ("csv",))


def run_list(arguments: Namespace) -> int:
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
    return _print_list(arguments.format, _DEVICE_COLUMNS, cells, {"devices": data})


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
    return _print_list(arguments.format, _COLUMNS, rows, {"device": device.id, "points": data})


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


def _print_list(form: str, head: Sequence[str], rows: Sequence[Sequence[str]], data: Mapping[str, object]) -> int:
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


SEARCH_EXAMPLE = """examples:
  fieldscribe search Hochlaufzeit
  fieldscribe search acceleration time
  fieldscribe search E07
  fieldscribe search error:21h
  fieldscribe search 4.2.40 --device woodward_mpu2s
  fieldscribe search ueberspannung --format json

All WORDs must occur in the texts of one point, command, message or code, in any case and language; ä and ae are the
same. Exact codes and names come first.

ends with 1 when nothing has all words"""

_MOST = 20
_MOST_WORDS = 20


def add_search_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add("words", nargs="+", metavar="WORD", help="a word, a code, a section, or a number with its kind: error:21h")
    common.add_repeated(parser, "--device", "DEVICE", "only this device")
    common.add_descriptions(parser)
    add("--most", type=int, default=_MOST, metavar="N", help=f"print the nearest N, 0 for all (default: {_MOST})")
    common.add_format(parser)


def run_search(arguments: Namespace) -> int:
    """Search and print the hits; return the exit code."""
    words = [word for text in arguments.words for word in text.split()]
    if not words:
        raise common.StopError("there is no word to search", "give a word, a code or a section")
    if len(words) > _MOST_WORDS:
        raise common.StopError(f"{len(words)} words are too many", f"give at most {_MOST_WORDS}: all must occur")
    entries = _searched_entries(arguments)
    hits = search(entries, words)
    near = [] if hits else near_words(entries, words)
    if arguments.format == "json":
        common.print_json({"words": words, "hits": [_hit_data(hit) for hit in hits], "near": near})
    elif hits:
        _print_hits(hits, arguments.most)
    else:
        common.usage_error(f"nothing has `{shortened(' '.join(words))}`", did_you_mean(near))
    return FINE if hits else FINDINGS


def _searched_entries(arguments: Namespace) -> list[Entry]:
    """Return the entries of the chosen devices; those with errors are left out, with a message."""
    folder = arguments.descriptions
    named = {name: common.device_file(Namespace(device=name, descriptions=folder)) for name in arguments.device}
    entries: list[Entry] = []
    for name, file in (named or common.searched_devices(arguments)).items():
        subject = load_analysis(file, Report())
        if subject is None:
            common.usage_error(f"`{name}` has errors and is left out", f"fieldscribe check {name}")
        else:
            entries += entries_of(subject)
    return entries


def _hit_data(hit: Hit) -> dict[str, object]:
    matched = []
    for text in hit.texts:
        span = text.place
        matched.append(
            {"what": text.kind, "text": text.text, "file": span.file, "line": span.line, "column": span.column}
        )
    entry = hit.entry
    return {"device": entry.device, "kind": entry.kind, "name": entry.name, "code": entry.code, "matched": matched}


def _print_hits(hits: Sequence[Hit], most: int) -> None:
    for hit in hits[: most if most > 0 else None]:
        print_lines([[("strong", visible(f"{hit.entry.device} {hit.entry.heading}"))]])
        for text in hit.texts:
            number = "" if text.number is None or text.text == str(text.number) else f" ({text.number})"
            found = f"  {text.kind} `{visible(text.text)}`{number}, "
            print_lines([[("", found), ("place", place_text(text.place))]])
    if 0 < most < len(hits):
        print_lines([[("hint", f"and {len(hits) - most} more: --most 0 shows all")]])


UNITS_EXAMPLE = """examples:
  fieldscribe units
  fieldscribe units kVAh mW
  fieldscribe units pressure --format json

A description declares other units under `units`, and may give one of these symbols another meaning there.

ends with 1 when a WORD names no unit"""


def add_units_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "words", nargs="*", metavar="WORD", help="a symbol (its case counts), a name or a quantity (default: all units)"
    )
    add_format(parser)


def run_units(arguments: Namespace) -> int:
    """List the units; return the exit code."""
    chosen: dict[str, Known] = {} if arguments.words else dict(shipped())
    code = FINE
    for word in arguments.words:
        found = _units_named(word)
        chosen |= {known.unit.symbol: known for known in found}
        if not found:
            code = FINDINGS
            usage_error(f"no unit, name or quantity is `{shortened(word)}`", unit_hint(word, ()))
    if arguments.format == "json":
        print_json({"units": [_unit_data(known) for known in chosen.values()]})
    else:
        _print_units(list(chosen.values()), with_prefixes=bool(arguments.words))
    return code


def _units_named(word: str) -> list[Known]:
    """Return the unit with this symbol, else all units with this name or quantity."""
    unit, name = shipped_unit(word), word.casefold()
    if unit is not None:
        return [known for known in shipped().values() if known.unit == unit]
    return [
        known for known in shipped().values() if name in (known.unit.name.casefold(), known.unit.quantity.casefold())
    ]


def _unit_data(known: Known) -> dict[str, str]:
    """Return a unit for JSON; `factor` is its exact size in `base`."""
    unit = known.unit
    described = {"symbol": unit.symbol, "name": unit.name, "quantity": unit.quantity}
    return {**described, "base": known.base, "factor": str(known.factor)}


def _print_units(chosen: Sequence[Known], *, with_prefixes: bool) -> None:
    """Print a line for each unit; prefixed units have their own only `with_prefixes`, else they follow their base."""
    prefixed = grouped((known.base, known.unit.symbol) for known in chosen if known.prefix)
    listed = [known for known in chosen if with_prefixes or not known.prefix]
    width = max((len(known.unit.symbol) for known in listed), default=0)
    for known in listed:
        text = f"{known.unit.name} ({known.unit.quantity})"
        if known.prefix:
            text += f" = {known.factor} {known.base}"
        elif not with_prefixes and known.base in prefixed:
            text += f"; also {', '.join(prefixed[known.base])}"
        print_lines([[("strong", f"{known.unit.symbol:<{width}}"), ("", f"  {text}")]])
