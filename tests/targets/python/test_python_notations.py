"""Bytes and times in the notation of people: the same in the generator and in the runtime of Python."""

from __future__ import annotations

import importlib
import json
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from fractions import Fraction
from typing import Any

import pytest
from fieldscribe.arithmetic import texts as notations
from support.described import kitchen_sink
from support.notation_rows import BYTES, NONE
from support.python_package import Slave, error, imported, write_package


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    yield from imported(write_package(kitchen_sink(), tmp_path_factory.mktemp("notations")), "kitchen_sink")


@pytest.fixture
def runtime(package: Any) -> Any:
    """The runtime of the generated package."""
    del package
    return importlib.import_module("fieldscribe_runtime")


@pytest.mark.parametrize(("notation", "text", "held"), BYTES)
def test_bytes(runtime: Any, notation: str, text: str, held: str) -> None:
    data, form = bytes.fromhex(held), runtime.Bytes(len(held) // 2, notation)
    assert notations.bytes_of(notation, text, len(data)) == data
    raw = form.converted(text, {})
    assert raw == int.from_bytes(data, "big")
    assert form.decode(raw, {}) == notations.notated(notation, data)
    assert form.converted(form.decode(raw, {}), {}) == raw


@pytest.mark.parametrize(("notation", "text", "count"), NONE)
def test_what_is_none(runtime: Any, notation: str, text: str, count: int) -> None:
    assert notations.bytes_of(notation, text, count) is None
    assert runtime.Bytes(count, notation).converted(text, {}) is None


@pytest.mark.parametrize(
    ("epoch", "text", "seconds"),
    [
        ("1970-01-01", "2026-11-29T12:00:00Z", 1795953600),
        ("1970-01-01", "2026-11-29 13:00+01:00", 1795953600),
        ("2000-01-01", "2000-01-01", 0),
        ("2000-01-01", "1999-12-31T23:59:59.750", Fraction(-1, 4)),
        ("1900-01-01", "1970-01-01", 2208988800),
    ],
)
def test_times(runtime: Any, epoch: str, text: str, seconds: Fraction) -> None:
    assert notations.seconds_of(epoch, text) == seconds
    assert notations.seconds_of(epoch, notations.date_of(epoch, Fraction(seconds))) == seconds
    time = datetime.fromisoformat(epoch).replace(tzinfo=UTC) + timedelta(seconds=float(seconds))
    form = runtime.Time(runtime.Scaled(runtime.S64, runtime.Rule(num=1000), decimals=3), epoch)
    raw = form.converted(time, {})
    assert (raw, form.decode(raw, {})) == (seconds * 1000, time)


@pytest.mark.parametrize(
    ("microseconds", "raw"),
    [(499_999, 0), (500_000, 1), (1_500_000, 2), (2_500_000, 3), (2_500_001, 3), (-500_000, -1), (-2_500_000, -3)],
)
def test_a_half_second_rounds_away_from_the_date(runtime: Any, microseconds: int, raw: int) -> None:
    time = datetime(2000, 1, 1, tzinfo=UTC) + timedelta(microseconds=microseconds)
    assert runtime.Time(runtime.Integer(runtime.S32), "2000-01-01").converted(time, {}) == raw


@pytest.mark.parametrize(("raw", "microseconds"), [(1, 7813), (2, 15625), (5, 39063), (-1, -7813)])
def test_half_a_microsecond_rounds_away_from_the_date(runtime: Any, raw: int, microseconds: int) -> None:
    """A count of 1/128 s."""
    form = runtime.Time(runtime.Scaled(runtime.S32, runtime.Rule(num=128), decimals=None), "2000-01-01")
    time = datetime(2000, 1, 1, tzinfo=UTC) + timedelta(microseconds=microseconds)
    assert form.decode(raw, {}) == time
    assert notations.date_of("2000-01-01", Fraction(raw, 128)) == time.replace(tzinfo=None).isoformat() + "Z"


def test_no_number_is_no_time(runtime: Any) -> None:
    form = runtime.Time(runtime.Floating(runtime.F32), "1970-01-01")
    with pytest.raises(runtime.MalformedError, match="is a time beyond Python's range"):
        form.decode(0x7F800000, {})
    with pytest.raises(runtime.MalformedError, match="is a time beyond Python's range"):
        form.decode(0x7FC00000, {})


def test_times_that_python_has_not(runtime: Any) -> None:
    form = runtime.Time(runtime.Integer(runtime.U64), "1970-01-01")
    assert notations.date_of("1970-01-01", Fraction(1 << 63)) == ""
    with pytest.raises(runtime.MalformedError, match="is a time beyond Python's range"):
        form.decode(1 << 63, {})
    assert form.shown(1 << 63, {}) == str(1 << 63)
    with pytest.raises(runtime.WrongTypeError, match="takes a time with a zone"):
        form.converted(datetime(2026, 11, 29), {})
    assert form.converted(datetime(1970, 1, 1, 0, 0, 2, 600_000, UTC), {}) == 3
    assert [notations.seconds_of("1970-01-01", text) for text in ("", "noon", "2026-13-01", "5")] == [None] * 4


def test_a_device_has_them(package: Any) -> None:
    line = Slave()
    device = package.KitchenSink(line, 1)
    time = datetime(2026, 11, 29, 12, 0, 0, 500_000, UTC)
    for name, value, text in (
        ("network_address", "10.0.0.1", "10.0.0.1"),
        ("hardware_address", "00:1a:2b:3c:4d:5e", "00:1A:2B:3C:4D:5E"),
        ("loader_version", "1.15.0.3", "1.15.0.3"),
        ("last_service", time, "2026-11-29T12:00:00.500000+00:00"),
    ):
        point = getattr(device, name)
        point.write(value)
        read = point.read()
        assert read == (text if isinstance(value, str) else value)
        assert point.text(read) == text
        [row] = json.loads(json.dumps(device.rows(device.read_many([name]))))
        assert row["value"] == text
    assert device.read_at("holding", 0x1C80, 7) == (10, 0, 0, 1, 0x1A00, 0x3C2B, 0x5E4D)
    refused = error(device.network_address.write, "10.0.0")
    assert (refused.status, str(refused)) == ("out_of_range", "network_address: 10.0.0 is not 4 bytes as ipv4")
    assert str(device.clock.special(0xFFFFFFFF)) == "not_set"
