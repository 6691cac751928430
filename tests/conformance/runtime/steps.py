"""Commands of several requests: what they send in which order, what they wait for, and what a device does by itself."""

from __future__ import annotations

from typing import Any

from conformance.package import Package
from conformance.runtime.bench import AsyncMemory, Memory, devices, refusal
from conformance.scripts import now


def _made(package: Package, within: float = 0.0, **more: Any) -> Any:
    """Devices with a mailbox, bits that share a word, and commands; each with its kind of line."""
    runtime = package.runtime
    word, step, of = runtime.Integer(runtime.U16), runtime.Step, runtime.StepWord
    key = step("key", runtime.holding(40, 41, function=16), (of(0, 1, "unit"), of(65535, -1, "unit")))
    points: dict[str, Any] = {
        "PROFILE": runtime.Profile(functions={3: 8, 6: 1, 16: 8}, broadcast=0),
        "VARIANTS": {"model": ("a", "b")},
        "mode": runtime.ReadOnly(word, at=runtime.holding(1)),
        "level": runtime.ReadWrite(word, at=runtime.holding(2)),
        "close": runtime.SteppedCommand(
            key, step("wait", runtime.holding(3), (0,), within=within), arguments={"unit": (1, 32)}
        ),
        "bits": runtime.SteppedCommand(step("bits", runtime.holding(5, function=6), (of(0x0A, mask=0x0F),))),
        "chosen": runtime.SteppedCommand(
            step("a", runtime.holding(6, function=6), (1,), when=((("model", "in", ("a",)), ("mode", ">=", (2,))),)),
            step("b", runtime.holding(7, function=6), (2,), when=((("model", "!=", ("a",)),), (("mode", "==", (0,)),))),
        ),
        "alive": runtime.SteppedCommand(step("alive", runtime.holding(8, function=6), (1,)), every=10.0),
        "copy": runtime.SteppedCommand(
            step("copy", runtime.holding(9, function=6), (of(0, 1, "from"),)), arguments={"from": (0, 5)}
        ),
        **more,
    }
    kinds = devices(package, points, runtime.ModbusDevice, runtime.AsyncModbusDevice)
    return zip(kinds, (Memory, AsyncMemory), strict=True)


def check_requests(package: Package) -> None:
    """Words follow from arguments; bits of others stay; a step with a condition asks for what it compares."""
    for kind, line in _made(package):
        memory = line({5: 0x1234})
        device = kind(memory, 1, {"model": "a"})
        now(device.close.send(unit=32))
        assert (memory.since(), memory.words[40], memory.words[41]) == ([(16, 40, 2), (3, 3, 1)], 32, 65503)
        for given in ({"from_": 3}, {"from": 3}):
            now(device.copy.send(**given))
            assert memory.since() == [(6, 9, 3)]
        assert str(refusal(lambda device: now(device.copy.send()), device)) == "copy takes from_, not none"
        now(device.bits.send())
        assert memory.since() == [(3, 5, 1), (6, 5, 0x123A)]
        now(device.chosen.send())
        assert memory.since() == [(3, 1, 1), (3, 1, 1), (6, 7, 2)]
        memory.words[1] = 2
        now(device.chosen.send())
        assert memory.since() == [(3, 1, 1), (6, 6, 1), (3, 1, 1)]
        now(kind(memory, 1, {"model": "b"}).chosen.send())
        assert memory.since() == [(6, 7, 2)]
        assert (kind.alive.every, device.alive.every, device.close.every) == (10.0, 10.0, None)


