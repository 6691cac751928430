"""A made CAN device, and a bus on which its unit answers."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from typing import Any

from conformance.package import Package
from conformance.runtime.bench import devices
from conformance.scripts import async_twin


class Bus:
    """A bus with one unit: `answer` gives what comes for a frame that is sent; every wait takes a second."""

    def __init__(self, package: Package, answer: Callable[[Any], list[Any]] = lambda _: []) -> None:
        self.clock = 1000.0
        self.sent: list[Any] = []
        self.queue: list[Any] = []
        self.answer = answer
        self.waits = 1.0
        session = sys.modules[f"{package.can.__name__}.session"]
        session.monotonic = lambda: self.clock  # type: ignore[attr-defined]  # so that no time passes

    def send(self, frame: Any) -> None:
        """A frame to the unit."""
        self.sent.append(frame)
        self.queue += self.answer(frame)

    def receive(self) -> Any:
        """The next frame."""
        self.clock += self.waits
        if not self.queue:
            raise TimeoutError
        return self.queue.pop(0)


class Waiting(Bus):
    """A bus that can tell what came already."""

    def receive_waiting(self) -> Any:
        """The next frame that is there."""
        return self.queue.pop(0) if self.queue else None


AsyncBus, AsyncWaiting = (async_twin(kind, "send", "receive") for kind in (Bus, Waiting))


def roles_of(package: Package, text: str) -> Any:
    """Eight bytes: `c5` a constant, `u` the unit, `a8`, `r0` parts of address and raw number, `m`, `w0`, `x`."""
    kinds = {"c": "constant", "u": "unit", "a": "address", "r": "raw", "m": "multiplexer", "w": "word", "x": "xor"}
    return tuple(package.can.Role(kinds[part[0]], int(part[1:] or 0)) for part in text.split())


def profile_of(package: Package) -> Any:
    message = package.can.Message
    read, write = "c3 u a8 a0 c0 c0 c0 x127", "c6 u a8 a0 r8 r0 c0 x127"
    return package.can.Profile(
        units=(1, 30),
        identifier_bits=11,
        messages=(
            message("ask", "request", 0x100, roles_of(package, read), True),
            message("told", "response", 0x200, roles_of(package, write.replace("c6", "c4")), True, "ask"),
            message("put", "request", 0x100, roles_of(package, write), True),
            message("done", "response", 0x200, roles_of(package, write.replace("c6", "c7")), True, "put"),
            message("cyclic", "cyclic", 0x300, roles_of(package, "m w0 w1 w2 w3 w4 w5 u"), True),
        ),
        telegrams=(package.can.Telegram("beat", "cyclic", 5, "cyclic"),),
    )


def kinds_of(package: Package) -> list[Any]:
    runtime = package.runtime
    word, wide = runtime.Integer(runtime.U16), runtime.Integer(runtime.U32)
    points = {
        "PROFILE": profile_of(package),
        "speed": runtime.ReadWrite(word, at=runtime.parameter(5), code="P5"),
        "long": runtime.ReadWrite(wide, at=runtime.parameter(8, 7), group="g"),
        "again": runtime.ReadOnly(word, at=runtime.parameter(7), group="g"),
        "same": runtime.ReadOnly(wide, at=runtime.parameter(8, 7), group="g"),
        "number": runtime.ReadWrite(runtime.Floating(runtime.F32), at=runtime.parameter(10)),
        "beat": runtime.ReadOnly(word, at=runtime.telegram("beat", 1), code="B1", group="heard"),
        "late": runtime.ReadOnly(wide, at=runtime.telegram("beat", 2, 3), group="heard"),
    }
    return devices(package, points, package.can.CanDevice, package.can.AsyncCanDevice)


def answers_of(package: Package, words: dict[int, int]) -> Callable[[Any], list[Any]]:
    """What a unit answers."""
    profile = profile_of(package)
    names = {3: ("ask", "told"), 6: ("put", "done")}

    def answer(frame: Any) -> list[Any]:
        request, response = names[frame.data[0]]
        address, raw = package.can.parse(profile.message(request), 9, frame)
        if request == "put":
            words[address] = raw
        return [package.can.build(profile.message(response), profile, 9, address, words.get(address, 0))]

    return answer


def on_lines(package: Package, waiting: bool) -> Iterator[tuple[Any, Bus, dict[int, int]]]:
    kinds = (Waiting, AsyncWaiting) if waiting else (Bus, AsyncBus)
    for kind, line in zip(kinds_of(package), kinds, strict=True):
        words = {5: 50, 7: 0x7777, 8: 0x8888}
        bus = line(package, answers_of(package, words))
        yield kind(bus, 9), bus, words


def beat_of(package: Package, place: int, *words: int) -> Any:
    data = bytes((place,)) + b"".join(word.to_bytes(2, "big") for word in words) + bytes((9,))
    return package.can.Frame(0x309, data)


def bus_frame(package: Package, address: int) -> Any:
    """The question for a parameter."""
    profile = profile_of(package)
    return package.can.build(profile.message("ask"), profile, 9, address)
