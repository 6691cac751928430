"""CAN frames in words, and values into CAN frames."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import pytest
from fieldscribe.cli.frame_options import refuse_foreign
from fieldscribe.conversation.decoder import StreamDecoder, decode
from fieldscribe.conversation.encoding import encode_point, frames_for
from fieldscribe.conversation.explain_other_items import explain_other_items
from fieldscribe.conversation.explanation import explain_point, sample_raw
from fieldscribe.conversation.lookup import find
from fieldscribe.conversation.meanings import quoted_text
from fieldscribe.families.can.frame_decoder import CanFrameDecoder
from fieldscribe.families.can.frames import CanFrame, parse
from fieldscribe.families.can.notation import Pasted, read_frames, read_identifier
from fieldscribe.model import Role
from fieldscribe.user_errors import Options, RefusedError, UnclearError
from hypothesis import given
from hypothesis import strategies as st
from support.asked import asked
from support.described import group, head, kitchen_sink, loaded_in, shipped, together
from support.frames_by_hand import at, can_frame, coded
from support.models import named

if TYPE_CHECKING:
    from pathlib import Path

    from fieldscribe.families.frame_results import FrameResult

DEVICE = shipped("woodward_mpu2s")
FACTOR = coded(DEVICE, "KWUGNSEK")
EXPONENTS = "321#DD010302000007D0"


def hear(*texts: str, **settings: int) -> list[FrameResult]:
    """All frames, one after the other."""
    return decode(DEVICE, settings, texts, asked())


def said(heard: FrameResult) -> list[str]:
    """What the items say, each up to the title."""
    return [item.text for item in heard.items]


def send(item: str, value: str, options: Options | None = None) -> tuple[str, ...]:
    """The frames that write a value."""
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


def test_a_telegram_word_by_word() -> None:
    heard = hear("321#DD00051E13880064", EXPONENTS)
    assert (heard[0].kind, heard[0].unit, heard[0].faults) == ("cyclic", 1, ())
    assert "multiplexer 0, words 0 to 2" in heard[0].summary
    assert said(heard[0])[1].startswith("generator_frequency = 50 Hz (raw 5000 = 1388h)")
    power = heard[0].items[2]
    assert power.missing == ("generator_power_exponent",)
    assert power.text.endswith("give --with PGNEXPO=VALUE; it comes with multiplexer 1")
    assert said(heard[1])[-1].startswith("from a frame before: generator_active_power = 100000 W")
    again = hear(EXPONENTS, "321#DD00051E13880064")[1]
    assert said(again)[2].startswith("generator_active_power = 100000 W (raw 100 = 0064h)")


def test_what_is_given_goes_before_what_was_heard() -> None:
    heard = hear(EXPONENTS, "321#DD00051E13880064", generator_power_exponent=0)
    assert said(heard[1])[2].startswith("generator_active_power = 100 W")


def test_units_are_kept_apart() -> None:
    heard = hear(EXPONENTS, "322#DD00051E13880064")
    assert heard[1].unit == 2
    assert heard[1].items[2].missing == ("generator_power_exponent",)


def test_counters_of_two_frames() -> None:
    high, low, other = "321#DD0E000000000001", "321#DD0F123400000000", "321#DD0E000000000002"
    heard = hear(high, low, high, low)
    assert said(heard[0])[-1].endswith(
        "only the high word (1 of 2, the high part first) = 0001h; the rest comes with multiplexer 15"
    )
    assert "may be torn; 70196 h (raw 70196 = 00011234h) if the high word stayed" in said(heard[1])[0]
    assert heard[1].items[0].raw is None
    assert said(heard[2])[-1].startswith("operating_hours = 70196 h")
    torn = hear(high, low, other)
    assert "may be torn" in said(torn[2])[-1]
    assert "only the low word" in said(hear(low)[0])[0]


def test_requests_and_answers() -> None:
    asked = can_frame(DEVICE, "read_request", 1, 507)
    heard = hear(asked, can_frame(DEVICE, "read_answer", 1, 507, 400))
    assert [one.kind for one in heard] == ["request", "reply"]
    assert [one.details["message"] for one in heard] == ["read_request", "read_answer"]
    assert heard[0].unit == heard[1].unit == 1
    assert said(heard[0]) == [f"KWUGNSEK {FACTOR.name}: {FACTOR.title['en']}"]
    assert said(heard[1])[0].startswith(f"KWUGNSEK {FACTOR.name} = 400 (raw 400 = 0190h)")
    assert heard[1].checks.startswith("ok (")


def test_factors_of_parameters_are_kept_until_they_may_have_changed() -> None:
    setpoint = can_frame(DEVICE, "read_answer", 1, 10, 400)
    factor = can_frame(DEVICE, "read_answer", 1, 507, 400)
    transformer = can_frame(DEVICE, "write_answer", 1, 2, 500)
    assert hear(setpoint)[0].items[0].missing == (FACTOR.name,)
    assert " = 400 V" in said(hear(factor, setpoint)[1])[0]
    assert hear(factor, transformer, setpoint)[2].items[0].missing == (FACTOR.name,)


def test_variants_that_mean_the_same_are_said_once() -> None:
    answer = hear(can_frame(DEVICE, "read_answer", 1, 10, 400))[0]
    assert [item.point for item in answer.items] == ["generator_voltage_setpoint"]
    factor = can_frame(DEVICE, "read_answer", 1, 507, 400)
    written = hear(factor, can_frame(DEVICE, "write_request", 1, 10, 400))[1]
    assert [item.point for item in written.items] == [
        "generator_voltage_setpoint_100v",
        "generator_voltage_setpoint_400v",
    ]
    assert ["outside" in text for text in said(written)] == [True, False]


def test_a_write_out_of_range_is_said() -> None:
    heard = hear(can_frame(DEVICE, "write_request", 1, 2, 9999))[0]
    assert heard.kind == "request"
    assert "9999 A is outside 10..7000 A" in said(heard)[0]
    assert "read only" in said(hear(can_frame(DEVICE, "write_request", 1, 507, 1))[0])[0]


def test_bits_that_are_always_written() -> None:
    group = named(DEVICE, "relay_1_event_1")
    broken = hear(can_frame(DEVICE, "write_request", 1, group.addresses[0], 0x05F8))[0]
    assert said(broken)[0].endswith("; the word breaks what is always written: bits 7..3 always 00000")
    assert "breaks" not in said(hear(can_frame(DEVICE, "read_answer", 1, group.addresses[0], 0x05F8))[0])[0]


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


def test_answers_that_do_not_follow() -> None:
    heard = hear(can_frame(DEVICE, "write_request", 1, 2, 500), can_frame(DEVICE, "write_answer", 1, 2, 400))
    assert heard[1].findings == ("it does not repeat what was written: 01F4h was, 0190h came back",)
    heard = hear(can_frame(DEVICE, "read_request", 1, 2), can_frame(DEVICE, "read_answer", 1, 3, 400))
    assert heard[1].findings == ("the request before asked for parameter 2, this answers 3",)


def test_bit_groups_of_a_word_are_all_shown() -> None:
    groups = [point for point in DEVICE.points if point.space == "parameter" and point.addresses == (21,)]
    heard = hear(can_frame(DEVICE, "read_answer", 1, 21, 0x0800))[0]
    assert len(groups) > 1
    assert [item.point for item in heard.items] == [point.item for point in groups]


def test_texts_are_put_together() -> None:
    text = named(DEVICE, "fault_text_terminal_62")
    frames = [
        can_frame(DEVICE, "read_answer", 1, address, word)
        for address, word in zip(
            text.addresses, (0x4F49, 0x4C20, 0x5052, 0x4553, 0x5355, 0x5245, 0x2020, 0x2020), strict=True
        )
    ]
    heard = hear(*frames)
    assert said(heard[0])[0].endswith("word 1 of 8 = 4F49h; 7 more words to come")
    assert '= "OIL PRESSURE"' in said(heard[7])[0]
    assert heard[7].items[0].value == "OIL PRESSURE"


def test_digits_have_names() -> None:
    heard = hear(can_frame(DEVICE, "read_answer", 1, 404, 3502))[0]
    assert "digits 3 s_1 (1 s), 5 s_5 (5 s), 0 ms_100 (100 ms), 2 ms_500 (500 ms)" in said(heard)[0]


@pytest.mark.parametrize(
    ("text", "kind", "words"),
    [
        ("33F#FF0101FB00000000", "request", "the checksum is wrong"),
        ("33F#FF0101FB0001FEFB", "request", "byte 5 is 01h, in this message it is 00h"),
        ("321#FF0201FB0190FF69", "reply", "byte 1 is 02h, in this message it is 01h"),
        ("321#1122334455667788", "unreadable", "byte 0 is 11h; on this identifier it is DDh visualisation, FFh"),
        ("321#DD00", "unreadable", "every message has 8 bytes, here are 2"),
        ("321#R", "unreadable", "remote request"),
    ],
)
def test_faults(text: str, kind: str, words: str) -> None:
    heard = hear(text)[0]
    assert heard.kind == kind
    assert any(words in fault for fault in heard.faults), heard.faults


def test_damaged_telegrams_are_not_read() -> None:
    cyclic = DEVICE.messages[0]
    roles = (*cyclic.roles[:-1], Role("xor", 0b0111_1111))
    device = replace(DEVICE, messages=(replace(cyclic, roles=roles), *DEVICE.messages[1:]))
    heard = decode(device, {}, ["321#DD00051E13880000", "321#DD00051E1388005D"], asked())
    assert (heard[0].faults, heard[0].items) == (("the checksum is wrong",), ())
    assert "not read" in heard[0].notes[0]
    assert (heard[1].faults, heard[1].checks) == ((), "ok (5D)")
    assert said(heard[1])[1].startswith("generator_frequency = 50 Hz")


def test_what_is_no_fault() -> None:
    foreign = hear("123#00")[0]
    assert (foreign.kind, foreign.unit, foreign.faults) == ("other", None, ())
    assert "320h to 33Eh visualisation" in foreign.notes[0]
    assert "multiplexers 0 to 22 only" in hear("321#DDFF000000000000")[0].findings[0]
    nobody = hear(can_frame(DEVICE, "read_request", 1, 9))[0]
    assert "no point is described" in said(nobody)[0] or nobody.items[0].point
    assert "no point is described here (1234h)" in said(hear(can_frame(DEVICE, "read_answer", 1, 60000, 0x1234))[0])[0]
    data = bytes.fromhex("FF2801FB0000")
    data += bytes((data[0] ^ data[2] ^ data[4], data[1] ^ data[3] ^ data[5]))
    assert "cannot have unit 40" in hear(f"33F#{data.hex()}")[0].findings[0]


def test_as_data() -> None:
    data = hear("(1.5) can0 " + EXPONENTS)[0].as_data()
    assert (data["can_id"], data["multiplexer"], data["time"], data["interface"]) == (0x321, 1, "1.5", "can0")
    assert (data["message"], data["framing"]) == ("visualisation", "can")


_IDS = st.one_of(st.sampled_from([0x320, 0x321, 0x33E, 0x33F]), st.integers(0, 0x1FFFFFFF))
_HEADS = st.sampled_from([b"", b"\xdd", b"\xff\x01", b"\xee\x01", b"\xdd\x0e", b"\xdd\x0f"])


@given(st.lists(st.tuples(_IDS, _HEADS, st.binary(max_size=12)), min_size=1, max_size=8))
def test_any_frames_are_safe(frames: list[tuple[int, bytes, bytes]]) -> None:
    listening = StreamDecoder(DEVICE, {}, CanFrameDecoder(DEVICE))
    for number, start, rest in frames:
        for data in (start + rest, (start + rest)[:8]):
            heard = listening.decode(Pasted(CanFrame(number, data)))
            assert heard.summary
            assert heard.as_data()


RECOGNISER = CanFrameDecoder(DEVICE)
"""It remembers what the heads of all the frames have told."""


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
    if found is not None and not found.head.flaws:
        assert found.head.message.name in good
    else:
        assert good == []


@given(st.text(max_size=60), st.one_of(st.none(), st.text(max_size=10)))
def test_any_text_is_safe(text: str, can_id: str | None) -> None:
    try:
        read_frames([text], None if can_id is None else read_identifier(can_id))
    except UnclearError as error:
        assert error.message


def test_a_word_is_written_by_one_frame() -> None:
    unit = asked(unit=3)
    transformer = at(DEVICE, 2)
    assert send(transformer.item, "500 A", unit) == (can_frame(DEVICE, "write_request", 3, 2, 500),)
    with pytest.raises(RefusedError, match="unit number") as caught:
        send(transformer.item, "500 A", asked(unit=31))
    assert caught.value.hint == "units are 0 to 30"


def test_a_text_takes_all_its_frames() -> None:
    text = named(DEVICE, "fault_text_terminal_62")
    frames = send(text.item, "OIL PRESSURE")
    assert len(frames) == 8
    assert frames[0] == can_frame(DEVICE, "write_request", 1, text.addresses[0], 0x4F49)
    heard = hear(*[frame.replace("33F#EE", "33F#EE") for frame in frames])
    assert [one.faults for one in heard] == [()] * 8
    for value, why in (("x" * 17, "16 characters, here are 17"), ("\u00e4", "cannot hold"), ("\x07", "cannot hold")):
        with pytest.raises(RefusedError, match=why):
            encode_point(DEVICE, text, value, {})


def test_bit_groups_need_the_word() -> None:
    with pytest.raises(RefusedError, match="takes the word that is there") as caught:
        send("relay_1_event_1", "5")
    assert "--with-word" in caught.value.hint
    assert can_frame(DEVICE, "read_request", 1, named(DEVICE, "relay_1_event_1").addresses[0]) in caught.value.hint
    word = send("relay_1_event_1", "5", asked(with_word="12FFh"))
    assert word == (can_frame(DEVICE, "write_request", 1, named(DEVICE, "relay_1_event_1").addresses[0], 0x0507),)
    for bad in ("10000h", "zz", "-1"):
        with pytest.raises(UnclearError, match="is no word"):
            send("relay_1_event_1", "5", asked(with_word=bad))
    with pytest.raises(UnclearError, match="takes its whole word"):
        send(at(DEVICE, 2).item, "500", asked(with_word="0h"))


@pytest.mark.parametrize(
    ("value", "raw"), [("1 s, 5 s, 0, 500 ms", 3502), ("3502", 3502), ("s_1,s_5,ms_100,ms_500", 3502), ("0,0,0,0", 0)]
)
def test_digits_are_typed(value: str, raw: int) -> None:
    assert encode_point(DEVICE, at(DEVICE, 404), value, {}).raw == raw


@pytest.mark.parametrize(
    ("value", "why"), [("1,2", "4 digits, here are 2"), ("1,2,3,x", "number"), ("1,2,3,12", "no digit")]
)
def test_digits_that_are_none(value: str, why: str) -> None:
    with pytest.raises(UnclearError, match=why):
        encode_point(DEVICE, at(DEVICE, 404), value, {})


def test_a_digit_that_the_enum_does_not_have() -> None:
    with pytest.raises(RefusedError, match="does not take 4000") as caught:
        encode_point(DEVICE, at(DEVICE, 130), "4000", {})
    assert "each digit is one of 0 " in caught.value.hint


@pytest.mark.parametrize("options", [asked(pkw=4), asked(framing="rtu"), asked(direction="request"), asked(index=0)])
def test_options_of_other_families_are_refused(options: Options) -> None:
    with pytest.raises(UnclearError, match="woodward_mpu2s"):
        refuse_foreign(DEVICE, options)
    refuse_foreign(DEVICE, asked(can_id="321", with_word="0", unit=1, request=""))
    with pytest.raises(UnclearError, match="--can-id is for can devices"):
        refuse_foreign(kitchen_sink(), asked(can_id="321"))


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


@pytest.mark.parametrize(
    ("what", "count"),
    [("can:321", 3), ("can:0x33F", 2), ("can:33Eh", 3), ("can:123", 0), ("can:zz", 0), ("read_answer", 1)],
)
def test_messages_are_explained(what: str, count: int) -> None:
    assert len(explain_other_items(DEVICE, what)) == count


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
        heard = hear(*frames_for(DEVICE, one, raw, {}, options).frames)
        assert all(not frame.faults for frame in heard)
        items = [item for frame in heard for item in frame.items if item.point in (one.item, one.name)]
        assert [item.raw for item in items] == [None if one.text is not None else raw] * len(heard), one.name
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
