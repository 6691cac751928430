"""The command line: the only room that prints, exits, or decides where files are written.

To add a command, write it in a module of this folder and add one line to `COMMANDS`; `explain.py` is a short model.
In a module of another name, such as one with related commands, it also needs a word in `_MODULES`. The command `list`
has in its module

- `LIST_EXAMPLE`: the end of its `--help`: examples, and the meaning of its exit codes,
- `add_list_arguments(parser)`: its arguments, with the shared ones of `common.py` (`add_device`, `add_paths`, ...),
- `run_list(arguments)`: does the work and returns `FINE`, `FINDINGS` or `USAGE`. Results go to stdout, messages to
  stderr. To stop a command, raise `common.StopError`.

A module is imported when its command is chosen, so it can import what it needs at its top. Tests: an entry in
`tests/cli/test_help_examples.py` for each example, and in `tests/cli/test_reporting.py` for each exit code.
"""

from __future__ import annotations

import gc
import os
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Sequence
from errno import ENAMETOOLONG
from importlib import import_module
from typing import NamedTuple, NoReturn

from fieldscribe import __version__
from fieldscribe.cli.terminal import FINDINGS, USAGE, terminal_width

COMMANDS = {
    "check": "validate descriptions; print everything that is wrong, and where",
    "generate": "compile descriptions into C, Python, Rust, documentation and vectors",
    "vendor": "write exactly the files that a project needs of a device: for all points, or some",
    "docs": "write the documentation of devices: a workbook, tables as CSV, Markdown, or pages with a search",
    "export": "print a device for other tools: the resolved model as JSON, or a CAN database (DBC)",
    "explain": "show everything about one address, code or name",
    "decode": "decode frames from the line into points and values",
    "listen": "show what is exchanged on a line or in a capture: names, values, who polls what, what is wrong",
    "encode": "turn a value into its raw number, or into the whole request frame",
    "simulate": "let devices answer on a line, as their descriptions say: TCP, serial ports, CAN",
    "read": "read points of a device on its line: names, values and units",
    "write": "write points of a device on its line, or give a command, after asking",
    "monitor": "read points of a device again and again: a table of changes, CSV or JSON lines",
    "scan": "list the units that answer on a line, and with what",
    "snapshot": "write all that a device holds now to a file",
    "compare": "show what differs between two snapshots, or between one and the manual's defaults",
    "restore": "write the settings of a snapshot back, in an order that the device allows, with a journal",
    "identify": "say which known device answers on a line",
    "audit": "compare everything that a description cites with the text of its manual",
    "diff": "show what changed between two descriptions, whom it breaks, and which step the version must take",
    "list": "list the known devices, or the points of one",
    "search": "find words in titles, codes, sections, names, flags, labels and numbers of all devices",
    "completion": "print the script with which a shell completes commands, options, devices and points",
    "init": "start a description that compiles at once, by a few questions or by options",
    "import": "draft a description from a file of another kind: tables, models of SunSpec, a gateway's template",
    "fmt": "bring descriptions into their canonical form; facts and comments stay the same",
    "watch": "compile descriptions and print their findings each time one of their files is saved",
    "units": "list the units that descriptions can use without declaring them",
    "schema": "print the keys of descriptions as JSON Schema or as a page, or the JSON Schema of exported models",
}
"""All commands and what they do, in the order of `--help`."""

_MODULES = {
    "authoring": ("init", "fmt"),
    "conversion": ("decode", "encode"),
    "deliveries": ("vendor", "docs"),
    "discovery": ("scan", "identify"),
    "export": ("export", "schema"),
    "importing": ("import",),
    "listing": ("list", "search", "units"),
    "points": ("read", "write", "monitor"),
    "snapshots": ("snapshot", "compare", "restore"),
}
"""The modules with commands of other names; each other command has a module of its name."""

_DIGITS = frozenset(".0123456789")
_INTERRUPTED, _PIPE_CLOSED = 130, 141
"""Exit codes of a shell for Ctrl-C and for a broken pipe."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code. No exception gets out: every failure is a message on stderr."""
    sys.stdout = sys.stdout or open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115  # it was closed by the caller
    sys.stderr = sys.stderr or open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115  # likewise
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    gc.disable()  # a run is short and has no reference cycles: collection would cost a third of a large compile
    try:
        code = _run(list(sys.argv[1:] if argv is None else argv))
        sys.stdout.flush()
    except KeyboardInterrupt:
        return _INTERRUPTED
    except BrokenPipeError:
        _discard_output()
        return _PIPE_CLOSED
    except OSError as error:
        place = "" if error.filename is None else f": {ascii(str(error.filename)[:200])[1:-1]}"
        print(f"fieldscribe: {error.strerror or type(error).__name__}{place}", file=sys.stderr)
        if error.errno == ENAMETOOLONG:
            print("  hint: give a shorter name, or a shorter path", file=sys.stderr)
        if error.filename is None:
            _discard_output()
        return USAGE
    except Exception as error:
        from fieldscribe.diagnostics import show_traceback

        show_traceback(error)
        text = ascii(str(error)[:200])[1:-1]
        print(
            f"fieldscribe: internal error: {type(error).__name__}: {text}; this is a bug: please report it to the "
            "project with the command line and the description (FIELDSCRIBE_DEBUG=1 shows where)",
            file=sys.stderr,
        )
        return USAGE
    gc.freeze()  # otherwise the interpreter collects again at exit
    return code