def check_errors(package: Package) -> None:
    """An error names the command and the step; what a step needs is named, too."""
    runtime = package.runtime
    for kind, line in _made(package):
        memory = line({3: 7})
        device = kind(memory, 1)
        waited = refusal(lambda device: now(device.close.send(unit=1)), device)
        assert (type(waited), waited.held, waited.status) == (runtime.WaitError, (7,), "not_reached")
        assert str(waited) == "close, step 2 (wait): not so within 0 s"
        assert memory.since() == [(16, 40, 2), (3, 3, 1)]
        for arguments, text in (
            ({}, "close takes unit, not none"),
            ({"unit": 1, "more": 2}, "close takes unit, not unit, more"),
            ({"unit": 0}, "unit of close is 1..32, not 0"),
            ({"unit": 33}, "unit of close is 1..32, not 33"),
        ):
            assert str(refusal(lambda device, given: now(device.close.send(**given)), device, arguments)) == text
        assert memory.since() == []
        unsaid = refusal(lambda device: now(device.chosen.send()), device)
        assert str(unsaid) == "chosen, step 1 (a): depends on model: pass it when the device is made"
        memory.errors = [runtime.ExceptionReplyError(2)]
        refused = refusal(lambda device: now(device.chosen.send()), kind(memory, 1, {"model": "a"}))
        assert (
            str(refused) == "chosen, step 1 (a): needs mode: the device answered exception 02h (illegal_data_address)"
        )
        device.retries, memory.errors = 3, [TimeoutError()]
        lost = refusal(lambda device: now(device.alive.send()), device)
        assert str(lost) == "alive, step 1 (alive): unit 1 did not reply to function 06h"
        assert (device.retries, memory.since()) == (3, [])
        all_units = kind(memory, 0)
        now(all_units.alive.send())
        deaf = refusal(lambda device: now(device.bits.send()), all_units)
        assert str(deaf) == "bits, step 1 (bits): function 03h cannot be sent to all units"
        assert str(refusal(getattr, device.close, "read")) == "close is a command: it has no read, use close.send()"
        assert str(refusal(setattr, device, "close", 1)) == "a command is not assigned to: use its send method"


class _Busy(Memory):
    """A line whose register 3 falls with each request."""

    def exchange(self, request: bytes) -> bytes:
        """The answer to a request."""
        self.words[3] -= 1
        return super().exchange(request)


def check_waiting(package: Package) -> None:
    """A step waits with pauses, and no longer than it may."""
    kind = next(iter(_made(package, within=0.05)))[0]
    memory = _Busy({3: 3})
    now(kind(memory, 1).close.send(unit=1))
    assert memory.since() == [(16, 40, 2), *[(3, 3, 1)] * 2]
    memory = _Busy({3: 9})
    late = refusal(kind(memory, 1).close.send, unit=1)
    assert (late.held, str(late)) == ((6,), "close, step 2 (wait): not so within 0.05 s")
    assert memory.since() == [(16, 40, 2), *[(3, 3, 1)] * 2]


def check_automatic(package: Package) -> None:
    """What comes first is sent before all else but identification, again after a failure and after `forget`."""
    runtime = package.runtime
    first = runtime.SteppedCommand(
        runtime.Step("one", runtime.holding(20, function=6), (1,)),
        runtime.Step("two", runtime.holding(21, function=6), (2,)),
        run="first",
    )
    unlock = runtime.SteppedCommand(runtime.Step("key", runtime.holding(22, function=6), (3,)), run="before write")
    for kind, line in _made(package, first=first, unlock=unlock):
        memory = line({})
        device = kind(memory, 1)
        assert (now(device.identify()), memory.since()) == ({}, [])
        memory.errors = [runtime.ExceptionReplyError(4)]
        failed = refusal(lambda device: now(device.mode.read()), device)
        assert str(failed) == "first, step 1 (one): the device answered exception 04h (server_device_failure)"
        now(device.mode.read())
        assert memory.since() == [(6, 20, 1), (6, 21, 2), (3, 1, 1)]
        now(device.level.write(9))
        now(device.mode.read())
        now(device.alive.send())
        assert memory.since() == [(6, 22, 3), (6, 2, 9), (3, 1, 1), (6, 8, 1)]
        device.forget()
        now(device.read_at("holding", 1))
        now(device.first.send())
        assert memory.since() == [(6, 20, 1), (6, 21, 2), (3, 1, 1), (6, 20, 1), (6, 21, 2)]


def check_guide(package: Package) -> None:
    """A command says what it takes, and its steps."""
    for kind, line in _made(package):
        text = "close, a command: on a device, device.close.send(unit=number).\n\n1. key\n2. wait\n\nunit is 1..32."
        assert kind.close.__doc__ == text
        assert kind.alive.__doc__.startswith("alive, a command: on a device, device.alive.send(), again every 10 s.")
        device = kind(line({}), 1)
        assert repr(kind.close) == "<SteppedCommand close: 2 steps>"
        assert repr(device.close) == f"<SteppedCommand close: 2 steps of {device!r}>"
        absent = refusal(device.point, "close")
        assert str(absent) == "close is a command of this device: close.send() sends it"
