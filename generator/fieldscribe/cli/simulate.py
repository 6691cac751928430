"""`fieldscribe simulate`: devices that answer on a line, made from their descriptions alone."""

import asyncio
import gc
import os
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from signal import SIGINT, SIGTERM
from stat import S_ISREG
from typing import Any, TextIO

from fieldscribe.cli.common import (
    StopError,
    add_descriptions,
    add_repeated,
    device_file,
    period,
    report_findings,
    some_path,
    speed,
    usage_error,
)
from fieldscribe.cli.terminal import FINDINGS, FINE
from fieldscribe.diagnostics import UnclearError, visible
from fieldscribe.simulation.bench import Bench, BrokenError, carry_out, read_bench
from fieldscribe.simulation.line import KINDS
from fieldscribe.simulation.servers import serve

_PLACES = ("tcp", "serial", "can")
_USUAL_TIME = 1.0
_AT_ONCE = 1 << 16
"""The most bytes of standard input that are read at once."""
_OF_THE_LINE = {"with": "given", "set": "values", "fault": "faults", "time-scale": "time_scale"} | {
    name: name for name in ("framing", "speed", "unit", "descriptions", "variant", "unmet", "still", "strict", "seed")
}
"""The options that a bench file has keys for, with their attributes."""


SIMULATE_EXAMPLE = f"""examples:
  fieldscribe simulate hitachi_l200 --tcp 5020
  fieldscribe simulate hitachi_l200 eastron_sdm630@2 --serial
  fieldscribe simulate hitachi_l200 --set A020=60 --fault "late 0.5 x3" --strict --for 10
  fieldscribe simulate --bench bench.yaml --trace trace.jsonl

faults: {", ".join(KINDS)}; each with a number, xTIMES and SHARE%
while it runs, it reads lines from standard input: `help` lists them
ends with 0 at Ctrl-C, SIGTERM or `quit`; with 1 if --strict finds a fault of a client; with 2 if a port is taken or
missing"""


def add_simulate_arguments(parser: ArgumentParser) -> None:
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
    add("--speed", type=speed, metavar="N", help="bauds of a serial port, or bits/s of a CAN bus")
    add("--unit", type=int, metavar="N", help="the unit of the device (default: its usual one)")
    add_descriptions(parser)
    add_repeated(parser, "--variant", "AXIS=VALUE", "choose a variant, as in voltage_class=400V")
    add_repeated(parser, "--with", "NAME=NUMBER", "a number that addresses depend on, such as slot=3", dest="given")
    add_repeated(parser, "--set", "POINT=VALUE", "what it holds at the start", dest="values")
    add_repeated(parser, "--unmet", "CONDITION", "refuse the writes that need a condition, such as stopped")
    add_repeated(parser, "--fault", "KIND", 'spoil answers, as in "late 0.5 x3"', dest="faults")
    add("--still", action="store_true", help="ignore its behaviour file: numbers change only by writes")
    add("--strict", action="store_true", help="print what clients do against the manual, with its line")
    add("--seed", type=int, default=0, metavar="N", help="choose other numbers where the manual gives none")
    add(
        "--time-scale",
        type=float,
        default=_USUAL_TIME,
        metavar="X",
        help="let the time of the devices run X times as fast",
    )
    add(
        "--trace",
        type=some_path,
        metavar="FILE",
        help="write requests and answers as JSON lines (- for standard output)",
    )
    add("--for", type=period, metavar="SECONDS", dest="seconds", help="end after that time")


def run_simulate(arguments: Namespace) -> int:
    """Serve until the end, and return the exit code."""
    gc.enable()  # the process runs for long
    file: Path | None = arguments.bench
    if file is not None:
        _require_bench_alone(arguments)
    try:
        with _trace(arguments.trace) as stream:
            settings = _settings(arguments) if file is None else read_bench(file)
            trace = None if stream is None else partial(print, file=stream, flush=True)
            bench = Bench(settings, Path() if file is None else file.parent, trace)
            return asyncio.run(_serve(bench, arguments.seconds, stream))
    except BrokenError as error:
        report_findings(error.report, "text")
        return FINDINGS


def _require_bench_alone(arguments: Namespace) -> None:
    """Raise StopError if something is given beside a bench file that the file says itself."""
    if arguments.devices:
        raise StopError("a bench file names its devices itself", "leave DEVICE out, or --bench")
    for option, attribute in _OF_THE_LINE.items():
        if getattr(arguments, attribute) not in (None, "", False, [], 0, _USUAL_TIME):
            raise StopError(f"a bench file is given, and --{option} would have no effect", "write it in the file")


