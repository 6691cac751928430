"""Shared by commands: common arguments, finding and opening descriptions, printing findings and errors."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, ArgumentTypeError, Namespace, _ArgumentGroup
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO, TypeVar

from fieldscribe import pipeline
from fieldscribe.cli.terminal import FINDINGS, USAGE, print_lines
from fieldscribe.diagnostics import Report, UnclearError, as_data, as_lines, did_you_mean, split_lines, summary, visible
from fieldscribe.pipeline import DEVICE_FILE, device_files_below, find_devices
from fieldscribe.resources import descriptions_dir
from fieldscribe.safe_files import Inputs, read_regular
from fieldscribe.text import shortened

if TYPE_CHECKING:
    from fieldscribe.model import Device

Parser = ArgumentParser | _ArgumentGroup
Loaded = TypeVar("Loaded")

_LONGEST = 1e8
"""The most seconds that an option accepts: three years."""

LOCAL = Path("descriptions")
"""The usual folder of a project's descriptions."""


class StopError(UnclearError):
    """Ends a command with a message and a hint on stderr (both may be empty) and an exit code."""

    def __init__(self, message: str, hint: str = "", code: int = USAGE) -> None:
        super().__init__(message, hint)
        self.code = code

    def report(self) -> int:
        """Print the message and return the exit code."""
        if self.message:
            usage_error(self.message, self.hint)
        return self.code


def duration(text: str) -> float:
    """Return a number of seconds above 0, for argparse."""
    return _number(text, f"seconds above 0, up to {_LONGEST:.0f}", lambda seconds: 0 < seconds <= _LONGEST)


def period(text: str) -> float:
    """Return a number of seconds from 0 on, for argparse."""
    return _number(text, f"seconds from 0 to {_LONGEST:.0f}", lambda seconds: 0 <= seconds <= _LONGEST)


def times(text: str) -> int:
    """Return a whole number above 0, for argparse."""
    return _whole_number(text, "times", 1)


def repeats(text: str) -> int:
    """Return a whole number from 0 on, for argparse."""
    return _whole_number(text, "times", 0)


def speed(text: str) -> int:
    """Return the speed of a line, for argparse."""
    return _whole_number(text, "bits per second", 1)


def _whole_number(text: str, what: str, least: int) -> int:
    ends = f"from {least} to {_LONGEST:.0f}"
    return int(_number(text, f"{what} {ends}", lambda number: least <= number <= _LONGEST and number == int(number)))


def _number(text: str, what: str, is_allowed: Callable[[float], bool]) -> float:
    with suppress(ValueError):
        if is_allowed(number := float(text)):
            return number
    raise ArgumentTypeError(f"`{shortened(text)}` is no number of {what}")


def usage_error(message: str, hint: str = "") -> int:
    """Print an error of the command line or the machine on stderr; return the exit code."""
    lines = [[("error", "fieldscribe: "), ("", visible(message))]]
    if hint:
        lines.append([("hint", f"  hint: {visible(hint)}")])
    sys.stdout.flush()
    print_lines(lines, sys.stderr)
    return USAGE


def unknown_command(name: str, known: Iterable[str]) -> int:
    """Print that there is no such command, with similar names; return the exit code."""
    return usage_error(f"there is no command `{shortened(name)}`", _near(name, list(known)))


def add_format(parser: ArgumentParser, more: tuple[str, ...] = (), remark: str = "") -> None:
    """Add `--format`; `more` are formats that only this command has, `remark` ends the help text."""
    parser.add_argument(
        "--format", choices=("text", "json", *more), default="text", help=f"how to report (default: text{remark})"
    )


def add_repeated(parser: Parser, name: str, metavar: str, help_text: str, **more: Any) -> None:
    """Add an option that may be repeated; its values become a list."""
    help_text += "; may be repeated"
    parser.add_argument(name, action="append", default=[], metavar=metavar, help=help_text, **more)


def add_paths(parser: ArgumentParser) -> None:
    """Add the PATH arguments; `description_paths` resolves them."""
    parser.add_argument(
        "paths",
        nargs="*",
        type=some_path,
        metavar="PATH",
        help="device ids, folders with device.yaml, or folders of such folders "
        "(default: device.yaml here, else descriptions)",
    )


def add_device(parser: ArgumentParser, *, variants: bool = True, optional: bool = False) -> None:
    """Add the DEVICE argument, with `--descriptions` and `--variant`; `open_device` reads them."""
    help_text = "a device's id, or the path of its folder or device.yaml"
    parser.add_argument("device", nargs="?" if optional else None, metavar="DEVICE", help=help_text)
    add_descriptions(parser)
    if variants:
        add_repeated(parser, "--variant", "AXIS=VALUE", "choose a variant, as in voltage_class=400V")


def add_descriptions(parser: ArgumentParser) -> None:
    """Add `--descriptions`, the folder in which device ids are searched."""
    parser.add_argument(
        "--descriptions",
        type=Path,
        metavar="DIR",
        help=f"where device ids are searched (default: this folder, {LOCAL}, then the shipped devices)",
    )


def some_path(text: str) -> Path:
    """Return a path from the command line; refuse an empty one (often an unset variable): it would mean `.`."""
    if not text:
        raise ArgumentTypeError("the path is empty")
    return Path(text)


def description_paths(paths: list[Path]) -> list[Path]:
    """Return the given paths, with device ids as folders. Raises StopError for one that does not exist.

    The default is ./device.yaml, ./descriptions, or the shipped descriptions.
    """
    if paths:
        return list(map(_device_folder, paths))
    if Path(DEVICE_FILE).is_file():
        return [Path(DEVICE_FILE)]
    if LOCAL.is_dir():
        return [LOCAL]
    print(f"there is no folder {LOCAL} here: these are the devices that come with fieldscribe", file=sys.stderr)
    return [descriptions_dir()]


