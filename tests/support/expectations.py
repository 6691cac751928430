"""Expected findings in the first lines of a description: read, written and compared. See test_bad.py."""

from __future__ import annotations

from pathlib import Path

from fieldscribe.diagnostics import Diagnostic, Report, Span
from fieldscribe.pipeline import find_devices, load_device
from fieldscribe.simulation.behaviour_file import FILE, read_behaviour

SIDECAR = "expected.txt"
"""Holds the expectation of a folder: its files may be empty, missing or no text at all."""

_MARKS = ("# error:", "# warning:", "#   hint:", "#   also:")


def findings_of(case: Path) -> tuple[Diagnostic, ...]:
    """Return the compiler's findings in a case: one file, or a folder as a user would name it."""
    report = Report()
    devices = [case] if case.is_file() else find_devices([case], report)
    for device_file in devices:
        device = load_device(device_file, report)
        assert (device is None) == report.has_errors, "a device without errors, and none with errors"
        if device is not None and case.is_dir() and (device_file.parent / FILE).exists():
            assert (read_behaviour(device_file, device, report) is None) == report.has_errors
    return report.findings


def wording(case: Path, findings: tuple[Diagnostic, ...]) -> list[str]:
    """The findings as comment lines; places in the case's own file are line:column alone."""
    lines = []
    for one in findings:
        lines.append(f"# {one.severity}: {one.rule} {_place(case, one.span)} {one.message}")
        if one.hint:
            lines.append(f"#   hint: {one.hint}")
        lines += [f"#   also: {_place(case, span)} {text}" for span, text in one.related]
    return lines


def expected(case: Path) -> list[str]:
    """Return the expected findings that the case states."""
    if case.is_dir():
        file = case / SIDECAR
        return file.read_text("utf-8").splitlines() if file.exists() else []
    lines = case.read_text("utf-8").splitlines()
    return lines[: _head(lines)]


def accept(case: Path) -> None:
    """Write the present findings into the case as the expected ones."""
    if case.is_dir():
        (case / SIDECAR).write_text("".join(f"{line}\n" for line in wording(case, findings_of(case))), "utf-8")
        return
    for _ in range(2):  # the head moves the places that it names
        lines = case.read_text("utf-8").splitlines()
        head = wording(case, findings_of(case))
        case.write_text("\n".join([*head, *lines[_head(lines) :]]) + "\n", "utf-8")


def _head(lines: list[str]) -> int:
    return next((number for number, line in enumerate(lines) if not line.startswith(_MARKS)), len(lines))


def _place(case: Path, span: Span) -> str:
    file = Path(span.file).name
    return f"{span.line}:{span.column}" if case.is_file() else f"{file}:{span.line}:{span.column}"
