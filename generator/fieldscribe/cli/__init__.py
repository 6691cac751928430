"""The command line: the only place that prints or exits. A command is one module here and one line below."""

from __future__ import annotations

import gc
import os
import sys
from errno import ENAMETOOLONG
from importlib import import_module
from typing import TYPE_CHECKING, Any, NoReturn

from fieldscribe import __version__

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Sequence
    from typing import Protocol

    class Command(Protocol):
        """What a command's module offers."""

        HELP: str
        EXAMPLE: str

        def add_arguments(self, parser: ArgumentParser) -> None:
            """The command's arguments."""

        def run(self, arguments: Namespace) -> int:
            """Do it; the exit code."""


COMMANDS = {
    "check": "validate descriptions; say everything that is wrong, and where",
    "generate": "compile descriptions into C, Python, Rust, documentation and vectors",
    "vendor": "leave exactly the files that a project needs of a device: all of it, or some points",
    "docs": "write the documentation of devices: a workbook, tables as CSV, or a page in Markdown",
    "export": "print a device for other tools: the resolved model as JSON, or a CAN database (DBC)",
    "explain": "say everything about one address, code or name",
    "decode": "say what frames from the line mean",
    "encode": "turn a value into its raw number, or into the whole request frame",
    "audit": "hold everything that a description cites against the text of its manual",
    "diff": "say what changed between two descriptions, whom it breaks, and which step the version must take",
    "list": "list the devices there are, or the points of one",
    "search": "find words in titles, codes, sections, names, flags, labels and numbers of all devices",
    "completion": "print what makes a shell complete commands, options, devices and points",
    "init": "start a description that compiles at once, by a few questions or by options",
    "import": "draft a description from the tables of a manual: its text, CSV, TSV, Markdown, HTML, XLSX",
    "fmt": "bring descriptions into their canonical form; what they say stays the same, and so do comments",
    "watch": "compile descriptions, and say what is wrong with them, whenever a file of theirs is saved",
    "units": "list the units that descriptions can use without declaring them",
    "schema": "print the keys of descriptions: as JSON Schema for editors, or as a page to read",
}
"""All commands with what they do, in the order in which they are listed. Their modules are imported when chosen."""

_MODULES = {"list": "listing"}
"""Commands whose module has another name: a module `list` would hide Python's own."""

FINE, FINDINGS, USAGE = 0, 1, 2
"""Exit codes: all is well; findings in the input, or stale output; wrong usage or trouble with the machine."""

