"""USS telegrams, held against the examples of the manual and against arithmetic done by hand."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from fieldscribe.families.uss import UssBus, of_bus
from fieldscribe.families.uss.telegrams import (
    Link,
    Part,
    Request,
    broadcast,
    build,
    check_byte,
    default_link,
    parameter_words,
    parse,
    part_of,
    telegram,
)
from fieldscribe.model import Bus, Code
from hypothesis import given
from hypothesis import strategies as st
from support.c_device import write_headers
from support.described import made, shipped
from support.toolchains import succeed, tool


def test_variants_may_take_fewer_words() -> None:
    """Maximale PZD-Länge, section on BiCo: 4 words for the 410 and 420, 8 for the 430 and 440."""
    assert {str(variant): most for variant, most in of_bus(shipped("siemens_mm4").bus).variant_pzd} == {
        "model=mm410": 4,
        "model=mm420": 4,
        "model=mm430": 8,
        "model=mm440": 8,
    }


def task(number: int, *answers: int) -> Code:
    return Code(number, f"task_{number}", {"en": "Task"}, None, answers=answers)


BUS = Bus(
    framings=(),
    units=(0, 31),
    broadcast=32,
    functions=(task(0, 0), task(1, 1, 2), task(2, 1), task(3, 2), task(6, 4, 5), task(13, 2), task(14, 1)),
    exceptions=(),
    gaps={},
    timing={},
    serial={},
    note={},
    family_facts=UssBus(pkw=(0, 3, 4, 127), pzd=(0, 8)),
)
VARIABLE, FIXED, SHORT, NONE = Link(127, 0), Link(4, 0), Link(3, 0), Link(0, 2)


def words(text: str) -> tuple[int, ...]:
    return tuple(int(word, 16) for word in text.split())


def answer(text: str, unit: int = 3) -> bytes:
    return telegram(unit, words(text))


@pytest.mark.parametrize(
    ("link", "request_", "expected"),
    [
        # MICROMASTER 4 manual, section "Beispiele für PKW", inside whole telegrams
        (VARIABLE, Request(3, 1, 700), "12BC 0000 0000 0000"),
        (VARIABLE, Request(3, 1, 1082), "143A 0000 0000 0000"),
        (VARIABLE, Request(3, 1, 2000), "1000 8000 0000 0000"),
        (VARIABLE, Request(3, 1, 2010, 1), "100A 8001 0000 0000"),
        (VARIABLE, Request(3, 3, 1082, 0, 2, 0x42200000), "343A 0000 4220 0000"),
        (VARIABLE, Request(3, 2, 700, 0, 1, 5), "22BC 0000 0005 0000"),
        (FIXED, Request(3, 2, 700, 0, 1, 5), "22BC 0000 0000 0005"),
        (Link(4, 0, single_first=True), Request(3, 2, 700, 0, 1, 5), "22BC 0000 0005 0000"),
        (SHORT, Request(3, 2, 700, 0, 1, 5), "22BC 0000 0005"),
        (NONE, Request(3, 0, words=(0x047F, 0x3333)), "047F 3333"),
        (Link(127, 2), Request(3, 0, words=(0x057E, 0)), "0000 0000 0000 0000 057E 0000"),
    ],
)
def test_requests_are_those_of_the_manual(link: Link, request_: Request, expected: str) -> None:
    status, data = build(BUS, link, request_)
    assert status == "ok"
    assert data[:3] == bytes((0x02, len(data) - 2, 3))
    assert data[3:-1] == bytes.fromhex(expected.replace(" ", ""))


def test_the_check_byte_of_the_manual() -> None:
    assert check_byte(b"\x02") == 0b00000010
    assert check_byte(b"\x02\xd6") == 0b11010100


def test_a_whole_telegram_by_hand() -> None:
    # 02 ^ 0A ^ 03 ^ 12 ^ BC = A5
    assert telegram(3, words("12BC 0000 0000 0000")).hex(" ").upper() == "02 0A 03 12 BC 00 00 00 00 00 00 A5"


@pytest.mark.parametrize(
    ("parameter", "index", "expected"),
    [
        (1999, 0, (1999, 0x0000)),
        (2000, 0, (0, 0x8000)),
        (3999, 7, (1999, 0x8007)),
        (4000, 0, (0, 0x1000)),
        (6000, 0, (0, 0x9000)),
        (8000, 0, (0, 0x2000)),
        (16000, 0, (0, 0x4000)),
        (31999, 255, (1999, 0xF0FF)),
    ],
)
def test_the_page_bits_stand_in_their_odd_order(parameter: int, index: int, expected: tuple[int, int]) -> None:
    assert parameter_words(0, parameter, index) == expected
    for report in (0, 0x0800):  # a drive's report of a change says so in bit 11
        words = expected[0] | report, expected[1], 7
        assert part_of(words) == Part(expected[0] >> 12, parameter, index, (7,), bool(report))


@pytest.mark.parametrize(
    ("link", "request_", "status"),
    [
        (Link(5, 0), Request(3, 1, 700), "bad_link"),
        (Link(127, 9), Request(3, 1, 700, words=(0,) * 9), "bad_link"),
        (Link(127, 2), Request(3, 1, 700, words=(0,)), "bad_link"),
        (VARIABLE, Request(32, 1, 700), "bad_unit"),
        (VARIABLE, Request(3, 5, 700), "bad_task"),
        (NONE, Request(3, 1, 700, words=(0, 0)), "bad_task"),
        (VARIABLE, Request(3, 1, 32000), "bad_parameter"),
        (VARIABLE, Request(3, 1, 700, 256), "bad_index"),
        (VARIABLE, Request(3, 2, 700, 0, 1, 65536), "bad_value"),
        (SHORT, Request(3, 3, 1082, 0, 2, 1), "bad_value"),
    ],
)
def test_what_must_not_be_sent(link: Link, request_: Request, status: str) -> None:
    assert build(BUS, link, request_) == (status, b"")


ASK = Request(3, 1, 1082)


@pytest.mark.parametrize(
    ("link", "request_", "data", "expected"),
    [
        (VARIABLE, Request(3, 1, 700), answer("12BC 0000 0002"), ("ok", 1, 2)),
        (VARIABLE, ASK, answer("243A 0000 4248 0000"), ("ok", 2, 0x42480000)),
        (VARIABLE, Request(3, 1, 2010, 1), answer("100A 8001 0006"), ("ok", 1, 6)),
        (VARIABLE, Request(3, 2, 1082, 0, 1, 1), answer("743A 0000 0005"), ("refused", 0, 0)),
        (FIXED, Request(3, 2, 700, 0, 1, 5), answer("12BC 0000 0000 0005"), ("ok", 1, 5)),
        (Link(4, 0, single_first=True), Request(3, 1, 700), answer("12BC 0000 0005 0000"), ("ok", 1, 5)),
        (VARIABLE, ASK, b"", ("wrong_start", 0, 0)),
        (VARIABLE, ASK, answer("243A 0000 4248 0000")[:-1], ("wrong_length", 0, 0)),
        (VARIABLE, ASK, answer("243A 0000"), ("wrong_length", 0, 0)),
        (FIXED, ASK, answer("243A 0000 4248"), ("wrong_length", 0, 0)),
        (VARIABLE, ASK, answer("243A 0000 4248"), ("wrong_length", 0, 0)),
        (VARIABLE, ASK, answer("243A 0000 4248 0000", 4), ("wrong_unit", 0, 0)),
        (VARIABLE, ASK, answer("043A 0000 0000"), ("no_answer", 0, 0)),
        (VARIABLE, ASK, answer("243B 0000 4248 0000"), ("wrong_parameter", 0, 0)),
        (VARIABLE, ASK, answer("243A 0001 4248 0000"), ("wrong_parameter", 0, 0)),
        (VARIABLE, ASK, answer("2C3A 0000 4248 0000"), ("wrong_parameter", 0, 0)),
        (VARIABLE, ASK, answer("843A 0000 0000"), ("no_rights", 0, 0)),
        (VARIABLE, ASK, answer("443A 0000 0001"), ("wrong_response", 0, 0)),
    ],
)
def test_answers(link: Link, request_: Request, data: bytes, expected: tuple[str, int, int]) -> None:
    found = parse(BUS, link, request_, data)
    assert (found.status, found.width, found.value) == expected


def test_a_reply_holds_an_error_and_process_data() -> None:
    assert parse(BUS, VARIABLE, replace(ASK, task=2), answer("743A 0000 0011")).error == 17
    found = parse(BUS, Link(127, 2), Request(3, 0, words=(0, 0)), answer("0000 0000 0000 FA31 0000"))
    assert (found.status, found.words) == ("ok", (0xFA31, 0))


def test_a_broadcast_sets_the_bit_of_the_address_and_carries_masks() -> None:
    status, data = broadcast(BUS, Link(127, 2), words("0006 FFFF 0000 0000"), words("047F 3333"))
    assert (status, data[2], data[3:-1].hex()) == ("ok", 0x20, "0006ffff00000000047f3333")
    assert check_byte(data) == 0


@pytest.mark.parametrize(
    ("bus", "pzd", "mask", "data", "status"),
    [
        (BUS, 2, "0006 FFFF", "0 0", "bad_link"),
        (BUS, 2, "0006 FFFF 0 0", "0", "bad_link"),
        (BUS, 8, "0006 FFFF 0 0", "0 0 0 0 0 0 0 0", "ok"),
        (BUS, 9, "0006 FFFF 0 0", "0 0 0 0 0 0 0 0 0", "bad_link"),
        (replace(BUS, broadcast=None), 2, "0006 FFFF 0 0", "0 0", "bad_link"),
        (BUS, 2, "0006 10000 0 0", "0 0", "bad_value"),
        (BUS, 2, "0006 FFFF 0 0", "0 10000", "bad_value"),
        (BUS, 2, "0006 FFFF 0 0", "0 -1", "bad_value"),
    ],
)
def test_what_must_not_be_broadcast(bus: Bus, pzd: int, mask: str, data: str, status: str) -> None:
    made = broadcast(bus, Link(127, pzd), words(mask), words(data))
    assert (made[0], made[1] == b"") == (status, status != "ok")


@pytest.mark.parametrize(
    ("pkw", "pzd", "link"),
    [
        ((0, 3, 4, 127), (0, 8), Link(127, 2)),
        ((0, 3, 4), (0, 8), Link(4, 2)),
        ((), (0, 2), Link(127, 2)),
        ((127,), (0, 1), Link(127, 1)),
        ((3,), (4, 8), Link(3, 4)),
    ],
)
def test_the_link_if_nobody_says_another(pkw: tuple[int, ...], pzd: tuple[int, int], link: Link) -> None:
    """Variable length where the device has it, else the longest; two words of process data, or what comes near."""
    assert default_link(replace(BUS, family_facts=UssBus(pkw=pkw, pzd=pzd))) == link


@given(st.binary(max_size=40), st.sampled_from([VARIABLE, FIXED, SHORT, NONE]))
def test_any_bytes_are_safe(data: bytes, link: Link) -> None:
    assert parse(BUS, link, ASK, data).status != ""


@given(st.integers(0, 8 * 12 - 1))
def test_no_turned_bit_passes(bit: int) -> None:
    data = bytearray(answer("243A 0000 4248 0000"))
    data[bit >> 3] ^= 1 << (bit & 7)
    assert parse(BUS, VARIABLE, ASK, bytes(data)).status != "ok"


@pytest.mark.parametrize(("unit", "listed"), [(None, "NO_BROADCAST"), (32, "0x20U")])
def test_the_header_of_a_bus_with_and_without_broadcast_compiles(unit: int | None, listed: str, tmp_path: Path) -> None:
    device = made("kitchen_uss")
    points = tuple(point for point in device.points if point.name == "control_word")
    small = replace(device, bus=replace(device.bus, broadcast=unit), points=points, frames=(), enums=())
    folder = write_headers(small, tmp_path)
    assert listed in (folder / "c" / "kitchen_uss_uss.h").read_text("utf-8")
    (tmp_path / "user.c").write_text('#define FIELDSCRIBE_IMPLEMENTATION\n#include "kitchen_uss_uss.h"\n', "utf-8")
    succeed([tool("gcc"), "-std=c99", "-fsyntax-only", f"-I{folder / 'c'}", tmp_path / "user.c"])
