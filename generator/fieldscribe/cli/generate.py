"""`fieldscribe generate`: compile descriptions into files."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import groupby
from operator import itemgetter
from pathlib import Path
from typing import TYPE_CHECKING

from fieldscribe.output import UnsafePathError
from fieldscribe.targets import TARGETS

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from fieldscribe.diagnostics import Report
    from fieldscribe.model import Device
    from fieldscribe.output import Changes

HELP = "compile descriptions into C, Python, Rust, documentation and vectors"
EXAMPLE = """examples:
  fieldscribe generate hitachi_l200 --target c --out firmware/drivers
  fieldscribe generate --check          (says what is stale and writes nothing; for CI)

ends with 1 when a description is wrong, and with --check when anything is stale"""


_WEIGHTS = {"c": 4.0, "python": 3.0, "rust": 4.0, "docs": 2.0, "vectors": 5.0}
"""About how long the targets take, for parting the work between two processes."""
_FEW_POINTS = 150
"""Below this a second process is not worth its start."""


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import some_path

    parser.add_argument(
        "paths",
        nargs="*",
        type=some_path,
        metavar="PATH",
        help="device ids, folders with device.yaml, or folders of such folders (default: descriptions)",
    )
    parser.add_argument(
        "--target",
        default=",".join(TARGETS),
        metavar="LIST",
        help=f"what to make, of {', '.join(TARGETS)} (default: all)",
    )
    parser.add_argument(
        "--out", type=some_path, default=Path("generated"), metavar="DIR", help="where to (default: generated)"
    )
    parser.add_argument("--check", action="store_true", help="write nothing; say what is stale, exit 1 if anything is")
    parser.add_argument("--depfile", type=some_path, metavar="FILE", help="write a make rule from outputs to inputs")
    parser.add_argument("--list-outputs", action="store_true", help="write nothing; print the paths of all outputs")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="how to report (default: text)")


@dataclass(slots=True)
class _Result:
    """What became of all devices: relative paths by what happened to them."""

    written: set[str] = field(default_factory=set)
    removed: set[str] = field(default_factory=set)
    unchanged: set[str] = field(default_factory=set)
    stale: set[str] = field(default_factory=set)
    made: dict[tuple[str, str], list[str]] = field(default_factory=dict)
    """The files of each device and target."""

    def add(self, other: _Result) -> None:
        """Take over what another process found."""
        self.written |= other.written
        self.removed |= other.removed
        self.unchanged |= other.unchanged
        self.stale |= other.stale
        self.made.update(other.made)

    @property
    def outputs(self) -> list[str]:
        """All files that now should be there."""
        return sorted((self.written | self.unchanged | self.stale) - self.removed)

    @property
    def left(self) -> int:
        """How many files were as they should be (a manifest counts as written when one target changed it)."""
        return len(self.unchanged - self.written - self.stale)


def run(arguments: Namespace) -> int:
    """Compile; the exit code: 0 fine, 1 findings or stale, 2 environment."""
    from fieldscribe.cli.common import description_paths, report_findings, usage_error
    from fieldscribe.diagnostics import Report
    from fieldscribe.output import stamp
    from fieldscribe.pipeline import description_files, find_devices

    targets = tuple(dict.fromkeys(name.strip() for name in arguments.target.split(",") if name.strip()))
    unknown = [name for name in targets if name not in TARGETS]
    if unknown or not targets:
        return usage_error(f"there is no target `{', '.join(unknown)}`; there are {', '.join(TARGETS)}")
    report = Report()
    device_files = find_devices(description_paths(arguments.paths), report)
    inputs = [path for device_file in device_files for path in description_files(device_file)]
    digest = stamp.digest_of(inputs, targets)
    plain = not (arguments.depfile or arguments.list_outputs or report.has_errors)
    known = stamp.remembered(arguments.out, digest) if plain else None
    if known is not None:
        return _say(arguments, _Result(unchanged=set(known)), report)
    result = _Result()
    try:
        _compile(arguments, targets, device_files, report, result)
    except (OSError, UnsafePathError) as error:
        return usage_error(f"cannot write to {arguments.out}: {error}")
    writes = not (report.has_errors or arguments.check or arguments.list_outputs)
    if arguments.depfile and writes:
        try:
            _write_depfile(arguments, result, inputs)
        except OSError as error:
            return usage_error(f"cannot write {arguments.depfile}: {error.strerror}")
    if arguments.format == "text":
        report_findings(report, "text")
    if writes:
        stamp.remember(arguments.out, digest, result.outputs)
    return _say(arguments, result, report)


def _compile(
    arguments: Namespace, targets: tuple[str, ...], device_files: list[Path], report: Report, result: _Result
) -> None:
    from fieldscribe.output import settle_manifest
    from fieldscribe.output.two_processes import both, halved

    devices = _load(device_files, report)
    work = [(device, target) for device in devices for target in targets]
    few = sum(len(device.points) for device in devices) < _FEW_POINTS
    mine, others = (work, []) if few else halved(work, lambda one: len(one[0].points) * _WEIGHTS[one[1]])
    if others:
        halves = both(lambda: _make(arguments, mine), lambda: _make(arguments, others))
    else:
        halves = (_make(arguments, mine), _Result())
    for half in halves:
        result.add(half)
    for device in devices:
        made = {target: result.made[device.id, target] for target in targets}
        _settle(arguments, result, settle_manifest(arguments.out, device.id, made))


def _load(device_files: list[Path], report: Report) -> list[Device]:
    """The devices without errors; a second description of one is an error."""
    from fieldscribe.diagnostics import Span
    from fieldscribe.language.source import shown
    from fieldscribe.pipeline import DEVICE_FILE, load_device

    devices: list[Device] = []
    seen: dict[str, Path] = {}
    for device_file in device_files:
        device = load_device(device_file, report)
        if device is None:
            continue
        if device.id in seen:
            message = f"the device `{device.id}` is described twice in this run, first in {shown(seen[device.id])}"
            report.error(
                "duplicate-device", message, Span(shown(device_file), 1, 1), f"give one {DEVICE_FILE} another `device`"
            )
            continue
        seen[device.id] = device_file
        devices.append(device)
    return devices


def _make(arguments: Namespace, work: list[tuple[Device, str]]) -> _Result:
    """Render and settle some targets of some devices, one after the other: all texts at once would take much memory."""
    from fieldscribe.output import compare
    from fieldscribe.pipeline import outputs

    result = _Result()
    for device, items in groupby(work, key=itemgetter(0)):
        for target, made in groupby(outputs(device, [name for _, name in items]), key=itemgetter(0)):
            files = {path: text.encode() for _, path, text in made}
            result.made[device.id, target] = sorted(files)
            _settle(arguments, result, compare(arguments.out, device.id, target, files))
    return result


def _settle(arguments: Namespace, result: _Result, changes: Changes) -> None:
    """Write what changed, or note that it is stale."""
    from fieldscribe.output import apply

    if arguments.check or arguments.list_outputs:
        result.stale.update(changes.stale)
        result.removed.update(changes.remove)
    else:
        apply(arguments.out, changes)
        result.written.update(changes.write)
        result.removed.update(changes.remove)
    result.unchanged.update(changes.unchanged)


def _write_depfile(arguments: Namespace, result: _Result, inputs: list[Path]) -> None:
    """One make rule; blanks, `#` and `$` in paths are escaped as make and ninja read them."""

    def escaped(path: Path) -> str:
        return str(path).replace("\\", "/").replace("$", "$$").replace("#", "\\#").replace(" ", "\\ ")

    made = " ".join(escaped(arguments.out / path) for path in result.outputs)
    needed = " \\\n  ".join(escaped(path) for path in inputs)
    arguments.depfile.write_text(f"{made}: {needed}\n", "utf-8")


def _say(arguments: Namespace, result: _Result, report: Report) -> int:
    """Tell what happened; the exit code."""
    failed = report.has_errors
    if arguments.format == "json":
        from fieldscribe.cli.common import print_json
        from fieldscribe.report import as_data

        lists = {name: sorted(getattr(result, name)) for name in ("outputs", "written", "removed", "stale")}
        print_json({"out": str(arguments.out), **lists, "findings": as_data(report.findings)})
    elif arguments.list_outputs:
        print(*(str(arguments.out / path) for path in result.outputs), sep="\n")
    elif arguments.check:
        for path in sorted(result.stale):
            print(f"stale: {arguments.out / path}")
        print(f"{len(result.stale)} stale, {result.left} current in {arguments.out}")
    elif result.outputs or not failed:
        counts = f"{len(result.written)} written, {len(result.removed)} removed, {result.left} unchanged"
        print(f"{counts} in {arguments.out}")
    return 1 if failed or (arguments.check and result.stale) else 0
