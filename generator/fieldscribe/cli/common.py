"""What commands share: finding the description, and printing results and errors."""

from __future__ import annotations

import sys
from argparse import ArgumentTypeError
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from fieldscribe.cli import FINDINGS, USAGE
from fieldscribe.cli.terminal import print_lines

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterable
    from fractions import Fraction

    from fieldscribe.diagnostics import Report
    from fieldscribe.model import Device
    from fieldscribe.report import ReadLines
    from fieldscribe.safe_files import Inputs

HERE, LOCAL = Path(), Path("descriptions")
"""Where the device of an id is looked for first: what is beside the user is never passed over for what is shipped."""


class StopError(Exception):
    """The command cannot go on: a message and a hint for stderr, and the exit code."""

    def __init__(self, message: str, hint: str = "", code: int = USAGE) -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint
        self.code = code

    def tell(self) -> int:
        """Print it and return the exit code."""
        if self.message:
            usage_error(self.message, self.hint)
        return self.code


def usage_error(message: str, hint: str = "") -> int:
    """Say on stderr what is wrong with the command line or the machine; the exit code."""
    from fieldscribe.report import visible

    lines = [[("error", "fieldscribe: "), ("", visible(message))]]
    if hint:
        lines.append([("hint", f"  hint: {visible(hint)}")])
    sys.stdout.flush()
    print_lines(lines, sys.stderr)
    return USAGE


def unknown_command(name: str, known: Iterable[str]) -> int:
    """Say that there is no such command; the exit code."""
    from fieldscribe.user_errors import quoted

    return usage_error(f"there is no command `{quoted(name)}`", _near(name, list(known)))


def add_format(parser: ArgumentParser, more: tuple[str, ...] = (), said: str = "") -> None:
    """How a command reports; `more` are forms that only this command has, `said` what to know of them."""
    known, said = ("text", "json", *more), f"how to report (default: text{said})"
    parser.add_argument("--format", choices=known, default="text", help=said)


def add_paths(parser: ArgumentParser) -> None:
    """Which descriptions a command is about."""
    parser.add_argument(
        "paths",
        nargs="*",
        type=some_path,
        metavar="PATH",
        help="device ids, folders with device.yaml, or folders of such folders "
        "(default: device.yaml here, else descriptions)",
    )


def add_device(parser: ArgumentParser, *, variants: bool = True) -> None:
    """Which device a command is about."""
    parser.add_argument("device", metavar="DEVICE", help="a device's id, or the path of its folder or device.yaml")
    add_descriptions(parser)
    if variants:
        parser.add_argument(
            "--variant",
            action="append",
            default=[],
            metavar="AXIS=VALUE",
            help="choose a variant, as in voltage_class=400V; may be repeated",
        )


def add_descriptions(parser: ArgumentParser) -> None:
    """Where ids of devices are looked for."""
    parser.add_argument(
        "--descriptions",
        type=Path,
        metavar="DIR",
        help=f"where ids are looked for (default: this folder, {LOCAL}, then what comes with fieldscribe)",
    )


def some_path(text: str) -> Path:
    """A path from the command line; an empty one (an unset variable, most often) would mean the working folder."""
    if not text:
        raise ArgumentTypeError("the path is empty")
    return Path(text)


def description_paths(paths: list[Path]) -> list[Path]:
    """The given paths, with device ids as folders; without any, ./device.yaml, ./descriptions, or the shipped ones.

    Raises StopError for what does not exist.
    """
    from fieldscribe.pipeline import DEVICE_FILE
    from fieldscribe.resources import descriptions_dir

    if paths:
        return list(map(_meant_folder, paths))
    if Path(DEVICE_FILE).is_file():
        return [Path(DEVICE_FILE)]
    if LOCAL.is_dir():
        return [LOCAL]
    print(f"there is no folder {LOCAL} here: these are the devices that come with fieldscribe", file=sys.stderr)
    return [descriptions_dir()]


def _meant_folder(path: Path) -> Path:
    """A path, or the folder of a device id: one that is here without a description hides no device."""
    from fieldscribe.diagnostics import Report
    from fieldscribe.pipeline import DEVICE_FILE, find_devices

    if path.exists() and (not _is_id(str(path)) or find_devices([path], Report())):
        return path
    known = known_devices(roots())
    if str(path) in known:
        return known[str(path)].parent
    if path.exists():
        return path
    hint = _near(str(path), list(known)) or f"name a folder with {DEVICE_FILE}, or a device: {', '.join(known)}"
    raise StopError(f"there is no such file or folder, and no device, as `{path}`", hint)


def _is_id(asked: str) -> bool:
    return asked.replace("_", "").isalnum()


def roots() -> list[Path]:
    """Where the devices of ids are looked for, the first one that has it wins."""
    from fieldscribe.resources import descriptions_dir

    return [HERE, LOCAL, descriptions_dir()]


