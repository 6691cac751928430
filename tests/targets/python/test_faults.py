"""Replies that are broken, cut, late, doubled, foreign or missing, at each byte: the error comes in time, and the next
request has its reply."""

from __future__ import annotations

import asyncio
import importlib
import logging
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from typing import Any, NamedTuple

import pytest
from support.line_ends import pty_end
from support.places import PACKAGES
from support.python_families import CanUnit, UssDrive
from support.python_package import Slave, imported, status
from support.python_transports import behind_a_gateway, socket_end, transport, with_word

TIMEOUTS = (0.06, 0.6, 3.0)
"""So long a line waits for a spoiled reply, longer at each try: other work on the machine delays both ends."""
PATIENCE = 5.0
"""So long it waits for the good reply after that."""
REST = 0.02
"""So long after a good reply a program reads again."""
MOST = 3.0
"""An error comes so many seconds after the timeout at the latest, on such a machine."""

Fault = Callable[[bytes], Iterator[bytes]]

AT_EACH_BYTE: dict[str, Callable[[bytes, int], bytes]] = {
    "broken": lambda reply, at: reply[:at] + bytes((reply[at] ^ 0xFF,)) + reply[at + 1 :],
    "cut": lambda reply, at: reply[:at],
    "without it": lambda reply, at: reply[:at] + reply[at + 1 :],
    "twice": lambda reply, at: reply[: at + 1] + reply[at:],
}
TCP = {  # the errors by position; a broken word (and a byte too many behind it) is none that TCP could tell
    "broken": "wrong_transaction*2 bad_protocol*2 long_frame timeout wrong_unit wrong_function bad_byte_count ok*2",
    "cut": "timeout*11",
    "without it": "long_frame*5 short_frame timeout*5",
    "twice": "short_frame*5 wrong_unit wrong_function bad_byte_count ok*3",
}
RTU = {
    "broken": "bad_crc timeout long_frame bad_crc*4",
    "cut": "timeout*7",
    "without it": "bad_crc*3 timeout*4",
    "twice": "bad_crc*6 ok",
}
USS = {
    "broken": "wrong_start timeout wrong_check*14",
    "cut": "timeout*16",
    "without it": "wrong_start*2 timeout*14",
    "twice": "wrong_start wrong_check*14 ok",
}
ERRORS = {"tcp": TCP, "rtu": RTU, "uss": USS}
SIZES = {"tcp": 11, "rtu": 7, "uss": 16}


def late(reply: bytes) -> Iterator[bytes]:
    time.sleep(1.5 * ends.timeout)
    yield reply


def repeated(reply: bytes) -> Iterator[bytes]:
    yield reply
    time.sleep(REST / 4)
    yield reply


def noise(_: bytes) -> Iterator[bytes]:
    while ends.noise:
        yield b"\x55"
        time.sleep(0.002)


def of_another(reply: bytes) -> bytes:
    """The reply of unit 9, or with TCP to another request."""
    if len(reply) == SIZES["uss"]:
        return reply[:2] + b"\x09" + reply[3:-1] + bytes((reply[-1] ^ reply[2] ^ 9,))
    return b"\x09" + reply[1:] if len(reply) == SIZES["tcp"] else with_word(b"\x09" + reply[1:2], reply[-3])


WHOLE: dict[str, tuple[Fault, dict[str, str]]] = {
    "missing": (lambda _: iter(()), {"": "timeout"}),
    "late": (late, {"": "timeout"}),
    "doubled": (lambda reply: iter((reply + reply,)), {"": "ok"}),
    "repeated": (repeated, {"": "ok"}),
    "in pieces": (lambda reply: iter([bytes((byte,)) for byte in reply]), {"": "ok"}),
    "foreign": (lambda reply: iter((of_another(reply),)), {"": "wrong_unit", "tcp": "wrong_transaction"}),
    "behind a foreign one": (lambda reply: iter((of_another(reply), reply)), {"": "ok"}),
    "joined to a foreign one": (lambda reply: iter((of_another(reply) + reply,)), {"": "ok"}),
    "noise without end": (noise, {"": "timeout", "tcp": "long_frame"}),
    "too many bytes": (lambda _: iter((b"\x55" * 3000,)), {"": "long_frame", "uss": "wrong_start"}),
}