class Command(NamedTuple):
    """A command: the end of its `--help`, and the functions that add its arguments and run it."""

    example: str
    add_arguments: Callable[[ArgumentParser], None]
    run: Callable[[Namespace], int]


def command_named(name: str) -> Command:
    """Return a command; its module is imported."""
    module = next((module for module, commands in _MODULES.items() if name in commands), name)
    parts = vars(import_module(f"fieldscribe.cli.{module}"))
    return Command(parts[f"{name.upper()}_EXAMPLE"], parts[f"add_{name}_arguments"], parts[f"run_{name}"])


def _run(argv: list[str]) -> int:
    if not argv or argv[0] not in COMMANDS:
        return _overview(argv)
    from fieldscribe.cli.common import StopError, usage_error  # `--help` and `--version` start without these
    from fieldscribe.diagnostics import RefusedError, UnclearError

    command = command_named(argv[0])
    parser = _parser(f"fieldscribe {argv[0]}", COMMANDS[argv[0]], command.example)
    command.add_arguments(parser)
    # a value such as `-5Hz` is no option: none of ours starts with a digit
    words = [f" {word}" if word[:1] == "-" and word[1:2] in _DIGITS else word for word in argv[1:]]
    try:
        arguments, unknown = parser.parse_known_intermixed_args(words)
        if unknown:
            parser.error(_unrecognised(unknown, parser))
        if argv[0] != "completion" and words.count("--") > 1:
            parser.error("`--` is no argument: it stands once, before arguments that begin with `-`")
    except SystemExit as stop:
        return _parser_code(stop)
    try:
        return command.run(arguments)
    except StopError as stop:
        return stop.report()
    except (UnclearError, RefusedError) as error:
        usage_error(error.message, error.hint)
        return FINDINGS if isinstance(error, RefusedError) and error.status != "missing" else USAGE


def _unrecognised(unknown: list[str], parser: ArgumentParser) -> str:
    """Return the message for unknown arguments, with near options."""
    from difflib import get_close_matches

    from fieldscribe.diagnostics import did_you_mean

    options = [name for action in parser._actions for name in action.option_strings]  # argparse offers no other way
    wrong = [word.partition("=")[0] for word in unknown if word.startswith("-")]
    near = dict.fromkeys(name for word in wrong for name in get_close_matches(word[:60], options, 2))
    message = f"unrecognized arguments: {' '.join(unknown)}"
    return f"{message}; {did_you_mean(list(near))}" if near else message


def _overview(argv: list[str]) -> int:
    """Answer `--help`, `--version`, and anything that is not a command; return the exit code."""
    width = max(map(len, COMMANDS))
    commands = "\n".join(f"  {name:<{width}}  {does}" for name, does in COMMANDS.items())
    parser = _parser(
        "fieldscribe",
        "Compiles descriptions of fieldbus devices into code, documentation and tests.",
        f"commands:\n{commands}\n\n`fieldscribe COMMAND --help` explains a command, with examples.",
    )
    parser.usage = "fieldscribe COMMAND ..."
    parser.add_argument("-V", "--version", action="version", version=f"fieldscribe {__version__}")
    if argv and not argv[0].startswith("-"):
        from fieldscribe.cli.common import unknown_command

        return unknown_command(argv[0], COMMANDS)
    try:
        parser.parse_args(argv)
    except SystemExit as stop:
        return _parser_code(stop)
    parser.print_help(sys.stderr)
    return USAGE


def _parser_code(stop: SystemExit) -> int:
    """Return the exit code of argparse, which has printed the reason."""
    return stop.code if isinstance(stop.code, int) else USAGE


def _parser(prog: str, description: str, epilog: str) -> ArgumentParser:
    from argparse import ArgumentParser, RawDescriptionHelpFormatter

    class Parser(ArgumentParser):
        """A parser that quotes arguments in messages as findings do: file names may hold control characters."""

        def error(self, message: str) -> NoReturn:
            from fieldscribe.diagnostics import visible

            super().error(visible(message))

    width = max(40, min(terminal_width(), 120) - 2)
    return Parser(
        prog=prog,
        description=description[0].upper() + description[1:].rstrip(".") + ".",
        epilog=epilog,
        formatter_class=lambda prog: RawDescriptionHelpFormatter(prog, width=width),
        allow_abbrev=False,
    )


def _discard_output() -> None:
    """Discard the rest of the output, also at interpreter exit: the pipe is closed, or the disk is full."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (OSError, ValueError):
        return
