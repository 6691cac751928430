"""What people type and see of bytes and times: the same text both ways."""

from __future__ import annotations

import pytest
from fieldscribe.conversation.encoding import encode_point
from fieldscribe.conversation.meanings import Meanings
from fieldscribe.diagnostics import RefusedError
from support.described import kitchen_sink

POINTS = {point.name: point for point in kitchen_sink().points}


@pytest.mark.parametrize(
    ("name", "typed", "raw", "seen"),
    [
        ("network_address", "10.0.0.1", 0x000A000000000001, "10.0.0.1"),
        ("hardware_address", "00-1a-2b-3c-4d-5e", 0x1A003C2B5E4D, "00:1A:2B:3C:4D:5E"),
        ("device_key", "0011 2233 4455 6677", 0x0011223344556677, "0011223344556677"),
        ("loader_version", "1.15.0.3", 0x1F03, "1.15.0.3"),
        ("clock", "2026-11-29T13:00+01:00", 1795953600, "2026-11-29T12:00:00Z"),
        ("clock", "1795953600", 1795953600, "2026-11-29T12:00:00Z"),
        ("last_service", "2000-01-01T00:00:01.5", 1500, "2000-01-01T00:00:01.500000Z"),
        ("last_service", "90 s", 90000, "2000-01-01T00:01:30Z"),
        ("local_time", "2024-02-29 23:59:58.9", 0x18021D173B3A, "2024-02-29T23:59:58"),
        ("meter_time", "1999-12-31T12:30:15", 0x3015061212310099, "1999-12-31T12:30:15"),
        ("switch_on_time", "06:30", 0x0006001E, "06:30:00"),
        ("event_time", "2026-11-30T08:15:30.250", 0x001A0B3E080F762A, "2026-11-30T08:15:30.250000"),
        ("rest_day", "2026-11-29", 0x0000002900112026, "2026-11-29"),
    ],
)
def test_values(name: str, typed: str, raw: int, seen: str) -> None:
    encoded = encode_point(kitchen_sink(), POINTS[name], typed, {})
    assert encoded.raw == raw
    assert encoded.text.startswith(f"{name} = {seen}: ")
    assert Meanings(kitchen_sink(), POINTS[name]).of(raw, {}).text == seen


@pytest.mark.parametrize(
    ("name", "raw"),
    [("local_time", 0), ("local_time", (1 << 48) - 1), ("sold_on", 0x005F), ("meter_time", 0x0A << 104)],
)
def test_what_is_no_date(name: str, raw: int) -> None:
    text = Meanings(kitchen_sink(), POINTS[name]).of(raw & (1 << 16 * POINTS[name].words) - 1, {}).text
    assert text.startswith("not known: the words are no date")


def test_a_time_that_no_calendar_has() -> None:
    assert Meanings(kitchen_sink(), POINTS["last_service"]).of((1 << 48) - 1, {}).text == "about 2.81474977e+11 s"


@pytest.mark.parametrize(
    ("name", "typed", "message"),
    [
        ("network_address", "10.0.0", "`10.0.0` is not 4 bytes, ipv4, one in the low byte of each word"),
        ("loader_version", "1.16.0.0", "`1.16.0.0` is not 2 bytes, version of nibbles"),
        ("local_time", "2256-01-01T00:00", "`2256-01-01T00:00` is no date and time of local_time"),
        ("local_time", "2025-02-29T00:00", "`2025-02-29T00:00` is no date and time of local_time"),
        ("local_time", "2025-01-01T00:00Z", "`2025-01-01T00:00Z` is no date and time of local_time"),
        ("switch_on_time", "24:00", "`24:00` is no time of switch_on_time"),
        ("clock", "2200-01-01", "clock: 7258118400 is outside 0..4294967294"),
    ],
)
def test_what_is_refused(name: str, typed: str, message: str) -> None:
    with pytest.raises(RefusedError) as refused:
        encode_point(kitchen_sink(), POINTS[name], typed, {})
    assert refused.value.message == message
