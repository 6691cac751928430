"""`fieldscribe generate`: compile descriptions into files."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from fieldscribe.targets import TARGETS

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterator

    from fieldscribe.diagnostics import Report
    from fieldscribe.model import Device
    from fieldscribe.output.memory import Memory
    from fieldscribe.output.plan import Made, Plan
    from fieldscribe.reading import Inputs, State

HELP = "compile descriptions into C, Python, Rust, documentation and vectors"
EXAMPLE = """examples:
  fieldscribe generate hitachi_l200 --target c --out firmware/drivers
  fieldscribe generate --check          (says what is stale and writes nothing; for CI)

A device with an error, or with somebody else's file in its way, writes nothing; the others are written.
Ends with 1 when there is such a device, or, with --check, when anything is stale."""


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
    parser.add_argument("--force", action="store_true", help="replace files in the way that fieldscribe did not make")
    parser.add_argument("--depfile", type=some_path, metavar="FILE", help="write a make rule from outputs to inputs")
    parser.add_argument("--list-outputs", action="store_true", help="write nothing; print the paths of all outputs")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="how to report (default: text)")


@dataclass(slots=True)
class _Result:
    """What became of all devices: relative paths by what happened to them."""

    written: set[str] = field(default_factory=set)
    removed: set[str] = field(default_factory=set)
    stale: set[str] = field(default_factory=set)
    kept: set[str] = field(default_factory=set)
    wanted: set[str] = field(default_factory=set)
    states: dict[str, State] = field(default_factory=dict)
    """How files are that are as they should be."""
    digests: dict[str, str] = field(default_factory=dict)

    @property
    def outputs(self) -> list[str]:
        """All files that now should be there."""
        return sorted(self.wanted)

    @property
    def left(self) -> int:
        """How many files were as they should be (a file that several devices share counts as written when one wrote it)."""
        return len(self.wanted - self.written - self.stale)


@dataclass(frozen=True, slots=True)
class _Found:
    """What the descriptions say: the devices without errors, each with the file that describes it."""

    devices: list[tuple[Path, Device]]
    inputs: Inputs
    report: Report


def run(arguments: Namespace) -> int:
    """Compile; the exit code: 0 fine, 1 findings or stale, 2 environment."""
    from fieldscribe.cli.common import description_paths, report_findings, usage_error
    from fieldscribe.diagnostics import Report
    from fieldscribe.output.memory import Memory
    from fieldscribe.pipeline import find_devices

    targets = tuple(dict.fromkeys(name.strip() for name in arguments.target.split(",") if name.strip()))
    unknown = [name for name in targets if name not in TARGETS]
    if unknown or not targets:
        return usage_error(f"there is no target `{', '.join(unknown)}`; there are {', '.join(TARGETS)}")
    report = Report()
    device_files = find_devices(description_paths(arguments.paths), report)
    writes = not (arguments.check or arguments.list_outputs)
    memory = Memory(arguments.out, targets, device_files) if writes and not report.has_errors else None
    known = memory.outputs() if memory and not arguments.depfile else None
    if known is not None:
        return _say(arguments, _Result(wanted=set(known)), report)
    found = _load(device_files, report)
    result = _Result()
    try:
        _compile(arguments, targets, found, result, memory)
    except OSError as error:
        return usage_error(f"cannot write to {arguments.out}: {error}")
    if arguments.depfile and writes and not report.has_errors:
        from fieldscribe.output.depfile import write_depfile

        try:
            write_depfile(arguments.depfile, (arguments.out / path for path in result.outputs), found.inputs.digests)
        except OSError as error:
            return usage_error(f"cannot write {arguments.depfile}: {error.strerror}")
    if arguments.format == "text":
        report_findings(report, "text")
    return _say(arguments, result, report)


def _load(device_files: list[Path], report: Report) -> _Found:
    """The devices without errors; a second description of one is an error."""
    from fieldscribe.diagnostics import Span
    from fieldscribe.language.source import shown
    from fieldscribe.pipeline import DEVICE_FILE, load_device
    from fieldscribe.reading import Inputs

    inputs = Inputs()
    seen: dict[str, tuple[Path, Device]] = {}
    for device_file in device_files:
        try:
            device = load_device(device_file, report, inputs)
        except Exception as error:  # one device must not keep the others from being written
            _report_bug(report, device_file, "the compiler", error)
            continue
        if device is None:
            continue
        if device.id in seen:
            first = shown(seen[device.id][0])
            message = f"the device `{device.id}` is described twice in this run, first in {first}"
            report.error(
                "duplicate-device", message, Span(shown(device_file), 1, 1), f"give one {DEVICE_FILE} another `device`"
            )
            continue
        seen[device.id] = device_file, device
    return _Found(list(seen.values()), inputs, report)


def _compile(
    arguments: Namespace, targets: tuple[str, ...], found: _Found, result: _Result, memory: Memory | None
) -> None:
    if arguments.list_outputs:
        for device, made in _made(targets, found):
            result.wanted.update(_paths(device, made))
    elif arguments.check:
        _compare(arguments, targets, found, result)
    elif found.devices:
        from fieldscribe.output.lock import only_run

        with only_run(arguments.out, lambda: _say_waiting(arguments.out)):
            _write(arguments, targets, found, result)
            if memory and not found.report.has_errors:
                memory.keep(
                    found.inputs, {path: (state, result.digests[path]) for path, state in result.states.items()}
                )


def _made(targets: tuple[str, ...], found: _Found) -> Iterator[tuple[Device, Made]]:
    """Each device with all its files, or a finding: a device with a target that fails has no files at all."""
    from fieldscribe.pipeline import TargetError, outputs

    for device_file, device in found.devices:
        made: Made = {target: {} for target in targets}
        try:
            for target, path, text in outputs(device, targets):
                made[target][path] = text.encode()
        except TargetError as error:
            _report_bug(found.report, device_file, f"target {error}", error.__cause__ or error)
            continue
        yield device, made


def _compare(arguments: Namespace, targets: tuple[str, ...], found: _Found, result: _Result) -> None:
    """Note what is stale. What was current when it was read has to be so still at the end, or somebody is writing."""
    from fieldscribe.output.manifests import Manifests
    from fieldscribe.output.plan import changed_since, plan_of

    manifests = Manifests(arguments.out)
    for device, made in _made(targets, found):
        plan = plan_of(arguments.out, manifests, device.id, made)
        result.wanted.update(_paths(device, made))
        result.stale.update(plan.stale)
        result.removed.update(plan.remove)
        result.kept.update(plan.kept)
        result.states.update(plan.unchanged)
    result.stale.update(changed_since(arguments.out, result.states))


def _write(arguments: Namespace, targets: tuple[str, ...], found: _Found, result: _Result) -> None:
    from fieldscribe.output.manifests import Manifests
    from fieldscribe.output.plan import plan_of
    from fieldscribe.output.writing import carry_out

    manifests = Manifests(arguments.out)
    for device, made in _made(targets, found):
        plan = plan_of(arguments.out, manifests, device.id, made, force=arguments.force)
        if plan.refused:
            _report_refused(arguments, device, plan, found.report)
            continue
        result.states.update(carry_out(arguments.out, manifests, plan))
        result.digests.update(plan.digests)
        result.wanted.update(_paths(device, made))
        result.written.update(plan.write)
        result.removed.update(plan.remove)
        result.kept.update(plan.kept)


def _paths(device: Device, made: Made) -> Iterator[str]:
    from fieldscribe.output.manifests import manifest_path

    yield manifest_path(device.id)
    for files in made.values():
        yield from files


def _report_refused(arguments: Namespace, device: Device, plan: Plan, report: Report) -> None:
    from fieldscribe.diagnostics import Span
    from fieldscribe.language.source import shown

    hint = f"move it away, or replace it with `--force`; nothing of {device.id} was written"
    for path, reason in sorted(plan.refused.items()):
        report.error("foreign-file", f"a file is in the way: {reason}", Span(shown(arguments.out / path), 1, 1), hint)


def _report_bug(report: Report, device_file: Path, where: str, error: BaseException) -> None:
    """An internal error is a finding of its device."""
    from fieldscribe.cli import show_traceback
    from fieldscribe.diagnostics import Span
    from fieldscribe.language.source import shown

    show_traceback(error)
    message = (
        f"internal error in {where}: {type(error).__name__}: {str(error)[:120]}; nothing of the device was written"
    )
    hint = "this is a bug: please report it to the project with the description (FIELDSCRIBE_DEBUG=1 shows where)"
    report.error("internal-error", message, Span(shown(device_file), 1, 1), hint)


def _say_waiting(out: Path) -> None:
    import sys

    from fieldscribe.report import visible

    print(f"waiting for another run that writes to {visible(str(out))}", file=sys.stderr, flush=True)


def _say(arguments: Namespace, result: _Result, report: Report) -> int:
    """Tell what happened; the exit code."""
    import sys

    from fieldscribe.report import as_data, visible

    failed = report.has_errors
    out = visible(str(arguments.out))
    if arguments.format == "json":
        from fieldscribe.cli.common import print_json

        lists = {name: sorted(getattr(result, name)) for name in ("outputs", "written", "removed", "stale", "kept")}
        print_json({"out": str(arguments.out), **lists, "findings": as_data(report.findings)})
    elif arguments.list_outputs:
        print(*(visible(str(arguments.out / path)) for path in result.outputs), sep="\n")
    elif arguments.check:
        for path in sorted(result.stale):
            print(f"stale: {visible(str(arguments.out / path))}")
        print(f"{len(result.stale)} stale, {result.left} current in {out}")
    elif result.wanted or not failed:
        print(f"{len(result.written)} written, {len(result.removed)} removed, {result.left} unchanged in {out}")
    if result.kept and arguments.format == "text":
        for path in sorted(result.kept):
            where = visible(str(arguments.out / path))
            print(f"left in place: {where} is not made any more, but somebody changed it", file=sys.stderr)
    return 1 if failed or (arguments.check and result.stale) else 0