def known_devices(roots: Iterable[Path]) -> dict[str, Path]:
    """The device.yaml of each device below these folders, by its folder's name; the first folder wins."""
    from fieldscribe.pipeline import device_files_below

    known: dict[str, Path] = {}
    for root in roots:
        for file in device_files_below(root):
            known.setdefault(file.parent.name, file)
    return dict(sorted(known.items()))


def devices_asked(arguments: Namespace) -> dict[str, Path]:
    """The devices that are known without being named, by their id. Raises StopError."""
    return known_devices(_roots_asked(arguments))


def open_device(arguments: Namespace, inputs: Inputs | None = None) -> Device:
    """The device that the command line names, with its chosen variants. Findings go to stderr. Raises StopError.

    `inputs` remembers the files that were read.
    """
    from fieldscribe.conversation.selection import choose_variants
    from fieldscribe.diagnostics import Report
    from fieldscribe.pipeline import load_device
    from fieldscribe.user_errors import UnclearError

    report = Report()
    device = load_device(device_file(arguments), report, inputs)
    if device is None:
        report_findings(report, getattr(arguments, "format", "text"))
        raise StopError("", code=FINDINGS)
    try:
        return choose_variants(device, getattr(arguments, "variant", []))
    except UnclearError as error:
        raise StopError(error.message, error.hint) from error


def report_findings(report: Report, form: str, stream: TextIO | None = None) -> None:
    """Print findings: as text on stderr or `stream`; as JSON on stdout if there are errors, in place of the result."""
    from fieldscribe.report import as_data, as_lines, summary

    findings = report.findings
    if form == "json":
        if report.has_errors:
            print_json({"findings": as_data(findings)})
        return
    if findings:
        stream = stream or sys.stderr
        print_lines(as_lines(findings, _reader()), stream)
        print_lines([[("strong", summary(findings))]], stream)


def print_json(data: object) -> None:
    """One JSON object on stdout; ASCII only, so that nothing in it reaches a terminal raw."""
    import json

    json.dump(data, sys.stdout, indent=2)
    sys.stdout.write("\n")


def device_file(arguments: Namespace) -> Path:
    """The device.yaml of the device that is meant. Raises StopError."""
    from fieldscribe.diagnostics import Report
    from fieldscribe.pipeline import DEVICE_FILE, find_devices

    asked: str = arguments.device
    asked_roots = _roots_asked(arguments)
    if _is_id(asked):
        for root in asked_roots:
            if (root / asked / DEVICE_FILE).is_file():
                return root / asked / DEVICE_FILE
    path = Path(asked)
    if not path.exists():
        known = list(known_devices(asked_roots))
        where = " and ".join(dict.fromkeys(map(str, asked_roots[-2:])))
        raise StopError(
            f"there is no device or path `{asked}`", _near(asked, known) or f"descriptions are looked for in {where}"
        )
    devices = find_devices([path], Report())
    if not devices:
        raise StopError(f"`{asked}` holds no {DEVICE_FILE}", f"name a folder with a {DEVICE_FILE}, or the file itself")
    if len(devices) > 1:
        names = ", ".join(file.parent.name for file in devices[:8])
        raise StopError(f"`{asked}` holds {len(devices)} devices", f"name one of them: {names}")
    return devices[0]


def _roots_asked(arguments: Namespace) -> list[Path]:
    folder: Path | None = arguments.descriptions
    if folder is None:
        return roots()
    if not folder.is_dir():
        raise StopError(f"there is no folder `{folder}`")
    return [folder]


def _near(name: str, known: list[str]) -> str:
    from difflib import get_close_matches

    names = get_close_matches(name.lower()[:60], known, 3)
    if names:
        return f"did you mean {' or '.join(f'`{name}`' for name in names)}?"
    return f"there are {', '.join(known[:20])}" if known else ""


def _reader() -> ReadLines:
    """A reader of the files that findings name; it keeps each text."""
    from fieldscribe.language.source import MOST_BYTES
    from fieldscribe.report import split_lines
    from fieldscribe.safe_files import read_regular

    known: dict[str, list[str] | None] = {}

    def read(name: str) -> list[str] | None:
        if name not in known:
            try:
                known[name] = split_lines(read_regular(name, MOST_BYTES).data.decode("utf-8-sig", "replace"))
            except (OSError, ValueError):
                known[name] = None
        return known[name]

    return read


def settings_of(device: Device, pairs: list[str]) -> dict[str, int | Fraction]:
    """The settings of other points that `--with` gives. Raises StopError."""
    from fieldscribe.conversation.typed_values import read_settings
    from fieldscribe.user_errors import RefusedError, UnclearError

    try:
        return read_settings(device, pairs)
    except (UnclearError, RefusedError) as error:
        raise StopError(f"--with: {error.message}", error.hint) from error
