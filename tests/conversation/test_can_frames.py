"""CAN frames in words, and values into CAN frames."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest
from fieldscribe.conversation.decoder import StreamDecoder, decode
from fieldscribe.conversation.encoding import encode_point, frames_for
from fieldscribe.conversation.explanation import explain_point, sample_raw
from fieldscribe.conversation.lookup import find
from fieldscribe.conversation.meanings import quoted_text
from fieldscribe.diagnostics import RefusedError, UnclearError
from fieldscribe.families.can.frame_decoder import CanFrameDecoder
from fieldscribe.families.can.frames import CanFrame, parse
from fieldscribe.families.can.notation import read_frames, read_identifier
from fieldscribe.families.decoded_frame import DecodedFrame, OpenRequests
from fieldscribe.families.frame_results import FrameResult, Options
from fieldscribe.model import Device, Role
from hypothesis import given
from hypothesis import strategies as st
from support.asked import asked
from support.described import group, head, loaded_in, made, shipped, together
from support.frames_by_hand import at, can_frame
from support.models import named

DEVICE = shipped("woodward_mpu2s")
KITCHEN = made("kitchen_can")
_SCALED = replace(named(KITCHEN, "page").shape, scale=named(KITCHEN, "power").scale)
SCALED_PAGES = replace(
    KITCHEN, points=tuple(replace(one, shape=_SCALED) if one.name == "page" else one for one in KITCHEN.points)
)
"""A number that several frames have also needs an exponent."""
EXPONENTS = "321#DD010302000007D0"


def decode_all(*texts: str, **settings: int) -> list[FrameResult]:
    """Decode all frames, one after the other."""
    return decode(DEVICE, settings, texts, asked())


def texts_of(decoded: FrameResult) -> list[str]:
    """Return the texts of the items."""
    return [item.text for item in decoded.items]


def send(item: str, value: str, options: Options | None = None) -> tuple[str, ...]:
    """Return the frames that write a value."""
    point = named(DEVICE, item)
    return frames_for(DEVICE, point, encode_point(DEVICE, point, value, {}).raw, {}, options or asked()).frames


@pytest.mark.parametrize(
    ("texts", "can_id", "shown"),
    [
        (["321#DD00051E13880064"], None, ["321#DD00051E13880064"]),
        (["321#DD.00.05.1E"], None, ["321#DD00051E"]),
        (["0x321#dd00"], None, ["321#DD00"]),
        (["(1436509052.249713) can0 321#DD00"], None, ["(1436509052.249713) can0 321#DD00"]),
        (["(1436509052.249713)", "can0", "321#DD00", "322#"], None, ["(1436509052.249713) can0 321#DD00", "322#"]),
        (["(1.5) can0 321#DD00\n\n(1.6) can0 322#EE R\n"], None, ["(1.5) can0 321#DD00", "(1.6) can0 322#EE"]),
        (["  can0  321   [3]  DD 00 05"], None, ["can0 321#DD0005"]),
        ([" (1.5)  vcan0  00000321   [2]  DD 00   '..'"], None, ["(1.5) vcan0 321#DD00"]),
        (["can0 321 [0] remote request"], None, ["can0 321#R"]),
        (["321#R8"], None, ["321#R"]),
        (["321##1DD00"], None, ["321#DD00"]),
        (["1ABCDEF0#00"], None, ["1ABCDEF0#00"]),
        (["DD 00 05", "0xDD,0x01"], "321", ["321#DD0005", "321#DD01"]),
        (["DD", "00", "05"], "0x321", ["321#DD0005"]),
        (["322#00", "DD00"], "321h", ["322#00", "321#DD00"]),
    ],
)
def test_notations(texts: list[str], can_id: str | None, shown: list[str]) -> None:
    pasted = read_frames(texts, None if can_id is None else read_identifier(can_id))
    assert [one.text for one in pasted] == shown
    assert all(isinstance(word, str) for one in pasted for word in (one.stamp, one.bus))


@pytest.mark.parametrize(
    ("text", "can_id", "why"),
    [
        ("DD 00", None, "has no identifier"),
        ("", None, "no bytes"),
        ("321#DD0", None, "3 digits"),
        ("321#XY", None, "not hexadecimal"),
        ("FFFFFFFF#00", None, "29 bits"),
        ("32Z#00", "321", "has no identifier"),
        ("00", "XYZ", "no CAN identifier"),
        ("00", "FFFFFFFF", "no CAN identifier"),
        ("\x1b[31m", None, "not a frame"),
    ],
)
def test_what_is_no_frame(text: str, can_id: str | None, why: str) -> None:
    with pytest.raises(UnclearError, match=why) as caught:
        read_frames([text], None if can_id is None else read_identifier(can_id))
    assert "\x1b" not in caught.value.message
    assert caught.value.hint


def test_given_settings_go_before_those_of_frames() -> None:
    decoded = decode_all(EXPONENTS, "321#DD00051E13880064", generator_power_exponent=0)
    assert texts_of(decoded[1])[2].startswith("generator_active_power = 100 W")


def test_units_are_kept_apart() -> None:
    decoded = decode_all(EXPONENTS, "322#DD00051E13880064")
    assert decoded[1].unit == 2
    assert decoded[1].items[2].missing == ("generator_power_exponent",)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("A B", '"A B"'),
        ("A   B", '"A \\x20\\x20B"'),
        ('"\\', '"\\x22\\x5C"'),
        ("\x00\xa0\xe4", '"\\x00\\xA0\xe4"'),
        ("", '""'),
    ],
)
def test_texts_are_shown_as_they_are(text: str, words: str) -> None:
    assert quoted_text(text) == words


def test_damaged_telegrams_are_not_read() -> None:
    cyclic = DEVICE.messages[0]
    roles = (*cyclic.roles[:-1], Role("xor", 0b0111_1111))
    device = replace(DEVICE, messages=(replace(cyclic, roles=roles), *DEVICE.messages[1:]))
    decoded = decode(device, {}, ["321#DD00051E13880000", "321#DD00051E1388005D"], asked())
    assert (decoded[0].faults, decoded[0].items) == (("the checksum is wrong",), ())
    assert "not read" in decoded[0].notes[0]
    assert (decoded[1].faults, decoded[1].checks) == ((), "ok (5D)")
    assert texts_of(decoded[1])[1].startswith("generator_frequency = 50 Hz")


def test_what_is_no_fault() -> None:
    foreign = decode_all("123#00")[0]
    assert (foreign.kind, foreign.unit, foreign.faults) == ("other", None, ())
    assert "320h to 33Eh visualisation" in foreign.notes[0]
    assert "multiplexers 0 to 22 only" in decode_all("321#DDFF000000000000")[0].findings[0]
    nobody = decode_all(can_frame(DEVICE, "read_request", 1, 9))[0]
    assert "no point is described" in texts_of(nobody)[0] or nobody.items[0].point
    assert (
        "no point is described here (1234h)"
        in texts_of(decode_all(can_frame(DEVICE, "read_answer", 1, 60000, 0x1234))[0])[0]
    )
    data = bytes.fromhex("FF2801FB0000")
    data += bytes((data[0] ^ data[2] ^ data[4], data[1] ^ data[3] ^ data[5]))
    assert "cannot have unit 40" in decode_all(f"33F#{data.hex()}")[0].findings[0]


def test_as_data() -> None:
    data = decode_all("(1.5) can0 " + EXPONENTS)[0].as_data()
    assert (data["can_id"], data["multiplexer"], data["time"], data["interface"]) == (0x321, 1, "1.5", "can0")
    assert (data["message"], data["framing"]) == ("visualisation", "can")


_IDS = st.one_of(st.sampled_from([0x320, 0x321, 0x33E, 0x33F]), st.integers(0, 0x1FFFFFFF))
_HEADS = st.sampled_from([b"", b"\xdd", b"\xff\x01", b"\xee\x01", b"\xdd\x0e", b"\xdd\x0f"])


@given(st.lists(st.tuples(_IDS, _HEADS, st.binary(max_size=12)), min_size=1, max_size=8))
def test_any_frames_are_safe(frames: list[tuple[int, bytes, bytes]]) -> None:
    decoder = StreamDecoder(DEVICE, {}, CanFrameDecoder(DEVICE))
    for number, start, rest in frames:
        for data in (start + rest, (start + rest)[:8]):
            decoded = decoder.decode(CanFrame(number, data))
            assert decoded.summary
            assert decoded.as_data()


RECOGNISER = CanFrameDecoder(DEVICE)
"""It remembers what the heads of all the frames have told."""


class _Forgetful(CanFrameDecoder):
    """Keeps nothing."""

    def decode(self, frame: CanFrame, requests: OpenRequests, *, expecting: bool = False) -> DecodedFrame:
        self._heads.clear()
        self._last.clear()
        return super().decode(frame, requests, expecting=expecting)._replace(memo=None)


def test_more_heads_than_are_remembered() -> None:
    """31 units with 60 multiplexers, and each a second time: the words are read as the first time."""
    decoder = StreamDecoder(DEVICE, {}, CanFrameDecoder(DEVICE))
    frames = [CanFrame(0x320 + unit, bytes((0xDD, slot)) + bytes(6)) for unit in range(31) for slot in range(60)]
    first, second = ([decoder.decode(frame).summary for frame in frames] for _ in range(2))
    assert first == second
    assert len(set(first)) == len(frames)


def _exponents_and_halves(random: Random) -> CanFrame:
    """Return a frame of one of two gensets: values, exponents, or halves of the operating hours."""
    (place,) = random.choices((0, 1, 4, 5, 7, 10, 14, 15), (9, 3, 4, 4, 9, 3, 2, 2))
    data = bytes((0xDD, place, random.randrange(2), 0, random.choice((0, 0, 96)), 0, 0, random.randrange(2)))
    return CanFrame(random.choice((0x321, 0x322)), data)


def _values_and_parameters(random: Random) -> CanFrame:
    """Return a frame of the kitchen: measured values, pages, or the answer with a parameter that some of them need."""
    if random.random() < 0.2:
        return CanFrame(0x125, bytes((random.choice((0x10, 0x30)), 0, 0, 0, 0, 0)))
    if random.random() < 0.1:
        (answer,) = read_frames([can_frame(KITCHEN, "read_answer", 5, 507, random.choice((280, 400)))], None)
        return answer
    place, last = random.randrange(5), random.choice((0, 0, 1, 7))
    word = random.choice((0, 0, 1)) if place < 3 else 0
    exponent = random.choice((0, 0, 0x50)) if place == 0 else 0
    return CanFrame(0x325, bytes((0xDD, place, 0, word, 0, 0, exponent, last if place < 2 else 0)))


@pytest.mark.parametrize(
    ("device", "frame_of", "least"),
    [
        (DEVICE, _exponents_and_halves, 120),
        (KITCHEN, _values_and_parameters, 350),
        (SCALED_PAGES, _values_and_parameters, 350),
    ],
)
def test_what_is_kept_of_frames_that_come_again_is_what_they_say_now(
    device: Device, frame_of: Callable[[Random], CanFrame], least: int
) -> None:
    """Also where other frames bring exponents, or halves of numbers; a decoder that keeps nothing says the same."""
    random, again = Random(26), 0
    for _ in range(40):
        keeping, forgetting = (StreamDecoder(device, {}, each(device)) for each in (CanFrameDecoder, _Forgetful))
        seen = list[FrameResult]()
        for _ in range(60):
            frame = frame_of(random)
            first = keeping.decode(frame)
            assert first.as_data() == forgetting.decode(frame).as_data()
            again += any(first is kept for kept in seen)
            seen.append(first)
    assert again > least


@given(_IDS, _HEADS, st.binary(min_size=8, max_size=8))
def test_a_frame_without_faults_is_what_the_reference_takes(number: int, head: bytes, rest: bytes) -> None:
    frame = CanFrame(number, (head + rest)[:8])
    found = RECOGNISER.recognise(frame)
    good = [
        message.name
        for message in DEVICE.messages
        for unit in range(31 if message.adds_unit else 256)
        if parse(message, unit, frame).status == "ok"
    ]
    if found is not None and not found.flaws:
        assert found.message.name in good
    else:
        assert good == []


@given(st.text(max_size=60), st.one_of(st.none(), st.text(max_size=10)))
def test_any_text_is_safe(text: str, can_id: str | None) -> None:
    try:
        read_frames([text], None if can_id is None else read_identifier(can_id))
    except UnclearError as error:
        assert error.message


@pytest.mark.parametrize(
    ("what", "items"),
    [
        ("nr:2", ["generator_frequency"]),
        ("mux:0", ["telegram_identification", "generator_frequency", "generator_active_power"]),
        ("mux:15", ["operating_hours", "hours_until_maintenance", "engine_start_counter"]),
        ("nr:46", ["operating_hours"]),
        ("mux:99", []),
    ],
)
def test_telegram_words_are_found(what: str, items: list[str]) -> None:
    assert [match.point.item for match in find(DEVICE, what)] == items


def test_explained() -> None:
    rows = dict(explain_point(DEVICE, named(DEVICE, "generator_frequency")).rows)
    assert rows["Read"].endswith("from unit 1: multiplexer 0, bytes 4 and 5 (321#DD000000hhll0000)")
    rows = dict(explain_point(DEVICE, named(DEVICE, "operating_hours")).rows)
    assert "(321#DD0E00000000hhll), then multiplexer 15, bytes 2 and 3 (321#DD0Fhhll00000000)" in rows["Read"]
    rows = dict(explain_point(DEVICE, at(DEVICE, 2)).rows)
    assert rows["Read"] == f"message read_request, to unit 1: {can_frame(DEVICE, 'read_request', 1, 2)}"
    assert rows["Write"].endswith(can_frame(DEVICE, "write_request", 1, 2, 10))
    rows = dict(explain_point(DEVICE, named(DEVICE, "relay_1_event_1")).rows)
    assert "replace the bits of mask FF00h" in rows["Write"]
    assert (
        "8 messages write_request" in dict(explain_point(DEVICE, named(DEVICE, "fault_text_terminal_62")).rows)["Write"]
    )


def test_a_device_without_messages() -> None:
    bare = replace(DEVICE, messages=(), telegrams=())
    point = at(bare, 2)
    rows = dict(explain_point(bare, point).rows)
    assert "Write" not in rows
    with pytest.raises(RefusedError, match="no message"):
        frames_for(bare, point, 100, {}, asked())
    assert decode(bare, {}, ["321#00"], asked())[0].kind == "other"


def test_every_point_is_explained() -> None:
    for one in DEVICE.points:
        rows = dict(explain_point(DEVICE, one).rows)
        assert ("Read" in rows) == (one.generated and one.readable), one.name


def test_every_point_comes_back_from_its_frames() -> None:
    """What is encoded with any word beside it is decoded to the same number."""
    seen = 0
    for one in DEVICE.points:
        if not one.writable or not one.generated:
            continue
        raw = 0x5445585420202020 << 64 if one.text is not None else sample_raw(one)
        if raw is None:
            continue
        options = asked(with_word=None if one.bits is None else "FFFFh")
        decoded = decode_all(*frames_for(DEVICE, one, raw, {}, options).frames)
        assert all(not frame.faults for frame in decoded)
        items = [item for frame in decoded for item in frame.items if item.point in (one.item, one.name)]
        assert [item.raw for item in items] == [None if one.text is not None else raw] * len(decoded), one.name
        assert all("breaks" not in item.text for item in items)
        seen += 1
    assert seen > 190


CELLS = head(
    family="can",
    bus="{units: 1..9}",
    messages="""
