"""What the part `simulation` of a family offers, and what it is given. Nothing here does I/O.

A family's `simulation.py` has

    def core_of(devices: Sequence[SimulatedDevice], framing: str) -> Core

for the devices that share a line, and `LINES`: the lines that its devices can be on (`tcp`, `serial`, `can`), the usual
one first, each with its framings there, the usual one first: `framing` is one of these.

Requests and answers are bytes. A frame of CAN is its identifier in four bytes, high first, with the highest bit set for
an extended one, then the data: `cut` is not called for it. A core on a serial line whose speed is known has `character`
set to the seconds that one takes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Protocol

from fieldscribe.simulation.device import SimulatedDevice


@dataclass(slots=True)
class Answer:
    """What a request leads to: the bytes that go out (none for a broadcast), `delay` seconds after the request.

    `more` are further frames behind the first. `refused` says why, if the answer is a refusal.
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
        costs no request behind it.
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
