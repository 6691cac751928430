"""`fieldscribe init`: start a description."""

import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Mapping
from pathlib import Path

from fieldscribe.authoring.starting import QUESTIONS, NotStartedError, Question, start, startable, wrong_with
from fieldscribe.cli.common import LOCAL, StopError, some_path
from fieldscribe.cli.terminal import FINE
from fieldscribe.diagnostics import visible

EXAMPLE = """examples:
  fieldscribe init
  fieldscribe init heat_pump --family modbus --vendor Example --model "HP 12" --title "Heat pump"

makes DEVICE/device.yaml in ./descriptions (if that is there, else here), with one point and a frame to replace, and
the schema for editors beside it, unless one stands in the folder above; what is there already is never touched.
On a terminal, what no option says is asked; ends with 2 when something is missing or in the way"""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    device, *others = QUESTIONS
    add(device.name, nargs="?", metavar="DEVICE", help=device.asks)
    for question in others:
        usual = f" (default: {question.usual.format(vendor='VENDOR', model='MODEL')})" if question.usual else ""
        add(f"--{question.name}", metavar="TEXT", help=question.asks + usual)
    add("--in", dest="folder", type=some_path, metavar="DIR", help="the folder to make it in")


def run(arguments: Namespace) -> int:
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
    except NotStartedError as error:
        raise StopError(f"{error.finding.message}; nothing was written", error.finding.hint or "") from error
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
                raise StopError(f"{_option(question)}: {wrong[0]}", wrong[1])
            answers[question.name] = given
        elif may_ask:
            answers[question.name] = _ask(question, question.usual.format(**answers))
        elif question.usual and not missing:
            answers[question.name] = question.usual.format(**answers)
        elif not question.usual:
            missing.append(_option(question))
    if missing:
        raise StopError(f"missing: {', '.join(missing)}", "say it on the command line, or run `init` on a terminal")
    return answers


def _option(question: Question) -> str:
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
