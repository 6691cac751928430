"""`fieldscribe snapshot`, `compare` and `restore`: what a device holds, kept in a file."""

import os
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from fieldscribe.cli.common import (
    StopError,
    add_descriptions,
    add_format,
    add_repeated,
    open_device,
    print_json,
)
from fieldscribe.cli.live_options import LINES, Live, Progress, add_live, add_pairs, add_writing, opened
from fieldscribe.cli.points import ask
from fieldscribe.cli.terminal import FINDINGS, FINE, print_lines
from fieldscribe.conversation.selection import choose_point
from fieldscribe.diagnostics import Line, UnclearError, visible
from fieldscribe.live.connection import FieldscribeError
from fieldscribe.live.restoring import Journal, Order, interrupted, ordered, refusals
from fieldscribe.live.snapshots import (
    Difference,
    Held,
    Snapshot,
    compared,
    contradictions,
    defaults,
    is_setting,
    may_be_replaced,
    read_snapshot,
    settings_of,
    take,
)
from fieldscribe.live.writing import Planner, Write, carry_out, in_requests
from fieldscribe.model import Device, Point
from fieldscribe.output import writing
from fieldscribe.safe_files import kind_of
from fieldscribe.text import counted

SNAPSHOT_EXAMPLE = f"""examples:
  fieldscribe snapshot hitachi_l200 --line tcp://192.168.0.20 --out before.json
  fieldscribe snapshot siemens_mm4 --line "uss:///dev/ttyUSB0?pkw=4&pzd=2" --variant interface=rs485 --out drive.json
  fieldscribe snapshot pump --out pump.json   (a station of fieldscribe.toml)

`compare` shows what differs from another snapshot or from the manual's defaults, `restore` writes the settings back

{LINES}

ends with 1 when points have no number (the file says why), with 2 when the line or the device does not answer"""


def add_snapshot_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_live(parser)
    parser.add_argument("--out", required=True, type=Path, metavar="FILE", help="the file to write, as JSON")


def run_snapshot(arguments: Namespace) -> int:
    """Read all and write the file; return the exit code."""
    if arguments.out.exists() and (kind := kind_of(os.stat(arguments.out))) is not None:
        raise StopError(f"{kind}: {arguments.out}", "name a file")
    if not may_be_replaced(arguments.out):
        raise StopError(f"{arguments.out} is there, and no snapshot: it would be lost", "name another file")
    given = list(arguments.settings)
    with opened(arguments) as live:
        snapshot = _taken(live)
    writing.replace(Path(os.path.realpath(arguments.out)), [replace(snapshot, given=given).as_text().encode("utf-8")])
    missing = [[("error", visible(f"{name}: {why}"))] for name, why in snapshot.missing.items()]
    print_lines(missing, sys.stderr)
    without = f", {len(missing)} without a number" if missing else ""
    print_lines([[("", visible(f"{len(snapshot.points)} points in {arguments.out}{without}"))]])
    return FINDINGS if missing else FINE


def _taken(live: Live) -> Snapshot:
    """Return all that the device holds now. Raises FieldscribeError."""
    progress = Progress()
    try:
        return take(live.model, live.device, live.line.text, progress.show)
    finally:
        progress.clear()


COMPARE_EXAMPLE = """examples:
  fieldscribe compare before.json after.json
  fieldscribe compare meter.json                   (with the defaults that the manual gives)
  fieldscribe compare before.json after.json --all --format json

the files are of `snapshot`; what can be written is compared by name, value and unit

ends with 1 when something differs"""


def add_compare_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("first", type=Path, metavar="FILE", help="a snapshot")
    parser.add_argument("second", nargs="?", type=Path, metavar="OTHER", help="another one (default: the defaults)")
    parser.add_argument("--all", action="store_true", help="compare read-only points too")
    add_descriptions(parser)
    add_format(parser)


def run_compare(arguments: Namespace) -> int:
    """Compare and print; return the exit code."""
    first, other = _examined(arguments, arguments.first), arguments.second
    second = defaults(_model_of(arguments, first)) if other is None else _examined(arguments, other)
    differences = compared(first, second, also_read=arguments.all)
    if arguments.format == "json":
        print_json({"first": first.title, "second": second.title, "differences": list(map(_as_data, differences))})
    else:
        _print_differences(first, second, differences)
    return FINDINGS if differences else FINE


