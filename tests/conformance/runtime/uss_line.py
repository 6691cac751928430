"""A made USS device, and a line on which its unit answers."""

from __future__ import annotations

from typing import Any

from conformance.package import Package
from conformance.runtime.bench import devices
from conformance.scripts import async_twin

_TASKS = {0: (0,), 1: (1, 2), 2: (1,), 3: (2,), 6: (4, 5), 7: (4,), 8: (5,), 11: (5,), 12: (4,), 13: (2,), 14: (1,)}


class Line:
    """A unit that answers tasks and notes the words of each telegram; `heard` is its own process data."""

    def __init__(self, pzd: int = 3) -> None:
        self.pzd = pzd
        self.asked: list[tuple[int, ...]] = []
        self.values: dict[tuple[int, int], tuple[int, ...]] = {}
        self.heard = (0x1111, 0x2222, 0x3333)[:pzd]
        self.busy = 0
        self.fails: BaseException | None = None
        self.turns = 0
        self.most = 4
        self.refuses: int | None = None

    def exchange(self, request: bytes) -> bytes:
        """The reply to a telegram."""
        words = tuple(int.from_bytes(request[at : at + 2], "big") for at in range(3, len(request) - 1, 2))
        self.asked.append((request[2], *words))
        if self.fails is not None:
            raise self.fails
        part = words[: len(words) - self.pzd]
        return self._closed(bytes((request[2],)), (*self._answer(part)[: self.most], *self.heard))

    def _answer(self, part: tuple[int, ...]) -> tuple[int, ...]:
        if not part:
            return ()
        task, number = part[0] >> 12, (part[0] & 0xFFF, part[1])
        if task == 0:
            return (0, 0, 0, 0)
        if self.busy:
            self.busy -= 1
            return (0, 0, 0, 0)
        if self.refuses is not None:
            return (0x7000 | number[0], number[1], self.refuses, 0)
        if task not in (1, 6):
            wide = task in (3, 8, 11, 13)
            self.values[number] = part[2:4] if wide else part[2:3]
        words = self.values.get(number, (0,))
        words = (*words[:-1], words[-1] ^ self.turns)
        response = len(words) + (3 if number[1] and task != 1 else 0)
        return (response << 12 | number[0], number[1], *words, *(0,) * (2 - len(words)))

    def _closed(self, unit: bytes, words: tuple[int, ...]) -> bytes:
        data = b"".join(word.to_bytes(2, "big") for word in words)
        frame = bytes((2, len(data) + 2)) + unit + data
        check = 0
        for byte in frame:
            check ^= byte
        return frame + bytes((check,))

    def since(self) -> list[tuple[int, ...]]:
        """Return the telegrams since the last call of this method."""
        asked, self.asked = self.asked, []
        return asked


AsyncLine = async_twin(Line, "exchange")


def profile_of(package: Package) -> Any:
    telegram = package.uss.Telegram
    return package.uss.Profile(
        units=(0, 30),
        pkw=(0, 3, 4, 127),
        pzd=(0, 4),
        tasks=_TASKS,
        broadcast=32,
        errors={2: "limit_exceeded"},
        telegrams=(telegram("task", "request", 3), telegram("answer", "response", 3)),
        variant_pzd={("model", "small"): (0, 2)},
    )


def kinds_of(package: Package) -> list[Any]:
    runtime, stored = package.runtime, package.uss.Stored
    word, wide = runtime.Integer(runtime.U16), runtime.Integer(runtime.U32)
    points = {
        "PROFILE": profile_of(package),
        "VARIANTS": {"model": ("small", "large")},
        "ramp": stored(word, at=runtime.parameter(5), code="P5", group="g"),
        "wide": stored(wide, at=runtime.parameter(6), group="g"),
        "first": stored(word, at=runtime.parameter(7, index=1)),
        "second": stored(wide, at=runtime.parameter(7, index=2)),
        "silent": package.uss.StoredWriteOnly(word, at=runtime.parameter(9)),
        "number": stored(runtime.Floating(runtime.F32), at=runtime.parameter(10)),
        "bits": stored(word, at=runtime.parameter(11), bits=(3, 0)),
        "on": runtime.ReadWrite(runtime.Bit(), at=runtime.telegram("task", 0), bits=(0, 0), fixed=(0x0400, 0x0400)),
        "left": runtime.ReadWrite(runtime.Bit(), at=runtime.telegram("task", 0), bits=(1, 1), fixed=(0x0800, 0x0800)),
        "setpoint": runtime.ReadWrite(word, at=runtime.telegram("task", 1), code="HSW"),
        "state": runtime.ReadOnly(word, at=runtime.telegram("answer", 0), group="g", code="ZSW"),
        "actual": runtime.ReadOnly(wide, at=runtime.telegram("answer", 1, 2), group="g"),
    }
    return devices(package, points, package.uss.UssDevice, package.uss.AsyncUssDevice)


def on_lines(package: Package, pkw: int = 4, pzd: int = 3, **more: Any) -> list[tuple[Any, Line]]:
    link = package.uss.Link(pkw, pzd, True)
    made = []
    for kind, line in zip(kinds_of(package), (Line, AsyncLine), strict=True):
        transport = line(pzd)
        made.append((kind(transport, 9, link, **more), transport))
    return made
