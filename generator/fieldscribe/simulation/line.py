"""Devices that share a line: requests in, answers out, with faults, delays and a trace. No I/O.

A family's `simulation.py` has

    def core_of(devices: Sequence[SimulatedDevice], framing: str) -> Core

for the devices that share a line, and `LINES`: the lines that its devices can be on (`tcp`, `serial`, `can`), the usual
one first, each with its framings there, the usual one first: `framing` is one of these. `REFUSALS` are the kinds of
refusals that get an answer with a number, of at most `LARGEST_CODE`.

Requests and answers are bytes. A frame of CAN is its identifier in four bytes, high first, with the highest bit set for
an extended one, then the data: `cut` is not called for it. A core on a serial line whose speed is known has `character`
set to the seconds that one takes. A fault of an answer is written in a few words, such as `late 0.5 x3`.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from random import Random
from typing import NamedTuple, Protocol

from fieldscribe.diagnostics import UnclearError
from fieldscribe.simulation.device import Clock, SimulatedDevice
from fieldscribe.simulation.memory import LOCK

KINDS = {
    "silent": "no answer comes",
    "late": "the answer arrives N seconds later (1)",
    "cut": "only its first N bytes arrive (half of them)",
    "doubled": "the answer arrives twice",
    "check": "its checksum is wrong (over TCP: its transaction number)",
    "unit": "another unit answers",
    "function": "the answer has another function",
    "exception": "the device refuses",
    "damaged": "byte N of it is wrong (the first)",
    "noise": "random bytes come before byte N (the first)",
    "drop": "the line breaks down after byte N (the first)",
}
"""The faults, with what each means; N is the number after the name, with its default."""
_SPOILED = frozenset({"check", "unit", "function", "exception"})
_NUMBER, _TIMES, _SHARE = (re.compile(form) for form in (r"\d+(?:\.\d+)?", r"x(\d+)", r"(\d+(?:\.\d+)?)%"))


def cut_sound(data: bytes, sound_size: Callable[[bytes], int], least: int, longest: int) -> tuple[list[bytes], int]:
    """Return the sound frames in the data, and where the last one ends; what begins no sound frame is skipped.

    `sound_size` returns the size of the sound frame that its argument begins with, 0 if it begins with none.
    """
    found: list[bytes] = []
    end = at = 0
    while len(data) - at >= least:
        size = sound_size(data[at : at + longest])
        if size:
            found.append(bytes(data[at : at + size]))
            end = at + size
        at += size or 1
    return found, end


class Outcome(NamedTuple):
    """What is sent for an answer: bytes, a delay, and whether the line breaks down afterwards."""

    data: bytes
    delay: float
    drop: bool = False
    fault: str = ""


@dataclass(slots=True)
class Fault:
    """A fault for the next `times` answers (None: all), each with the probability `share`."""

    kind: str
    number: float | None = None
    times: int | None = None
    share: float = 1.0

    @classmethod
    def of(cls, text: str) -> Fault:
        """Return the fault written as a kind, then in any order N, `xTIMES` and `SHARE%`. Raises UnclearError."""
        kind, *words = text.split() or [""]
        fault = cls(kind)
        if kind not in KINDS:
            raise UnclearError(f"there is no fault `{kind[:40]}`", f"there are {', '.join(KINDS)}")
        for word in words:
            if _NUMBER.fullmatch(word):
                fault.number = float(word)
            elif (match := _TIMES.fullmatch(word)) and int(match[1]) > 0:
                fault.times = int(match[1])
            elif (match := _SHARE.fullmatch(word)) and float(match[1]) <= 100:
                fault.share = float(match[1]) / 100
            else:
                hint = f"write it as `{kind} 2 x3 50%`: with the number 2, for 3 answers, for every second one"
                raise UnclearError(f"`{word[:40]}` does not belong to the fault `{kind}`", hint)
        return fault


class Faults:
    """The active faults; the oldest one that applies to an answer is used."""

    def __init__(self, seed: int = 0) -> None:
        self.waiting: list[Fault] = []
        self._random = Random(seed)  # noqa: S311  # no secret

    def outcome(self, data: bytes, delay: float, spoiled: Callable[[bytes, str], bytes]) -> Outcome:
        """Return what is sent for an answer; `spoiled` corrupts it in the family's way."""
        for fault in self.waiting:
            if fault.share < 1 and self._random.random() >= fault.share:
                continue
            if fault.times is not None:
                fault.times -= 1
                if fault.times <= 0:
                    self.waiting.remove(fault)
            return self._struck(fault, data, delay, spoiled)
        return Outcome(data, delay)

    def _struck(self, fault: Fault, data: bytes, delay: float, spoiled: Callable[[bytes, str], bytes]) -> Outcome:
        kind, number = fault.kind, fault.number
        at = min(int(number or 0), len(data))
        if kind in _SPOILED:
            data = spoiled(data, kind)
        elif kind == "late":
            delay += 1.0 if number is None else number
        elif kind == "cut":
            data = data[: len(data) // 2 if number is None else at]
        elif kind == "doubled":
            data += data
        elif kind == "damaged":
            at = min(at, len(data) - 1)
            data = data[:at] + bytes((data[at] ^ self._random.randint(1, 255),)) + data[at + 1 :]
        elif kind == "noise":
            data = data[:at] + self._random.randbytes(3) + data[at:]
        elif kind == "drop":
            data = data[:at]
        return Outcome(b"" if kind == "silent" else data, delay, kind == "drop", kind)


@dataclass(slots=True)
class Answer:
    """The result of a request: the bytes to send (none for a broadcast), `delay` seconds after the request.

    `more` are further frames after the first. `refused` is the reason, if the answer is a refusal.
    """

    device: SimulatedDevice | None
    data: bytes
    delay: float = 0.0
    refused: str = ""
    more: list[bytes] = field(default_factory=list)


class Core(Protocol):
    """The protocol of a line without I/O: its `devices` answer requests."""

    devices: Sequence[SimulatedDevice]
    framing: str

    def settled(self, data: bytes) -> Core:
        """Return the core for a client that sends these bytes: this one, unless the framing follows from them."""
        del data
        return self

    def cut(self, data: bytes, *, quiet: bool) -> tuple[list[bytes], int]:
        """Return the complete requests in the data, and the number of bytes used up by requests or noise.

        `quiet`: no more bytes follow that belong to these. Any bytes are safe, and noise never costs the request
        after it.
        """

    def answer(self, request: bytes) -> Answer | None:
        """Return the result of a request; None if no device here receives it."""

    def spoiled(self, answer: bytes, what: str) -> bytes:
        """Return an answer with one mistake but otherwise correct, checksums included.

        `what` is `check` (a wrong checksum), `unit` or `function` (of another one), or `exception` (the usual refusal
        instead of the answer). A core returns the answer unchanged if its frames have no such part.
        """

    def due(self, now: float) -> tuple[list[bytes], float | None]:
        """Return the cyclic frames due by the time `now`, and the time of the next ones; None for never."""
        del now
        return [], None


_MOST_WAITING = 4096
"""The most bytes that wait for the rest of a request."""

Trace = Callable[[str], None]
"""Takes one line of the trace, a JSON object."""


class Line:
    """A line with the devices of a core; `name` is its name in the trace.

    `on` is the kind of line, `at` its port, path or channel, `speed` its bits per second; all are optional.
    """

    def __init__(self, core: Core, clock: Clock, *, name: str = "", seed: int = 0) -> None:
        self.core, self.clock, self.name, self.faults = core, clock, name, Faults(seed)
        self.trace: Trace | None = None
        self.requests, self.speed, self.on, self.at = 0, 0, "", ""

    def answer(self, request: bytes, core: Core | None = None) -> list[Outcome]:
        """Return what to send for one request of a client with the framing of `core`."""
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
        """Return the cyclic frames that are due now, and the real seconds until the next ones."""
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
    """One connection to a line, or its one serial port: keeps the bytes of an incomplete request."""

    def __init__(self, line: Line) -> None:
        self.line = line
        self.waiting = b""
        self._core = line.core

    def received(self, data: bytes, *, quiet: bool = False) -> list[Outcome]:
        """Return what to send for these bytes; `quiet`: no more bytes belong to them."""
        data = self.waiting + data
        self._core = self._core.settled(data)
        requests, done = self._core.cut(data, quiet=quiet)
        self.waiting = data[done:][-_MOST_WAITING:]
        return [outcome for request in requests for outcome in self.line.answer(request, self._core)]
