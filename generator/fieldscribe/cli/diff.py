"""`fieldscribe diff`: what changed between two descriptions, and whom it breaks."""

import sys
from argparse import ArgumentParser, Namespace
from contextlib import ExitStack
from pathlib import Path

from fieldscribe.authoring.formatting import rewrite
from fieldscribe.cli.common import StopError, description_paths, print_json, report_findings
from fieldscribe.cli.terminal import print_lines
from fieldscribe.diagnostics import Report, visible
from fieldscribe.differences.aliases import with_aliases
from fieldscribe.differences.changes import CLASSES, Comparison, as_data, compared
from fieldscribe.differences.rendering import as_markdown, as_text
from fieldscribe.differences.sides import EXPORT_HINT, opened

DIFF_EXAMPLE = """examples:
  fieldscribe diff HEAD~1:descriptions/hitachi_l200 descriptions/hitachi_l200
  fieldscribe diff v1.2.0:descriptions descriptions --format markdown > changes.md
  fieldscribe diff released.json hitachi_l200 --fail-on breaking       (released.json: of `export json`)
  fieldscribe diff old/my_drive my_drive --keep-names

classes: wire and api break (major), behaviour and compatible are new (minor), docs changes no code (patch)
ends with 1 when there are differences at or above --fail-on, or errors in a description: stderr lists them,
and the rest of the description is compared"""

_LEAST = {"breaking": 2, "behaviour": 3, "any": len(CLASSES)}
"""How many of the classes count, the gravest first."""


def add_diff_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the command."""
    add = parser.add_argument
    what = "a device's id, a folder of one device or of several, a file, an exported model, or GIT-REVISION:PATH"
    add("old", metavar="OLD", help=what)
    add("new", metavar="NEW", help="the same; they may be of different kinds")
    add("--fail-on", choices=tuple(_LEAST), default="any", help="which differences end with 1 (default: any)")
    add(
        "--keep-names",
        action="store_true",
        help="write `was: [OLD NAME]` to renamed points of NEW, so that the old names stay as deprecated aliases",
    )
    add("--format", choices=("text", "json", "markdown"), default="text", help="how to report (default: text)")


def run_diff(arguments: Namespace) -> int:
    """Compare and report; return the exit code."""
    report = Report()
    exported: list[str] = []
    try:
        with ExitStack() as stack:
            old, new = (stack.enter_context(opened(_known(side), report)) for side in (arguments.old, arguments.new))
            exported += [side.name_of(side.file) for side in (*old.values(), *new.values()) if side.described is None]
            report_findings(report, "text")
            if not (old and new):
                raise StopError("", code=1)
            comparisons = compared(old, new)
            if arguments.keep_names and _keep_names(arguments.new, comparisons):
                comparisons = compared(old, stack.enter_context(opened(_known(arguments.new), Report())))
            _print(arguments.format, comparisons)
    except (LookupError, TypeError, AttributeError, ValueError, RecursionError) as error:
        if not exported:
            raise
        files = " or ".join(exported)  # strangers may have written them
        raise StopError(f"{files} does not follow the schema of exported models", EXPORT_HINT) from error
    counted = list(CLASSES)[: _LEAST[arguments.fail_on]]
    counts = any(difference.weight in counted for each in comparisons for difference in each.differences)
    return int(counts or report.has_errors)


def _known(argument: str) -> str:
    """Return the argument, or the folder of the device that it names. Raises StopError."""
    if not argument:
        raise StopError("the path is empty")
    if ":" in argument:
        return argument
    return str(description_paths([Path(argument)])[0])


def _print(form: str, comparisons: list[Comparison]) -> None:
    if form == "json":
        print_json(as_data(comparisons))
    elif form == "markdown":
        print("\n".join(as_markdown(comparisons)))
    else:
        print_lines(list(as_text(comparisons)))


def _keep_names(argument: str, comparisons: list[Comparison]) -> bool:
    """Write `was` to the renamed points; return True if anything was written. Raises StopError."""
    if any(each.new and (each.new.described is None or each.new.copied) for each in comparisons):
        raise StopError(f"--keep-names writes to a description, `{argument}` is none", "name a folder or a file as NEW")
    written = False
    for each in comparisons:
        edited = with_aliases(each)
        rewrite(edited.files)
        written = written or bool(edited.files)
        for message in edited.messages:
            print(visible(message), file=sys.stderr)
    return written