class Ends:
    """The other end of all lines: it numbers its replies, and spoils the next one."""

    fault: Fault | None = None
    noise = False
    timeout = 0.0
    number = 0
    mm4 = UssDrive()

    def answer(self, request: bytes) -> Iterator[bytes]:
        self.number = self.number % 250 + 1
        if request[0] == 2:
            self.mm4.ram[1, 0] = (self.number,)
            reply = self.mm4.exchange(request)
        elif request[2:4] == b"\0\0":
            reply = request[:4] + b"\0\5" + request[6:8] + b"\2\0" + bytes((self.number,))
        else:
            reply = with_word(request, self.number)
        fault, self.fault = self.fault, None
        return iter((reply,)) if fault is None else fault(reply)


ends = Ends()


class Read(NamedTuple):
    """A line, and a read over it."""

    line: Any
    once: Callable[[], Any]


@pytest.fixture(scope="module")
def reads() -> Iterator[dict[str, Read]]:
    """A read over each line, by the name of the line and its framing."""
    with ExitStack() as stack:
        l200 = stack.enter_context(contextmanager(imported)(PACKAGES, "hitachi_l200"))
        drive, tcp = behind_a_gateway(l200.HitachiL200), transport("tcp")
        port, pty = stack.enter_context(socket_end(ends.answer)), stack.enter_context(pty_end(ends.answer))
        lines = {
            "TcpLine tcp": tcp.TcpLine("127.0.0.1", port),
            "TcpLine rtu": tcp.TcpLine("127.0.0.1", port, framing="rtu"),
            "SerialLine rtu": transport("serial").SerialLine(pty, 115200),
            "SerialLine socket:// rtu": transport("serial").SerialLine(f"socket://127.0.0.1:{port}", 115200),
        }
        for line in lines.values():
            stack.callback(line.close)
        made = {name: Read(line, partial(drive(line, 1).read_at, "holding", 2)) for name, line in lines.items()}
        for framing in ("tcp", "rtu"):
            line = tcp.AsyncTcpLine("127.0.0.1", port, framing=framing)
            awaiting = behind_a_gateway(l200.HitachiL200Async)(line, 1)
            made[f"AsyncTcpLine {framing}"] = Read(line, partial(awaited, awaiting))
        siemens = stack.enter_context(contextmanager(imported)(PACKAGES, "siemens_mm4")).SiemensMm4
        link = importlib.import_module("fieldscribe_runtime.uss").Link(4, 2)
        pty = stack.enter_context(pty_end(ends.answer))
        line = stack.enter_context(transport("serial").UssLine(pty, 115200))
        made["UssLine uss"] = Read(line, partial(siemens(line, 1, link).read_at, "parameter", 1))
        yield made


def awaited(drive: Any) -> Any:
    return asyncio.run(drive.read_at("holding", 2))


def waiting(line: Any, timeout: float) -> None:
    """Let a line wait so long from now on."""
    for owner in (line, getattr(line, "_connection", line)):
        owner.timeout = timeout


def spoiled(read: Read, fault: Fault, expected: str) -> str:
    """The status of a read whose reply is spoiled; it ends in time, and the next read has its reply."""
    for timeout in TIMEOUTS:
        found = _tried(read, fault, timeout)
        if found == expected:
            break
    return found


def _tried(read: Read, fault: Fault, timeout: float) -> str:
    ends.fault, ends.noise, ends.timeout = fault, True, timeout
    waiting(read.line, timeout)
    before = time.monotonic()
    found: str = status(read.once)[0]
    took, ends.noise = time.monotonic() - before, False
    assert took < timeout + MOST
    time.sleep(REST if found == "ok" else 0)
    waiting(read.line, PATIENCE)
    words: list[int] = []
    again, message = status(lambda: words.extend(read.once()))
    return found if words == [ends.number] else f"{found}, then {again} {words} {message}"


