"""Which group and which points an error of a read is about, and devices in one event loop after the other."""

from __future__ import annotations

import asyncio
import pickle
from typing import Any

from conformance.package import Package
from conformance.runtime.bench import AsyncMemory, Memory, devices, refusal, refuses
from conformance.runtime.can_bus import on_lines as can_lines
from conformance.runtime.uss_line import on_lines as uss_lines
from conformance.scripts import now


def _points(package: Package) -> dict[str, Any]:
    """A group of two planned reads, one of them of many bits, and a point that needs others."""
    runtime, block = package.runtime, package.modbus.Block
    word, at = runtime.Integer(runtime.U16), runtime.holding
    scaled = runtime.Scaled(runtime.U16, runtime.Rule(factors=(runtime.Factor("ratio"),)), decimals=0)
    limit = runtime.Limit(runtime.Rule(factors=(runtime.Factor("least"),)), 0, 9, {})
    bits = {f"bit_{place}": runtime.ReadOnly(runtime.Bit(), at=runtime.coil(place), group="g") for place in range(6)}
    return {
        "PROFILE": runtime.Profile(functions={1: 8, 3: 4, 6: 1}),
        "BLOCKS": {
            "g": (block("coil", 1, 0, 6), block("holding", 3, 1, 2)),
            "split": (block("holding", 3, 41, 1), block("holding", 3, 42, 1)),
        },
        "first": runtime.ReadOnly(word, at=at(41), group="split"),
        "second": runtime.ReadOnly(word, at=at(42), group="split"),
        "speed": runtime.ReadOnly(word, at=at(1), code="A1", group="g"),
        "level": runtime.ReadOnly(word, at=at(2), group="g"),
        "alone": runtime.ReadOnly(word, at=at(9), code="A9"),
        "ratio": runtime.ReadOnly(word, at=at(20), code="A20"),
        "least": runtime.ReadOnly(word, at=at(21), code="A21"),
        "needy": runtime.ReadOnly(scaled, at=at(30), code="A30", group="late"),
        "limited": runtime.ReadWrite(word, at=at(31), code="A31", allowed=((limit, 9),)),
        **bits,
    }


def check_what_errors_are_about(package: Package) -> None:
    """An error of a read names the group, the points of the request, and what had to be read first."""
    runtime = package.runtime
    made = devices(package, _points(package), runtime.ModbusDevice, runtime.AsyncModbusDevice)
    for kind, line in zip(made, (Memory, AsyncMemory), strict=True):
        memory = line({20: 0})
        device, silent = kind(memory, 1), "unit 1 did not reply to function"
        error = refusal(device.read_many, "late")
        text = "group late: A30 needy: ratio is zero"
        assert (error.group, error.point, error.needs, str(error)) == ("late", "A30 needy", None, text)
        memory.since()
        assert (now(device.read_many("split")), memory.since()) == (
            {"first": 0, "second": 0}, [(3, 41, 1), (3, 42, 1)],
        )  # fmt: skip
        memory.fails = TimeoutError()
        error = refusal(device.read_many, "g")
        assert (error.group, error.point, error.status) == ("g", "bit_0, bit_1, bit_2, bit_3 and 2 more", "timeout")
        assert str(error) == f"group g: bit_0, bit_1, bit_2, bit_3 and 2 more: {silent} 01h"
        twin = pickle.loads(pickle.dumps(error))
        assert (str(twin), twin.group, twin.point) == (str(error), error.group, error.point)
        error = refusal(device.read_many, ["speed", "level", "alone"])
        assert (error.group, error.point, str(error)) == (
            None, "A1 speed, level", f"A1 speed, level: {silent} 03h",
        )  # fmt: skip
        assert refusal(device.read_many, [device.alone]).point == "A9 alone"
        for function, more, needs in ((device.needy.read, (), "A20 ratio"), (device.limited.write, (5,), "A21 least")):
            error = refusal(function, *more)
            assert error.needs == needs
            assert str(error) == f"{error.point}: needs {needs}: {silent} 03h"
        assert error.point == "A31 limited"
        everyone = kind(line({}), 0)
        text = "A31 limited: needs A21 least: function 03h cannot be sent to all units"
        for function in (everyone.limited.write, everyone.limited.write_raw):
            refuses(runtime.RequestError, text, function, 5)


