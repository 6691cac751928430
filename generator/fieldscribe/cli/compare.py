"""`fieldscribe compare`: the differences between two snapshots, or between one and the manual's defaults."""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from fieldscribe.cli.common import add_descriptions, add_format, open_device, print_json
from fieldscribe.cli.terminal import FINDINGS, FINE, print_lines
from fieldscribe.diagnostics import Line, visible
from fieldscribe.live.snapshots import Difference, Held, Snapshot, compared, defaults, read_snapshot

EXAMPLE = """examples:
  fieldscribe compare before.json after.json
  fieldscribe compare meter.json                   (with the defaults that the manual gives)
  fieldscribe compare before.json after.json --all --format json

the files are of `snapshot`; what can be written is compared by name, value and unit

ends with 1 when something differs"""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("first", type=Path, metavar="FILE", help="a snapshot")
    parser.add_argument("second", nargs="?", type=Path, metavar="OTHER", help="another one (default: the defaults)")
    parser.add_argument("--all", action="store_true", help="compare read-only points too")
    add_descriptions(parser)
    add_format(parser)


def run(arguments: Namespace) -> int:
    """Compare and print; return the exit code."""
    first = read_snapshot(arguments.first)
    second = _defaults(arguments, first) if arguments.second is None else read_snapshot(arguments.second)
    differences = compared(first, second, also_read=arguments.all)
    if arguments.format == "json":
        print_json({"first": first.title, "second": second.title, "differences": list(map(_as_data, differences))})
    else:
        _print(first, second, differences)
    return FINDINGS if differences else FINE


def _defaults(arguments: Namespace, first: Snapshot) -> Snapshot:
    """Return the defaults in the description of the snapshot's device. Raises UnclearError."""
    arguments.device = first.device
    arguments.variant = [f"{axis}={value}" for axis, value in first.variants.items()]
    return defaults(open_device(arguments))


def _print(first: Snapshot, second: Snapshot, differences: list[Difference]) -> None:
    width = max([len(each.label) for each in differences], default=0)
    lines: list[Line] = [[("strong", visible(f"{first.title} -> {second.title}:"))]]
    for each in differences:
        label = visible(each.label)
        lines.append([("", f"  {label:<{width}}  {visible(_text(each.first))} -> {visible(_text(each.second))}")])
    count = len(differences)
    total = f"{count} difference{'' if count == 1 else 's'}" if count else "no difference"
    print_lines([*lines, [("", total)]])


def _text(held: Held | None) -> str:
    return "nothing" if held is None else held.text


def _as_data(each: Difference) -> dict[str, object]:
    sides = {"first": each.first, "second": each.second}
    return {"name": each.name, **{side: None if held is None else held._asdict() for side, held in sides.items()}}