LINES = (
    *("TcpLine tcp", "TcpLine rtu", "SerialLine rtu", "SerialLine socket:// rtu", "AsyncTcpLine tcp"),
    *("AsyncTcpLine rtu", "UssLine uss"),
)


@pytest.mark.full(seconds=0.5)
@pytest.mark.parametrize("kind", AT_EACH_BYTE)
@pytest.mark.parametrize("line", [line for line in LINES if "://" not in line])  # which differs in its port alone
def test_each_byte_of_a_reply(line: str, kind: str, reads: dict[str, Read]) -> None:
    errors = _each(ERRORS[line[-3:]][kind])
    assert len(errors) == SIZES[line[-3:]]
    assert [spoiled(reads[line], partial(_spoiled_at, kind, at), error) for at, error in enumerate(errors)] == errors


def _spoiled_at(kind: str, at: int, reply: bytes) -> Iterator[bytes]:
    yield AT_EACH_BYTE[kind](reply, at)


@pytest.mark.full(seconds=0.1)
@pytest.mark.parametrize("kind", WHOLE)
@pytest.mark.parametrize("line", LINES)
def test_whole_replies(line: str, kind: str, reads: dict[str, Read]) -> None:
    fault, errors = WHOLE[kind]
    expected = errors.get(line[-3:]) or errors[""]
    assert spoiled(reads[line], fault, expected) == expected


@pytest.mark.parametrize("line", LINES)
def test_bytes_that_are_no_reply_are_logged(
    line: str, reads: dict[str, Read], caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.DEBUG, "fieldscribe"):
        spoiled(reads[line], lambda _: iter((b"\x55" * 12,)), "long_frame" if line[-3:] == "tcp" else "timeout")
    came = [one for one in caplog.messages if "<- 55 55 55 55" in one]
    sent = [one for one in caplog.messages if " -> " in one]
    assert 2 * len(came) == len(sent) > 0, caplog.messages  # each try sends a good request, too
    assert line == "UssLine uss" or "12 bytes came (55 55" in caplog.text


def _each(statuses: str) -> list[str]:
    """Statuses position by position: `ok*2` is two."""
    counted = [one.partition("*") for one in statuses.split()]
    return [name for name, _, count in counted for _ in range(int(count or 1))]


class Losing:
    """A peer that loses what it was asked first, so often."""

    def __init__(self, peer: Any, times: int) -> None:
        self.peer, self.framing, self.times, self.sent = peer, getattr(peer, "framing", "uss"), times, 0

    def exchange(self, request: bytes) -> bytes:
        self.sent += 1
        reply: bytes = self.peer.exchange(request)
        self.times -= 1
        if self.times >= 0:
            raise TimeoutError("no byte came")
        return reply

    def send(self, frame: Any) -> None:
        self.sent += 1
        self.peer.send(frame)
        self.times -= 1
        if self.times >= 0:
            self.peer.waiting.clear()

    def receive(self) -> Any:
        return self.peer.receive()


def on_modbus(line: Callable[[Any], Any]) -> tuple[Any, Any]:
    package = importlib.import_module("hitachi_l200")
    drive = behind_a_gateway(package.HitachiL200)(line(Slave("tcp")), 1)
    return drive, drive.base_frequency


def on_uss(line: Callable[[Any], Any]) -> tuple[Any, Any]:
    package, uss = importlib.import_module("siemens_mm4"), importlib.import_module("fieldscribe_runtime.uss")
    mm4 = UssDrive()
    mm4.ram[1082, 0] = (0x4248, 0)
    drive = package.SiemensMm4(line(mm4), 1, uss.Link(4, 2))
    return drive, drive.maximum_frequency


