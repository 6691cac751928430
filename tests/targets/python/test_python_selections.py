"""Addresses whose meaning a page and an index select: clients write these before, and remember what stands."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from typing import Any

import pytest
from support.described import kitchen_sink
from support.python_package import Awaited, imported, status, write_package
from support.windows import INDEX, PAGE, RESTARTS, WINDOW, Windowed


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    folder = write_package(kitchen_sink(), tmp_path_factory.mktemp("selections"))
    yield from imported(folder, "kitchen_sink")


def test_only_what_does_not_stand_is_written(package: Any) -> None:
    line = Windowed()
    device = package.KitchenSink(line, 1)
    assert device.input_delay_index_2.read() == 2.0
    assert (line.sent, line.asked) == ([(PAGE, 1), (INDEX, 11)], [(WINDOW, 1)])
    assert device.input_counter_index_2.read() == 102
    device.input_delay_index_3.write(4.5)
    assert line.sent[2:] == [(INDEX, 12), (WINDOW, 45)]
    assert line.behind[1, 12][0] == 45
    assert device.output_mode.read() == 1
    assert line.sent[4:] == [(PAGE, 2)]


def test_a_group_is_read_selection_by_selection(package: Any) -> None:
    line = Windowed()
    values = package.KitchenSink(line, 1).read_many("window")
    counted = {f"input_counter_index_{index}": 100 + index for index in (1, 2, 3)}
    assert values == {f"input_delay_index_{index}": float(index) for index in (1, 2, 3)} | counted
    assert line.sent == [(PAGE, 1), (INDEX, 10), (INDEX, 11), (INDEX, 12)]
    assert line.asked == [(WINDOW, 3)] * 3


def test_what_may_have_changed_is_written_again(package: Any) -> None:
    line = Windowed()
    device = package.KitchenSink(line, 1)
    device.input_delay_index_1.read()
    device.page.write(0)
    assert device.input_delay_index_1.read() == 1.0
    assert line.sent == [(PAGE, 1), (INDEX, 10), (PAGE, 0), (PAGE, 1), (INDEX, 10)]
    line.is_dead = True
    assert status(device.input_delay_index_1.read)[0] == "timeout"
    line.is_dead, line.sent = False, []
    assert device.input_delay_index_1.read() == 1.0
    device.forget()
    device.input_delay_index_1.read()
    assert line.sent == [(PAGE, 1), (INDEX, 10)] * 2


@pytest.mark.parametrize(("at", "given", "sent"), RESTARTS)
def test_a_retry_selects_again(package: Any, at: int, given: list[float], sent: list[Any]) -> None:
    line = Windowed()
    device = package.KitchenSink(line, 1)
    device.retries = 1
    line.restarts_at = at
    got = getattr(device.input_delay_index_2, "write" if given else "read")(*given)
    assert got == (None if given else 2.0)
    assert line.sent == sent
    assert line.behind[1, 11][0] == (45 if given else 20)


def test_with_await(package: Any) -> None:
    line = Windowed()
    device = package.KitchenSinkAsync(Awaited(line), 1)
    assert asyncio.run(device.read_many(["input_delay_index_2", "output_mode"])) == {
        "input_delay_index_2": 2.0,
        "output_mode": 1,
    }
    assert line.sent == [(PAGE, 1), (INDEX, 11), (PAGE, 2)]


def test_one_request_has_one_selection(package: Any) -> None:
    line = Windowed()
    device = package.KitchenSink(line, 1)
    device.write_together({"input_delay_index_2": 3.0})
    assert line.sent == [(PAGE, 1), (INDEX, 11), (WINDOW, 30)]
    both = {"input_delay_index_2": 3.0, "input_delay_index_3": 3.0}
    assert status(lambda: device.write_together(both))[0] == "not_together"