def _examined(arguments: Namespace, file: Path) -> Snapshot:
    """Return the snapshot in a file, examined if its description is at hand. Raises UnclearError."""
    snapshot = read_snapshot(file)
    try:
        model = _model_of(arguments, snapshot)
    except UnclearError:
        return snapshot
    _require_agreement(model, snapshot)
    return snapshot


def _model_of(arguments: Namespace, snapshot: Snapshot) -> Device:
    """Return the description of a snapshot's device. Raises UnclearError."""
    arguments.device = snapshot.device
    arguments.variant = [f"{axis}={value}" for axis, value in snapshot.variants.items()]
    return open_device(arguments)


def _require_agreement(model: Device, snapshot: Snapshot) -> None:
    """Raise StopError if a point's raw number and its value contradict each other."""
    if wrong := list(contradictions(model, snapshot)):
        more = f" ({len(wrong)} such points)" if wrong[1:] else ""
        hint = "correct one: `restore` writes the raw number, `compare` compares the value"
        raise StopError(f"{snapshot.title}: {wrong[0]}{more}", hint, FINDINGS)


def _print_differences(first: Snapshot, second: Snapshot, differences: list[Difference]) -> None:
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


RESTORE_EXAMPLE = f"""examples:
  fieldscribe restore before.json --dry-run
  fieldscribe restore before.json             (to the device on the line that the file names)
  fieldscribe restore before.json --keep --yes --line rtu:///dev/ttyUSB0 --unit 3
  fieldscribe restore before.json pump --only A020 --only standard_a --yes   (a station of fieldscribe.toml)

reads the device first, and writes only settings that differ. By the description, a setting is kept, never changes by
itself, or has a default. --only names other points, --all takes everything that can be written, also commands and
setpoints. Limits, conditions and scales order the writes.
FILE.journal notes each write before and after it; after an early end the next start says what was written

{LINES}

ends with 1 when something cannot be written or was not, or the answer is no; with 2 when the line or the device does
not answer, and where nobody can be asked"""

_MOST_NAMES = 8
"""The most points left out that are named."""


def add_restore_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add("file", type=Path, metavar="FILE", help="a snapshot")
    add_live(parser, optional=True)
    add_repeated(parser, "--only", "POINT|GROUP", "restore only this, whatever it is")
    add("--all", action="store_true", help="also restore points that are not settings, such as commands and setpoints")
    add_repeated(parser, "--without", "POINT|GROUP", "do not restore this, as a baud rate or an address")
    add("--dry-run", action="store_true", help="only show what would be written")
    add_writing(parser)
    add_format(parser)


def run_restore(arguments: Namespace) -> int:
    """Restore, if the user agrees; return the exit code."""
    wanted = read_snapshot(arguments.file)
    journal = arguments.file.with_name(f"{arguments.file.name}.journal")
    print_lines([[("warning", visible(text))] for text in interrupted(journal)], sys.stderr)
    _take_from(wanted, arguments)
    with opened(arguments) as live:
        _require_agreement(live.model, wanted)
        now = _taken(live)
        order = ordered(live.model, now, wanted, _chooser(live, arguments))
        writes = _planned(live, now, order, keep=arguments.keep)
        _print_rest(live, order, by_name=bool(arguments.only or arguments.all))
        left = None
        if not arguments.dry_run:
            if writes and not arguments.yes:
                ask(live, writes)
            live.work.left = [write.reading.label for write in writes]
            _write_journalled(live, writes, now, Journal(journal, live.work.left, _journal_facts(arguments, live)))
            left = [item for item, raw in order.writes.items() if _differs(live, item, raw)]
            lost = sum(write.is_lost for write in writes)
            text = f"note: {lost} of {counted(len(writes), 'write')} lost when switched off, without --keep"
            print_lines([[("hint", text)]] if lost else [], sys.stderr)
        return _report_restored(arguments, live, writes, order, left)


def _differs(live: Live, item: str, raw: int) -> bool:
    """Return True if the device does not hold a number that was written to it. Raises FieldscribeError."""
    return live.device.point(item).read_raw() != raw


