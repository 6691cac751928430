"""`fieldscribe simulate`: devices that answer on a line, made from their descriptions alone."""

from __future__ import annotations

import asyncio
import gc
import os
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from signal import SIGINT, SIGTERM

from fieldscribe.cli.common import (
    StopError,
    add_descriptions,
    add_repeated,
    device_file,
    report_findings,
    some_path,
    usage_error,
)
from fieldscribe.cli.terminal import FINDINGS, FINE
from fieldscribe.report import visible
from fieldscribe.simulation.bench import read_bench
from fieldscribe.simulation.clock import Clock
from fieldscribe.simulation.console import Console
from fieldscribe.simulation.device import Complaint
from fieldscribe.simulation.faults import KINDS
from fieldscribe.simulation.line import Line, Trace
from fieldscribe.simulation.making import Bench, BrokenError, DeviceSettings, LineSettings, close_all, serve
from fieldscribe.user_errors import UnclearError

EXAMPLE = f"""examples:
  fieldscribe simulate hitachi_l200 --tcp 5020
  fieldscribe simulate hitachi_l200 eastron_sdm630@2 --serial
  fieldscribe simulate hitachi_l200 --set A020=60 --fault "late 0.5 x3" --strict --for 10
  fieldscribe simulate --bench bench.yaml --trace trace.jsonl

faults: {", ".join(KINDS)}; each with a number, xTIMES and SHARE%
while it runs, it reads lines from standard input: `help` lists them
ends with 0 at Ctrl-C, SIGTERM or `quit`; with 1 if --strict has something to complain of; with 2 if a port is taken or
missing"""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add("devices", nargs="*", metavar="DEVICE[@UNIT]", help="device ids or folders, all on one line")
    line = parser.add_mutually_exclusive_group()
    line.add_argument("--tcp", metavar="[HOST:]PORT", help="answer at a TCP port of this machine (0: any free one)")
    line.add_argument(
        "--serial", nargs="?", const="", metavar="PORT", help="answer at a serial port, or a new pseudo terminal"
    )
    line.add_argument("--can", metavar="INTERFACE:CHANNEL", help="answer on a CAN bus, as python-can names it")
    line.add_argument("--bench", type=some_path, metavar="FILE", help="many devices on many lines")
    add("--framing", default="", help="the framing on the line, such as rtu over TCP (default: the usual one)")
    add("--speed", type=int, default=0, metavar="N", help="bauds of a serial port, or bits/s of a CAN bus")
    add("--unit", type=int, metavar="N", help="the unit of the device (default: its usual one)")
    add_descriptions(parser)
    add_repeated(parser, "--variant", "AXIS=VALUE", "choose a variant, as in voltage_class=400V")
    add_repeated(parser, "--set", "POINT=VALUE", "what it holds at the start", dest="values")
    add_repeated(parser, "--unmet", "CONDITION", "refuse the writes that need a condition, such as stopped")
    add_repeated(parser, "--fault", "KIND", 'spoil answers, as in "late 0.5 x3"', dest="faults")
    add("--still", action="store_true", help="leave its behaviour file aside: numbers change by writes alone")
    add("--strict", action="store_true", help="print what clients do against the manual, and where it says so")
    add("--seed", type=int, default=0, metavar="N", help="choose other numbers where the manual gives none")
    add("--time-scale", type=float, default=1.0, metavar="X", help="let the time of the devices run X times as fast")
    add(
        "--trace",
        type=some_path,
        metavar="FILE",
        help="write requests and answers as JSON lines (- for standard output)",
    )
    add("--for", type=float, metavar="SECONDS", dest="seconds", help="end after that time")


def run(arguments: Namespace) -> int:
    """Serve until the end, and return the exit code."""
    gc.enable()  # the process runs for long
    bench = _bench(arguments)
    if not 0 <= bench.time_scale <= 1e6:
        raise StopError("--time-scale is a number from 0 (time stands) to a million", "")
    try:
        with _trace(arguments.trace) as trace:
            return asyncio.run(_serve(bench, trace, arguments.seconds))
    except BrokenError as error:
        report_findings(error.report, "text")
        return FINDINGS


