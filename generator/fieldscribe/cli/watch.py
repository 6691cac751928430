"""`fieldscribe watch`: compile descriptions whenever they are saved."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from pathlib import Path
    from threading import Event
    from types import FrameType

    from fieldscribe.authoring.watching import Outcome

EXAMPLE = """examples:
  fieldscribe watch heat_pump --out bindings
  fieldscribe watch --target c,docs

prints the findings and a line with the time after each run; a description with errors leaves its output as it was
ends with 0 at Ctrl-C or SIGTERM, when the run that goes on is done"""


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import add_format, add_paths
    from fieldscribe.cli.generate import add_where

    add_paths(parser)
    add_where(parser)
    add_format(parser)


def run(arguments: Namespace) -> int:
    """Watch until somebody stops it; the exit code."""
    import gc

    from fieldscribe.authoring.watching import Watch
    from fieldscribe.cli import FINE, show_traceback
    from fieldscribe.cli.common import description_paths
    from fieldscribe.cli.generate import print_waiting, targets_of

    gc.enable()  # this run is not short
    watch = Watch(
        description_paths(arguments.paths),
        arguments.out,
        targets_of(arguments),
        show_traceback,
        lambda: print_waiting(arguments.out),
    )
    with _Stop() as stop:
        for outcome in watch.outcomes(stop.wait):
            _tell(outcome, arguments.out, arguments.format)
    return FINE


class _Stop:
    """Lets the run that goes on end before Ctrl-C or SIGTERM does; a second one does not wait."""

    def __enter__(self) -> Event:
        from signal import SIGINT, SIGTERM, signal
        from threading import Event

        self.event = Event()
        self.before = {number: signal(number, self._come) for number in (SIGINT, SIGTERM)}
        return self.event

    def __exit__(self, *_: object) -> None:
        from signal import signal

        for number, handler in self.before.items():
            signal(number, handler)

    def _come(self, _number: int, _frame: FrameType | None) -> None:
        if self.event.is_set():
            raise KeyboardInterrupt
        self.event.set()


def _tell(outcome: Outcome, out: Path, form: str) -> None:
    from time import strftime

    from fieldscribe.cli.common import report_findings

    if form == "json":
        _tell_json(outcome, out)
    else:
        report_findings(outcome.report, "text", sys.stdout)
        print(f"{strftime('%H:%M:%S')} {_said(outcome, out)} ({outcome.seconds:.2f} s)")
    sys.stdout.flush()


def _said(outcome: Outcome, out: Path) -> str:
    from fieldscribe.report import summary, visible

    result = outcome.result
    gone = [f"{visible(name)} is gone" for name in outcome.gone]
    if not outcome.devices:
        return f"{'; '.join(gone) or 'there is no device'}; no output was touched"
    few = len(outcome.devices) <= 3
    names = ", ".join(map(visible, outcome.devices)) if few else f"{len(outcome.devices)} devices"
    if outcome.trouble is not None:
        error = outcome.trouble
        return f"{names}: cannot write to {visible(str(error.filename or out))}: {error.strerror or error}"
    written = (
        f"{len(result.written)} written, {len(result.removed)} removed, {result.left} unchanged in {visible(str(out))}"
    )
    if outcome.report.has_errors:
        rest = f"; {written}" if result.wanted else "; the output stays as it was"
        return "; ".join([*gone, f"{names}: {summary(outcome.report)}{rest}"])
    return "; ".join([*gone, f"{names}: {written}"])


def _tell_json(outcome: Outcome, out: Path) -> None:
    """One line for each run."""
    import json

    from fieldscribe.report import as_data

    result = outcome.result
    lists = {name: sorted(getattr(result, name)) for name in ("written", "removed", "kept")}
    trouble = {} if outcome.trouble is None else {"trouble": str(outcome.trouble)}
    findings = as_data(outcome.report.findings)
    said = {"devices": outcome.devices, "gone": outcome.gone, "out": str(out), **lists, **trouble, "findings": findings}
    print(json.dumps(said))
