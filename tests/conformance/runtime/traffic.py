"""What people see of a device beside its values: counters, what is sent again, the log, rows, limits and names."""

from __future__ import annotations

import json
import logging
from typing import Any

from conformance.package import Package
from conformance.runtime.bench import AsyncMemory, Memory, devices, refusal, table
from conformance.scripts import now


def _made(package: Package) -> list[tuple[Any, Any]]:
    """Both flavours of a device, and their lines."""
    runtime = package.runtime
    word = runtime.Integer(runtime.U16)
    codes = runtime.Codes({"off": 7, "over": (9, 12)})
    points = {
        "PROFILE": runtime.Profile(functions={3: 4, 6: 1}),
        "a": runtime.ReadWrite(word, at=runtime.holding(0), code="A1", unit="Hz"),
        "b": runtime.ReadOnly(runtime.WithCodes(word, codes), at=runtime.holding(1)),
        "store": runtime.Command(at=runtime.holding(5), value=1),
    }
    kinds = devices(package, points, runtime.ModbusDevice, runtime.AsyncModbusDevice)
    lines = Memory({0: 3, 1: 7}), AsyncMemory({0: 3, 1: 7})
    return [(kind(line, 1), line) for kind, line in zip(kinds, lines, strict=True)]


def check_retries(package: Package) -> None:
    """What the line loses is sent again so often; a refusal, a mistake and a command are not."""
    lost, wrong = TimeoutError("nothing came"), package.runtime.FrameError("bad_crc", "wrong")
    refused = package.runtime.ExceptionReplyError(2)
    for device, memory in _made(package):
        for retries, errors, status, counted in (
            (0, [lost], "timeout", {"timeout": 1}),
            (1, [lost], None, {"timeout": 1}),
            (2, [lost, wrong], None, {"bad_crc": 1, "timeout": 1}),
            (2, [lost, lost], None, {"timeout": 2}),
            (1, [wrong, lost], "bad_crc", {"bad_crc": 1, "timeout": 1}),
            (2, [refused], "exception", {"exception": 1}),
        ):
            device.retries, memory.errors = retries, list[BaseException](errors)
            device.traffic.clear()
            if status is None:
                assert now(device.a.read()) == 3
            else:
                assert refusal(device.a.read).status == status
            answered = status is None
            assert (device.traffic.requests, device.traffic.replies) == (len(errors) + answered, answered)
            assert device.traffic.errors == counted
        device.retries, memory.errors = 5, [lost]
        assert refusal(device.store.send).status == "timeout"
        assert device.retries == 5
        now(device.store.send())
        assert memory.words[5] == 1


def check_settings(package: Package) -> None:
    """What is no number of tries, or of seconds, is refused where it is set."""
    for device, _ in _made(package):
        for name, wrong in (("retries", (-1, 1.5, "two", True)), ("retry_pause", (-1, "1", float("nan"), None))):
            for value in wrong:
                error = refusal(setattr, device, name, value)
                assert (isinstance(error, ValueError), error.status) == (True, f"bad_{name}")
        device.retries, device.retry_pause = 3, 0.5


def check_absent_methods(package: Package) -> None:
    """What a point or a command cannot do is an AccessError, and an AttributeError; so are misspelt names."""
    for device, _ in _made(package):
        for owner, name, told in (
            (device.point("b"), "write", "b is only read: it has no write"),
            (device.store, "read", "store is a command: it has no read, use store.send()"),
        ):
            error = refusal(getattr, owner, name)
            assert (isinstance(error, package.runtime.AccessError), str(error)) == (True, told)
            assert not hasattr(owner, name)
        assert str(refusal(getattr, device, "stor")).startswith("'Made' object has no attribute 'stor'")
        assert refusal(device.rows, [("a", 1)]).status == "bad_value"


def check_times(package: Package) -> None:
    """Good replies are counted and timed, as their transport says or from their requests on."""
    for device, memory in _made(package):
        traffic = device.traffic
        assert (traffic.mean, traffic.longest, repr(traffic)) == (
            0.0,
            0.0,
            "<Traffic 0 requests, 0 replies; 0.0 ms each, 0.0 ms at most>",
        )
        for _ in range(3):
            now(device.a.read())
        assert 0 < traffic.mean <= traffic.longest <= traffic.total < 60
        assert traffic.total == traffic.mean * 3
        traffic.total, traffic.longest, traffic.errors = 0.006, 0.004, {"timeout": 2}
        assert repr(traffic) == "<Traffic 3 requests, 3 replies, 2 timeout; 2.0 ms each, 4.0 ms at most>"
        traffic.clear()
        memory._closed = lambda frame, close=memory._closed: _Timed(close(frame))
        assert now(device.a.read()) == 3
        memory._answer = lambda _: b"\3\4\0\0"
        assert refusal(device.a.read).status == "short_frame"
        memory._answer = lambda _: b"\x83\x02"
        assert refusal(device.a.read).status == "exception"
        assert (traffic.requests, traffic.replies, traffic.longest) == (3, 2, 5.0)


class _Timed(bytes):
    seconds = 5.0


