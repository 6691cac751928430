"""`fieldscribe restore`: write the settings of a snapshot back, in an order that the device allows."""

import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from fieldscribe.cli.common import StopError, add_format, add_repeated, print_json
from fieldscribe.cli.live_options import LINES, Live, add_live, add_pairs, add_unit, add_writing, opened
from fieldscribe.cli.terminal import FINDINGS, FINE, print_lines
from fieldscribe.cli.write import ask
from fieldscribe.conversation.selection import choose_point
from fieldscribe.diagnostics import RefusedError, visible
from fieldscribe.live.connection import FieldscribeError
from fieldscribe.live.restoring import Journal, Order, interrupted, ordered, refusals
from fieldscribe.live.snapshots import Snapshot, is_setting, read_snapshot, settings_of
from fieldscribe.live.writing import Planner, Write, carry_out, in_requests
from fieldscribe.model import Point
from fieldscribe.text import counted

EXAMPLE = f"""examples:
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


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add("file", type=Path, metavar="FILE", help="a snapshot")
    add_live(parser, optional=True)
    add_unit(parser)
    add_repeated(parser, "--only", "POINT|GROUP", "restore only this, whatever it is")
    add("--all", action="store_true", help="also restore points that are not settings, such as commands and setpoints")
    add_repeated(parser, "--without", "POINT|GROUP", "do not restore this, as a baud rate or an address")
    add("--dry-run", action="store_true", help="only show what would be written")
    add_writing(parser)
    add_format(parser)


def run(arguments: Namespace) -> int:
    """Restore, if the user agrees; return the exit code."""
    wanted = read_snapshot(arguments.file)
    journal = arguments.file.with_name(f"{arguments.file.name}.journal")
    if (before := interrupted(journal)) is not None:
        print_lines([[("warning", visible(text))] for text in before.lines()], sys.stderr)
    _take_from(wanted, arguments)
    with opened(arguments) as live:
        now = live.taken()
        order = ordered(live.model, now, wanted, _chooser(live, arguments))
        writes = _planned(live, now, order, keep=arguments.keep)
        _print_rest(live, order, by_name=bool(arguments.only or arguments.all))
        done = Done(writes, order.refused, order.same)
        if not arguments.dry_run:
            if writes and not arguments.yes:
                ask(live, writes)
            live.work.left = [write.reading.label for write in writes]
            _write(live, writes, now, Journal(journal, live.work.left, _facts(arguments, live)))
            done.left = [item for item, raw in order.writes.items() if _differs(live, item, raw)]
            done.is_written = True
            lost = sum(write.is_lost for write in writes)
            text = f"note: {lost} of {counted(len(writes), 'write')} lost when switched off, without --keep"
            print_lines([[("hint", text)]] if lost else [], sys.stderr)
        return _report(arguments, live, done)


@dataclass
class Done:
    """The state of a restore: writes planned or done, impossible ones, equal points, and points that still differ."""

    writes: list[Write]
    refused: dict[str, str]
    same: int
    left: list[str] = field(default_factory=list)
    is_written: bool = False


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
    """Return the writes, with everything to know before they are sent. Raises StopError."""
    planner = Planner(live.model, live.device, keep=keep, lenient=True, known=settings_of(live.model, now.raws))
    try:
        return planner.plan([f"{item}.raw={raw}" for item, raw in order.writes.items()])
    except RefusedError as error:
        raise StopError(error.message, error.hint, FINDINGS) from error


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


def _facts(arguments: Namespace, live: Live) -> dict[str, object]:
    return {"file": str(arguments.file), **live.head, "keep": arguments.keep}


def _write(live: Live, writes: list[Write], now: Snapshot, journal: Journal) -> None:
    """Write all, each with its lines in the journal. Raises FieldscribeError, OSError."""
    try:
        for request in in_requests(live.model, writes):
            numbers = [writes.index(write) for write in request]
            for number, write in zip(numbers, request, strict=True):
                held = now.points.get(write.item)
                journal.begin(number, before=held and held.raw, raw=write.raw, text=write.text)
            try:
                with live.work.writing([write.reading.label for write in request]):
                    carry_out(request, live.device)
            except FieldscribeError as error:
                for number in numbers if not error.lost else ():
                    journal.refused(number, str(error))
                raise
            for number in numbers:
                journal.done(number)
        journal.end()
    finally:
        journal.close()


def _report(arguments: Namespace, live: Live, done: Done) -> int:
    """Print the result, and return the exit code."""
    if arguments.format == "json":
        what = [write.reading.as_data() for write in done.writes]
        key = "written" if done.is_written else "would_write"
        print_json({**live.head, "same": done.same, key: what, "refused": done.refused, "still_different": done.left})
    else:
        verb = "written" if done.is_written else "would be written"
        lines = [[("", visible(f"{verb}: {write.text}"))] for write in done.writes]
        print_lines([*lines, [("", f"as in the file before: {done.same}")]])
    print_lines([[("error", visible(f"still different: {', '.join(done.left)}"))]] if done.left else [], sys.stderr)
    return FINDINGS if done.refused or done.left else FINE