def _device_folder(path: Path) -> Path:
    """Return the path, or the folder of a device id.

    A folder of that name without a description does not hide a device.
    """
    if path.exists() and (not _is_id(str(path)) or find_devices([path], Report())):
        return path
    known = known_devices(default_folders())
    if str(path) in known:
        return known[str(path)].parent
    if path.exists():
        return path
    hint = _near(str(path), list(known)) or f"name a folder with {DEVICE_FILE}, or a device: {', '.join(known)}"
    raise StopError(f"there is no such file or folder, and no device, as `{path}`", hint)


def _is_id(text: str) -> bool:
    return text.replace("_", "").isalnum()


def default_folders() -> list[Path]:
    """Return the folders in which device ids are searched: those of the user, then the shipped one."""
    return [Path(), LOCAL, descriptions_dir()]


def known_devices(folders: Iterable[Path]) -> dict[str, Path]:
    """Return each device.yaml below these folders by the name of its folder; the first folder wins."""
    known: dict[str, Path] = {}
    for folder in folders:
        for file in device_files_below(folder):
            known.setdefault(file.parent.name, file)
    return dict(sorted(known.items()))


def searched_devices(arguments: Namespace) -> dict[str, Path]:
    """Return all devices in the folders of `--descriptions`, or the default ones, by id. Raises StopError."""
    return known_devices(_searched_folders(arguments))


def open_device(arguments: Namespace, inputs: Inputs | None = None) -> Device:
    """Return the device named on the command line, with its chosen variants; print findings on stderr.

    `inputs` records the files that were read. Raises StopError, and UnclearError for a variant.
    """
    from fieldscribe.conversation.selection import choose_variants  # `check` starts without it

    device = load(lambda file, report: pipeline.load_device(file, report, inputs), arguments)
    return choose_variants(device, getattr(arguments, "variant", []))


def load(how: Callable[[Path, Report], Loaded | None], arguments: Namespace) -> Loaded:
    """Return what a function loads of the device named on the command line. Raises StopError, with its findings."""
    report = Report()
    loaded = how(device_file(arguments), report)
    if loaded is None:
        report_findings(report, getattr(arguments, "format", "text"))
        raise StopError("", code=FINDINGS)
    return loaded


def device_file(arguments: Namespace) -> Path:
    """Return the device.yaml of the device named on the command line. Raises StopError."""
    name: str = arguments.device
    folders = _searched_folders(arguments)
    if _is_id(name):
        for folder in folders:
            if (folder / name / DEVICE_FILE).is_file():
                return folder / name / DEVICE_FILE
    path = Path(name)
    if not path.exists():
        places = " and ".join(dict.fromkeys(map(str, folders[-2:])))
        hint = _near(name, list(known_devices(folders))) or f"descriptions are searched in {places}"
        raise StopError(f"there is no device or path `{name}`", hint)
    devices = find_devices([path], Report())
    if not devices:
        wrong = f"holds no {DEVICE_FILE}" if path.is_dir() else "is neither a folder nor a regular file"
        raise StopError(f"`{name}` {wrong}", f"name a folder with a {DEVICE_FILE}, or the file itself")
    if len(devices) > 1:
        names = ", ".join(file.parent.name for file in devices[:8])
        raise StopError(f"`{name}` holds {len(devices)} devices", f"name one of them: {names}")
    return devices[0]


def _searched_folders(arguments: Namespace) -> list[Path]:
    folder: Path | None = arguments.descriptions
    if folder is None:
        return default_folders()
    if not folder.is_dir():
        raise StopError(f"there is no folder `{folder}`")
    return [folder]


def _near(name: str, known: list[str]) -> str:
    """Return a hint with similar names, or else with all names."""
    from difflib import get_close_matches

    near = did_you_mean(get_close_matches(name.lower()[:60], known, 3))
    return near or (f"there are {', '.join(known[:20])}" if known else "")


def report_findings(report: Report, form: str, stream: TextIO | None = None) -> None:
    """Print findings: as text on stderr or `stream`; as JSON on stdout if there are errors, instead of the result."""
    findings = report.findings
    if form == "json":
        if report.has_errors:
            print_json({"findings": as_data(findings)})
        return
    if findings:
        stream = stream or sys.stderr
        print_lines(as_lines(findings, lru_cache(_lines_of)), stream)
        print_lines([[("strong", summary(report))]], stream)


def print_json(data: object) -> None:
    """Print JSON on stdout, in ASCII so that a terminal gets no control character."""
    import json  # `check` starts without it

    json.dump(data, sys.stdout, indent=2)
    sys.stdout.write("\n")


def _lines_of(name: str) -> list[str] | None:
    """Return the lines of a file for findings; None if it cannot be read."""
    from fieldscribe.language.nodes import MOST_BYTES  # a `generate` with nothing changed starts without it

    try:
        return split_lines(read_regular(name, MOST_BYTES).data.decode("utf-8-sig", "replace"))
    except (OSError, ValueError):
        return None


def write_draft(text: str, out: Path | None) -> None:
    """Write to a new file, or to standard output; a file that appeared meanwhile is not overwritten."""
    if out is None:
        sys.stdout.write(text)
        return
    out.parent.mkdir(parents=True, exist_ok=True)
    with open(out, "x", encoding="utf-8", newline="\n") as stream:
        stream.write(text)