def _settings(arguments: Namespace) -> Mapping[str, Any]:
    """Return the bench of the command line: one line."""
    if not arguments.devices:
        raise StopError("there is nothing to simulate", "name a device, or a file after --bench")
    common: dict[str, Any] = {"unmet": arguments.unmet} | ({"behaviour": False} if arguments.still else {})
    common["values"] = dict(_pair("--set", text) for text in arguments.values)
    common["given"] = dict(_pair("--with", text) for text in arguments.given)
    common["variant"] = dict(_pair("--variant", text) for text in arguments.variant)
    devices = []
    for text in arguments.devices:
        name, at, unit = text.rpartition("@") if "@" in text else (text, "", arguments.unit)
        if at and not unit.isdecimal():
            raise StopError(f"`{text}` names no unit", "write DEVICE@UNIT, as in hitachi_l200@3")
        if at and arguments.unit is not None:
            raise StopError(f"--unit would have no effect on `{text}`", "give the unit once")
        file = device_file(Namespace(device=name, descriptions=arguments.descriptions))
        devices.append({"device": str(file), **common} | ({} if unit is None else {"unit": int(unit)}))
    line = {"devices": devices, "framing": arguments.framing, "faults": arguments.faults}
    line |= {} if arguments.speed is None else {"speed": arguments.speed}
    line |= {on: at for on in _PLACES if (at := getattr(arguments, on)) is not None}
    return {"lines": [line], **{key: getattr(arguments, key) for key in ("seed", "time_scale", "strict")}}


def _pair(option: str, text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not equals:
        raise StopError(f"{option}: `{text}` gives no value", f"write {option} NAME=VALUE")
    return name.strip(), value.strip()


def _first_byte(file: Path) -> bytes:
    with open(file, "rb") as stream:
        return stream.read(1)


@contextmanager
def _trace(file: Path | None) -> Iterator[TextIO | None]:
    """Return the stream of the trace; an older trace stays in its file until the lines are served."""
    if file is None or str(file) == "-":
        yield None if file is None else sys.stdout
    else:
        if file.is_file() and _first_byte(file) not in (b"", b"{"):
            raise StopError(f"{file} is there, and no trace: it would be lost", "name another file")
        with open(file, "a", encoding="utf-8", newline="\n") as stream:
            yield stream


async def _serve(bench: Bench, seconds: float | None, trace: TextIO | None) -> int:
    """Serve the lines until a signal, `quit`, or the end of the time."""
    stop, loop = asyncio.Event(), asyncio.get_running_loop()
    servers = [await serve(line) for line in bench.lines]
    if trace not in (None, sys.stdout) and S_ISREG(os.fstat(trace.fileno()).st_mode):
        trace.truncate(0)
    devices = [
        (device, server) for line, server in zip(bench.lines, servers, strict=True) for device in line.core.devices
    ]
    for device, server in devices:
        device.on_complaint = lambda complaint: print(visible(str(complaint)), file=sys.stderr, flush=True)
        print(f"{device.device.id} answers as unit {device.unit} on {server.url}", flush=True)
    for number in (SIGINT, SIGTERM):
        loop.add_signal_handler(number, stop.set)
    _read_lines(bench, stop)
    with suppress(TimeoutError):
        await asyncio.wait_for(stop.wait(), seconds)
    stop.set()
    for server in servers:
        server.close()
    requests, complaints = sum(line.requests for line in bench.lines), sum(len(each.complaints) for each, _ in devices)
    tail = f", {complaints} against the manual" if any(each.strict for each, _ in devices) else ""
    print(f"{requests} request{'' if requests == 1 else 's'}{tail}")
    return FINDINGS if complaints else FINE


def _read_lines(bench: Bench, stop: asyncio.Event) -> None:
    """Carry out the lines of standard input, if this process may read it."""
    with suppress(OSError, ValueError, AttributeError):  # it may be closed
        source = sys.stdin.fileno()
        if not os.isatty(source) or os.tcgetpgrp(source) == os.getpgrp():  # in the background it would be stopped
            begun = bytearray()
            try:
                asyncio.get_running_loop().add_reader(source, _read_lines_now, source, begun, bench, stop)
            except PermissionError:  # a file has its lines at once, and cannot be waited for
                while _read_lines_now(source, begun, bench, stop) and S_ISREG(os.fstat(source).st_mode):
                    pass


def _read_lines_now(source: int, begun: bytearray, bench: Bench, stop: asyncio.Event) -> bool:
    """Carry out what has come; `begun` keeps the beginning of a line. Return False at the end, and after `quit`."""
    if stop.is_set():
        return False
    data = os.read(source, _AT_ONCE)
    if not data:
        asyncio.get_running_loop().remove_reader(source)
    begun += data
    end = begun.rfind(b"\n") + 1 if data and len(begun) < 2 * _AT_ONCE else len(begun)
    lines = begun[:end].decode("utf-8", "replace").splitlines()
    del begun[:end]
    for text in lines:
        try:
            for answer in carry_out(bench, text).splitlines():
                print(visible(answer), flush=True)
        except UnclearError as error:
            usage_error(error.message, error.hint)
        except EOFError:
            stop.set()
            return False
    return bool(data)
