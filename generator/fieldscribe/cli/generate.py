"""`fieldscribe generate`: compile descriptions into files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from fieldscribe.targets import TARGETS

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Callable

    from fieldscribe.diagnostics import Report
    from fieldscribe.output.memory import Memory
    from fieldscribe.output.result import Result

EXAMPLE = """examples:
  fieldscribe generate hitachi_l200 --target c --out firmware/drivers
  fieldscribe generate --check          (says what is stale and writes nothing; for CI)
  fieldscribe generate --check --strict-version

the manifest records the version and a digest of its facts; facts that change under the same version are a warning until
the version is raised (`fieldscribe diff` says by which step)

a device with an error, or with somebody else's file in its way, writes nothing; the others are written
ends with 1 when there is such a device, with --check when anything is stale, and with --strict-version when facts
changed under the same version"""


def add_where(parser: ArgumentParser) -> None:
    """What to make, and where."""
    from fieldscribe.cli.common import some_path

    parser.add_argument(
        "--target",
        default=",".join(TARGETS),
        metavar="LIST",
        help=f"what to make, of {', '.join(TARGETS)} (default: all)",
    )
    parser.add_argument(
        "--out", type=some_path, default=Path("generated"), metavar="DIR", help="where to (default: generated)"
    )


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import add_paths, some_path

    add_paths(parser)
    add_where(parser)
    parser.add_argument("--check", action="store_true", help="write nothing; say what is stale, exit 1 if anything is")
    parser.add_argument(
        "--strict-version",
        action="store_true",
        help="with --check: facts that change under the same version are an error",
    )
    parser.add_argument(
        "--unreleased",
        action="store_true",
        help="nobody has the present versions yet: record their present facts, without a warning",
    )
    parser.add_argument("--force", action="store_true", help="replace files in the way that fieldscribe did not make")
    parser.add_argument("--depfile", type=some_path, metavar="FILE", help="write a make rule from outputs to inputs")
    parser.add_argument("--list-outputs", action="store_true", help="write nothing; print the paths of all outputs")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="how to report (default: text)")


def targets_of(arguments: Namespace) -> tuple[str, ...]:
    """The targets that `--target` names. Raises StopError."""
    from fieldscribe.cli.common import StopError

    targets = tuple(dict.fromkeys(name.strip() for name in arguments.target.split(",") if name.strip()))
    unknown = [name for name in targets if name not in TARGETS]
    if unknown or not targets:
        raise StopError(f"there is no target `{', '.join(unknown)}`; there are {', '.join(TARGETS)}")
    return targets


def run(arguments: Namespace) -> int:
    """Compile; the exit code: 0 fine, 1 findings or stale, 2 environment."""
    from fieldscribe.cli.common import description_paths, report_findings, usage_error
    from fieldscribe.diagnostics import Report
    from fieldscribe.output.memory import Memory
    from fieldscribe.pipeline import find_devices

    targets = targets_of(arguments)
    if arguments.strict_version and not arguments.check:
        return usage_error("--strict-version is for --check", "write `generate --check --strict-version`")
    if arguments.unreleased and (arguments.check or arguments.list_outputs):
        return usage_error("--unreleased records facts; --check and --list-outputs write nothing")
    report = Report()
    device_files = find_devices(description_paths(arguments.paths), report)
    writes = not (arguments.check or arguments.list_outputs)
    memory = Memory(arguments.out, targets, device_files) if writes and not report.has_errors else None
    known = memory.outputs() if memory and not (arguments.depfile or arguments.unreleased) else None
    if known is not None:
        from fieldscribe.output.result import Result

        return _say(arguments, Result(known), report)
    try:
        result = _compiled(arguments, targets, device_files, report, memory)
    except OSError as error:
        return usage_error(f"cannot write to {error.filename or arguments.out}: {error.strerror or error}")
    if arguments.format == "text":
        report_findings(report, "text")
    return _say(arguments, result, report)


def _compiled(
    arguments: Namespace, targets: tuple[str, ...], device_files: list[Path], report: Report, memory: Memory | None
) -> Result:
    """List, compare or write, as the arguments say, and return the result. Raises OSError."""
    from fieldscribe.cli import show_traceback
    from fieldscribe.output.generation import Generation

    strict, unreleased = arguments.strict_version, arguments.unreleased
    generation = Generation(arguments.out, targets, report, show_traceback, strict=strict, unreleased=unreleased)
    generation.load(device_files)
    if arguments.list_outputs:
        generation.list_outputs()
    elif arguments.check:
        generation.compare()
    else:
        generation.write(lambda: say_waiting(arguments.out), memory, force=arguments.force)
        if arguments.depfile and not report.has_errors:
            from fieldscribe.output.depfile import keep_up

            outputs = (arguments.out / path for path in sorted(generation.result.wanted))
            keep_up(arguments.depfile, outputs, generation.inputs.digests)
    return generation.result


def say_waiting(out: Path) -> None:
    """Say that another run has the lock."""
    import sys

    from fieldscribe.report import visible

    print(f"waiting for another run that writes to {visible(str(out))}", file=sys.stderr, flush=True)


def _say(arguments: Namespace, result: Result, report: Report) -> int:
    """Print what happened and return the exit code."""
    from fieldscribe.report import visible

    if arguments.format == "json":
        _print_json(arguments, result, report)
    elif arguments.list_outputs:
        print(*(visible(str(arguments.out / path)) for path in sorted(result.wanted)), sep="\n")
    else:
        _print_text(arguments, result, visible)
    return 1 if report.has_errors or (arguments.check and result.stale) else 0


def _print_json(arguments: Namespace, result: Result, report: Report) -> None:
    from fieldscribe.cli.common import print_json
    from fieldscribe.report import as_data

    lists = {name: sorted(getattr(result, name)) for name in ("written", "removed", "stale", "kept")}
    outputs, findings = sorted(result.wanted), as_data(report.findings)
    print_json({"out": str(arguments.out), "outputs": outputs, **lists, "findings": findings})


def _print_text(arguments: Namespace, result: Result, visible: Callable[[str], str]) -> None:
    out = visible(str(arguments.out))
    for path in sorted(result.stale):
        print(f"stale: {visible(str(arguments.out / path))}")
    for path in sorted(result.kept):
        print(f"left in place: {visible(str(arguments.out / path))} is made no more, but was changed by hand")
    if arguments.check:
        print(f"{len(result.stale)} stale, {result.left} current in {out}")
    elif result.wanted:
        print(f"{len(result.written)} written, {len(result.removed)} removed, {result.left} unchanged in {out}")
