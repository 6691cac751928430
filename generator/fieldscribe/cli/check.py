"""`fieldscribe check`: validate descriptions."""

import sys
from argparse import ArgumentParser, Namespace
from collections import Counter
from pathlib import Path
from typing import Any

from fieldscribe.cli.common import add_format, add_paths, description_paths, print_json, report_findings
from fieldscribe.cli.terminal import FINDINGS, FINE
from fieldscribe.diagnostics import Report, as_data
from fieldscribe.model import Device
from fieldscribe.pipeline import find_devices, is_new, load_analysis
from fieldscribe.simulation.behaviour_file import read_behaviour
from fieldscribe.text import counted

CHECK_EXAMPLE = """examples:
  fieldscribe check
  fieldscribe check descriptions/hitachi_l200 --format json

ends with 1 when there is an error; warnings do not count"""


def add_check_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_paths(parser)
    add_format(parser)


def run_check(arguments: Namespace) -> int:
    """Check descriptions and print the findings; return the exit code."""
    as_text = arguments.format == "text"
    report, checked = Report(), []
    known: dict[str, Path] = {}
    for device_file in find_devices(description_paths(arguments.paths), report):
        analysis = load_analysis(device_file, report)
        if analysis is not None and is_new(analysis.device, device_file, known, report):
            checked.append(_counts(analysis.device))
            read_behaviour(device_file, analysis.device, report)
            if as_text:
                print(_line(checked[-1]), flush=True)
    if as_text:
        report_findings(report, "text", sys.stdout)
    else:
        print_json({"devices": checked, "findings": as_data(report.findings)})
    return FINDINGS if report.has_errors else FINE


def _counts(device: Device) -> dict[str, Any]:
    """Return the counts of the parts of a description."""
    return {
        "device": device.id,
        "version": device.version,
        "points": len(device.points),
        "generated": sum(point.generated for point in device.points),
        "groups": len(device.groups),
        "errata": len(device.errata),
        "errata_by_certainty": dict(sorted(Counter(erratum.certainty for erratum in device.errata).items())),
        "frames": len(device.frames),
    }


def _line(counts: dict[str, Any]) -> str:
    """Return the counts in one line."""
    certainty = ", ".join(f"{count} {name}" for name, count in counts["errata_by_certainty"].items())
    errata = f"{counts['errata']} {'erratum' if counts['errata'] == 1 else 'errata'}"
    return (
        f"{counts['device']}: {counted(counts['points'], 'point')} ({counts['generated']} generated) in "
        f"{counted(counts['groups'], 'group')}, {errata}{f' ({certainty})' if certainty else ''}, "
        f"{counted(counts['frames'], 'printed frame')}"
    )
