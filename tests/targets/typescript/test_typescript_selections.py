"""Addresses whose meaning a page and an index select, in TypeScript."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from support.blocks import served
from support.described import kitchen_sink
from support.node_device import NodeDevice, NodeError, installed, node_device
from support.typescript_packages import install
from support.windows import INDEX, PAGE, RESTARTS, WINDOW, Windowed

pytestmark = pytest.mark.full(4)


@pytest.fixture
def line() -> Windowed:
    return Windowed()


@pytest.fixture
def node(line: Windowed, tmp_path: Path) -> Iterator[NodeDevice]:
    folder = installed(tmp_path)
    install(folder, [kitchen_sink()])
    with (
        served(line) as port,
        node_device(folder, "kitchen_sink", {"kind": "tcp", "port": port, "framing": "rtu"}, unit=1) as device,
    ):
        yield device


def test_what_does_not_stand_is_written_before(line: Windowed, node: NodeDevice) -> None:
    assert node("input_delay_index_2", "read") == 2
    node("input_delay_index_3", "write", 4.5)
    assert line.sent == [(PAGE, 1), (INDEX, 11), (INDEX, 12), (WINDOW, 45)]
    node("page", "write", 0)
    assert node("input_delay_index_3", "read") == 4.5
    assert line.sent[4:] == [(PAGE, 0), (PAGE, 1), (INDEX, 12)]
    line.sent.clear()
    counted = {f"inputCounterIndex{index}": 100 + index for index in (1, 2, 3)}
    delays = {"inputDelayIndex1": 1, "inputDelayIndex2": 2, "inputDelayIndex3": 4.5}
    assert node(None, "readMany", "window") == delays | counted
    assert line.sent == [(INDEX, 10), (INDEX, 11), (INDEX, 12)]


@pytest.mark.parametrize(("at", "given", "sent"), RESTARTS)
def test_a_retry_selects_again(
    line: Windowed, node: NodeDevice, at: int, given: list[float], sent: list[tuple[int, int]]
) -> None:
    node.set(retries=1)
    line.restarts_at = at
    node("input_delay_index_2", "write" if given else "read", *given)
    assert line.sent == sent
    assert line.behind[1, 11][0] == (45 if given else 20)


def test_what_is_written_in_one_request_alone(line: Windowed, node: NodeDevice) -> None:
    line.held |= {120: 5, 121: 1}
    for name, partner in (("clock_hour", "clock_minute"), ("clock_minute", "clock_hour")):
        with pytest.raises(NodeError, match=f"{name} is written in one request with {partner}") as caught:
            node(name, "write", 3)
        assert caught.value.status == "not_together"
    with pytest.raises(NodeError, match="takes points that one request can write"):
        node(None, "writeTogether", {"clockHour": 12, "clockMinute": 30, "page": 1})
    with pytest.raises(NodeError, match="61 is outside"):
        node(None, "writeTogether", {"clockHour": 12, "clockMinute": 61})
    node(None, "writeTogether", {"clockHour": 12, "clockMinute": 30})
    assert (line.held[120], line.held[121], line.sent) == (30, 12, [])
    node(None, "writeTogether", {"page": 2})
    assert line.sent == [(PAGE, 2)], "one alone, as it has no partner"
