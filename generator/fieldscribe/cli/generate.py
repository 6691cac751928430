"""`fieldscribe generate`: compile descriptions into files."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from fieldscribe.output import UnsafePathError
from fieldscribe.targets import TARGETS

if TYPE_CHECKING:
    from fieldscribe.diagnostics import Report

HELP = "compile descriptions into C, Python, Rust, documentation and vectors"
EXAMPLE = """examples:
  fieldscribe generate hitachi_l200 --target c --out firmware/drivers
  fieldscribe generate --check          (says what is stale and writes nothing; for CI)"""


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    parser.add_argument("paths", nargs="*", type=Path, metavar="PATH", help="device ids, folders with device.yaml, or folders of such folders (default: descriptions)")
    parser.add_argument("--target", default=",".join(TARGETS), metavar="LIST", help=f"what to make, of {', '.join(TARGETS)} (default: all)")
    parser.add_argument("--out", type=Path, default=Path("generated"), metavar="DIR", help="where to (default: generated)")
    parser.add_argument("--check", action="store_true", help="write nothing; say what is stale, exit 1 if anything is")
    parser.add_argument("--depfile", type=Path, metavar="FILE", help="write a make rule from outputs to inputs")
    parser.add_argument("--list-outputs", action="store_true", help="write nothing; print the paths of all outputs")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="how to report (default: text)")


@dataclass(slots=True)
class _Result:
    """What became of all devices: relative paths by what happened to them."""

    written: list[str] = field(default_factory=list)
    removed: list[str] = field(default_factory=list)
    unchanged: list[str] = field(default_factory=list)
    stale: list[str] = field(default_factory=list)

    @property
    def outputs(self) -> list[str]:
        """All files that now should be there, each once."""
        return sorted({*self.written, *self.unchanged, *self.stale} - {*self.removed})


def run(arguments: Namespace) -> int:
    """Compile; the exit code: 0 fine, 1 findings or stale, 2 environment."""
    from fieldscribe import stamp
    from fieldscribe.cli.common import description_paths, report_findings, usage_error
    from fieldscribe.diagnostics import Report
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
        return _say(arguments, _Result(unchanged=known), failed=False)
    result = _Result()
    try:
        _compile(arguments, targets, device_files, report, result)
        if arguments.depfile and not report.has_errors:
            _write_depfile(arguments, result, inputs)
    except (OSError, UnsafePathError) as error:
        return usage_error(f"cannot write to {arguments.out}: {error}")
    report_findings(report, arguments.format)
    if not (report.has_errors or arguments.check or arguments.list_outputs):
        stamp.remember(arguments.out, digest, result.outputs)
    return _say(arguments, result, failed=report.has_errors)


def _compile(arguments: Namespace, targets: tuple[str, ...], device_files: list[Path], report: Report, result: _Result) -> None:
    from fieldscribe.output import apply, compare
    from fieldscribe.pipeline import DEVICE_FILE, load_device, outputs
    from fieldscribe.diagnostics import Span
    from fieldscribe.language.source import shown

    seen: dict[str, Path] = {}
    for device_file in device_files:
        device = load_device(device_file, report)
        if device is None:
            continue
        if device.id in seen:
            message = f"the device `{device.id}` is described twice in this run, first in {shown(seen[device.id])}"
            report.error("duplicate-device", message, Span(shown(device_file), 1, 1), f"give one {DEVICE_FILE} another `device`")
            continue
        seen[device.id] = device_file
        files: dict[str, dict[str, bytes]] = {name: {} for name in targets}
        for name, path, text in outputs(device, targets):
            files[name][path] = text.encode()
        changes = compare(arguments.out, device.id, files)
        result.unchanged += changes.unchanged
        if arguments.check or arguments.list_outputs:
            result.stale += changes.stale
            result.removed += changes.remove
        else:
            apply(arguments.out, changes)
            result.written += changes.write
            result.removed += changes.remove


def _write_depfile(arguments: Namespace, result: _Result, inputs: list[Path]) -> None:
    """One make rule; blanks, `#` and `$` in paths are escaped as make and ninja read them."""

    def escaped(path: Path) -> str:
        return str(path).replace("\\", "/").replace("$", "$$").replace("#", "\\#").replace(" ", "\\ ")

    made = " ".join(escaped(arguments.out / path) for path in result.outputs)
    needed = " \\\n  ".join(escaped(path) for path in inputs)
    arguments.depfile.parent.mkdir(parents=True, exist_ok=True)
    arguments.depfile.write_text(f"{made}: {needed}\n", "utf-8")


def _say(arguments: Namespace, result: _Result, *, failed: bool) -> int:
    """Tell what happened; the exit code."""
    if arguments.format == "json":
        import json

        if not failed:  # else the findings are the one object on stdout
            print(json.dumps({"out": str(arguments.out), "written": result.written, "removed": result.removed, "stale": result.stale, "unchanged": len(result.unchanged)}))
    elif arguments.list_outputs:
        print(*(str(arguments.out / path) for path in result.outputs), sep="\n")
    elif arguments.check:
        for path in result.stale:
            print(f"stale: {arguments.out / path}")
        print(f"{len(result.stale)} stale, {len(result.unchanged)} current in {arguments.out}")
    else:
        print(f"{len(result.written)} written, {len(result.removed)} removed, {len(result.unchanged)} unchanged in {arguments.out}")
    return 1 if failed or (arguments.check and result.stale) else 0
