"""Made devices: a table of points, and a transport that remembers words, counts what it is asked and can fail."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from conformance.package import Package
from conformance.scripts import now


def refusal(function: Callable[..., Any], *arguments: Any, **more: Any) -> Any:
    """Return the error that a call raises."""
    try:
        result = now(function(*arguments, **more))
    except Exception as error:
        return error
    raise AssertionError(f"it should be refused, and gave {result!r}")


def refuses(kind: Any, message: str, function: Callable[..., Any], *arguments: Any, **more: Any) -> None:
    """Assert that a call raises exactly that type of error with exactly that message."""
    error = refusal(function, *arguments, **more)
    assert (type(error), str(error)) == (kind, message), repr(error)


def devices(package: Package, points: dict[str, Any], *bases: type) -> list[Any]:
    """Classes of devices with these points, one on each base, as generated ones are."""
    return [type("Made", (table(package, **points), base), {}) for base in bases]


def table(package: Package, **points: Any) -> Any:
    """A table of points that belongs to no device."""
    return type("Points", (package.runtime.PointTable,), points)


class Memory:
    """A Modbus line with one unit that remembers its words; `asked` are the function, address and count or value."""

    framing = "rtu"

    def __init__(self, words: dict[int, int]) -> None:
        self.words = words
        self.asked: list[tuple[int, int, int]] = []
        self.fails: BaseException | None = None
        self.errors: list[BaseException] = []
        """Of the next requests, the last one first."""

    def exchange(self, request: bytes) -> bytes:
        """The answer to a request."""
        if self.fails is not None:
            raise self.fails
        if self.errors:
            raise self.errors.pop()
        if request[0] == 0:
            self.asked.append((request[1], *self._pair(request)))
            return b""
        return self._closed(request[:1] + self._answer(request))

    def _pair(self, request: bytes) -> tuple[int, int]:
        return int.from_bytes(request[2:4], "big"), int.from_bytes(request[4:6], "big")

    def _closed(self, frame: bytes) -> bytes:
        value = 0xFFFF
        for byte in frame:
            value ^= byte
            for _ in range(8):
                value = value >> 1 ^ (0xA001 if value & 1 else 0)
        return frame + value.to_bytes(2, "little")

    def _answer(self, request: bytes) -> bytes:
        function, (address, third) = request[1], self._pair(request)
        self.asked.append((function, address, third))
        if function in (1, 2):
            bits = sum(self.words.get(address + at, 0) << at for at in range(third))
            return bytes((function, (third + 7) // 8)) + bits.to_bytes((third + 7) // 8, "little")
        if function in (3, 4):
            words = (self.words.get(address + at, 0) for at in range(third))
            return bytes((function, 2 * third)) + b"".join(word.to_bytes(2, "big") for word in words)
        if function in (5, 6):
            self.words[address] = third
        else:
            for at in range(third):
                self.words[address + at] = int.from_bytes(request[7 + 2 * at : 9 + 2 * at], "big")
        return request[1:6]

    def since(self) -> list[tuple[int, int, int]]:
        """Return the requests since the last call of this method."""
        asked, self.asked = self.asked, []
        return asked


class AsyncMemory(Memory):
    """The same with `await`."""

    async def exchange(self, request: bytes) -> bytes:  # type: ignore[override]  # as the async transports are
        """The answer to a request."""
        return super().exchange(request)
