"""What exchanges say follows from the facts of their frames, whatever words a description uses."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest
from fieldscribe.arithmetic.codec import encode
from fieldscribe.conversation.decoder import StreamDecoder, decode, frame_decoder
from fieldscribe.families.frame_results import FrameResult, Options
from fieldscribe.families.modbus.frames import crc16
from fieldscribe.families.uss.telegrams import telegram
from fieldscribe.listening.exchanges import Content, item_text
from fieldscribe.model import Device
from support.described import described, loaded_in, shipped

POINTS = """\
- {name: wide, at: 1, type: u32, access: r, title: {en: "Wide = two; not set"}, unit: V}
- {name: word, at: 3, access: r, flags: {0: {name: ready, one: {en: "Now; not set before"}}, 1: late}}
- {name: plain, at: 4, access: r, title: {en: "Plain = simple"}}
"""


@pytest.fixture(scope="module")
def device(tmp_path_factory: pytest.TempPathFactory) -> Device:
    return loaded_in(tmp_path_factory.mktemp("words"), described(POINTS))


def rtu(text: str) -> str:
    """Return a frame with its checksum."""
    data = bytes.fromhex(text)
    return (data + crc16(data).to_bytes(2, "little")).hex()


def results(device: Device, *frames: str) -> list[FrameResult]:
    return decode(device, {}, frames, Options())


@pytest.mark.parametrize(
    ("frames", "expected"),
    [
        (("01 03 0001 0002",), "wide"),
        (("01 03 0001 0002", "01 03 04 0001 0000"), "wide = 65536 V"),
        (("01 03 0002 0001", "01 03 02 1234"), "wide: only the low word (2 of 2, the high part first) = 1234h"),
        (("01 03 0003 0001", "01 03 02 0001"), "word = ready (Now; not set before)"),
        (("01 03 0003 0001", "01 03 02 0000"), "word = none set"),
        (("01 03 0004 0001",), "plain"),
        (("01 03 0004 0001", "01 03 02 0007"), "plain = 7"),
        (("01 03 0009 0001", "01 03 02 0007"), "0009h (9): no point is described here (carries 0007h)"),
    ],
)
def test_an_item_in_short(frames: tuple[str, ...], expected: str, device: Device) -> None:
    assert [item_text(item) for item in results(device, *map(rtu, frames))[-1].items] == [expected]


@pytest.mark.parametrize("words", [(1, 2, 3, 4, 5, 6, 7), (1, 2, 3, 4, 5, 6, 8)])
def test_what_is_no_point_is_named_without_its_number(words: tuple[int, ...]) -> None:
    (result,) = results(shipped("siemens_mm4"), telegram(1, (0, 0, 0, *words)).hex())
    assert result.items[-1].about == "word 6 of process data"


@pytest.mark.parametrize(
    ("name", "frames", "refusal"),
    [
        ("hitachi_l200", (rtu("01 03 1001 0002"), rtu("01 83 02")), "exception 02h address_not_found: "),
        (
            "siemens_mm4",
            (telegram(1, (0x143A, 0, 0, 0, 0, 0)).hex(), telegram(1, (0x743A, 0, 0, 0, 0, 0)).hex()),
            "response 7 not_executable, parameter 1082: error 0 parameter_number_not_allowed: ",
        ),
        (
            "siemens_mm4",
            (telegram(1, (0x143A, 0, 0, 0, 0, 0)).hex(), telegram(1, (0x843A, 0, 0, 0, 0, 0)).hex()),
            "response 8 no_control, parameter 1082",
        ),
    ],
)
def test_what_was_refused_is_a_finding(name: str, frames: tuple[str, str], refusal: str) -> None:
    device = shipped(name)
    request, reply = results(device, *frames)
    assert reply.refusal.startswith(refusal)
    assert reply.refusal in Content(1, device, "read", request, reply).findings
    assert request.refusal == ""


@pytest.mark.parametrize(("volts", "is_wrong"), [(354, False), (700, False), (500, True)])
def test_a_number_that_one_of_the_variants_allows_is_in_range(volts: int, is_wrong: bool) -> None:
    """Nobody has said whether this is the drive for 200 V (330..395 V) or the one for 400 V (660..780 V)."""
    drive = shipped("hitachi_l200")
    point = next(point for point in drive.points if point.name == "overvoltage_deceleration_level" and point.variant)
    raw = encode(point, Fraction(volts), {})
    decoder = StreamDecoder(drive, {}, frame_decoder(drive, Options()), doubting=True)
    frames = rtu(f"01 03 {point.addresses[0]:04X} 0001"), rtu(f"01 03 02 {raw:04X}")
    reply = [decoder.decode(bytes.fromhex(frame)) for frame in frames][1]
    assert [bool(item.doubts) for item in reply.items] == [is_wrong, is_wrong]


LIMITED = """\
- {name: first_most, at: 1, access: r}
- {name: second_most, at: 2, access: r}
- name: speed
  at: 3
  variants: {model=one: {range: 1..first_most}, model=two: {range: 1..second_most}}
"""


@pytest.mark.parametrize(
    ("limits", "number", "is_wrong"),
    [
        ((10, 100), 5, (False, False)),
        ((10, 100), 50, (False, False)),  # each variant sees its own limit; that of the other is unknown to it
        ((10, 100), 500, (False, False)),
        ((10, 100), 0, (True, True)),
    ],
)
def test_limits_of_variants_count_for_the_points_that_name_them(
    tmp_path: Path, limits: tuple[int, int], number: int, is_wrong: tuple[bool, bool]
) -> None:
    model = "{model: {title: {en: Model}, values: {one: {}, two: {}}}}"
    device = loaded_in(tmp_path, described(LIMITED, variants=model))
    decoder = StreamDecoder(device, {}, frame_decoder(device, Options()), doubting=True)
    words = "".join(f"{word:04X}" for word in (*limits, number))
    frames = rtu("01 03 0001 0003"), rtu(f"01 03 06 {words}")
    reply = [decoder.decode(bytes.fromhex(frame)) for frame in frames][1]
    assert tuple(bool(item.doubts) for item in reply.items[2:]) == is_wrong
