"""A text that is longer than a request goes in several; the kitchen sink reads 16 words at once, and writes 12."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from support.described import kitchen_sink
from support.python_package import Slave, error, imported, write_package

TEXT = "Call the works before this unit is opened: 0049 30 1234567"


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    yield from imported(write_package(kitchen_sink(), tmp_path_factory.mktemp("long")), "kitchen_sink")


def test_it_is_written_and_read_in_parts(package: Any) -> None:
    line = Slave()
    device = package.KitchenSink(line, 1)
    device.service_note.write(TEXT)
    writes = [(0x10, 0x1C50, 12), (0x10, 0x1C5C, 12), (0x10, 0x1C68, 7)]
    assert line.log == writes
    assert device.service_note.read() == TEXT
    reads = [(0x03, 0x1C50, 16), (0x03, 0x1C60, 15)]
    assert line.log == writes + reads
    assert device.read_many(["service_note", "check_letter"])["service_note"] == TEXT
    assert line.log[5:] == [(0x03, 0x1C30, 1), *reads]


def test_other_words_than_those_of_a_text_are_not_parted(package: Any) -> None:
    line = Slave()
    device = package.KitchenSink(line, 1)
    assert error(device.write_at, "holding", 0x1C50, *[0] * 13).status == "bad_count"
    assert error(device.read_at, "holding", 0x1C50, 17).status == "bad_count"
    assert line.log == []


def test_what_is_no_unicode_is_malformed(package: Any) -> None:
    line = Slave()
    device = package.KitchenSink(line, 1)
    device.station_name.write("Süd 1")
    assert device.station_name.read() == "Süd 1"
    device.write_at("holding", 0x1C31, 0x41E4, 0x4200)
    refused = error(device.station_name.read)
    assert (refused.status, refused.point) == ("malformed", "station_name")
    assert device.read_many(["station_name"], errors="return")["station_name"].status == "malformed"
    assert error(device.station_name.write, "Zürich-Süd").status == "out_of_range"


def test_words_that_are_not_neighbours_come_by_several_requests(package: Any) -> None:
    line = Slave()
    device = package.KitchenSink(line, 1)
    for address, word in ((0x1CB0, 1), (0x1CB4, 2), (0x1CC0, 3), (0x1CB8, 4), (0x1CB9, 5)):
        device.write_at("holding", address, word)
    line.log.clear()
    assert device.split_counter.read() == 0x10002
    assert device.split_total.read() == 0x300040005
    reads = [(3, 0x1CB0, 1), (3, 0x1CB4, 1), (3, 0x1CB8, 2), (3, 0x1CC0, 1)]
    assert line.log == reads
    many = device.read_many(["check_letter", "split_total", "split_counter"])
    assert (many["split_counter"], many["split_total"]) == (0x10002, 0x300040005)
    assert sorted(line.log[4:]) == sorted([(3, 0x1C30, 1), *reads])
    assert not hasattr(device.split_counter, "write")
