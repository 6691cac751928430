"""`fieldscribe listen`: show what devices and their masters exchange, from a capture or on a line, without sending."""

import json
import sys
import time
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from contextlib import ExitStack
from datetime import UTC, datetime
from functools import lru_cache
from io import BufferedReader
from pathlib import Path
from typing import cast

from fieldscribe.cli.common import (
    StopError,
    add_descriptions,
    add_repeated,
    duration,
    open_device,
    usage_error,
)
from fieldscribe.cli.frame_options import add_family_options, add_with, options_of, placed, settings_of
from fieldscribe.cli.terminal import FINDINGS, FINE, USAGE, collect_rarely
from fieldscribe.conversation.decoder import logged_frame
from fieldscribe.diagnostics import UnclearError, visible
from fieldscribe.families import family
from fieldscribe.listening.captures import chunks_of
from fieldscribe.listening.chunks import STREAM, Chunk, timed
from fieldscribe.listening.exchanges import Exchange, Statistics, finding_text, seconds
from fieldscribe.listening.listener import Listener, Station
from fieldscribe.listening.packet_files import PacketWriter, is_packet_file
from fieldscribe.live.lines import NAME, LineAddress, Project, read_line, read_project, require_line
from fieldscribe.live.lines import Station as NamedStation
from fieldscribe.model import Device
from fieldscribe.pasted_numbers import HexError
from fieldscribe.text import counted, shortened

LISTEN_EXAMPLE = """examples:
  fieldscribe listen hitachi_l200 --capture plant.pcapng
  fieldscribe listen hitachi_l200=1 nord_sk5xxe=2 --line "rtu:///dev/ttyUSB0?baud=9600"
  fieldscribe listen woodward_mpu2s --line can://socketcan/can0 --for 60
  fieldscribe listen hitachi_l200=1 nord_sk5xxe=2 --capture gateway.log --write gateway.pcapng
  candump -L can0 | fieldscribe listen woodward_mpu2s --capture - --summary
  fieldscribe listen woodward_mpu2s --capture candump.log --format jsonl

DEVICE=N is the device with unit N; without N it covers all other units. Captures are pcap and pcapng (a network, a
serial line as DLT 147 to 162, SocketCAN), BLF and ASC, logs of candump, and lines of hexadecimal bytes, each perhaps
with a time.
On a line nothing is sent; Ctrl-C ends it, and the summary follows.

ends with 1 when there are errors, or something contradicts the manual
ends with 2 when a capture is cut off or invalid, or has nothing for the ports that are given, or when a line cannot be
opened or is lost; what came before is printed
"""

_LAST_MOMENT = 1 << 34
"""Later times are invalid."""


def add_listen_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add(
        "devices",
        nargs="+",
        metavar="DEVICE[=N]",
        help=f"a device's id or path, perhaps with its unit; or a station of {NAME}",
    )
    add_descriptions(parser)
    add_repeated(parser, "--variant", "AXIS=VALUE", "choose a variant, as in voltage_class=400V")
    add_with(parser)
    add_repeated(parser, "--capture", "FILE", "read a capture; - is standard input")
    add("--line", metavar="LINE", help=f"listen on a line: rtu:///dev/ttyUSB0?baud=9600, or a name from {NAME}")
    add("--for", type=duration, metavar="SECONDS", dest="duration", help="stop listening on the line after this time")
    add_repeated(parser, "--port", "N", "a TCP port of the devices (default: that of the protocol)", type=_port)
    add("--write", metavar="FILE", help="also write everything to a new capture (pcapng)")
    add("--summary", action="store_true", help="print only the summary, not each exchange")
    add("-v", "--verbose", action="store_true", help="with each exchange, print its frames and what the manual says")
    add_family_options(parser, "listen")
    add("--format", choices=("text", "jsonl"), default="text", help="how to report (default: text)")


def _port(text: str) -> int:
    """Return a TCP port, for argparse."""
    if not (text.isascii() and text.isdigit() and len(text) < 6 and 0 < int(text) < 1 << 16):
        raise ArgumentTypeError(f"`{shortened(text)}` is no TCP port: they are 1 to 65535")
    return int(text)