_DIGITS = frozenset(".0123456789")
_INTERRUPTED, _PIPE_CLOSED = 130, 141


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code. No exception gets out: every failure is a message on stderr."""
    sys.stdout = sys.stdout or open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115  # it was closed by the caller
    sys.stderr = sys.stderr or open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115  # likewise
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    gc.disable()  # a run is short and has no reference cycles: collection would cost a third of a large compile
    try:
        code = _dispatch(list(sys.argv[1:] if argv is None else argv))
        sys.stdout.flush()
    except KeyboardInterrupt:
        return _INTERRUPTED
    except BrokenPipeError:
        _forget_stdout()
        return _PIPE_CLOSED
    except OSError as error:
        where = "" if error.filename is None else f": {ascii(str(error.filename)[:200])[1:-1]}"
        print(f"fieldscribe: {error.strerror or type(error).__name__}{where}", file=sys.stderr)
        if error.errno == ENAMETOOLONG:
            print("  hint: give a shorter name, or a shorter path", file=sys.stderr)
        return USAGE
    except Exception as error:
        return _failed(error)
    return code


def _dispatch(argv: list[str]) -> int:
    if not argv or argv[0] not in COMMANDS:
        return _overview(argv)
    name = argv[0]
    command = command_of(name)
    parser = _parser(f"fieldscribe {name}", command.HELP, command.EXAMPLE)
    command.add_arguments(parser)
    # a value such as `-5Hz` is no option: none of ours starts with a digit
    words = [f" {word}" if word[:1] == "-" and word[1:2] in _DIGITS else word for word in argv[1:]]
    try:
        arguments, unknown = parser.parse_known_intermixed_args(words)
        if unknown:
            parser.error(_unrecognised(unknown, parser))
    except SystemExit as stop:
        return _left(stop)
    from fieldscribe.cli.common import StopError

    try:
        return command.run(arguments)
    except StopError as stop:
        return stop.tell()


def _unrecognised(unknown: list[str], parser: ArgumentParser) -> str:
    """The message for words that mean nothing, with options that are near them."""
    from fieldscribe.user_errors import did_you_mean

    options = [name for action in parser._actions for name in action.option_strings]  # argparse tells them nowhere else
    message = f"unrecognized arguments: {' '.join(unknown)}"
    wrong = [word.partition("=")[0] for word in unknown if word.startswith("-")]
    if not wrong:
        return message
    from difflib import get_close_matches

    near = dict.fromkeys(name for word in wrong for name in get_close_matches(word[:60], options, 2))
    return f"{message}; {did_you_mean(list(near))}" if near else message


def _overview(argv: list[str]) -> int:
    """`--help`, `--version`, and what is no command."""
    width = max(map(len, COMMANDS))
    listed = "\n".join(f"  {name:<{width}}  {does}" for name, does in COMMANDS.items())
    parser = _parser(
        "fieldscribe",
        "Compiles descriptions of fieldbus devices into code, documentation and tests.",
        f"commands:\n{listed}\n\n`fieldscribe COMMAND --help` says more, with examples.",
    )
    parser.usage = "fieldscribe COMMAND ..."
    parser.add_argument("-V", "--version", action="version", version=f"fieldscribe {__version__}")
    if argv and not argv[0].startswith("-"):
        from fieldscribe.cli.common import unknown_command

        return unknown_command(argv[0], COMMANDS)
    try:
        parser.parse_args(argv)
    except SystemExit as stop:
        return _left(stop)
    parser.print_help(sys.stderr)
    return USAGE


def _left(stop: SystemExit) -> int:
    """The exit code of argparse, which has printed the reason."""
    return stop.code if isinstance(stop.code, int) else USAGE


def command_of(name: str) -> Command:
    """The module of a command."""
    module: Any = import_module(f"fieldscribe.cli.{_MODULES.get(name, name)}")
    command: Command = module
    return command


def _parser(prog: str, description: str, epilog: str) -> ArgumentParser:
    from argparse import ArgumentParser, RawDescriptionHelpFormatter

    class Parser(ArgumentParser):
        """A parser that quotes arguments in messages as findings do: file names may hold control characters."""

        def error(self, message: str) -> NoReturn:
            from fieldscribe.report import visible

            super().error(visible(message))

    return Parser(
        prog=prog,
        description=description[0].upper() + description[1:].rstrip(".") + ".",
        epilog=epilog,
        formatter_class=lambda prog: RawDescriptionHelpFormatter(prog, width=_width()),
        allow_abbrev=False,
    )


def _width() -> int:
    """The columns of the terminal, without shutil: argparse would import it with all its archive formats."""
    try:
        columns = int(os.environ.get("COLUMNS", "0")) or os.get_terminal_size(sys.stdout.fileno()).columns
    except (OSError, ValueError):
        columns = 80
    return max(40, min(columns, 120) - 2)


def _forget_stdout() -> None:
    """The reader closed the pipe: send the rest of the output nowhere, also at interpreter exit."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (OSError, ValueError):
        return


def show_traceback(error: BaseException) -> None:
    """Print the traceback of an internal error if FIELDSCRIBE_DEBUG is set."""
    if os.environ.get("FIELDSCRIBE_DEBUG"):
        import traceback

        traceback.print_exception(error)


def _failed(error: Exception) -> int:
    show_traceback(error)
    text = ascii(str(error)[:200])[1:-1]
    print(
        f"fieldscribe: internal error: {type(error).__name__}: {text}; this is a bug: please report it to the project "
        "with the command line and the description (FIELDSCRIBE_DEBUG=1 shows where)",
        file=sys.stderr,
    )
    return USAGE
