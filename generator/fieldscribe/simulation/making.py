"""Makes what a bench lists: devices by id or folder, lines with their cores, and servers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import TypeVar

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
from fieldscribe.simulation.device import SimulatedDevice
from fieldscribe.simulation.faults import Fault
from fieldscribe.simulation.layout import Layout
from fieldscribe.simulation.line import Line, Trace
from fieldscribe.simulation.servers import LOOPBACK, Server, serve_can, serve_serial, serve_tcp
from fieldscribe.simulation.values import Value
from fieldscribe.user_errors import UnclearError

Made = TypeVar("Made")
LOCAL = Path("descriptions")
MOST_DEVICES = 10_000


class BrokenError(UnclearError):
    """The description of a device has errors; `report` has all of them."""

    def __init__(self, report: Report, message: str, hint: str) -> None:
        super().__init__(message, hint)
        self.report = report


@dataclass(slots=True)
class DeviceSettings:
    """A device, once for each of its `units` (none: its usual one); `unmet` are the conditions that do not hold."""

    device: str
    units: tuple[int, ...] = ()
    variants: tuple[str, ...] = ()
    given: Mapping[str, int] = field(default_factory=dict)
    values: Mapping[str, Value] = field(default_factory=dict)
    unmet: tuple[str, ...] = ()
    refusals: Mapping[str, int] = field(default_factory=dict)
    behaviour: bool | None = None
    """Whether its numbers move as a behaviour file says; None means that they do if there is one."""


@dataclass(slots=True)
class LineSettings:
    """A line: `on` is `tcp`, `serial` or `can` (empty: the usual one), `at` is its port, path or channel."""

    devices: list[DeviceSettings]
    on: str = ""
    at: str = ""
    framing: str = ""
    speed: int = 0
    faults: tuple[str, ...] = ()


@dataclass(slots=True)
class Bench:
    """Lines whose devices share a clock."""

    lines: list[LineSettings]
    seed: int = 0
    time_scale: float = 1.0
    strict: bool = False
    folder: Path = Path()
    """Where folders of descriptions count from."""

    def made(self, clock: Clock, trace: Trace | None = None) -> list[Line]:
        """Return the lines with their devices. Raises UnclearError."""
        if sum(max(1, len(device.units)) for line in self.lines for device in line.devices) > MOST_DEVICES:
            raise UnclearError(f"the bench has more than {MOST_DEVICES} devices", "run several benches")
        return [self._line(settings, clock, trace) for settings in self.lines]

    def _line(self, settings: LineSettings, clock: Clock, trace: Trace | None) -> Line:
        devices = [device for each in settings.devices for device in self._devices(each, clock)]
        core = _core_for(devices, settings)
        line = Line(core, clock, name=settings.at or devices[0].device.id, seed=self.seed, trace=trace)
        line.faults.waiting.extend(map(Fault.of, settings.faults))
        return line

    def _devices(self, settings: DeviceSettings, clock: Clock) -> list[SimulatedDevice]:
        layout = layout_of(settings.device, settings.variants, tuple(settings.given.items()), self.folder)
        rules = None
        if settings.behaviour or (settings.behaviour is None and find_behaviour(_file(settings.device, self.folder))):
            rules = rules_of(settings.device, self.folder)
        devices = []
        low, high = layout.device.bus.units
        for unit in settings.units or (layout.device.bus.usual_unit,):
            if not low <= unit <= high and (low, high) != (0, 0):
                raise UnclearError(f"{layout.device.id} has no unit {unit}", f"its units are {low} to {high}")
            moves = None if rules is None else Behaviour(rules)
            device = SimulatedDevice(layout, unit, seed=self.seed, clock=clock, strict=self.strict, behaviour=moves)
            device.refusals.update(settings.refusals)
            for condition in settings.unmet:
                if condition not in device.conditions:
                    known = ", ".join(device.conditions) or "none"
                    raise UnclearError(f"no write asks for the condition `{condition[:40]}`", f"there are {known}")
                device.conditions[condition] = False
            for name, value in settings.values.items():
                try:
                    device.values[name] = value
                except (KeyError, ValueError) as error:
                    raise UnclearError(str(error.args[0]), "write POINT=VALUE") from None
            devices.append(device)
        return devices


async def serve(line: Line, settings: LineSettings) -> Server:
    """Serve a line where its settings say; a port is one of this machine alone without a host. Raises UnclearError."""
    if settings.on == "serial":
        return await serve_serial(line, settings.at, settings.speed)
    if settings.on == "can":
        interface, colon, channel = (settings.at or f"virtual:{line.name}").partition(":")
        if not colon:
            hint = "write INTERFACE:CHANNEL as python-can names them, such as socketcan:can0"
            raise UnclearError(f"`{settings.at}` is no CAN bus", hint)
        return await serve_can(line, interface, channel, settings.speed or None)
    host, _, port = settings.at.rpartition(":")
    if not (port or "0").isdecimal() or len(port) > 5:
        raise UnclearError(f"`{settings.at}` is no TCP port", "write [HOST:]PORT, such as 5020")
    return await serve_tcp(line, host.strip("[]") or LOOPBACK, int(port or 0))


def _core_for(devices: list[SimulatedDevice], settings: LineSettings) -> Core:
    """Return the core for the devices of a line; fill in what the settings leave open. Raises UnclearError."""
    names = {device.device.family for device in devices}
    if len(names) > 1:
        raise UnclearError(f"devices of {' and '.join(sorted(names))} cannot share a line", "give each a line")
    (name,) = names
    part = family(name).part("simulation")
    if part is None:
        raise UnclearError(f"devices of the family {name} cannot be simulated", "")
    lines: Mapping[str, tuple[str, ...]] = part.LINES
    settings.on = settings.on or next(iter(lines))
    if settings.on not in lines:
        raise UnclearError(f"{devices[0].device.id} is on no {settings.on} line", f"it is on {' or '.join(lines)}")
    settings.framing = settings.framing or lines[settings.on][0]
    if settings.framing not in lines[settings.on]:
        hint = f"it has {' or '.join(lines[settings.on])}"
        raise UnclearError(f"a {settings.on} line has no framing `{settings.framing[:40]}` here", hint)
    units = [device.unit for device in devices]
    twice = next((unit for unit in units if units.count(unit) > 1), None)
    if twice is not None:
        raise UnclearError(f"two devices on the line have the unit {twice}", "give each another unit")
    core: Core = part.core_of(devices, settings.framing)
    return core


@lru_cache(maxsize=64)
def layout_of(
    name: str, variants: tuple[str, ...] = (), given: tuple[tuple[str, int], ...] = (), folder: Path = LOCAL
) -> Layout:
    """Return the layout of a device by its id or the path of its folder. Raises UnclearError."""
    return Layout(_model(name, folder), variants, dict(given))


@lru_cache(maxsize=16)
def rules_of(name: str, folder: Path = LOCAL) -> Rules:
    """Return the rules of the behaviour beside a description. Raises UnclearError."""
    file, report = _file(name, folder), Report()
    path = find_behaviour(file)
    if path is None:
        raise UnclearError(f"`{name}` has no behaviour", f"write a {BEHAVIOUR_FILE} beside {file}")
    return _or_refuse(read_behaviour(path, _model(name, folder), report), str(path), report)


@lru_cache(maxsize=16)
def _model(name: str, folder: Path) -> Device:
    file, report = _file(name, folder), Report()
    return _or_refuse(load_device(file, report), str(file), report)


def _file(name: str, folder: Path) -> Path:
    paths = [folder / name, Path(name), LOCAL / name, descriptions_dir() / name]
    files = (path if path.is_file() else path / DEVICE_FILE for path in paths)
    file = next((file for file in files if file.is_file()), None)
    if file is None:
        raise UnclearError(f"there is no device `{name[:80]}`", f"give an id, or a folder with a {DEVICE_FILE}")
    return file


def _or_refuse(read: Made | None, file: str, report: Report) -> Made:
    if read is None:
        raise BrokenError(
            report, f"`{file}` has errors: {report.findings[0].message}", "`fieldscribe check` prints all"
        )
    return read


async def close_all(servers: list[Server]) -> None:
    """Close servers in the loop that they run in."""
    for server in servers:
        server.close()
