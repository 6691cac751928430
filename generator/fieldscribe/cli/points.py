"""`fieldscribe read`, `write` and `monitor`: the values of a device's points on its line."""

import gc
import sys
import time
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterator
from datetime import datetime

from fieldscribe.cli.common import StopError, add_format, period, print_json, times
from fieldscribe.cli.live_options import LINES, Live, add_live, add_points, add_writing, opened
from fieldscribe.cli.terminal import FINDINGS, FINE, USAGE, is_coloured, print_lines, terminal_size
from fieldscribe.diagnostics import Line, visible
from fieldscribe.live.connection import FieldscribeError
from fieldscribe.live.readings import GOOD, Reader, Reading, chosen
from fieldscribe.live.writing import Planner, Write, carry_out, in_requests

READ_EXAMPLE = f"""examples:
  fieldscribe read hitachi_l200 A020 F002 --line tcp://192.168.0.20
  fieldscribe read hitachi_l200 status --line "rtu:///dev/ttyUSB0?baud=19200" --unit 3
  fieldscribe read siemens_mm4 P1082 --line "uss:///dev/ttyUSB0?pkw=4&pzd=2" -v
  fieldscribe read woodward_mpu2s generator_frequency --line can://socketcan/can0 --format json
  fieldscribe read pump output_frequency   (a station of fieldscribe.toml)

{LINES}
fieldscribe.toml names lines and stations: [lines] bench = "tcp://192.168.0.20",
[stations.pump] description = "hitachi_l200", line = "bench", unit = 3

ends with 1 when a point has no value or the device refuses it, with 2 when the line or the device does not answer"""


def add_read_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_live(parser)
    add_points(parser)
    add_format(parser)


def run_read(arguments: Namespace) -> int:
    """Read points and print their values; return the exit code."""
    with opened(arguments) as live:
        what = chosen(live.model, arguments.points)
        with live.progress():
            readings = Reader(live.model, live.device).read(what)
        if arguments.format == "json":
            print_json({**live.head, "values": [reading.as_data() for reading in readings]})
        else:
            print_readings(readings)
    return FINE if all(reading.status in GOOD for reading in readings) else FINDINGS


def print_readings(readings: list[Reading]) -> None:
    """Print readings as a table of names and values."""
    width = max([len(reading.label) for reading in readings], default=0)
    print_lines(
        [
            [("", f"{visible(reading.label):<{width}}  "), (style_of(reading), visible(reading.text))]
            for reading in readings
        ]
    )


def style_of(reading: Reading) -> str:
    """Return the style in which a reading stands out."""
    return "" if reading.status == "ok" else "warning" if reading.status == "special" else "error"


WRITE_EXAMPLE = f"""examples:
  fieldscribe write hitachi_l200 A020=50 --line tcp://192.168.0.20
  fieldscribe write hitachi_l200 "A003=50 Hz" A002=modbus --keep --line rtu:///dev/ttyUSB0 --unit 3
  fieldscribe write hitachi_l200 run_command=run --yes --line tcp://192.168.0.20
  fieldscribe write hitachi_l200 enter --line tcp://192.168.0.20
  fieldscribe write siemens_mm4 P1082=40 --keep --line "uss:///dev/ttyUSB0?pkw=4&pzd=2"
  fieldscribe write pump network_frequency_setpoint=12.5

values are as in `encode`. All of them are checked, with what their limits depend on in the device, before the first is
sent. A value may move what the device drives, and no description knows that: each write is asked for, with all that
the manual says of it, unless --yes is given.

{LINES}

ends with 1 when a value or the device refuses it, or the answer is no; with 2 when the line or the device does not
answer, and where nobody can be asked"""


def add_write_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_live(parser)
    parser.add_argument(
        "words",
        nargs="+",
        metavar="POINT=VALUE|COMMAND",
        help="a point with a value as for `encode`, or a command; arguments follow it, as in dim:percent=50",
    )
    add_writing(parser)
    add_format(parser)


def run_write(arguments: Namespace) -> int:
    """Write, if the user agrees; return the exit code."""
    with opened(arguments, reads=False) as live:
        with live.progress():
            writes = Planner(live.model, live.device, keep=arguments.keep).plan(arguments.words)
        if arguments.yes:
            notes = [note for write in writes for note in write.notes]
            print_lines(([("hint", f"note: {visible(note)}")] for note in notes), sys.stderr)
        else:
            ask(live, writes)
        live.work.left = [write.reading.label for write in writes]
        with live.progress():
            for request in in_requests(live.model, writes):
                with live.work.writing([write.reading.label for write in request]):
                    carry_out(request, live.device)
    if arguments.format == "json":
        print_json({**live.head, "written": [write.reading.as_data() for write in writes]})
    else:
        print_lines([[("", f"written: {visible(write.text)}")] for write in writes])
    return FINE


def ask(live: Live, writes: list[Write]) -> None:
    """Show what is to be written, and ask. Raises StopError if nobody can be asked, or the answer is no."""
    lines: list[Line] = [[("strong", f"{live.model.id}, unit {live.device.unit}, {visible(live.line.text)}:")]]
    for write in writes:
        lines.append([("", f"  {visible(write.text)}")])
        lines += [[("hint", f"    {visible(remark)}")] for remark in (*write.notes, *write.remarks)]
    print_lines(lines, sys.stderr)
    if not sys.stdin.isatty():
        raise StopError("nobody can be asked here: nothing was written", "give --yes if this is meant", USAGE)
    print("Write this? [y/N] ", end="", file=sys.stderr, flush=True)
    if sys.stdin.readline().strip().lower() not in ("y", "yes"):
        raise StopError("nothing was written", code=FINDINGS)


