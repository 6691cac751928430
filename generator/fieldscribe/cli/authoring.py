"""`fieldscribe init` and `fmt`: start a description, and bring descriptions into their canonical form."""

import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Mapping
from pathlib import Path

from fieldscribe.authoring.formatting import Formatting, files_of, formatted
from fieldscribe.authoring.starting import QUESTIONS, Question, start, startable, wrong_with
from fieldscribe.cli.common import (
    LOCAL,
    StopError,
    add_format,
    description_paths,
    print_json,
    report_findings,
    some_path,
)
from fieldscribe.cli.terminal import FINDINGS, FINE
from fieldscribe.diagnostics import Report, as_data, visible
from fieldscribe.language.nodes import MOST_BYTES
from fieldscribe.pipeline import find_devices

INIT_EXAMPLE = """examples:
  fieldscribe init
  fieldscribe init heat_pump --family modbus --vendor Example --model "HP 12" --title "Heat pump"

makes DEVICE/device.yaml in ./descriptions (if that is there, else here), with one point and a frame to replace, and
the schema for editors beside it, unless one stands in the folder above; what is there already is never touched.
On a terminal, what no option says is asked; ends with 2 when something is missing or in the way"""


def add_init_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    device, *others = QUESTIONS
    add(device.name, nargs="?", metavar="DEVICE", help=device.asks)
    for question in others:
        usual = f" (default: {question.usual.format(vendor='VENDOR', model='MODEL')})" if question.usual else ""
        add(f"--{question.name}", metavar="TEXT", help=question.asks + usual)
    add("--in", dest="folder", type=some_path, metavar="DIR", help="the folder to make it in")


def run_init(arguments: Namespace) -> int:
    """Make the description, and return the exit code."""
    within: Path = arguments.folder or (LOCAL if LOCAL.is_dir() else Path())
    if not within.is_dir():
        raise StopError(f"there is no folder `{within}`", "make it first, or name another with --in")
    answers = _answers(vars(arguments))
    folder = within / answers["device"]
    try:
        made = start(folder, answers)
    except FileExistsError as error:
        hint = "choose another id, or another folder with --in"
        raise StopError(f"there is already `{folder}`: nothing was written", hint) from error
    _print_next_steps(folder, made)
    return FINE


def _answers(options: Mapping[str, str | None]) -> dict[str, str]:
    """Return the answers: from options, from the terminal, or usual ones. Raises StopError."""
    answers: dict[str, str] = {}
    may_ask = sys.stdin is not None and sys.stdin.isatty() and sys.stderr.isatty()
    missing: list[str] = []
    for question in QUESTIONS:
        given = options[question.name]
        if given is not None:
            wrong = wrong_with(question.name, given)
            if wrong is not None:
                raise StopError(f"{_option_of(question)}: {wrong[0]}", wrong[1])
            answers[question.name] = given
        elif may_ask:
            answers[question.name] = _ask(question, question.usual.format(**answers))
        elif question.usual and not missing:
            answers[question.name] = question.usual.format(**answers)
        elif not question.usual:
            missing.append(_option_of(question))
    if missing:
        raise StopError(f"missing: {', '.join(missing)}", "say it on the command line, or run `init` on a terminal")
    return answers


def _option_of(question: Question) -> str:
    return "DEVICE" if question is QUESTIONS[0] else f"--{question.name}"


def _ask(question: Question, usual: str) -> str:
    """Ask on the terminal and return the answer. Raises StopError at the end of input."""
    write: Callable[[str], int] = sys.stderr.write
    if question.name == "family":
        for name, serves in startable().items():
            write(f"  {name:<8}{serves}\n")
    while True:
        write(f"{question.asks}{f' [{visible(usual)}]' if usual else ''}: ")
        sys.stderr.flush()
        typed = sys.stdin.readline()
        if not typed:
            write("\n")
            raise StopError("stopped: nothing was written")
        answer = typed.strip() or usual
        wrong = wrong_with(question.name, answer)
        if wrong is None:
            return answer
        write(f"  {visible(wrong[0])}{f'; {visible(wrong[1])}' if wrong[1] else ''}\n")


def _print_next_steps(folder: Path, made: list[Path]) -> None:
    where = visible(str(folder))
    print(f"made {' and '.join(visible(str(path)) for path in made)}")
    print("next:")
    print(f"  fieldscribe check {where}")
    print(f"  fieldscribe watch {where} --out bindings   (compiles, and says what is wrong, while you edit)")
    print("replace the point and the frames by what the manual prints; `fieldscribe schema --page` lists all keys")


FMT_EXAMPLE = """examples:
  fieldscribe fmt
  fieldscribe fmt heat_pump --check     (writes nothing; for CI)
  fieldscribe fmt - < status.yaml       (for editors: the canonical form on standard output)

Indents, blanks, quotes and empty lines become those of the shipped descriptions; which keys share a line stays your
choice. A schema of ours that a first line names is brought up to date, too.
ends with 1 when a file is not YAML, and with --check when one is not in its canonical form"""

_STDIN = Path("-")


def add_fmt_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    paths = "device ids, folders of descriptions, single files, or - (default: device.yaml here, else descriptions)"
    add("paths", nargs="*", type=some_path, metavar="PATH", help=paths)
    add("--check", action="store_true", help="write nothing; say what is not in its canonical form")
    add_format(parser)


def run_fmt(arguments: Namespace) -> int:
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
