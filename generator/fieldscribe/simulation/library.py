"""Simulated devices for tests: `with simulated("hitachi_l200") as drive:`, one line a device, free ports."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

from fieldscribe.simulation.clock import Clock
from fieldscribe.simulation.device import SimulatedDevice
from fieldscribe.simulation.faults import Fault
from fieldscribe.simulation.line import Line, Trace
from fieldscribe.simulation.making import Bench, DeviceSettings, LineSettings, close_all, serve
from fieldscribe.simulation.servers import Server


class Simulated:
    """A running simulated device: `port`, `path` or `url` say where it answers.

    `values` has its values by name; writing them asks no rule. `conditions` has what must hold before some writes, all
    true. `complaints` has what clients did against the manual, if it is strict. `restart()` switches it off and on.
    """

    def __init__(self, device: SimulatedDevice, line: Line, server: Server) -> None:
        self.device, self.line, self.unit = device, line, device.unit
        self.port, self.path, self.url = server.port, server.path, server.url
        self.values, self.conditions, self.complaints = device.values, device.conditions, device.complaints
        self.restart, self.advance = device.restart, device.clock.advance

    @property
    def requests(self) -> int:
        """Return how many requests came."""
        return self.line.requests

    def fault(self, text: str) -> None:
        """Put a fault in force, such as `late 0.5 x3`; see `faults.KINDS`."""
        self.line.faults.add(Fault.of(text))


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

    `on` is the line: `tcp`, `serial` (a new pseudo terminal) or `can` (the bus of python-can's interface `virtual` that
    is named after the device). With its `behaviour`, the numbers move as the file beside the description says. A strict
    device raises AssertionError at the end, with all that clients did against the manual. With a `time_scale` of 0 the
    time stands, but for `advance`. Raises UnclearError.
    """
    units = () if unit is None else (unit,)
    settings = DeviceSettings(str(device), units, tuple(variants), given or {}, values or {}, behaviour=behaviour)
    line_settings = LineSettings([settings], on, "", framing)
    (line,) = Bench([line_settings], seed, time_scale, strict).made(Clock(time_scale), trace)
    server = asyncio.run_coroutine_threadsafe(serve(line, line_settings), _loop()).result()
    made = Simulated(line.core.devices[0], line, server)
    try:
        yield made
    finally:
        asyncio.run_coroutine_threadsafe(close_all([server]), _loop()).result()
    if made.complaints:
        raise AssertionError("\n".join(map(str, made.complaints)))


@cache
def _loop() -> asyncio.AbstractEventLoop:
    """Return the event loop of all devices of the process, in a thread of its own."""
    loop = asyncio.new_event_loop()
    threading.Thread(target=loop.run_forever, name="simulated devices", daemon=True).start()
    return loop
