"""`fieldscribe import sunspec`: draft the description of a device from models of SunSpec."""

import re
import sys
from argparse import ArgumentTypeError, Namespace

from fieldscribe.cli.common import Parser, StopError, add_repeated, write_draft
from fieldscribe.cli.terminal import FINDINGS, FINE
from fieldscribe.importing import compilable
from fieldscribe.importing.readers import UnreadableError
from fieldscribe.importing.sunspec import Imported, draft_models
from fieldscribe.importing.sunspec.models import read_models
from fieldscribe.report import visible
from fieldscribe.text import counted


def add_arguments(parser: Parser) -> None:
    """Add the options of this kind."""
    what = "which models of a folder the device has, as 1,103,120 (default: all)"
    parser.add_argument("--models", type=_numbers, default=(), metavar="N,N", help=what)
    what = "how many elements of a group are described, if the device says how many there are (default: 10)"
    parser.add_argument("--most", type=int, choices=range(1, 1001), default=10, metavar="N", help=what)
    what = "how far scale factors lie from 0 at most (default: 10): with 6, points of 16 bits have integer counts"
    parser.add_argument("--exponents", type=int, choices=range(1, 11), default=10, metavar="N", help=what)
    what = "what a point that counts elements holds in the device, for what lies after them"
    add_repeated(parser, "--count", "POINT=N", what, type=_count)


def run(arguments: Namespace) -> int:
    """Import, and return the exit code."""
    try:
        models = read_models(arguments.file, arguments.models)
        name, counts = arguments.device or "sunspec", dict(arguments.count)
        imported = draft_models(models, name, arguments.most, counts, arguments.exponents)
    except UnreadableError as error:
        raise StopError(f"{arguments.file}: {error.message}", error.hint, FINDINGS) from error
    write_draft(compilable(imported.groups, imported.head, with_head=True), arguments.out)
    print(_report(len(models), imported), file=sys.stderr)
    return FINE


def _numbers(text: str) -> tuple[int, ...]:
    """Return the numbers of `1,103,120`."""
    if not re.fullmatch(r"[0-9]{1,5}(?:,[0-9]{1,5}){0,999}", text):
        raise ArgumentTypeError(f"`{text}` are no numbers of models: write them as 1,103,120")
    return tuple(map(int, text.split(",")))


def _count(text: str) -> tuple[str, int]:
    """Return the name and the number of `NPt=4`."""
    name, _, number = text.partition("=")
    if not name or not re.fullmatch("[0-9]{1,4}", number):
        raise ArgumentTypeError(f"`{text}` is no number of elements: write it as NPt=4")
    return name, int(number)


def _report(models: int, imported: Imported) -> str:
    """Return a report of what is carried and what is not."""
    whole = sum(not point.questions for point in imported.points)
    lost = imported.lost().most_common()
    first = f"{counted(models, 'model')}, {counted(len(imported.points), 'point')}, {whole} whole"
    return visible("; ".join((first, *(f"not carried: {what} ({times})" for what, times in lost))))
