"""Transports that lead to simulated devices without any line, for clients of the runtime."""

from __future__ import annotations

from collections import deque
from typing import Any

from fieldscribe.families.can import simulation as can
from fieldscribe.families.uss import simulation as uss
from fieldscribe.simulation.device import SimulatedDevice
from fieldscribe.simulation.line import Line, Stream

_EXTENDED = 1 << 31
_STANDARD = 0x7FF


class DirectLine:
    """A transport that leads to a line without any bus."""

    def __init__(self, line: Line) -> None:
        self.line, self._stream = line, Stream(line)

    def exchange(self, request: bytes) -> bytes:
        """Return the reply; raises TimeoutError without one."""
        outcomes = self._stream.received(request)
        if not outcomes:
            raise TimeoutError
        return b"".join(outcome.data for outcome in outcomes)


def direct_line(device: SimulatedDevice) -> DirectLine:
    """A transport to a USS device."""
    return DirectLine(Line(uss.core_of([device]), device.clock))


class DirectBus:
    """A transport that leads to a bus of simulated devices; where nothing waits, time passes up to the next frame."""

    def __init__(self, *devices: SimulatedDevice, silent: bool = False) -> None:
        self.silent = silent
        self.line = Line(can.core_of(devices), devices[0].clock)
        self._waiting: deque[bytes] = deque()

    def send(self, frame: Any) -> None:
        """Send a frame."""
        extended = _EXTENDED if frame.id > _STANDARD else 0
        data = (frame.id | extended).to_bytes(4, "big") + frame.data
        self._waiting.extend(outcome.data for outcome in self.line.answer(data) if len(outcome.data) >= 4)

    def receive(self) -> Any:
        """Return the next frame; raises TimeoutError if none comes."""
        from fieldscribe_runtime.can import Frame

        if not self._waiting and not self.silent:
            self.line.clock.advance(0.1)
            self._waiting.extend(self.line.due()[0])
        if not self._waiting:
            raise TimeoutError
        data = self._waiting.popleft()
        return Frame(int.from_bytes(data[:4], "big") & ~_EXTENDED, data[4:])

    def receive_waiting(self) -> Any:
        """Return the next frame that is there already; None without one."""
        return self.receive() if self._waiting else None
