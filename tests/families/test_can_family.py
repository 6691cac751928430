"""CAN messages laid out in a description, held against the layouts of the MPU2-S manual, worked out by hand."""

from __future__ import annotations

import pytest
from fieldscribe.families.can.frames import CanFrame, Receiver, build, parse, telegram_words
from fieldscribe.model import Message, Role, Source, Telegram
from hypothesis import given
from hypothesis import strategies as st

SOURCE = Source("manual", "2", None, None)


def message(name: str, first: int, can_id: int, *, adds_unit: bool, carries_raw: bool = True) -> Message:
    """Byte 0 a constant, byte 1 the unit, then id and data word, then the words combined by exclusive or."""
    value = (Role("raw", 8), Role("raw", 0)) if carries_raw else (Role("constant", 0), Role("constant", 0))
    head = (Role("constant", first), Role("unit", 0), Role("address", 8), Role("address", 0))
    check = (Role("xor", 0b010101), Role("xor", 0b101010))
    return Message(name, {"en": name}, "request", None, can_id, adds_unit, (*head, *value, *check), SOURCE)


READ = message("read_request", 0xFF, 0x33F, adds_unit=False, carries_raw=False)
WRITE = message("write_request", 0xEE, 0x33F, adds_unit=False)
ANSWER = message("read_answer", 0xFF, 0x320, adds_unit=True)
CYCLIC = Message(
    "cyclic",
    {"en": "Cyclic"},
    "cyclic",
    None,
    0x320,
    True,
    (Role("constant", 0xDD), Role("multiplexer", 0), *(Role("word", number) for number in range(6))),
    SOURCE,
)
UNITS = (0, 30)


@pytest.mark.parametrize(
    ("layout", "address", "raw", "can_id", "data"),
    [
        # id 507 = 01FBh of unit 5: FF^01^00 = FE, 05^FB^00 = FE
        (READ, 507, 0, 0x33F, "FF 05 01 FB 00 00 FE FE"),
        # id 11 = 12800 = 3200h: EE^00^32 = DC, 05^0B^00 = 0E
        (WRITE, 11, 12800, 0x33F, "EE 05 00 0B 32 00 DC 0E"),
        (ANSWER, 507, 400, 0x325, "FF 05 01 FB 01 90 FF 6E"),
    ],
)
def test_messages_by_hand(layout: Message, address: int, raw: int, can_id: int, data: str) -> None:
    frame = CanFrame(can_id, bytes.fromhex(data))
    assert build(layout, UNITS, 5, address, raw) == ("ok", frame)
    found = parse(layout, 5, frame)
    assert (found.status, found.address, found.raw) == ("ok", address, raw)


@pytest.mark.parametrize(
    ("unit", "address", "raw", "status"),
    [(31, 0, 0, "bad_unit"), (-1, 0, 0, "bad_unit"), (5, 65536, 0, "bad_address"), (5, 0, -1, "bad_value")],
)
def test_what_must_not_be_sent(unit: int, address: int, raw: int, status: str) -> None:
    assert build(WRITE, UNITS, unit, address, raw) == (status, CanFrame(0, b""))


GOOD = "FF 05 01 FB 01 90 FF 6E"


@pytest.mark.parametrize(
    ("can_id", "data", "status"),
    [
        (0x326, GOOD, "wrong_id"),
        (0x325, GOOD[:-3], "wrong_length"),
        (0x325, f"{GOOD} 00", "wrong_length"),
        (0x325, "EE 05 01 FB 01 90 EE 6E", "wrong_constant"),
        (0x325, "FF 06 01 FB 01 90 FF 6D", "wrong_unit"),
        (0x325, "FF 05 01 FB 01 90 FF 6F", "wrong_check"),
        (0x325, "FF 05 01 FB 01 90 6E FF", "wrong_check"),
    ],
)
def test_what_is_no_answer(can_id: int, data: str, status: str) -> None:
    assert parse(ANSWER, 5, CanFrame(can_id, bytes.fromhex(data))).status == status


