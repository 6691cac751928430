"""The devices of this repository, compiled once for all commands that a process of the tests tries."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from fieldscribe import pipeline
from fieldscribe.diagnostics import Report
from fieldscribe.model import Device
from fieldscribe.safe_files import Inputs

from support.places import ROOT

_load = pipeline.load_device


def load_device(device_file: Path, report: Report, inputs: Inputs | None = None) -> Device | None:
    """Load a device as the pipeline does, but only once if it is part of this repository."""
    place = device_file.resolve()
    known = _loaded(place) if inputs is None and ROOT in place.parents else None
    return known or _load(device_file, report, inputs)


@cache
def _loaded(device_file: Path) -> Device | None:
    """Return a device that no test changes; None if it has findings, which each load must report."""
    report = Report()
    device = _load(device_file, report)
    return None if report.findings else device
