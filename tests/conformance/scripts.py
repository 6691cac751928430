"""Transports with a script: they expect given requests and give the scripted answers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from support.vector_file import Vector


class Script:
    """A transport of every family that follows a script; requests in `needs` may come in any order."""

    def __init__(self, vector: Vector, frame: Callable[[int, bytes], Any]) -> None:
        self.framing = vector["framing"] or "uss"  # only Modbus has several
        self._steps = list(vector["script"])
        self._needs = dict(vector["needs"])
        self._frame = frame
        self._came: list[bytes] = []

    def exchange(self, request: bytes) -> bytes:
        """One request and its reply."""
        if request in self._needs:
            return bytes(self._needs[request])
        sent, received = self._steps.pop(0)
        if sent != request:
            raise AssertionError(f"sent {request.hex()}, not {sent.hex()}")
        return bytes(received)

    def send(self, frame: Any) -> None:
        """One frame to the bus; what answers it comes next."""
        self._came.append(Script.exchange(self, frame.id.to_bytes(4, "big") + frame.data))

    def receive(self) -> Any:
        """The next frame from the bus."""
        data = self._came.pop(0) if self._came else b""
        if not data:
            raise TimeoutError
        return self._frame(int.from_bytes(data[:4], "big"), data[4:])

    def receive_waiting(self) -> Any:
        """What is there already."""
        return Script.receive(self) if self._came and self._came[0] else None

    @property
    def done(self) -> bool:
        """Whether every request of the script was sent."""
        return not self._steps


def async_twin(kind: type, *names: str) -> Any:
    """Return a subclass whose methods of these names are awaited; they never let anything else run."""

    def awaited(name: str) -> Any:
        method = getattr(kind, name)

        async def call(self: Any, *arguments: Any) -> Any:
            return method(self, *arguments)

        return call

    return type(f"Async{kind.__name__}", (kind,), {name: awaited(name) for name in names})


AsyncScript = async_twin(Script, "exchange", "send", "receive")


def now(result: Any) -> Any:
    """Return a result, also that of a coroutine that never really waits."""
    if not hasattr(result, "send"):
        return result
    try:
        result.send(None)
    except StopIteration as done:
        return done.value
    raise AssertionError("it waits for something else than its transport")