def check_log(package: Package) -> None:
    """Frames stand in the log with the points that they are about, if the log takes debug messages."""
    messages: list[str] = []
    handler = logging.Handler()
    handler.emit = lambda record: messages.append(record.getMessage())  # type: ignore[method-assign]  # all it does
    logger = logging.getLogger("fieldscribe")
    level = logger.level
    logger.addHandler(handler)
    try:
        for device, memory in _made(package):
            logger.setLevel(logging.INFO)
            now(device.a.read())
            assert messages == []
            logger.setLevel(logging.DEBUG)
            now(device.a.read())
            now(device.read_at("holding", 1))
            memory.fails = TimeoutError("nothing came")
            refusal(device.store.send)
            memory.fails, device.retries = package.runtime.LineError("no line", unsent=True), 1
            logger.setLevel(logging.WARNING)
            traffic = device.traffic
            before = traffic.requests
            refusal(device.a.read)
            assert (traffic.requests - before, traffic.errors) == (0, {"timeout": 1, "line": 2})
            assert messages.pop() == "unit 1: not sent: line: no line (A1 a)"
            memory.fails = None
            sent, came, by_address, _, command, failed = messages
            assert sent == "unit 1 -> 01 03 00 00 00 01 84 0A (A1 a)"
            assert came.startswith("unit 1 <- 01 03 02 00 03 F8 45 after ")
            assert by_address.endswith("(holding 0x0001)")
            assert command.endswith("(store)")
            assert failed == "unit 1: timeout: unit 1 did not reply to function 06h: nothing came (store)"
            messages.clear()
    finally:
        logger.setLevel(level)
        logger.removeHandler(handler)


def check_rows(package: Package) -> None:
    """Values become rows that JSON takes, with units; special codes and errors stand in columns that hold no value."""
    for device, _ in _made(package):
        values = now(device.read_many(["a", "b"]))
        assert device.rows(values) == [
            _row("a", 3, code="A1", unit="Hz", raw=3),
            _row("b", None, raw=device.b.special.off.raw, status="special", detail="off"),
        ]
        values = now(device.read_many(["a", "zzz"], errors="return"))
        values["b"], values["a"] = error, _ = package.runtime.RangeError("too far"), float("inf")
        lost = "zzz is no point of this device: its `POINTS` lists their names"
        assert device.rows(values) == [
            _row("a", None, code="A1", unit="Hz", status="not_a_number", detail="inf"),
            _row("zzz", None, status="no_access", detail=lost),
            _row("b", None, status=error.status, detail="too far"),
        ]
        assert json.loads(json.dumps(device.rows(values))) == device.rows(values)


def _row(name: str, value: object, **others: object) -> dict[str, object]:
    return {"name": name, "code": None, "value": value, "unit": "", "raw": None, "status": "ok", "detail": ""} | others


def check_limits(package: Package) -> None:
    """Limits in the unit, whatever stands around the form; none where other points decide them."""
    runtime = package.runtime
    tenths, at = runtime.Rule(num=10), runtime.holding(0)
    falling, moved = runtime.Rule(num=-10, offset=(5, 1)), runtime.Rule(factors=(runtime.Factor("other"),))
    u16 = runtime.U16
    cases: list[tuple[Any, dict[str, Any], tuple[Any, Any]]] = [
        (runtime.Integer(u16), {}, (0, 65535)),
        (runtime.Integer(u16), {"allowed": ((3, 5), (1, 2))}, (1, 5)),
        (runtime.Scaled(u16, tenths, decimals=1), {"allowed": ((10, 4000),)}, (1.0, 400.0)),
        (runtime.Scaled(u16, falling, decimals=1), {"allowed": ((0, 105),)}, (-10.0, 0.5)),
        (runtime.Scaled(u16, moved, decimals=0), {"allowed": ((0, 105),)}, (None, None)),
        (runtime.Floating(runtime.F32), {}, (None, None)),
        (runtime.Floating(runtime.F32, units=((5.0, 9.0), (-1.0, 2.0))), {}, (-1.0, 9.0)),
        (runtime.Bit(), {}, (None, None)),
        (runtime.WithCodes(runtime.Integer(u16), runtime.Codes({"off": 0})), {"allowed": ((0, 8),)}, (0, 8)),
        (runtime.Integer(u16), {"fixed": (1, 1), "allowed": ((1, 9),)}, (1, 9)),
    ]
    for form, facts, expected in cases:
        point = table(package, some_point_2=runtime.ReadWrite(form, at=at, unit="V", **facts)).some_point_2
        assert (point.minimum, point.maximum) == expected, (form, facts)
        assert (point.title, point.unit) == ("Some point 2", "V")


def check_completion(package: Package) -> None:
    """Completion lists what people use, of a point that can do it, and the names of special codes."""
    for device, _ in _made(package):
        both, reads = set(dir(device.a)), set(dir(device.b))
        assert {"read", "write", "write_raw", "read_raw", "encode", "decode", "facts", "minimum"} <= both
        assert both - reads == {"write", "write_raw", "encode", "encode_count", "check"}
        assert not [name for name in both if name.startswith("_") or not hasattr(device.a, name)]
        assert (dir(device.b.special), dir(device.a.special)) == (["off", "over"], [])
        assert "read" not in dir(type(device).a)
