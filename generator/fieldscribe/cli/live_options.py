"""The options of commands that talk to a device: line, unit and variants, given there or in `fieldscribe.toml`."""

from __future__ import annotations

import sys
import time
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from difflib import get_close_matches
from pathlib import Path
from threading import Event, Thread
from typing import NamedTuple

from fieldscribe.cli.common import StopError, add_device, add_repeated, duration, repeats
from fieldscribe.cli.frame_options import model_of
from fieldscribe.cli.terminal import FINDINGS, USAGE
from fieldscribe.diagnostics import did_you_mean, visible
from fieldscribe.live.connection import AnyDevice, Connection, FieldscribeError, advice
from fieldscribe.live.lines import NAME, LineAddress, Project, Station, read_line, read_project
from fieldscribe.live.readings import in_words
from fieldscribe.model import Device
from fieldscribe.text import shortened

LINES = """lines: tcp://HOST[:PORT], rtu:///dev/ttyUSB0, rtu+tcp://HOST:PORT, uss:///dev/ttyUSB0, can://INTERFACE/CHANNEL
serial ones take settings, as in rtu:///dev/ttyUSB0?baud=9600&parity=even&stop=1, uss also pkw=4&pzd=2"""


def add_live(parser: ArgumentParser, *, optional: bool = False, unit: bool = True) -> None:
    """Add DEVICE and the options about its line, with those of one `unit`; `opened` reads them."""
    add_device(parser, optional=optional)
    add_repeated(parser, "--with", "NAME=NUMBER", "a number that addresses depend on, such as slot=3", dest="settings")
    add = parser.add_argument
    add("--line", metavar="LINE", help=f"where the device is: tcp://192.168.0.20, or a name from {NAME}")
    add("--timeout", type=duration, metavar="SECONDS", help="how long to wait for an answer")
    add("-v", "--verbose", action="store_true", help="print the frames, and how many requests it took, on stderr")
    if unit:
        add("--unit", type=int, metavar="N", help="the unit number (default: 1, or the lowest)")
        tries = "how often a failed read is repeated (default: 1); writes never are"
        add("--retries", type=repeats, default=1, metavar="N", help=tries)


def add_points(parser: ArgumentParser) -> None:
    """Add the points that a command reads."""
    help_text = "points by code, name or address; or groups, records, sets, arrays"
    parser.add_argument("points", nargs="+", metavar="POINT|GROUP", help=help_text)


def add_writing(parser: ArgumentParser) -> None:
    """Add the options of commands that write."""
    add = parser.add_argument
    add("--keep", action="store_true", help="keep it when switched off, by EEPROM or a command; wears the memory")
    add("-y", "--yes", action="store_true", help="write without asking")


def line_of(arguments: Namespace) -> LineAddress:
    """Return the line of the command line, or of the station that DEVICE names; a station's facts become arguments.

    Raises StopError, UnclearError.
    """
    project = read_project(Path(NAME))
    station = project.stations.get(arguments.device or "")
    if station is not None:
        _take(arguments, station)
    if not arguments.line:
        none = "" if station or not arguments.device else f", and `{shortened(arguments.device)}` is no station"
        near = did_you_mean(get_close_matches(arguments.device or "", project.stations, 1))
        raise StopError(f"no line is given{none}", near or f"give --line tcp://HOST:PORT, or name stations in {NAME}")
    return read_line(_named(arguments.line, project))


def _take(arguments: Namespace, station: Station) -> None:
    """Set what the command line leaves out from the station."""
    arguments.device = station.description
    arguments.line = arguments.line or station.line
    if getattr(arguments, "unit", None) is None:
        arguments.unit = station.unit
    add_pairs(arguments, station.variants, station.settings)


def add_pairs(arguments: Namespace, variants: Iterable[str], settings: Iterable[str]) -> None:
    """Add variants and settings whose name the command line does not give."""
    arguments.variant = _without_given(variants, arguments.variant)
    arguments.settings = _without_given(settings, arguments.settings)


def _without_given(known: Iterable[str], given: list[str]) -> list[str]:
    """Return the given pairs, and the known ones with other names."""
    names = {pair.partition("=")[0] for pair in given}
    return [*given, *(pair for pair in known if pair.partition("=")[0] not in names)]


def _named(text: str, project: Project) -> str:
    """Return the line of that name, or the text itself. Raises StopError."""
    if "://" in text or text in project.lines:
        return project.lines.get(text, text)
    none = f"{NAME} here has no table `lines`" if Path(NAME).exists() else f"there is no {NAME} here"
    names = f"{NAME} has {', '.join(project.lines)}" if project.lines else none
    itself = f"rtu://{text}, or uss://{text}" if text.startswith("/") else "tcp://HOST:PORT"
    host, _, port = text.rpartition(":")
    itself = f"tcp://{text}" if host and port.isdecimal() else itself
    near = did_you_mean(get_close_matches(text, project.lines, 1)) or f"{names}; a line itself is {itself}"
    raise StopError(f"`{shortened(text)}` is no line, and no name of one", near)


