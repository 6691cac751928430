"""Dates and times in parts: the objects of Python, and what is refused or cannot be read."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, date, datetime, time
from typing import Any

import pytest
from support.described import kitchen_sink
from support.python_package import Slave, error, imported, write_package


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    yield from imported(write_package(kitchen_sink(), tmp_path_factory.mktemp("dates")), "kitchen_sink")


class Day(date):
    """A date of another library."""


NOON = datetime(1999, 12, 31, 12, 30, 15)


@pytest.mark.parametrize(
    ("name", "written", "words", "read"),
    [
        (
            "local_time",
            datetime(2024, 2, 29, 3, 2, 1, 999999),
            [0x1802, 0x1D03, 0x0201],
            datetime(2024, 2, 29, 3, 2, 1),
        ),
        ("meter_time", NOON, [0x3015, 0x0612, 0x1231, 0x0099], NOON),
        ("switch_on_time", time(6, 30, 59), [6, 30], time(6, 30)),
        (
            "event_time",
            datetime(2026, 11, 29, 8, 15, 30, 250999),
            [0x001A, 0x0BFD, 0x080F, 0x762A],
            datetime(2026, 11, 29, 8, 15, 30, 250000),
        ),
        ("rest_day", Day(2026, 11, 29), [0x0000, 0x0029, 0x0011, 0x2026], date(2026, 11, 29)),
    ],
)
def test_values_travel(package: Any, name: str, written: Any, words: list[int], read: Any) -> None:
    slave = Slave()
    point = getattr(package.KitchenSink(slave, unit=1, voltage="230V", model="small"), name)
    point.write(written)
    assert [slave.words[address] for address in point.facts.at.addresses] == words
    assert point.read() == read


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("local_time", datetime(2024, 1, 1, tzinfo=UTC), "takes a time without a zone, as the device keeps it"),
        ("local_time", date(2024, 1, 1), "takes a datetime.datetime, not datetime.date(2024, 1, 1)"),
        ("rest_day", datetime(2024, 1, 1), "takes a datetime.date, not datetime.datetime(2024, 1, 1, 0, 0)"),
        ("switch_on_time", "6:30", "takes a datetime.time, not '6:30'"),
        ("local_time", datetime(1999, 12, 31), "1999-12-31 00:00:00 is no date and time that the point can hold"),
        ("local_time", datetime(2256, 1, 1), "2256-01-01 00:00:00 is no date and time that the point can hold"),
    ],
)
def test_what_is_refused(package: Any, name: str, value: Any, message: str) -> None:
    point = getattr(package.KitchenSink, name)
    assert message in str(error(lambda: point.encode(value)))


@pytest.mark.parametrize("raw", [0, 0x005F, 0xFFFF])
def test_what_is_no_date(package: Any, raw: int) -> None:
    refused = error(lambda: package.KitchenSink.sold_on.decode(raw))
    assert refused.status == "malformed"
    assert str(refused) == f"sold_on: words {raw:04X}h are no date"