@given(st.integers(0, 0x7FF), st.binary(max_size=12))
def test_any_frame_is_safe(can_id: int, data: bytes) -> None:
    frame = CanFrame(can_id, data)
    receiver = Receiver(Telegram("t", {"en": "T"}, "cyclic", 69, "cyclic", SOURCE), CYCLIC, 5)
    assert receiver.take(frame) == (can_id == 0x325 and len(data) == 8 and data[0] == 0xDD and data[1] < 23)
    assert parse(ANSWER, 5, frame).status != ""


def taken(*frames: tuple[int, int, int, int]) -> Receiver:
    """A receiver after frames of (multiplexer, word 1, word 2, word 3)."""
    receiver = Receiver(Telegram("t", {"en": "T"}, "cyclic", 69, "cyclic", SOURCE), CYCLIC, 5)
    for mux, *words in frames:
        data = bytes((0xDD, mux)) + b"".join(word.to_bytes(2, "big") for word in words)
        assert receiver.take(CanFrame(0x325, data))
    return receiver


@pytest.mark.parametrize(
    ("mux", "words"), [(0, {0: 7, 1: 1, 2: 0x86A0}), (16, {48: 7, 49: 1, 50: 0x86A0}), (22, {66: 7, 67: 1, 68: 0x86A0})]
)
def test_the_multiplexer_says_which_words_a_frame_brings(mux: int, words: dict[int, int]) -> None:
    """Three words each: multiplexer 16 brings the numbers 49 to 51 of the manual, which counts from 1."""
    frame = CanFrame(0x325, bytes((0xDD, mux, 0x00, 0x07, 0x00, 0x01, 0x86, 0xA0)))
    assert telegram_words(CYCLIC, frame) == words


def test_words_of_one_frame() -> None:
    receiver = taken((16, 7, 0x0001, 0x86A0))
    assert receiver.words((49, 50)) == ("ok", (0x0001, 0x86A0))  # Nr 50 and 51: multiplexer 16, words 2 and 3
    assert receiver.words((44, 45)) == ("missing", ())


def test_a_text_is_given_as_its_words_came_last() -> None:
    """More than two words over several frames: no two of them need to belong together."""
    receiver = taken((0, 1, 2, 3), (1, 4, 5, 6), (2, 7, 8, 9), (0, 11, 2, 3))
    assert receiver.words((0, 3, 6)) == ("ok", (11, 4, 7))
    assert receiver.words((0, 3, 9)) == ("missing", ())


HIGH, LOW = 14, 15  # operating hours: Nr 45 is word 3 of multiplexer 14, Nr 46 word 1 of multiplexer 15


@pytest.mark.parametrize(
    ("frames", "expected"),
    [
        ([(HIGH, 1)], ("missing", ())),
        ([(HIGH, 1), (LOW, 0xFFFF)], ("torn", ())),
        ([(HIGH, 1), (LOW, 0xFFFF), (HIGH, 1)], ("ok", (1, 0xFFFF))),
        ([(HIGH, 1), (LOW, 0xFFFF), (HIGH, 2)], ("torn", ())),
        ([(HIGH, 1), (LOW, 0xFFFF), (HIGH, 2), (LOW, 0), (HIGH, 2)], ("ok", (2, 0))),
        ([(HIGH, 1), (LOW, 5), (HIGH, 1), (LOW, 6)], ("ok", (1, 5))),
        ([(LOW, 5), (HIGH, 1), (HIGH, 1)], ("torn", ())),
    ],
)
def test_a_counter_over_two_frames_is_believed_between_two_equal_high_words(
    frames: list[tuple[int, int]], expected: tuple[str, tuple[int, ...]]
) -> None:
    receiver = taken(*((mux, 0, 0, word) if mux == HIGH else (mux, word, 0, 0) for mux, word in frames))
    assert receiver.words((44, 45)) == expected
