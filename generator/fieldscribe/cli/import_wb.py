"""`fieldscribe import wb`: draft the description of a device from a template of wb-mqtt-serial."""

import sys
from argparse import Namespace

from fieldscribe.cli.common import Parser, StopError, write_draft
from fieldscribe.cli.terminal import FINDINGS, FINE
from fieldscribe.importing import compilable
from fieldscribe.importing.readers import UnreadableError
from fieldscribe.importing.wb import draft
from fieldscribe.report import visible
from fieldscribe.text import counted


def add_arguments(parser: Parser) -> None:
    """Add the options of this kind: none."""


def run(arguments: Namespace) -> int:
    """Import, print what is not carried, and return the exit code."""
    try:
        drafted = draft(arguments.file, arguments.device or "draft")
    except UnreadableError as error:
        where = f"{arguments.file}:{error.line}" if error.line else str(arguments.file)
        raise StopError(f"{where}: {error.message}", error.hint, FINDINGS) from error
    write_draft(compilable(drafted.groups, drafted.head, with_head=True), arguments.out)
    points = [point for group in drafted.groups for point in group.points]
    lost = [f"not carried: {what} ({times})" for what, times in drafted.not_carried.most_common()]
    whole = sum(not point.questions for point in points)
    print(visible("; ".join((f"{counted(len(points), 'row')}, {whole} whole", *lost))), file=sys.stderr)
    return FINE