class Work:
    """The state of a command, for the report if it is interrupted: what was `written`, `begun`, and is `left`."""

    def __init__(self) -> None:
        self.written: list[str] = []
        self.left: list[str] = []
        self.begun: list[str] = []

    @property
    def is_begun(self) -> bool:
        """True if it is known what is to be written."""
        return bool(self.left or self.written)

    @contextmanager
    def writing(self, names: list[str]) -> Iterator[None]:
        """Record what a request writes: it is `begun`, and then written unless an error comes."""
        self.begun = names
        yield
        self.written += names
        self.left = [name for name in self.left if name not in names]
        self.begun = []

    def state(self) -> str:
        """Return what was written and what was not, as text for a command that ends early."""
        left = [name for name in self.left if name not in self.begun]
        states = (("written", self.written), ("perhaps written", self.begun), ("not written", left))
        return "; ".join(f"{state}: {', '.join(names)}" for state, names in states if names) or "nothing was written"


class Live(NamedTuple):
    """A device that a command talks to: its model, the device of the runtime, and its line."""

    model: Device
    device: AnyDevice
    line: LineAddress
    work: Work

    @property
    def head(self) -> dict[str, object]:
        """The device, for JSON."""
        return {"device": self.model.id, "unit": self.device.unit, "line": self.line.text}

    def progress(self) -> AbstractContextManager[None]:
        """Show the number of requests sent if it takes long."""
        return Progress().showing(lambda: f"waiting for the device; {self.device.traffic.requests} requests sent")


@contextmanager
def opened(arguments: Namespace, *, reads: bool = True) -> Iterator[Live]:
    """Yield the device of the command line on its line; what `reads` takes one unit, not all units at once.

    Raises StopError, also for errors of the line in the context.
    """
    line = line_of(arguments)
    model = model_of(arguments)
    unit = model.bus.usual_unit if arguments.unit is None else arguments.unit
    if reads and unit == model.bus.broadcast:
        raise StopError(f"unit {unit} is all units at once, and nobody answers to it", "give --unit of one device")
    with connected(arguments, line) as (connection, work):
        device = connection.device(model, unit, arguments.retries)
        try:
            yield Live(model, device, line, work)
        finally:
            print_requests(arguments, device.traffic.requests)


@contextmanager
def connected(arguments: Namespace, line: LineAddress) -> Iterator[tuple[Connection, Work]]:
    """Yield the line; its errors and Ctrl-C end the command with a report of what was written.

    Frames are printed with `--verbose`. Raises StopError.
    """
    connection, work = Connection(line, arguments.timeout), Work()
    try:
        with _frames_printed() if arguments.verbose else nullcontext():
            yield connection, work
    except FieldscribeError as error:
        hint = advice(error)
        message = in_words(error) + (f"; {work.state()}" if work.is_begun else "")
        raise StopError(message, hint, USAGE if hint else FINDINGS) from error
    except OSError as error:  # of a file
        if error.filename is None or not work.is_begun:
            raise
        raise StopError(f"{error.filename}: {error.strerror}; {work.state()}") from error
    except KeyboardInterrupt:
        print(f"\nfieldscribe: interrupted; {work.state()}", file=sys.stderr)
        raise
    finally:
        connection.close()


def print_requests(arguments: Namespace, requests: int) -> None:
    """Print the number of requests sent, with `--verbose`."""
    if arguments.verbose:
        print(f"{requests} request{'' if requests == 1 else 's'}", file=sys.stderr)


@contextmanager
def _frames_printed() -> Iterator[None]:
    """Print the frames that the runtime logs, in this context."""
    import logging

    logger, handler = logging.getLogger("fieldscribe"), logging.StreamHandler(sys.stderr)
    before = logger.level
    logger.addHandler(handler)
    logger.setLevel(logging.DEBUG)
    try:
        yield
    finally:
        logger.removeHandler(handler)
        logger.setLevel(before)


_RARELY = 10
"""Seconds between lines of progress if stderr is not a terminal."""


class Progress:
    """A line on stderr about work that takes longer than a second: rewritten on a terminal, else now and then."""

    def __init__(self) -> None:
        self._is_terminal = sys.stderr.isatty()
        self._next = time.monotonic() + (1 if self._is_terminal else _RARELY)
        self._width = 0

    @contextmanager
    def showing(self, text: Callable[[], str]) -> Iterator[None]:
        """Show a text repeatedly while the context is open."""
        is_done = Event()

        def show() -> None:
            while not is_done.wait(0.1):
                self.show(text())

        thread = Thread(target=show, daemon=True)
        thread.start()
        try:
            yield
        finally:
            is_done.set()
            thread.join()
            self.clear()

    def show(self, text: str) -> None:
        """Show the progress, if it is time."""
        if (now := time.monotonic()) < self._next:
            return
        self._next = now + (0.1 if self._is_terminal else _RARELY)
        text = visible(text)
        sys.stderr.write(f"\r{text:<{self._width}}" if self._is_terminal else f"{text}\n")
        sys.stderr.flush()
        self._width = len(text)

    def clear(self) -> None:
        """Remove the line from the terminal."""
        if self._is_terminal and self._width:
            sys.stderr.write(f"\r{'':<{self._width}}\r")
            sys.stderr.flush()
            self._width = 0
