"""Simulated devices for tests: `with simulated("hitachi_l200") as drive:`, one line a device, free ports."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Coroutine, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import Any, NoReturn, TypeVar

from fieldscribe.diagnostics import Report
from fieldscribe.families import family
from fieldscribe.model import Device
from fieldscribe.pipeline import DEVICE_FILE, load_device
from fieldscribe.resources import descriptions_dir
from fieldscribe.simulation.behaviour import Behaviour
from fieldscribe.simulation.behaviour_file import FILE as BEHAVIOUR_FILE
from fieldscribe.simulation.behaviour_file import find_behaviour, read_behaviour
from fieldscribe.simulation.behaviour_rules import Rules
from fieldscribe.simulation.clock import Clock
from fieldscribe.simulation.core import Core
from fieldscribe.simulation.device import Complaint, SimulatedDevice
from fieldscribe.simulation.faults import Fault
from fieldscribe.simulation.layout import Layout
from fieldscribe.simulation.line import Line, Trace
from fieldscribe.simulation.servers import Server, serve_can, serve_serial, serve_tcp
from fieldscribe.simulation.values import Values
from fieldscribe.user_errors import UnclearError

Result = TypeVar("Result")
_LOCAL = Path("descriptions")


class Simulated:
    """A running simulated device.

    `port`, `path` or `url` say where it answers. `values` has its values by name; writing them asks no rule.
    `conditions` has what must hold before some writes, all true.
    """

    def __init__(self, device: SimulatedDevice, line: Line, server: Server) -> None:
        self.device = device
        self.line = line
        self.values: Values = device.values
        self.conditions = device.conditions
        self.unit = device.unit
        self.port, self.path, self.url = server.port, server.path, server.url

    @property
    def complaints(self) -> list[Complaint]:
        """Return what clients did against the manual, if the device is strict."""
        return self.device.complaints

    @property
    def requests(self) -> int:
        """Return how many requests came."""
        return self.line.requests

    def fault(self, text: str) -> None:
        """Put a fault in force, such as `late 0.5 x3`; see `faults.KINDS`."""
        self.line.faults.add(Fault.of(text))

    def advance(self, seconds: float) -> None:
        """Let so many seconds pass at once."""
        self.device.clock.advance(seconds)

    def restart(self) -> None:
        """Switch the device off and on."""
        self.device.restart()


@contextmanager
def simulated(  # noqa: PLR0913  # each is given by name
    device: str | Path,
    *,
    unit: int | None = None,
    on: str = "",
    framing: str = "",
    values: Mapping[str, Any] | None = None,
    variants: Sequence[str] = (),
    given: Mapping[str, int] | None = None,
    seed: int = 0,
    strict: bool = False,
    behaviour: bool = False,
    time_scale: float = 1.0,
    trace: Trace | None = None,
) -> Iterator[Simulated]:
    """Run a device, by its id or the path of its folder, as long as the context lasts.

    `on` is the line: `tcp`, `serial` (a new pseudo terminal) or `can` (a virtual bus of python-can named after the
    device). With its `behaviour`, the numbers move as the file beside the description says. A strict device raises
    AssertionError at the end, with all that clients did against the manual. With a `time_scale` of 0 the time stands,
    but for `advance`. Raises UnclearError.
    """
    layout = layout_of(str(device), tuple(variants), tuple(sorted((given or {}).items())))
    clock = Clock(time_scale)
    moves = Behaviour(rules_of(str(device))) if behaviour else None
    simulated_device = SimulatedDevice(layout, unit, seed=seed, clock=clock, strict=strict, behaviour=moves)
    simulated_device.values.update(values or {})
    on, core = core_for([simulated_device], on, framing)
    line = Line(core, clock, name=simulated_device.device.id, seed=seed, trace=trace)
    loop = _Loop.running()
    server = loop.run(_serve(line, on, simulated_device.device.id))
    try:
        yield Simulated(simulated_device, line, server)
    finally:
        loop.call(server.close)
    if strict and simulated_device.complaints:
        raise AssertionError("\n".join(map(str, simulated_device.complaints)))


def core_for(devices: Sequence[SimulatedDevice], on: str = "", framing: str = "") -> tuple[str, Core]:
    """Return the line and the core for devices of one family. Raises UnclearError for a line that they cannot be on."""
    names = {device.device.family for device in devices}
    if len(names) > 1:
        raise UnclearError(f"devices of {' and '.join(sorted(names))} cannot share a line", "give each a line")
    (name,) = names
    part = family(name).part("simulation")
    if part is None:
        raise UnclearError(f"devices of the family {name} cannot be simulated", "")
    lines: Mapping[str, tuple[str, ...]] = part.LINES
    on = on or next(iter(lines))
    if on not in lines:
        raise UnclearError(f"{devices[0].device.id} is on no {on} line", f"it is on {' or '.join(lines)}")
    if framing and framing not in lines[on]:
        raise UnclearError(f"a {on} line has no framing `{framing[:40]}`", f"it has {' or '.join(lines[on])}")
    units = [device.unit for device in devices]
    twice = next((unit for unit in units if units.count(unit) > 1), None)
    if twice is not None:
        raise UnclearError(f"two devices on the line have the unit {twice}", "give each another unit")
    core: Core = part.core_of(devices, framing or lines[on][0])
    return on, core


@lru_cache(maxsize=64)
def layout_of(name: str, variants: tuple[str, ...] = (), given: tuple[tuple[str, int], ...] = ()) -> Layout:
    """Return the layout of a device by its id or the path of its folder. Raises UnclearError."""
    return Layout(_model(name), variants, dict(given))


@lru_cache(maxsize=16)
def rules_of(name: str) -> Rules:
    """Return the rules of the behaviour beside a description. Raises UnclearError."""
    file, report = _file(name), Report()
    path = find_behaviour(file)
    if path is None:
        raise UnclearError(f"`{name}` has no behaviour", f"write a {BEHAVIOUR_FILE} beside {file}")
    rules = read_behaviour(path, _model(name), report)
    return rules if rules is not None else _refuse(f"the behaviour of `{name}`", file, report)


@lru_cache(maxsize=16)
def _model(name: str) -> Device:
    file, report = _file(name), Report()
    device = load_device(file, report)
    return device if device is not None else _refuse(f"`{name}`", file, report)


def _file(name: str) -> Path:
    folders = [Path(name), _LOCAL / name, descriptions_dir() / name]
    files = (path if path.is_file() else path / DEVICE_FILE for path in folders)
    file = next((file for file in files if file.is_file()), None)
    if file is None:
        raise UnclearError(f"there is no device `{name}`", f"give an id, or a folder with a {DEVICE_FILE}")
    return file


def _refuse(what: str, file: Path, report: Report) -> NoReturn:
    first = report.findings[0].message
    raise UnclearError(f"{what} has errors: {first}", f"`fieldscribe check {file.parent}` prints them all")


async def _serve(line: Line, on: str, channel: str) -> Server:
    if on == "tcp":
        return await serve_tcp(line)
    return await (serve_serial(line) if on == "serial" else serve_can(line, "virtual", channel))


class _Loop:
    """An event loop in a thread of its own, for all devices of the process."""

    _only: _Loop | None = None

    def __init__(self) -> None:
        self._loop = asyncio.new_event_loop()
        threading.Thread(target=self._loop.run_forever, name="simulated devices", daemon=True).start()

    @classmethod
    def running(cls) -> _Loop:
        """Return the loop, started once."""
        cls._only = cls._only or cls()
        return cls._only

    def run(self, work: Coroutine[Any, Any, Result]) -> Result:
        """Return the result of a coroutine."""
        return asyncio.run_coroutine_threadsafe(work, self._loop).result()

    def call(self, close: Any) -> None:
        """Call a function in the loop, and wait for it."""

        async def work() -> None:
            close()

        self.run(work())