def run_listen(arguments: Namespace) -> int:
    """Listen and print; return the exit code."""
    project = read_project(Path(NAME))
    stations = [_station(arguments, name, project) for name in arguments.devices]
    if bool(arguments.capture) == bool(arguments.line):
        either = "either --capture FILE or --line LINE, not both" if arguments.line else "--capture FILE or --line LINE"
        raise StopError(f"give {either}", "captures are pcap, pcapng, candump, bytes in lines")
    _require_effect(arguments)
    line = None if arguments.line is None else _line(arguments, project, stations[0].device)
    listener = Listener(stations, options_of(stations[0].device, arguments))
    _require_one_each(stations)
    collect_rarely()
    with ExitStack() as stack:
        writer = PacketWriter(stack.enter_context(open(arguments.write, "xb"))) if arguments.write else None
        output = _Output(arguments, listener, writer)
        if line is not None:
            output.follow_line(line, arguments.duration)
        for name in arguments.capture:
            if name == "-":
                output.follow(_standard_input(), "standard input")
            else:
                output.follow(stack.enter_context(open(name, "rb")), name)
        return output.end()


def _require_effect(arguments: Namespace) -> None:
    """Raise StopError for an option that has no effect on a capture, or on a line."""
    if arguments.capture and arguments.duration is not None:
        raise StopError("--for would have no effect on a capture", "leave it out, or give --line LINE")
    if arguments.line and arguments.port:
        raise StopError("--port would have no effect on a line", "leave it out, or give --capture FILE")


def _standard_input() -> BufferedReader:
    """Return standard input as unbuffered bytes. Raises StopError."""
    if sys.stdin is None:
        raise StopError("standard input is closed", "give --capture FILE")
    stream = cast("BufferedReader", sys.stdin.buffer)
    return stream if hasattr(stream, "peek") else BufferedReader(stream)


def _station(arguments: Namespace, text: str, project: Project) -> Station:
    """Return a device with its unit: as typed, or from the project file. Raises StopError."""
    known = project.stations.get(text)
    if known is None:
        name, equals, unit = text.rpartition("=")
        if equals and not (unit.isascii() and unit.isdigit() and len(unit) < 5 and int(unit) < 256):
            raise StopError(f"`{shortened(text)}`: a unit is a number up to 255", "as in hitachi_l200=1")
        known = NamedStation(name if equals else text, None, int(unit) if equals else None)
    arguments.line = arguments.line or (None if arguments.capture else known.line)
    chosen = Namespace(**vars(arguments))
    chosen.device = known.description
    chosen.variant, chosen.settings = [*arguments.variant, *known.variants], [*arguments.settings, *known.settings]
    device = placed(open_device(chosen), chosen)
    return Station(device, known.unit, settings_of(device, chosen))


def _require_one_each(stations: list[Station]) -> None:
    """Raise StopError if two devices are given for one unit, or for all other units."""
    seen: dict[int | None, str] = {}
    for station in stations:
        unit, name = station.unit, station.device.id
        if unit in seen:
            what = "all other units" if unit is None else f"unit {unit}"
            raise StopError(f"{seen[unit]} and {name} are both given for {what}", "name units, as in hitachi_l200=1")
        seen[unit] = name


def _line(arguments: Namespace, project: Project, device: Device) -> LineAddress:
    """Return the line; its settings become options that are not given. Raises UnclearError."""
    line = read_line(project.lines.get(arguments.line, arguments.line))
    require_line(line, device)
    for option in family(device.family).options:
        if option.name in line.settings and not getattr(arguments, option.name, None):
            is_number, text = option.type is int, line.settings[option.name]
            setattr(arguments, option.name, line.number(option.name, 0, (0, 127)) if is_number else text == "yes")
    return line


