"""`fieldscribe generate`: compile descriptions into files."""

import sys
from argparse import ArgumentParser, Namespace
from pathlib import Path

from fieldscribe.cli import common
from fieldscribe.diagnostics import Report, as_data, visible
from fieldscribe.output.memory import Memory, Result
from fieldscribe.pipeline import find_devices
from fieldscribe.targets import TARGETS

GENERATE_EXAMPLE = """examples:
  fieldscribe generate hitachi_l200 --target c --out firmware/drivers
  fieldscribe generate --check          (says what is stale and writes nothing; for CI)
  fieldscribe generate --check --strict-version

the manifest records the version and a digest of its facts; facts that change under the same version are a warning until
the version is raised (`fieldscribe diff` says by which step)

a device with an error, or with somebody else's file in its way, writes nothing; the others are written
ends with 1 when there is such a device, with --check when anything is stale, and with --strict-version when facts
changed under the same version"""


def add_where(parser: ArgumentParser) -> None:
    """Add --target and --out."""
    names = ", ".join(TARGETS)
    targets = f"what to make, of {names} (default: all)"
    parser.add_argument("--target", default=",".join(TARGETS), metavar="LIST", help=targets)
    out = "where to (default: generated)"
    parser.add_argument("--out", type=common.some_path, default=Path("generated"), metavar="DIR", help=out)


def add_generate_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    common.add_paths(parser)
    add_where(parser)
    add = parser.add_argument
    add("--check", action="store_true", help="write nothing; say what is stale, exit 1 if anything is")
    strict = "with --check: facts that change under the same version are an error"
    add("--strict-version", action="store_true", help=strict)
    unreleased = "nobody has the present versions yet: record their present facts, without a warning"
    add("--unreleased", action="store_true", help=unreleased)
    add("--force", action="store_true", help="replace files in the way that fieldscribe did not make")
    add("--depfile", type=common.some_path, metavar="FILE", help="write a make rule from outputs to inputs")
    add("--list-outputs", action="store_true", help="write nothing; print the paths of all outputs")
    add("--format", choices=("text", "json"), default="text", help="how to report (default: text)")


def targets_of(arguments: Namespace) -> tuple[str, ...]:
    """Return the targets that `--target` names. Raises StopError."""
    targets = tuple(dict.fromkeys(name.strip() for name in arguments.target.split(",") if name.strip()))
    unknown = [name for name in targets if name not in TARGETS]
    if unknown or not targets:
        raise common.StopError(f"there is no target `{', '.join(unknown)}`; there are {', '.join(TARGETS)}")
    return targets


def run_generate(arguments: Namespace) -> int:
    """Compile, and return the exit code: 0 fine, 1 findings or stale, 2 environment."""
    targets = targets_of(arguments)
    if arguments.strict_version and not arguments.check:
        return common.usage_error("--strict-version is for --check", "write `generate --check --strict-version`")
    if arguments.unreleased and (arguments.check or arguments.list_outputs):
        return common.usage_error("--unreleased records facts; --check and --list-outputs write nothing")
    report = Report()
    device_files = find_devices(common.description_paths(arguments.paths), report)
    writes = not (arguments.check or arguments.list_outputs)
    memory = Memory(arguments.out, targets, device_files) if writes and not report.has_errors else None
    known = memory.outputs() if memory and not (arguments.depfile or arguments.unreleased) else None
    if known is not None:
        return _print_result(arguments, Result(known), report)
    try:
        result = _compiled(arguments, targets, device_files, report, memory)
    except OSError as error:
        return common.usage_error(f"cannot write to {error.filename or arguments.out}: {error.strerror or error}")
    if arguments.format == "text":
        common.report_findings(report, "text")
    return _print_result(arguments, result, report)


def _compiled(
    arguments: Namespace, targets: tuple[str, ...], device_files: list[Path], report: Report, memory: Memory | None
) -> Result:
    """List, compare or write, as the arguments say, and return the result. Raises OSError."""
    from fieldscribe.output.generation import Generation

    strict, unreleased = arguments.strict_version, arguments.unreleased
    generation = Generation(arguments.out, targets, report, strict=strict, unreleased=unreleased)
    generation.load(device_files)
    if arguments.list_outputs:
        generation.list_outputs()
    elif arguments.check:
        generation.compare()
    else:
        generation.write(lambda: print_waiting(arguments.out), memory, force=arguments.force)
        if arguments.depfile and not report.has_errors:
            from fieldscribe.output.writing import update_depfile

            outputs = (arguments.out / path for path in sorted(generation.result.wanted))
            update_depfile(arguments.depfile, outputs, generation.inputs.digests)
    return generation.result


def print_waiting(out: Path) -> None:
    """Print that another run holds the lock."""
    print(f"waiting for another run that writes to {visible(str(out))}", file=sys.stderr, flush=True)


def _print_result(arguments: Namespace, result: Result, report: Report) -> int:
    """Print the result and return the exit code."""
    if arguments.format == "json":
        lists = {name: sorted(getattr(result, name)) for name in ("written", "removed", "stale", "kept")}
        head = {"out": str(arguments.out), "outputs": sorted(result.wanted)}
        common.print_json({**head, **lists, "findings": as_data(report.findings)})
    elif arguments.list_outputs:
        print(*(visible(str(arguments.out / path)) for path in sorted(result.wanted)), sep="\n")
    else:
        _print_text(arguments, result)
    return 1 if report.has_errors or (arguments.check and result.stale) else 0


def _print_text(arguments: Namespace, result: Result) -> None:
    out = visible(str(arguments.out))
    for path in sorted(result.stale):
        print(f"stale: {visible(str(arguments.out / path))}")
    for path in sorted(result.kept):
        print(f"left in place: {visible(str(arguments.out / path))} is no longer generated, but was changed by hand")
    if arguments.check:
        print(f"{len(result.stale)} stale, {result.left} current in {out}")
    elif result.wanted:
        print(f"{len(result.written)} written, {len(result.removed)} removed, {result.left} unchanged in {out}")