- {name: ask, direction: request, can_id: 100h + unit, layout: {0: 1, 1..2: address, 3..7: 0}}
- {name: got, direction: response, answers: ask, can_id: 200h + unit, layout: {0: 2, 1..2: address, 3..4: raw, 5..7: 0}}
- {name: cells, direction: cyclic, can_id: 300h + unit, layout: {0: multiplexer, 1: A5h, 2..7: telegram}}""",
    telegrams="[{name: cells, direction: cyclic, length: 6, message: cells}]",
)
CELL = {"group": "cells", "space": "telegram", "telegram": "cells", "addressing": "number + index - 1"}
LIMIT = {"group": "limits", "space": "parameter", "access": "r", "addressing": "100h * number + index"}


def test_elements_of_an_array_are_found_by_address_where_no_index_travels(tmp_path: Path) -> None:
    """The index beside the address is of uss alone: by a rule it is in the address."""
    cells = group("- {name: cell, at: 0, indices: 6}\n", **CELL)
    limits = group("- {name: limit, at: 1, indices: 2}\n", **LIMIT)
    device = loaded_in(tmp_path, together(CELLS, cells, limits))
    first, second, told = decode(
        device, {}, ["301#00A5000100020003", "301#01A5000400050006", "201#0201020007000000"], asked()
    )
    assert [item.point for item in (*first.items, *second.items)] == [f"cell_index_{number}" for number in range(1, 7)]
    assert [item.point for item in told.items] == ["limit_index_2"]
    rows = dict(explain_point(device, named(device, "limit_index_2")).rows)
    assert (rows["Wire address"], rows["Index"]) == ("0102h (258), space parameter", "2")
