"""`fieldscribe snapshot`: write all that a device holds to a file."""

import os
import sys
from argparse import ArgumentParser, Namespace
from dataclasses import replace
from pathlib import Path

from fieldscribe.cli.common import StopError
from fieldscribe.cli.live_options import LINES, add_live, add_unit, opened
from fieldscribe.cli.terminal import FINDINGS, FINE, print_lines
from fieldscribe.diagnostics import visible
from fieldscribe.live.snapshots import may_be_replaced
from fieldscribe.output import writing
from fieldscribe.safe_files import kind_of

EXAMPLE = f"""examples:
  fieldscribe snapshot hitachi_l200 --line tcp://192.168.0.20 --out before.json
  fieldscribe snapshot siemens_mm4 --line "uss:///dev/ttyUSB0?pkw=4&pzd=2" --variant interface=rs485 --out drive.json
  fieldscribe snapshot pump --out pump.json   (a station of fieldscribe.toml)

`compare` shows what differs from another snapshot or from the manual's defaults, `restore` writes the settings back

{LINES}

ends with 1 when points have no number (the file says why), with 2 when the line or the device does not answer"""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_live(parser)
    parser.add_argument("--out", required=True, type=Path, metavar="FILE", help="the file to write, as JSON")
    add_unit(parser)


def run(arguments: Namespace) -> int:
    """Read all and write the file; return the exit code."""
    if arguments.out.exists() and (kind := kind_of(os.stat(arguments.out))) is not None:
        raise StopError(f"{kind}: {arguments.out}", "name a file")
    if not may_be_replaced(arguments.out):
        raise StopError(f"{arguments.out} is there, and no snapshot: it would be lost", "name another file")
    given = list(arguments.settings)
    with opened(arguments) as live:
        snapshot = live.taken()
    writing.replace(Path(os.path.realpath(arguments.out)), [replace(snapshot, given=given).as_text().encode("utf-8")])
    missing = [[("error", visible(f"{name}: {why}"))] for name, why in snapshot.missing.items()]
    print_lines(missing, sys.stderr)
    without = f", {len(missing)} without a number" if missing else ""
    print_lines([[("", visible(f"{len(snapshot.points)} points in {arguments.out}{without}"))]])
    return FINDINGS if missing else FINE
