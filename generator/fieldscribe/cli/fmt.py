"""`fieldscribe fmt`: bring descriptions into their canonical form."""

import sys
from argparse import ArgumentParser, Namespace
from pathlib import Path

from fieldscribe.authoring.formatting import Formatting, MovedError, files_of, formatted
from fieldscribe.cli.common import StopError, add_format, description_paths, print_json, report_findings, some_path
from fieldscribe.cli.terminal import FINDINGS, FINE
from fieldscribe.diagnostics import Report, as_data, visible
from fieldscribe.language.nodes import MOST_BYTES
from fieldscribe.pipeline import find_devices

EXAMPLE = """examples:
  fieldscribe fmt
  fieldscribe fmt heat_pump --check     (writes nothing; for CI)
  fieldscribe fmt - < status.yaml       (for editors: the canonical form on standard output)

Indents, blanks, quotes and empty lines become those of the shipped descriptions; which keys share a line stays your
choice. A schema of ours that a first line names is brought up to date, too.
ends with 1 when a file is not YAML, and with --check when one is not in its canonical form"""

_STDIN = Path("-")


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    paths = "device ids, folders of descriptions, single files, or - (default: device.yaml here, else descriptions)"
    add("paths", nargs="*", type=some_path, metavar="PATH", help=paths)
    add("--check", action="store_true", help="write nothing; say what is not in its canonical form")
    add_format(parser)


def run(arguments: Namespace) -> int:
    """Format, and return the exit code."""
    report = Report()
    if _STDIN not in arguments.paths:
        return _format_files(arguments, report)
    if len(arguments.paths) > 1 or arguments.check or arguments.format != "text":
        raise StopError("`-` takes no other path and no option", "give the text on standard input, and nothing else")
    return _format_stdin(report)


def _format_stdin(report: Report) -> int:
    new = formatted("<stdin>", sys.stdin.buffer.read(MOST_BYTES + 1), report)
    if new is None:
        report_findings(report, "text")
        return FINDINGS
    sys.stdout.flush()
    sys.stdout.buffer.write(new)
    return FINE


def _format_files(arguments: Namespace, report: Report) -> int:
    run = Formatting(report, writes=not arguments.check)
    for path in find_devices(description_paths(arguments.paths), report):
        for file in files_of(path):
            try:
                run.file(file)
            except MovedError as error:
                raise StopError(f"`{file}` was saved while it was formatted: it stays as it is", "run again") from error
            except OSError as error:
                raise StopError(f"`{file}`: {error.strerror}") from error
    if arguments.format == "json":
        changed = [path.as_posix() for path in run.changed]
        print_json({"changed": changed, "unchanged": run.kept, "findings": as_data(report.findings)})
    else:
        what = "not formatted" if arguments.check else "formatted"
        for path in run.changed:
            print(f"{what}: {visible(str(path))}")
        report_findings(report, "text")
        print(f"{len(run.changed)} {what}, {run.kept} in canonical form")
    return FINDINGS if report.has_errors or (arguments.check and run.changed) else FINE
