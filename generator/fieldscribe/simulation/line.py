"""Devices that share a line: requests in, answers out, with faults, delays and a trace. No I/O.

A family's `simulation.py` has

    def core_of(devices: Sequence[SimulatedDevice], framing: str) -> Core

for the devices that share a line, and `LINES`: the lines that its devices can be on (`tcp`, `serial`, `can`), the usual
one first, each with its framings there, the usual one first: `framing` is one of these.

Requests and answers are bytes. A frame of CAN is its identifier in four bytes, high first, with the highest bit set for
an extended one, then the data: `cut` is not called for it. A core on a serial line whose speed is known has `character`
set to the seconds that one takes.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from fieldscribe.simulation.device import Clock, SimulatedDevice
from fieldscribe.simulation.faults import Faults, Outcome
from fieldscribe.simulation.memory import LOCK


@dataclass(slots=True)
class Answer:
    """What a request leads to: the bytes that go out (none for a broadcast), `delay` seconds after the request.

    `more` are further frames after the first. `refused` says why, if the answer is a refusal.
    """

    device: SimulatedDevice | None
    data: bytes
    delay: float = 0.0
    refused: str = ""
    more: list[bytes] = field(default_factory=list)


class Core(Protocol):
    """The sans-I/O end of a line: `devices` answer what comes."""

    devices: Sequence[SimulatedDevice]
    framing: str

    def settled(self, data: bytes) -> Core:
        """Return the core for a client that sends these bytes: this one, unless the framing follows from them."""
        del data
        return self

    def cut(self, data: bytes, *, quiet: bool) -> tuple[list[bytes], int]:
        """Return the whole requests in the data, and how many bytes are done with: taken, or noise.

        `quiet` says that nothing more comes that belongs to these bytes. Any bytes are safe, and what is no request
        costs no request after it.
        """

    def answer(self, request: bytes) -> Answer | None:
        """Return what a request leads to; None if no device here takes notice of it."""

    def spoiled(self, answer: bytes, what: str) -> bytes:
        """Return an answer that is wrong in one way, and right in all others, checksums included.

        `what` is `check` (the checksum alone), `unit`, `function` (another one answers), or `exception` (the usual
        refusal in place of the answer). A core returns the answer as it is if its frames have no such thing.
        """

    def due(self, now: float) -> tuple[list[bytes], float | None]:
        """Return the frames that go out unasked by the time `now`, and when the next ones do; None for never."""
        del now
        return [], None


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