def on_can(line: Callable[[Any], Any]) -> tuple[Any, Any]:
    package, frames = importlib.import_module("woodward_mpu2s"), importlib.import_module("fieldscribe_runtime.can")
    device = package.WoodwardMpu2s(line(CanUnit(frames.Frame, 1)), 1)
    return device, device.generator_frequency_setpoint


@pytest.mark.parametrize(
    ("name", "made"), [("hitachi_l200", on_modbus), ("siemens_mm4", on_uss), ("woodward_mpu2s", on_can)]
)
def test_what_is_lost_is_sent_again(name: str, made: Any, caplog: pytest.LogCaptureFixture) -> None:
    with contextmanager(imported)(PACKAGES, name), caplog.at_level("DEBUG", "fieldscribe"):
        device, point = made(lambda peer: Losing(peer, 2))
        device.retries = 1
        assert status(point.read)[0] == "timeout"
        device.retries = 2
        point.read()
        assert (device.traffic.requests, device.traffic.replies, device.traffic.errors) == (3, 1, {"timeout": 2})
        assert point.label in caplog.messages[0]
        assert "timeout" in repr(device.traffic)
        device.transport.times, device.retry_pause = 1, 0.05
        before = time.monotonic()
        point.read()
        assert time.monotonic() - before > device.retry_pause
        assert device.traffic.errors == {"timeout": 3}


def test_what_is_sent_once() -> None:
    """Commands, what the device refuses, and process data that changes."""
    with contextmanager(imported)(PACKAGES, "hitachi_l200"):
        drive, _ = on_modbus(lambda peer: Losing(peer, 1))
        drive.retries = 2
        assert status(drive.enter.send)[0] == "timeout"
        assert (drive.transport.sent, drive.retries) == (1, 2)
        drive.transport.peer.refuses[0x1028] = 2
        assert status(drive.base_frequency.read)[0] == "exception"
        assert (drive.transport.sent, drive.traffic.errors) == (2, {"timeout": 1, "exception": 1})
    with contextmanager(imported)(PACKAGES, "siemens_mm4"):
        drive, _ = on_uss(lambda peer: Losing(peer, 1))
        drive.retries = 2
        assert status(drive.write_at, "task", 1, 5)[0] == "timeout"
        assert (drive.transport.sent, drive.traffic.errors) == (1, {"timeout": 1})


CAN_FAULTS: dict[str, Callable[[bytes, int], list[bytes]]] = {
    "broken": lambda data, at: [data[:at] + bytes((data[at] ^ 0xFF,)) + data[at + 1 :]],
    "cut": lambda data, at: [data[:at]],
    "doubled": lambda data, _: [data, data],
    "missing": lambda _data, _at: [],
    "behind others": lambda data, at: [bytes((0xDD, at, 0, 0, 0, 0, 0, 0)), data[:2] + bytes(6), data],
}


class SpoilingUnit(CanUnit):
    """A unit whose answer to the next request is spoiled."""

    kind, at = "", 0

    def send(self, frame: Any) -> None:
        super().send(frame)
        if self.kind:
            answers = CAN_FAULTS[self.kind](self.waiting.pop().data, self.at)
            self.waiting += [self.frame(0x320 + self.number, data) for data in answers]
        self.kind = ""

    def receive_waiting(self) -> Any:
        return self.waiting.pop(0) if self.waiting else None


@pytest.mark.parametrize("kind", CAN_FAULTS)
def test_answers_on_a_can_bus(kind: str) -> None:
    with contextmanager(imported)(PACKAGES, "woodward_mpu2s") as package:
        unit = SpoilingUnit(importlib.import_module("fieldscribe_runtime.can").Frame, 1)
        point = package.WoodwardMpu2s(unit, 1).generator_frequency_setpoint
        for at in range(8):
            unit.parameters[11], unit.kind, unit.at = at, kind, at
            assert status(point.read_raw)[0] == ("ok" if kind in ("doubled", "behind others") else "timeout"), at
            unit.parameters[11] = 99
            assert point.read_raw() == 99
