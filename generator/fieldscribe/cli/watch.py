"""`fieldscribe watch`: compile descriptions whenever they are saved."""

import gc
import json
import sys
from argparse import ArgumentParser, Namespace
from pathlib import Path
from signal import SIGINT, SIGTERM, signal
from threading import Event
from time import strftime
from types import FrameType

from fieldscribe.authoring.watching import Outcome, Watch
from fieldscribe.cli.common import add_format, add_paths, description_paths, report_findings
from fieldscribe.cli.generate import add_where, print_waiting, targets_of
from fieldscribe.cli.terminal import FINE
from fieldscribe.diagnostics import as_data, summary, visible

WATCH_EXAMPLE = """examples:
  fieldscribe watch heat_pump --out bindings
  fieldscribe watch --target c,docs

prints the findings and a line with the time after each run; a description with errors leaves its output as it was
ends with 0 at Ctrl-C or SIGTERM, when the run that goes on is done"""


def add_watch_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_paths(parser)
    add_where(parser)
    add_format(parser)


def run_watch(arguments: Namespace) -> int:
    """Watch until Ctrl-C or SIGTERM, and return the exit code."""
    gc.enable()  # the process runs for long
    paths, out = description_paths(arguments.paths), arguments.out
    watch = Watch(paths, out, targets_of(arguments), lambda: print_waiting(out))
    with _Stop() as stop:
        for outcome in watch.outcomes(stop.wait):
            _print(outcome, out, arguments.format)
    return FINE


class _Stop:
    """Lets the current compilation finish at Ctrl-C or SIGTERM; a second signal does not wait."""

    def __enter__(self) -> Event:
        self.event = Event()
        self.before = {number: signal(number, self._on_signal) for number in (SIGINT, SIGTERM)}
        return self.event

    def __exit__(self, *_: object) -> None:
        for number, handler in self.before.items():
            signal(number, handler)

    def _on_signal(self, _number: int, _frame: FrameType | None) -> None:
        if self.event.is_set():
            raise KeyboardInterrupt
        self.event.set()


def _print(outcome: Outcome, out: Path, form: str) -> None:
    if form == "json":
        _print_json(outcome, out)
    else:
        report_findings(outcome.report, "text", sys.stdout)
        print(f"{strftime('%H:%M:%S')} {_summary(outcome, out)} ({outcome.seconds:.2f} s)")
    sys.stdout.flush()


def _summary(outcome: Outcome, out: Path) -> str:
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


def _print_json(outcome: Outcome, out: Path) -> None:
    """Print one line of JSON for a run."""
    result = outcome.result
    lists = {name: sorted(getattr(result, name)) for name in ("written", "removed", "kept")}
    trouble = {} if outcome.trouble is None else {"trouble": str(outcome.trouble)}
    findings = as_data(outcome.report.findings)
    data = {"devices": outcome.devices, "gone": outcome.gone, "out": str(out), **lists, **trouble, "findings": findings}
    print(json.dumps(data))