def _take_from(wanted: Snapshot, arguments: Namespace) -> None:
    """Take from the snapshot what neither the command line nor a station gives."""
    if arguments.device is None:
        arguments.device = wanted.device
        arguments.line = arguments.line or wanted.line
        arguments.unit = wanted.unit if arguments.unit is None else arguments.unit
    add_pairs(arguments, [f"{axis}={value}" for axis, value in wanted.variants.items()], wanted.given)


def _chooser(live: Live, arguments: Namespace) -> Callable[[Point], bool]:
    """Return a test for points: settings, or those of `--only`, except those of `--without`. Raises UnclearError."""
    usual: Callable[[Point], bool] = (lambda _point: True) if arguments.all else is_setting
    only = _named(live, arguments.only) if arguments.only else usual
    without = _named(live, arguments.without)
    return lambda point: only(point) and not without(point)


def _named(live: Live, names: list[str]) -> Callable[[Point], bool]:
    """Return a test for points by their names or groups. Raises UnclearError."""
    known = {group.name for group in live.model.groups}
    items = {choose_point(live.model, name, groups=known).item for name in names if name not in known}
    groups = known & {*names}
    return lambda point: point.item in items or point.group in groups


def _planned(live: Live, now: Snapshot, order: Order, *, keep: bool) -> list[Write]:
    """Return the writes, with everything to know before they are sent. Raises RefusedError."""
    planner = Planner(live.model, live.device, keep=keep, lenient=True, known=settings_of(live.model, now.raws))
    return planner.plan([f"{item}.raw={raw}" for item, raw in order.writes.items()])


def _print_rest(live: Live, order: Order, *, by_name: bool) -> None:
    """Print what is not restored."""
    lines = [[("error", visible(f"cannot be written: {text}"))] for text in refusals(live.model, order)]
    if order.unknown:
        lines.append([("warning", visible(f"not in the description: {', '.join(order.unknown)}"))])
    if order.others and not by_name:
        names = ", ".join(order.others[:_MOST_NAMES])
        more = f" and {len(order.others) - _MOST_NAMES} more" if order.others[_MOST_NAMES:] else ""
        why = f"the description of {live.model.id} does not say that they are settings"
        text = (
            f"left out, and different, for {why}: {names}{more}; --only NAME or GROUP restores some, --all all of them"
        )
        lines.append([("warning", visible(text))])
    print_lines(lines, sys.stderr)


def _journal_facts(arguments: Namespace, live: Live) -> dict[str, object]:
    return {"file": str(arguments.file), **live.head, "keep": arguments.keep}


def _write_journalled(live: Live, writes: list[Write], now: Snapshot, journal: Journal) -> None:
    """Write all, each with its lines in the journal. Raises FieldscribeError, OSError."""
    try:
        for request in in_requests(live.model, writes):
            numbers = [writes.index(write) for write in request]
            for number, write in zip(numbers, request, strict=True):
                held = now.points.get(write.item)
                journal.note(begin=number, before=held and held.raw, raw=write.raw, text=write.text)
            try:
                with live.work.writing([write.reading.label for write in request]):
                    carry_out(request, live.device)
            except FieldscribeError as error:
                for number in numbers if not error.lost else ():
                    journal.note(refused=number, why=str(error))
                raise
            for number in numbers:
                journal.note(done=number)
        journal.end()
    finally:
        journal.close()


def _report_restored(
    arguments: Namespace, live: Live, writes: list[Write], order: Order, left: list[str] | None
) -> int:
    """Print the result, and return the exit code; `left` are points that still differ, None if nothing was written."""
    if arguments.format == "json":
        key, what = "would_write" if left is None else "written", [write.reading.as_data() for write in writes]
        rest = {"refused": order.refused, "still_different": left or []}
        print_json({**live.head, "same": order.same, key: what, **rest})
    else:
        verb = "would be written" if left is None else "written"
        lines = [[("", visible(f"{verb}: {write.text}"))] for write in writes]
        print_lines([*lines, [("", f"as in the file before: {order.same}")]])
    print_lines([[("error", visible(f"still different: {', '.join(left)}"))]] if left else [], sys.stderr)
    return FINDINGS if order.refused or left else FINE