def _bench(arguments: Namespace) -> Bench:
    if arguments.bench is not None:
        if arguments.devices:
            raise StopError("a bench file names its devices itself", "leave DEVICE out, or --bench")
        return read_bench(arguments.bench)
    if not arguments.devices:
        raise StopError("there is nothing to simulate", "name a device, or a file after --bench")
    if arguments.unit is not None and len(arguments.devices) > 1:
        raise StopError("--unit is for a single device", "write each as DEVICE@UNIT")
    values = dict(_pair(text) for text in arguments.values)
    variants, unmet = tuple(arguments.variant), tuple(arguments.unmet)
    moves = False if arguments.still else None
    devices = []
    for text in arguments.devices:
        name, at, unit = text.rpartition("@") if "@" in text else (text, "", "")
        if at and not unit.isdecimal():
            raise StopError(f"`{text}` names no unit", "write DEVICE@UNIT, as in hitachi_l200@3")
        units = (int(unit),) if at else () if arguments.unit is None else (arguments.unit,)
        file = device_file(Namespace(device=name, descriptions=arguments.descriptions))
        devices.append(DeviceSettings(str(file), units, variants, {}, values, unmet, behaviour=moves))
    chosen = [(on, getattr(arguments, on)) for on in ("tcp", "serial", "can") if getattr(arguments, on) is not None]
    on, at = chosen[0] if chosen else ("", "")
    line = LineSettings(devices, on, at, arguments.framing, arguments.speed, tuple(arguments.faults))
    return Bench([line], arguments.seed, arguments.time_scale, arguments.strict)


def _pair(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not equals:
        raise StopError(f"--set: `{text}` gives no value", "write --set POINT=VALUE")
    return name.strip(), value.strip()


@contextmanager
def _trace(file: Path | None) -> Iterator[Trace | None]:
    if file is None:
        yield None
    elif str(file) == "-":
        yield lambda entry: print(entry, flush=True)
    else:
        with open(file, "w", encoding="utf-8", newline="\n") as stream:
            yield lambda entry: print(entry, file=stream)


async def _serve(bench: Bench, trace: Trace | None, seconds: float | None) -> int:
    """Serve the lines until a signal, `quit`, or the end of the time."""
    clock, stop, loop = Clock(bench.time_scale), asyncio.Event(), asyncio.get_running_loop()
    lines = bench.made(clock, trace)
    servers = [await serve(line, settings) for line, settings in zip(lines, bench.lines, strict=True)]
    for line, server in zip(lines, servers, strict=True):
        for device in line.core.devices:
            device.on_complaint = _complain
            print(f"{device.device.id} answers as unit {device.unit} on {server.url}", flush=True)
    for number in (SIGINT, SIGTERM):
        loop.add_signal_handler(number, stop.set)
    _read_lines(Console(lines, clock), stop)
    with suppress(TimeoutError):
        await asyncio.wait_for(stop.wait(), seconds)
    await close_all(servers)
    return FINDINGS if _summary(lines) else FINE


def _summary(lines: list[Line]) -> int:
    """Print how many requests came; return the number of complaints."""
    complaints = sum(len(device.complaints) for line in lines for device in line.core.devices)
    requests = sum(line.requests for line in lines)
    tail = f", {complaints} against the manual" if any(d.strict for line in lines for d in line.core.devices) else ""
    print(f"{requests} request{'' if requests == 1 else 's'}{tail}")
    return complaints


def _complain(complaint: Complaint) -> None:
    print(visible(str(complaint)), file=sys.stderr, flush=True)


def _read_lines(console: Console, stop: asyncio.Event) -> None:
    """Carry out the lines of standard input, if this process may read it."""
    try:
        source = sys.stdin.fileno()
        if os.isatty(source) and os.tcgetpgrp(source) != os.getpgrp():
            return  # in the background, reading would stop the process
        asyncio.get_running_loop().add_reader(source, _read_line, source, console, stop)
    except (OSError, ValueError, AttributeError):  # a file cannot be waited for; it may be closed
        return


def _read_line(source: int, console: Console, stop: asyncio.Event) -> None:
    data = os.read(source, 65536)
    if not data:
        asyncio.get_running_loop().remove_reader(source)
    for text in data.decode("utf-8", "replace").splitlines():
        try:
            answer = console.said(text)
            if answer:
                print(visible(answer) if "\n" not in answer else answer, flush=True)
        except UnclearError as error:
            usage_error(error.message, error.hint)
        except EOFError:
            stop.set()
