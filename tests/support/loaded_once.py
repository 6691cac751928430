"""The devices of this repository, compiled once for all commands that a process of the tests tries."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from fieldscribe import pipeline
from fieldscribe.diagnostics import Report
from fieldscribe.model import Device
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.safe_files import Inputs

from support.places import ROOT

_load = pipeline.load_device


def load_device(device_file: Path, report: Report, inputs: Inputs | None = None) -> Device | None:
    """Load a device as the pipeline does, but only once if it is part of this repository."""
    place = device_file.resolve()
    device, read = _loaded(device_file, place) if ROOT in place.parents else (None, Inputs())
    if device is None:
        return _load(device_file, report, inputs)
    if inputs is not None:
        inputs.digests |= read.digests
        inputs.states |= read.states
    return device


@cache
def _loaded(device_file: Path, _place: Path) -> tuple[Device | None, Inputs]:
    """Return a device that no test changes, and what was read; None if it has findings, which each load must report."""
    report, inputs = Report(), Inputs()
    device = _load(device_file, report, inputs)
    return None if report.findings else device, inputs


def load_analysis(device_file: Path, report: Report) -> Analysis | None:
    """Analyse a device, but only once if it is part of this repository and messages would name the same files."""
    place = device_file.resolve()
    analysis = _analysed(device_file, place, Path.cwd()) if ROOT in place.parents else None
    return pipeline.load_analysis(device_file, report) if analysis is None else analysis


@cache
def _analysed(device_file: Path, _place: Path, _here: Path) -> Analysis | None:
    return pipeline.load_analysis(device_file, Report())
