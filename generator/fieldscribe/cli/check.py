"""`fieldscribe check`: validate descriptions."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from pathlib import Path

    from fieldscribe.model import Device

HELP = "validate descriptions; say everything that is wrong, and where"
EXAMPLE = """examples:
  fieldscribe check
  fieldscribe check descriptions/hitachi_l200 --format json

ends with 1 when there is an error; warnings do not count"""


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import add_format, add_paths

    add_paths(parser)
    add_format(parser)


def run(arguments: Namespace) -> int:
    """Check; the exit code: 1 when a description is wrong."""
    import sys

    from fieldscribe.cli import FINDINGS, FINE
    from fieldscribe.cli.common import description_paths, print_json, report_findings
    from fieldscribe.diagnostics import Report
    from fieldscribe.pipeline import find_devices, is_new, load_analysis
    from fieldscribe.report import as_data

    as_text = arguments.format == "text"
    report, good = Report(), []
    known: dict[str, Path] = {}
    for device_file in find_devices(description_paths(arguments.paths), report):
        analysis = load_analysis(device_file, report)
        if analysis is not None and is_new(analysis.device, device_file, known, report):
            good.append(_facts(analysis.device))
            if as_text:
                print(_line(good[-1]), flush=True)
    if as_text:
        report_findings(report, "text", sys.stdout)
    else:
        print_json({"devices": good, "findings": as_data(report.findings)})
    return FINDINGS if report.has_errors else FINE


def _facts(device: Device) -> dict[str, object]:
    """How much a description holds."""
    certainty: dict[str, int] = {}
    for erratum in device.errata:
        certainty[erratum.certainty] = certainty.get(erratum.certainty, 0) + 1
    return {
        "device": device.id,
        "version": device.version,
        "points": len(device.points),
        "generated": sum(point.generated for point in device.points),
        "groups": len(device.groups),
        "errata": len(device.errata),
        "errata_by_certainty": dict(sorted(certainty.items())),
        "frames": len(device.frames),
    }


def _line(facts: dict[str, object]) -> str:
    from fieldscribe.wording.buses import counted

    by_certainty = facts["errata_by_certainty"]
    assert isinstance(by_certainty, dict)
    certainty = ", ".join(f"{count} {name}" for name, count in by_certainty.items())
    counts = {key: value for key, value in facts.items() if isinstance(value, int)}
    points, groups, frames = (
        counted(counts[key], what)
        for key, what in (("points", "point"), ("groups", "group"), ("frames", "printed frame"))
    )
    errata = f"{counts['errata']} {'erratum' if counts['errata'] == 1 else 'errata'}"
    return (
        f"{facts['device']}: {points} ({counts['generated']} generated) in {groups}, "
        f"{errata}{f' ({certainty})' if certainty else ''}, {frames}"
    )