class _Output:
    """Prints exchanges as they come, and the summary at the end."""

    def __init__(self, arguments: Namespace, listener: Listener, writer: PacketWriter | None) -> None:
        self._listener, self._writer, self._statistics = listener, writer, Statistics()
        self._ports = frozenset(arguments.port) or listener.part.PORTS
        self._lacks_ports = bool(arguments.port)
        self._json = arguments.format == "jsonl"
        kind = _JsonPrinter if self._json else _Printer
        self._printer = None if arguments.summary else kind(verbose=arguments.verbose)
        self._unread, self._broken = 0, False

    def follow(self, stream: BufferedReader, name: str) -> None:
        """Print the exchanges of a capture."""
        each = None
        if self._writer is not None:
            is_packets = is_packet_file(stream.peek(4))
            each, self._listener.each = (self._writer.write, None) if is_packets else (None, self._writer.write)
        try:
            for chunk in chunks_of(stream, self._ports, self._chunk_of, each):
                if chunk.kind == STREAM:
                    self._lacks_ports = False
                self._take(chunk)
        except UnclearError as error:
            self._broken = True
            usage_error(f"{name}: {error.message}", error.hint)

    def follow_line(self, line: LineAddress, duration: float | None) -> None:
        """Print the exchanges on a line, until Ctrl-C or for a number of seconds."""
        self._listener.each = None if self._writer is None else self._writer.write
        end = None if duration is None else time.monotonic() + duration
        try:
            for chunk in self._listener.part.receive(line):
                self._take(chunk)
                sys.stdout.flush()
                if end is not None and time.monotonic() >= end:
                    break
        except KeyboardInterrupt:
            return
        except UnclearError as error:
            self._broken = True
            usage_error(error.message, error.hint)

    def _chunk_of(self, text: str) -> Chunk | None:
        """Return the chunk in a line of a log; None if it has no frame."""
        frame = logged_frame(text) if "unit " in text else text
        try:
            chunk: Chunk | None = None if frame is None else self._listener.part.chunk_of_text(frame)
        except HexError:
            self._unread += 1
            return None
        return chunk if chunk is None or frame is text else chunk._replace(time=timed(text)[0])

    def _take(self, chunk: Chunk) -> None:
        for exchange in self._listener.take(chunk):
            self._exchange(exchange)

    def _exchange(self, exchange: Exchange) -> None:
        self._statistics.add(exchange)
        if self._printer is not None:
            self._printer.exchange(exchange)

    def end(self) -> int:
        """Print the rest and the summary; return the exit code."""
        for exchange in self._listener.rest():
            self._exchange(exchange)
        statistics = self._statistics
        if self._broken and not statistics.exchanges:
            return USAGE
        if self._json:
            sys.stdout.write(f"{json.dumps({'summary': statistics.as_data()})}\n")
        else:
            sys.stdout.write("\n" if self._printer is not None and statistics.exchanges else "")
            sys.stdout.write("".join(f"{visible(text)}\n" for text in statistics.lines()))
        if self._unread:
            usage_error(f"{counted(self._unread, 'line')} without a frame")
        if self._listener.others:
            usage_error(f"{counted(self._listener.others, 'frame')} of another kind of bus")
        if self._lacks_ports:
            ports = " or ".join(map(str, sorted(self._ports)))
            usage_error(f"--port had no effect: no data here goes to or from port {ports}", "only networks have ports")
        return USAGE if self._broken or self._lacks_ports else FINDINGS if statistics.wrong else FINE


class _Printer:
    """Prints an exchange as a line of text, with `verbose` also its frames and remarks."""

    def __init__(self, *, verbose: bool) -> None:
        self._verbose = verbose
        self._clock = lru_cache(4)(lambda second: datetime.fromtimestamp(second, UTC).strftime("%H:%M:%S"))

    def exchange(self, exchange: Exchange) -> None:
        """Print an exchange."""
        content = exchange.content
        words = [self._moment(exchange.time), visible(exchange.place), exchange.text]
        if exchange.took:
            words.append(f"({seconds(exchange.took)})")
        if exchange.faults or content.findings:
            wrong = (*exchange.faults, *(finding_text(*finding) for finding in content.findings.items()))
            words.append(visible(f"! {'; '.join(wrong)}"))
        sys.stdout.write(f"{'  '.join(filter(None, words))}\n")
        if self._verbose:
            for frame, result in exchange.frames:
                sys.stdout.write(f"    {frame}\n")
                if result is not None:
                    texts = (result.summary, *(item.text for item in result.items), *result.notes)
                    sys.stdout.write("".join(f"      {visible(text)}\n" for text in texts))

    def _moment(self, moment: float | None) -> str:
        """Return a time of day (UTC)."""
        if moment is None or not 0 <= moment < _LAST_MOMENT:
            return ""
        thousandths = round(moment * 1000)
        return f"{self._clock(thousandths // 1000)}.{thousandths % 1000:03}"


class _JsonPrinter(_Printer):
    """Prints one object a line for each exchange."""

    def exchange(self, exchange: Exchange) -> None:
        data = exchange.as_data()
        if self._verbose:
            data["frames"] = [frame for frame, _ in exchange.frames]
        sys.stdout.write(f"{json.dumps(data)}\n")
