"""What a device object remembers: the numbers that scales and limits need, and when they are asked for anew."""

from __future__ import annotations

from typing import Any

from conformance.package import Package
from conformance.runtime.bench import Memory, devices, refusal, refuses


def _made(package: Package, **more: Any) -> Any:
    """A device whose points need others that change never, rarely, always, or with another point."""
    runtime = package.runtime
    word = runtime.Integer(runtime.U16)

    def scaled(address: int, *names: str, **facts: Any) -> Any:
        rule = runtime.Rule(factors=tuple(runtime.Factor(name) for name in names))
        return runtime.ReadWrite(runtime.Scaled(runtime.U16, rule, decimals=0), at=runtime.holding(address), **facts)

    limit = runtime.Limit(runtime.Rule(factors=(runtime.Factor("always"),)), 0, 100, {})
    points = {
        "PROFILE": runtime.Profile(functions={3: 8, 6: 1, 16: 8}),
        "never": runtime.ReadOnly(word, at=runtime.holding(1), changes="never"),
        "rarely": runtime.ReadWrite(word, at=runtime.holding(2), changes="rarely"),
        "always": runtime.ReadOnly(word, at=runtime.holding(3)),
        "with_it": runtime.ReadOnly(word, at=runtime.holding(4), changes_with=("trigger",)),
        "trigger": runtime.ReadWrite(word, at=runtime.holding(20), write_at=runtime.holding(21)),
        "by_never": scaled(5, "never", group="g"),
        "by_rarely": scaled(6, "rarely", group="g"),
        "by_always": scaled(7, "always"),
        "by_with": scaled(8, "with_it"),
        "limited": runtime.ReadWrite(word, at=runtime.holding(9), allowed=((0, limit),)),
        "lost": scaled(10, "nothing", code="L1"),
        **more,
    }
    return devices(package, points, runtime.ModbusDevice)[0]


def _device(package: Package) -> tuple[Any, Memory]:
    memory = Memory({1: 2, 2: 2, 3: 2, 4: 2, 5: 10, 6: 10, 7: 10, 8: 10})
    return _made(package)(memory, 1), memory


def _read(*addresses: int) -> list[tuple[int, int, int]]:
    return [(3, address, 1) for address in addresses]


def check_reading(package: Package) -> None:
    """What changes seldom is asked once for reading."""
    device, memory = _device(package)
    assert (device.by_never.read(), memory.since()) == (5.0, _read(1, 5))
    assert (device.by_never.read(), memory.since()) == (5.0, _read(5))
    assert (device.by_rarely.read(), memory.since()) == (5.0, _read(2, 6))
    assert (device.by_rarely.read(), memory.since()) == (5.0, _read(6))
    assert (device.by_always.read(), device.by_always.read(), memory.since()) == (5.0, 5.0, _read(3, 7, 3, 7))
    assert (device.by_with.read(), device.by_with.read(), memory.since()) == (5.0, 5.0, _read(4, 8, 8))
    device.forget()
    assert (device.by_never.read(), memory.since()) == (5.0, _read(1, 5))


def check_writing(package: Package) -> None:
    """For writing only what never changes is taken from memory."""
    device, memory = _device(package)
    for name, needed in (("by_never", 1), ("by_rarely", 2), ("by_always", 3), ("by_with", 4)):
        point = getattr(device, name)
        point.read()
        memory.since()
        point.write(4)
        asked = [] if name == "by_never" else _read(needed)
        assert memory.since() == [*asked, (6, point.facts.at.address, 8)], name
    device.limited.write(2)
    device.limited.write_raw(1)
    assert memory.since() == [(3, 3, 1), (6, 9, 2), (3, 3, 1), (6, 9, 1)]
    assert refusal(device.limited.write_raw, 3).status == "out_of_range"
    assert memory.since() == [(3, 3, 1)]


def check_forgetting(package: Package) -> None:
    """What is written is forgotten, and what changes with it; nothing else is."""
    device, memory = _device(package)
    for name in ("by_never", "by_rarely", "by_with"):
        getattr(device, name).read()
    memory.since()
    device.rarely.write(5)
    assert (device.by_rarely.read(), memory.since()) == (2.0, [(6, 2, 5), *_read(2, 6)])
    for address in (20, 21, 4):
        device.write_at("holding", address, 2)
        memory.since()
        assert (device.by_with.read(), memory.since()) == (5.0, _read(4, 8))
    device.trigger.write(1)
    memory.since()
    assert (device.by_with.read(), memory.since()) == (5.0, _read(4, 8))
    device.write_at("holding", 22, 1, 1)
    memory.since()
    assert (device.by_with.read(), device.by_never.read(), memory.since()) == (5.0, 5.0, _read(8, 5))


def check_missing(package: Package) -> None:
    """A point that needs another one that there is not says so."""
    device, _ = _device(package)
    message = "L1 lost needs nothing, which is no point of this device: its `POINTS` lists their names"
    refuses(package.runtime.AccessError, message, device.lost.read)
    refuses(package.runtime.AccessError, message, device.read_many, ["lost"])


def check_groups(package: Package) -> None:
    """A group is read with what its scales need, which is remembered then."""
    device, memory = _device(package)
    assert (device.read_many("g"), memory.since()) == ({"by_never": 5.0, "by_rarely": 5.0}, [(3, 1, 6)])
    assert (device.read_many("g"), memory.since()) == ({"by_never": 5.0, "by_rarely": 5.0}, [(3, 5, 2)])
    assert (device.read_many(["by_always"]), memory.since()) == ({"by_always": 5.0}, [(3, 3, 5)])
    memory.words[2] = 5
    assert (device.read_many(["rarely", "by_rarely"]), memory.since()) == ({"rarely": 5, "by_rarely": 2.0}, [(3, 2, 5)])


def check_places(package: Package) -> None:
    """Places that touch are of one space, telegram and element."""
    runtime = package.runtime
    places = [
        runtime.holding(1, 2),
        runtime.holding(2, 3),
        runtime.holding(3),
        runtime.coil(2),
        runtime.parameter(2, index=1),
        runtime.parameter(2, index=2),
        runtime.parameter(2),
        runtime.telegram("t", 2),
        runtime.telegram("u", 2),
    ]
    touching = {(a, b) for a, one in enumerate(places) for b, two in enumerate(places) if one.overlaps(two) and a < b}
    assert touching == {(0, 1), (1, 2), (4, 6), (5, 6)}
    wide = runtime.holding(9, 5, function=4)
    assert (wide.address, wide.span, wide.function, wide.index, wide.telegram) == (5, 5, 4, None, None)
    made = [runtime.discrete(1, index=3), runtime.input_register(1), runtime.telegram("t", 1, 2, index=4)]
    assert [(one.space, one.index, one.telegram) for one in made] == [
        ("discrete", 3, None), ("input", None, None), ("telegram", 4, "t"),
    ]  # fmt: skip
    other = runtime.Documented("why", at=runtime.parameter(3, index=2))
    assert str(other) == "why; `read_at` and `write_at` reach its words at parameter 3, index 2"
    assert str(runtime.Documented("why")) == "why"
