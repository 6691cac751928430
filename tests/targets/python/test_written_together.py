"""Points that a device takes in one request alone: what the client sends, and what it refuses before any traffic."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.live.connection import device_class
from fieldscribe_runtime import AccessError, FieldscribeError, RequestError
from support.async_classes import async_device_class
from support.described import described, loaded_in
from support.python_package import Slave

POINTS = """\
- {name: low, at: 0, range: 0..high, write_with: [high]}
- {name: high, at: 1, range: low..100}
- {name: mode, at: 5, bits: 3..0, write_with: [gain, wide]}
- {name: gain, at: 5, bits: 11..8, write_with: [mode]}
- {name: wide, at: 6, type: u32}
- {name: seen, at: 8, access: r}
- {name: far, at: 20}
"""


class AwaitedSlave(Slave):
    async def exchange(self, request: bytes) -> bytes:  # type: ignore[override]  # the async twin
        return super().exchange(request)


@pytest.fixture
def line() -> Slave:
    slave = Slave()
    slave.words = {0: 10, 1: 20, 5: 0xABCD}
    return slave


def made(line: Slave, folder: Path, *, awaiting: bool = False) -> Any:
    model = loaded_in(folder, described(POINTS))
    kind: Any = async_device_class(model) if awaiting else device_class(model)
    return kind(line, 1)


def test_one_request_brings_all(line: Slave, tmp_path: Path) -> None:
    """A limit that another one of the request moves, by the order of the call; bits of others stay."""
    device = made(line, tmp_path)
    device.write_together({"high": 50, device.low: 40})
    assert (line.words[0], line.words[1], line.log[-1]) == (40, 50, (16, 0, 2))
    device.write_together({"mode": 1, "gain": 2, "wide": 0x00010002})
    assert ([line.words[at] for at in (5, 6, 7)], line.log[-2:]) == ([0xA2C1, 1, 2], [(3, 5, 1), (16, 5, 3)])


def test_the_async_device_does_the_same(tmp_path: Path) -> None:
    line = AwaitedSlave()
    line.words = {0: 10, 1: 20}
    asyncio.run(made(line, tmp_path, awaiting=True).write_together({"high": 50, "low": 40}))
    assert (line.words[0], line.words[1]) == (40, 50)


@pytest.mark.parametrize(
    ("values", "kind", "message"),
    [
        ({"low": 1}, RequestError, "low is written in one request with high"),
        ({"high": 2}, RequestError, "high is written in one request with low"),
        ({"gain": 1, "wide": 2}, RequestError, "gain is written in one request with mode"),
        ({"mode": 1, "gain": 2}, RequestError, "mode is written in one request with wide"),
        ({"low": 1, "high": 2, "far": 3}, RequestError, "takes points that one request can write: adjacent"),
        ({}, RequestError, "takes points that one request can write"),
        ({"seen": 1}, AccessError, "seen cannot be written"),
        ({"nobody": 1}, AccessError, "nobody is no point of this device"),
        ({"high": 101, "low": 1}, FieldscribeError, "high"),
        ({"high": "x", "low": 1}, FieldscribeError, "high"),
    ],
)
def test_what_no_request_can_bring(
    values: dict[str, Any], kind: type[Exception], message: str, line: Slave, tmp_path: Path
) -> None:
    with pytest.raises(kind, match=message):
        made(line, tmp_path).write_together(values)
    assert not [entry for entry in line.log if entry[0] != 3]


def test_one_alone_is_refused_before_any_request(line: Slave, tmp_path: Path) -> None:
    """So is its raw number; a point without partners is written."""
    device = made(line, tmp_path)
    for name, partners in (("low", "high"), ("mode", "gain, wide")):
        with pytest.raises(RequestError, match=f"is written in one request with {partners}") as caught:
            device.point(name).write_raw(1)
        assert caught.value.status == "not_together"
    with pytest.raises(RequestError, match="low is written in one request with high"):
        device.low.write(5)
    assert not [entry for entry in line.log if entry[0] != 3]
    device.far.write(3)
    assert line.words[20] == 3
