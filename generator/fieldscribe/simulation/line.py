"""Devices that share a line: requests in, answers out, with faults, delays and a trace. No I/O."""

from __future__ import annotations

import json
from collections.abc import Callable

from fieldscribe.simulation.clock import Clock
from fieldscribe.simulation.core import Answer, Core
from fieldscribe.simulation.faults import Faults, Outcome
from fieldscribe.simulation.memory import LOCK

_MOST_WAITING = 4096
"""Bytes that may wait for the rest of a request."""

Trace = Callable[[str], None]
"""Takes one line of the trace, a JSON object."""


class Line:
    """A line with the devices of a core; `name` says in the trace which one it is.

    `on` is the kind of line, `at` its port, path or channel, `speed` its bits a second; each may be left open.
    """

    def __init__(self, core: Core, clock: Clock, *, name: str = "", seed: int = 0) -> None:
        self.core, self.clock, self.name, self.faults = core, clock, name, Faults(seed)
        self.trace: Trace | None = None
        self.requests, self.speed, self.on, self.at = 0, 0, "", ""

    def answer(self, request: bytes, core: Core | None = None) -> list[Outcome]:
        """Return what goes out because of one request, of a client whose framing is that of `core`."""
        core = core or self.core
        with LOCK:
            self.requests += 1
            answer = core.answer(request)
            if answer is None:
                return []
            outcome = Outcome(answer.data, answer.delay)
            if self.faults.waiting and answer.data:
                outcome = self.faults.outcome(answer.data, answer.delay, core.spoiled)
            if self.trace is not None:
                self.trace(self._entry(request, answer, outcome))
            more = [Outcome(data, answer.delay) for data in answer.more]
            return [outcome, *more] if outcome.data or outcome.drop else more

    def due(self) -> tuple[list[bytes], float | None]:
        """Return the frames that go out unasked by now, and in how many real seconds the next ones do."""
        with LOCK:
            now = self.clock.now()
            frames, after = self.core.due(now)
            return frames, None if after is None else self.clock.real(max(0.0, after - now))

    def _entry(self, request: bytes, answer: Answer, outcome: Outcome) -> str:
        entry = {
            "time": round(self.clock.now(), 6),
            "line": self.name,
            "unit": None if answer.device is None else answer.device.unit,
            "request": request.hex(),
            "answer": outcome.data.hex(),
            "delay": round(outcome.delay, 6),
            "refused": answer.refused or None,
            "fault": outcome.fault or None,
        }
        return json.dumps(entry)


class Stream:
    """One connection to a line, or its one serial port: keeps the bytes that are no whole request yet."""

    def __init__(self, line: Line) -> None:
        self.line = line
        self.waiting = b""
        self._core = line.core

    def received(self, data: bytes, *, quiet: bool = False) -> list[Outcome]:
        """Return what goes out because of these bytes; `quiet` says that no more belong to them."""
        data = self.waiting + data
        self._core = self._core.settled(data)
        requests, done = self._core.cut(data, quiet=quiet)
        self.waiting = data[done:][-_MOST_WAITING:]
        return [outcome for request in requests for outcome in self.line.answer(request, self._core)]