MONITOR_EXAMPLE = f"""examples:
  fieldscribe monitor hitachi_l200 status --line tcp://192.168.0.20
  fieldscribe monitor hitachi_l200 d001 d002 --every 0.2 --line rtu:///dev/ttyUSB0 --unit 3
  fieldscribe monitor pump status --format csv > pump.csv
  fieldscribe monitor pump status --format jsonl --count 60

A terminal shows a table, with the last changes highlighted. Elsewhere each change is a line: as text, as CSV, or as
JSON. --all prints what did not change, too.

{LINES}

goes on after errors of the line; ends with 0 at Ctrl-C or after --count, with 2 when nothing answers at first"""

_COLUMNS = ("time", *Reading._fields)


def add_monitor_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_live(parser)
    add_points(parser)
    add = parser.add_argument
    add("--every", type=period, default=1.0, metavar="SECONDS", help="how often they are read (default: 1)")
    add("--count", type=times, metavar="N", help="number of readings (default: until Ctrl-C)")
    add("--all", action="store_true", help="print all points each time, not only what changed")
    add("--format", choices=("text", "csv", "jsonl"), default="text", help="how to print (default: text)")


def run_monitor(arguments: Namespace) -> int:
    """Show changes until Ctrl-C or `--count`; return the exit code."""
    gc.enable()  # the process may run for days
    with opened(arguments) as live:
        show = _printer(arguments)
        try:
            for readings in _samples(live, arguments):
                show(readings)
        except KeyboardInterrupt:
            print(f"ended after {live.device.traffic.requests} requests; nothing was written", file=sys.stderr)
    return FINE


def _samples(live: Live, arguments: Namespace) -> Iterator[list[Reading]]:
    """Yield the readings of each period; after a lost line, the next ones. Raises if the first read fails."""
    reader, what = Reader(live.model, live.device), chosen(live.model, arguments.points)
    yield reader.read(what)
    due, left, is_lost = time.monotonic(), arguments.count, False
    while left is None or (left := left - 1) > 0:
        due = max(due + arguments.every, time.monotonic())
        time.sleep(max(0.0, due - time.monotonic()))
        try:
            readings = reader.read(what)
        except FieldscribeError as error:
            _report_lost(error, is_lost=is_lost)
            is_lost = True
        else:
            is_lost = False
            yield readings


def _report_lost(error: FieldscribeError, *, is_lost: bool) -> None:
    """Print that the line is lost; once until it is back."""
    if not error.lost:
        raise error
    if not is_lost:
        print(f"{datetime.now():%H:%M:%S} {visible(str(error))}; going on", file=sys.stderr)


Printer = Callable[[list[Reading]], None]
Show = Callable[[str, Reading], None]


def _printer(arguments: Namespace) -> Printer:
    """Return a function that prints readings in the chosen form."""
    if arguments.format == "text" and is_coloured(sys.stdout) and not arguments.verbose:
        return _Table()
    show: Show = _csv_writer() if arguments.format == "csv" else _show_line
    return _Changes(_show_json if arguments.format == "jsonl" else show, everything=arguments.all)


class _Changes:
    """Prints each reading that changed."""

    def __init__(self, show: Show, *, everything: bool) -> None:
        self._show, self._everything = show, everything
        self._before: dict[str, Reading] = {}

    def __call__(self, readings: list[Reading]) -> None:
        now = datetime.now().astimezone().isoformat(timespec="milliseconds")
        for reading in readings:
            if self._everything or self._before.get(reading.name) != reading:
                self._show(now, reading)
        self._before = {reading.name: reading for reading in readings}
        sys.stdout.flush()


def _show_line(now: str, reading: Reading) -> None:
    print_lines([[("", f"{now[11:23]}  {visible(reading.label)}  "), (style_of(reading), visible(reading.text))]])


def _show_json(now: str, reading: Reading) -> None:
    import json

    print(json.dumps({"time": now, **reading.as_data()}))


def _csv_writer() -> Show:
    import csv

    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(_COLUMNS)

    def show(now: str, reading: Reading) -> None:
        writer.writerow([now, *(visible(one) if isinstance(one, str) else one for one in reading)])

    return show


class _Table:
    """A table that is redrawn in place, limited to the lines of the terminal."""

    def __init__(self) -> None:
        self._before: dict[str, Reading] = {}
        self._drawn = 0

    def __call__(self, readings: list[Reading]) -> None:
        columns, lines = terminal_size()
        first_rows = readings[: lines - 2]
        width = max(len(reading.label) for reading in readings) if readings else 0
        rows: list[Line] = []
        for reading in first_rows:
            is_new = self._before and self._before.get(reading.name) != reading
            text = visible(reading.text)[: max(8, columns - width - 5)]
            rows.append(
                [("", f"{visible(reading.label):<{width}}  "), ("strong" if is_new else style_of(reading), text)]
            )
        rest = len(readings) - len(first_rows)
        more = f", {rest} more below the screen" if rest else ""
        rows.append([("hint", f"{datetime.now():%H:%M:%S}{more}; Ctrl-C ends")])
        sys.stdout.write(f"\x1b[{self._drawn}F\x1b[J" if self._drawn else "")
        print_lines(rows)
        sys.stdout.flush()
        self._drawn = len(rows)
        self._before = {reading.name: reading for reading in readings}
