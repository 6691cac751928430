"""`fieldscribe import sunspec` and `import wb`: draft the description of a whole device from what a program knows."""

import re
from argparse import ArgumentTypeError, Namespace

from fieldscribe.cli.common import Parser, add_repeated
from fieldscribe.importing import compilable
from fieldscribe.importing.draft_text import WholeDraft
from fieldscribe.importing.sunspec import draft_models
from fieldscribe.importing.sunspec.models import read_models
from fieldscribe.importing.wb import draft
from fieldscribe.text import counted


def add_arguments(parser: Parser) -> None:
    """Add the options of `import sunspec`; `import wb` has none."""
    what = "which models of a folder the device has, as 1,103,120 (default: all)"
    parser.add_argument("--models", type=_numbers, default=(), metavar="N,N", help=what)
    what = "how many elements of a group are described, if the device says how many there are (default: 10)"
    parser.add_argument("--most", type=int, choices=range(1, 1001), default=10, metavar="N", help=what)
    what = "how far scale factors lie from 0 at most (default: 10): with 6, points of 16 bits have integer counts"
    parser.add_argument("--exponents", type=int, choices=range(1, 11), default=10, metavar="N", help=what)
    what = "what a point that counts elements holds in the device, for what lies after them"
    add_repeated(parser, "--count", "POINT=N", what, type=_count)


def from_models(arguments: Namespace) -> tuple[str, list[str]]:
    """Return the draft of models of SunSpec, and a report of it. Raises UnreadableError."""
    models = read_models(arguments.file, arguments.models)
    name, counts = arguments.device or "sunspec", dict(arguments.count)
    drafted = draft_models(models, name, arguments.most, counts, arguments.exponents)
    return _with_report(drafted, f"{counted(len(models), 'model')}, {counted(len(drafted.points), 'point')}")


def from_template(arguments: Namespace) -> tuple[str, list[str]]:
    """Return the draft of a template of wb-mqtt-serial, and a report of it. Raises UnreadableError."""
    drafted = draft(arguments.file, arguments.device or "draft")
    return _with_report(drafted, counted(len(drafted.points), "row"))


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


def _with_report(drafted: WholeDraft, counts: str) -> tuple[str, list[str]]:
    """Return the text of a draft, and the report of what is carried and what is not."""
    whole = sum(not point.questions for point in drafted.points)
    lost = (f"not carried: {what} ({times})" for what, times in drafted.not_carried.most_common())
    return compilable(drafted.groups, drafted.head, with_head=True), ["; ".join((f"{counts}, {whole} whole", *lost))]