def check_other_families(package: Package) -> None:
    """The same on CAN and USS."""
    for device, bus, _ in can_lines(package, waiting=True):
        bus.answer = lambda frame: []
        error = refusal(device.read_many, "g")
        assert (error.group, error.point) == ("g", "long, same"), str(error)
    for device, line in uss_lines(package):
        line.fails = TimeoutError()
        error = refusal(device.read_many, "g")
        assert (error.group, error.point) == ("g", "ZSW state, actual"), str(error)
        assert refusal(device.ramp.read).group is None
        error = refusal(device.read_at, "parameter", 5)
        assert (error.group, error.point, error.needs) == (None, "parameter 5", None)


class Slow(AsyncMemory):
    """A line that lets others run before it answers; `most` is how many asked at the same time."""

    now = most = 0

    async def exchange(self, request: bytes) -> bytes:  # type: ignore[override]  # as the async transports are
        """The answer to a request."""
        self.now += 1
        self.most = max(self.now, self.most)
        try:
            await asyncio.sleep(0.001)
            return await super().exchange(request)
        finally:
            self.now -= 1


def check_event_loops(package: Package) -> None:
    """An async device works in one event loop after the other, after contention and cancelling too."""
    runtime = package.runtime
    _, kind = devices(package, _points(package), runtime.ModbusDevice, runtime.AsyncModbusDevice)
    line = Slow({1: 5, 9: 7})
    device = kind(line, 1)

    async def contend() -> list[int]:
        reading = asyncio.gather(*[point.read() for point in (device.speed, device.alone) * 2])
        return [*await asyncio.wait_for(reading, 5)]

    async def cancelled() -> None:
        reading = [asyncio.create_task(device.speed.read()) for _ in range(2)]
        await asyncio.sleep(0)
        reading[0].cancel()
        await asyncio.gather(*reading, return_exceptions=True)

    assert [asyncio.run(contend()) for _ in range(2)] == [[5, 7, 5, 7]] * 2
    asyncio.run(cancelled())
    assert (asyncio.run(contend()), line.most) == ([5, 7, 5, 7], 1)
    left = asyncio.new_event_loop()  # it ends in the middle of a read
    task = left.create_task(device.speed.read())
    left.run_until_complete(asyncio.sleep(0))
    assert asyncio.run(contend()) == [5, 7, 5, 7]
    task.cancel()
    left.run_until_complete(asyncio.gather(task, return_exceptions=True))
    left.close()


def check_loops_at_once(package: Package) -> None:
    """Two event loops cannot talk to one device at the same time."""
    import threading

    runtime = package.runtime
    _, kind = devices(package, _points(package), runtime.ModbusDevice, runtime.AsyncModbusDevice)
    asked, go_on = threading.Event(), threading.Event()

    class Held(AsyncMemory):
        async def exchange(self, request: bytes) -> bytes:  # type: ignore[override]  # as the async transports are
            asked.set()
            await asyncio.to_thread(go_on.wait, 5)
            return await super().exchange(request)

    device = kind(Held({1: 5}), 1)
    found: list[int] = []
    other = threading.Thread(target=lambda: found.append(asyncio.run(device.speed.read())))
    other.start()
    assert asked.wait(5)

    async def read() -> Any:
        return await asyncio.wait_for(device.speed.read(), 2)

    try:
        text = "another event loop is talking to the device: use it in one at a time"
        refuses(runtime.AccessError, text, lambda: asyncio.run(read()))
    finally:
        go_on.set()
        other.join(5)
    assert (found, now(device.point("A1").decode(3))) == ([5], 3)
