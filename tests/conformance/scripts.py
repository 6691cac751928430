"""Transports with a script: they expect given requests and give the scripted answers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from support.vector_file import Vector


class Script:
    """A transport of every family that follows a script; requests in `needs` may come in any order."""

    def __init__(self, vector: Vector, frame: Callable[[int, bytes], Any]) -> None:
        self.framing = vector["framing"] or "uss"  # only Modbus has several
        self._head = 2 if self.framing == "tcp" else 0
        """The bytes of the transaction, which is the same in all steps of a script."""
        self._steps = list(vector["script"])
        self._needs = {sent[self._head :]: (sent, answer) for sent, answer in dict(vector["needs"]).items()}
        self._frame = frame
        self._came: list[bytes] = []

    def exchange(self, request: bytes) -> bytes:
        """One request and its reply."""
        sent, received = self._needs.get(request[self._head :]) or self._steps.pop(0)
        if sent[self._head :] != request[self._head :]:
            raise AssertionError(f"sent {request.hex()}, not {sent.hex()}")
        exchanged = zip(received, sent, request[: self._head], strict=False)
        return bytes(came ^ one ^ other for came, one, other in exchanged) + bytes(received[self._head :])

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
