"""Simulated devices for tests: `with simulated("hitachi_l200") as drive:`, one line a device, free ports."""

import asyncio
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

from fieldscribe.simulation.bench import Bench
from fieldscribe.simulation.line import Fault, Line, Trace
from fieldscribe.simulation.servers import Server, serve
from fieldscribe.text import shortened
from fieldscribe.user_errors import UnclearError

_LINES = ("tcp", "serial", "can")
_OF_LINE, _OF_BENCH = ("framing", "faults"), ("seed", "strict", "time_scale")


class Simulated:
    """A running simulated device: it answers at `port`, `path` or `url`.

    `values` has its values by name; writing them ignores the rules. `conditions` are what must be true before some
    writes, all true at first. `complaints` are violations of the manual by clients, if it is strict. `restart()`
    switches it off and on.
    """

    def __init__(self, line: Line, server: Server) -> None:
        self.device, self.line, self.unit = line.core.devices[0], line, line.core.devices[0].unit
        self.port, self.path, self.url = server.port, server.path, server.url
        self.values, self.conditions = self.device.values, self.device.conditions
        self.complaints, self.restart = self.device.complaints, self.device.restart
        self.advance = self.device.clock.advance

    @property
    def requests(self) -> int:
        """Return the number of requests."""
        return self.line.requests

    def fault(self, text: str) -> None:
        """Add a fault, such as `late 0.5 x3`; see `line.KINDS`."""
        self.line.faults.waiting.append(Fault.of(text))


@contextmanager
def simulated(
    device: str | Path,
    *,
    on: str = "",
    variants: Iterable[str] = (),
    behaviour: bool = False,
    trace: Trace | None = None,
    **settings: Any,
) -> Iterator[Simulated]:
    """Run a device, by its id or the path of its folder, until the end of the context.

    `on` is the line: `tcp`, `serial` (a new pseudo terminal) or `can` (a bus of python-can's interface `virtual`, named
    after the device). `variants` are texts such as `voltage=400V`. With `behaviour`, its numbers follow the file next
    to the description. The other settings are those of a bench file: `unit`, `values`, `given`, `unmet`, `refusals`,
    `framing`, `faults`, `seed`, `strict`, `time_scale`. A strict device raises AssertionError at the end, with all
    violations of the manual by clients. With a `time_scale` of 0, only `advance` lets time pass. Raises UnclearError.
    """
    line: dict[str, Any] = {key: settings.pop(key) for key in _OF_LINE if key in settings}
    bench = {key: settings.pop(key) for key in _OF_BENCH if key in settings}
    if on not in ("", *_LINES):
        raise UnclearError(f"there is no line `{shortened(on)}`", f"`on` is one of {', '.join(_LINES)}")
    if wrong := [text for text in variants if "=" not in text]:
        raise UnclearError(f"`{shortened(wrong[0])}` is no variant", "write AXIS=VALUE, as in voltage=400V")
    settings["variant"] = dict(text.split("=", 1) for text in variants)
    line["devices"] = [{"device": str(device), "behaviour": behaviour, **settings}]
    if on:
        line[on] = ""
    (made,) = Bench({"lines": [line], **bench}, trace=trace).lines
    server = asyncio.run_coroutine_threadsafe(serve(made), _loop()).result()
    running = Simulated(made, server)
    try:
        yield running
    finally:
        asyncio.run_coroutine_threadsafe(_called(server.close), _loop()).result()
    if running.complaints:
        raise AssertionError("\n".join(map(str, running.complaints)))


@cache
def _loop() -> asyncio.AbstractEventLoop:
    """Return the event loop of all devices of the process, in a thread of its own."""
    loop = asyncio.new_event_loop()
    threading.Thread(target=loop.run_forever, name="simulated devices", daemon=True).start()
    return loop


async def _called(close: Callable[[], None]) -> None:
    close()
