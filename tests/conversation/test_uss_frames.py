"""USS telegrams in words, and values into USS telegrams."""

from __future__ import annotations

from fractions import Fraction

import pytest
from fieldscribe.arithmetic.words import with_fixed
from fieldscribe.conversation.decoder import StreamDecoder, decode
from fieldscribe.conversation.encoding import encode_point, frames_for, read_settings
from fieldscribe.conversation.explanation import explain_point, sample_raw
from fieldscribe.conversation.lookup import find
from fieldscribe.conversation.selection import choose_point, choose_variants
from fieldscribe.diagnostics import UnclearError
from fieldscribe.families.frame_results import FrameResult, Options
from fieldscribe.families.uss.frame_decoder import UssFrameDecoder
from fieldscribe.families.uss.telegrams import Link, Request, parse, telegram
from hypothesis import given
from hypothesis import strategies as st
from support.asked import asked
from support.described import made, shipped
from support.frames_by_hand import coded, uss_bytes

DEVICE = shipped("siemens_mm4")
SCALED = read_settings(DEVICE, ["P2000=50", "P2009=0"])
READ, ANSWER = "143A 0000 0000 0000", "243A 0000 4248 0000"
PKW = asked(framing="pkw")


def decode_all(*texts: str, options: Options | None = None, **settings: int | Fraction) -> list[FrameResult]:
    """Decode all telegrams, one after the other."""
    return decode(DEVICE, settings, texts, options or asked())


def pkw(*texts: str, link: int | None = None, direction: str | None = None) -> list[FrameResult]:
    """Decode parameter parts alone."""
    return decode_all(*texts, options=asked(framing="pkw", pkw=link, direction=direction))


def send(code: str, value: str, options: Options | None = None, *given: str) -> tuple[str, ...]:
    """Return the telegrams that write a value."""
    settings = read_settings(DEVICE, list(given))
    chosen = options or asked()
    point = choose_point(DEVICE, code, index=chosen.index)
    return frames_for(DEVICE, point, encode_point(DEVICE, point, value, settings).raw, settings, chosen).frames


def test_single_words_by_the_length_of_the_part() -> None:
    last = pkw("22BC 0000 0000 0005", "12BC 0000 0000 0005", link=4)
    assert [one.items[0].raw for one in last] == [5, 5]
    misplaced = pkw("22BC 0000 0005 0000", link=4)[0]
    assert "the second value word, here the first is used; is --pkw 127 or --single-first meant?" in misplaced.notes[0]
    assert "is --pkw 4 meant?" in pkw("22BC 0000 0000 0005")[0].notes[0]
    first = decode_all("22BC 0000 0005 0000", options=asked(framing="pkw", pkw=4, single_first=True))[0]
    assert first.items[0].raw == 5
    short = pkw("12BC 0000 0000", "12BC 0000 0002", link=3)
    assert short[1].items[0].raw == 2
    assert "does not fit" in pkw("343A 0000 4220", link=3)[0].findings[0]


def test_an_error_in_a_part_that_is_too_short_is_told_all_the_same() -> None:
    """Its one value word may be the second: then what the first held was never sent."""
    (short,) = pkw("743A 0000 0011", link=4, direction="response")
    assert short.exception == 17
    assert short.faults
    assert not any("second" in note for note in short.notes)
    (whole,) = pkw("743A 0000 0011 0005", link=4, direction="response")
    assert any("stand in the second, which holds 5" in note for note in whole.notes)


def test_a_request_for_what_the_chosen_model_lacks_says_so() -> None:
    """P3900 exists only in the model mm440; what an answer is about, the device has."""
    read, refused = "176C 8000 0000 0000", "776C 8000 0000"
    for model, told in (("mm420", True), ("mm440", False)):
        device = choose_variants(made("kitchen_uss"), [f"model={model}"])
        request, _ = decode(device, {}, (read, refused), asked(framing="pkw", pkw=127))
        assert any("exists only when" in each for item in request.items for each in item.findings) is told


def test_tasks_that_the_device_cannot_do() -> None:
    assert "cannot do this task; expect response 7 not_executable" in pkw("A43A 0000 0000 0000")[0].findings[0]
    assert "EEPROM" in pkw("D43A 0000 4220 0000")[0].notes[0]
    assert "SP" in pkw("1C3A 0000 0000 0000")[0].findings[0]
    error = pkw("143A 0000 0000 0000", "743A 0000 0005")[1]
    assert error.findings == ("the manual does not give error 5 for task 1",)
    assert "which the manual does not list" in pkw(READ, "743A 0000 0063")[1].summary
    assert pkw(READ, "843A 0000 0000")[1].summary.endswith("response 8 no_control, parameter 1082")
    assert pkw(READ, "003A 0000 0000", ANSWER)[2].kind == "reply"


def test_whole_telegrams() -> None:
    asked, answer = uss_bytes(1, "1000 8000 0000 0000 047F 3333"), uss_bytes(1, "2000 8000 4248 0000 FA31 3333")
    decoded = decode_all(asked, answer, asked, uss_normalisation=0)
    assert [one.kind for one in decoded] == ["request", "reply", "request"]
    assert [one.unit for one in decoded] == [1, 1, 1]
    assert decoded[0].checks == "ok (E6)"
    items = [item.text for item in decoded[1].items]
    assert items[0].startswith("P2000 reference_frequency = 50 Hz")
    assert items[1].startswith(
        "ZSW status_word = raw 64049 = FA31h: Status word; ready_to_switch_on, deviation (its bit is 0)"
    )
    assert "off2_pending (no OFF2)" in items[1]
    assert items[2].startswith("HIW main_actual_value = about 39.9993896 Hz")
    assert decoded[0].items[-1].missing == ("reference_frequency",)
    assert "HSW main_setpoint = about 39.9993896 Hz" in decoded[2].items[-1].text


def test_settings_are_learned_where_the_interface_is_chosen() -> None:
    telegrams = [uss_bytes(1, words) for words in (
        "1000 8000 0000 0000 0000 0000", "2000 8000 4248 0000 0000 0000",
        "1009 8000 0000 0000 0000 0000", "1009 8000 0001 0000 0000", "0000 0000 0000 0000 047F 0FA0",
    )]  # fmt: skip
    chosen = choose_variants(DEVICE, ["interface=rs485"])
    decoded = decode(chosen, {}, telegrams, asked())
    assert decoded[4].items[-1].text.startswith("HSW main_setpoint = 40 Hz")
    assert decode_all(*telegrams)[4].items[-1].missing == ("uss_normalisation",)


def test_process_data_alone() -> None:
    no_part = asked(pkw=0)
    decoded = decode_all(uss_bytes(1, "047F 3333"), uss_bytes(1, "FA31 3333"), options=no_part)
    assert [item.point for one in decoded for item in one.items] == [
        "control_word",
        "main_setpoint",
        "status_word",
        "main_actual_value",
    ]
    words = decode_all("FA31 3333", options=asked(framing="pzd", direction="response"), **SCALED)[0]
    assert "39.9993896 Hz" in words.items[1].text
    assert "--direction response" in decode_all("047F 3333", options=asked(framing="pzd"))[0].notes[0]
    assert decode_all("00" * 20, options=asked(framing="pzd"))[0].faults == (
        "there are 0 to 8 words of process data, here are 10",
    )
    ignored = decode_all("0000", options=asked(framing="pzd", direction="request"))[0]
    assert "breaks what is always written: bit 10 always 1" in ignored.items[0].text


@pytest.mark.parametrize(
    ("words", "texts"),
    [
        (
            "0006 FFFF 0000 0000 047F 3333",
            ["words 1 and 2 of process data count", "every bit of STW counts", "no bit of STW2"],
        ),
        (
            "0006 0401 0000 0000 0400 0000",
            ["words 1 and 2", "only these bits of STW count (on, setpoints_valid)", "no bit"],
        ),
        (
            "0000 0000 1234 5678 0000 0000",
            ["no word of process data counts", "no bit of STW", "only these bits of STW2 count"],
        ),
        ("FFFF FFFF FFFF FFFF 0000 0000", ["words 1, 2, 3", "every bit of STW counts", "every bit of STW2 counts"]),
    ],
)
def test_broadcasts(words: str, texts: list[str]) -> None:
    for decoded in (decode_all(uss_bytes(32, words))[0], decode_all(words, options=asked(framing="broadcast"))[0]):
        assert decoded.kind == "broadcast"
        for item, text in zip(decoded.items, texts, strict=False):
            assert text in item.text
    assert decode_all("0006 FFFF", options=asked(framing="broadcast"))[0].faults


def test_words_that_are_no_telegram() -> None:
    decoded = decode_all(READ)[0]
    assert decoded.kind == "unreadable"
    assert "--framing pkw" in decoded.notes[0]
    assert decode_all("143A00", options=PKW)[0].faults == ("the part is made of words of two bytes, here are 3 bytes",)
    with pytest.raises(UnclearError, match="not a telegram"):
        decode_all("zz")
    assert "cannot have unit 33" in decode_all(uss_bytes(33, "143A 0000 0000 0000 0000 0000"))[0].findings[0]


@pytest.mark.parametrize(
    ("options", "why"), [(asked(pkw=5), "no parameter part of this length"), (asked(pzd=9), "0 to 8 words")]
)
def test_links_that_the_device_does_not_know(options: Options, why: str) -> None:
    with pytest.raises(UnclearError, match=why):
        decode_all("00", options=options)


def test_a_part_longer_than_any_telegram_is_read_after_a_request() -> None:
    """Its words were once put into a telegram to be judged, whose length byte could not say so many."""
    _, long = pkw(READ, ANSWER + " 0000" * 150)
    assert (long.kind, long.unit) == ("reply", None)


@given(
    st.lists(st.binary(max_size=24), min_size=1, max_size=5),
    st.sampled_from(["uss", "pkw", "pzd", "broadcast"]),
    st.sampled_from([0, 3, 4, 127]),
    st.sampled_from([None, "request", "response"]),
)
def test_any_bytes_are_safe(frames: list[bytes], framing: str, words: int, direction: str | None) -> None:
    decoder = StreamDecoder(DEVICE, {}, UssFrameDecoder(DEVICE, Link(words, 2), framing, direction))
    for data in frames:
        even = data[: len(data) & ~1]
        for whole in (data, telegram(1, [int.from_bytes(even[at : at + 2], "big") for at in range(0, len(even), 2)])):
            decoded = decoder.decode(whole)
            assert decoded.summary
            assert decoded.as_data()


@given(
    st.integers(0, 15),
    st.integers(0, 2047),
    st.integers(0, 0xFFFF),
    st.integers(0, 0xFFFFFFFF),
    st.sampled_from([3, 4, 127]),
)
def test_answers_without_faults_are_those_of_the_reference(
    code: int, number: int, place: int, value: int, words: int
) -> None:
    """Whatever the reference does not take as an answer is either called a request or faulty."""
    asked = Request(1, 1, 1082, 0, words=(0, 0))
    link = Link(words, 2)
    part = (code << 12 | number, place, value >> 16, value & 0xFFFF)[: link.sent]
    answer = telegram(1, (*part, 0, 0))
    status = parse(DEVICE.bus, link, asked, answer).status
    decoder = StreamDecoder(DEVICE, {}, UssFrameDecoder(DEVICE, link))
    decoder.decode(telegram(1, (*(0x143A, 0, 0, 0)[: link.sent], 0, 0)))
    decoded = decoder.decode(answer)
    assert (decoded.kind in ("reply", "exception")) == (status in ("ok", "refused", "no_rights", "no_answer"))
    assert decoded.faults == ()


def test_process_data_takes_along_what_is_given() -> None:
    frames = send("HSW", "40", asked(framing="pzd"), "STW=047Fh", "P2000=50", "P2009=0")
    assert frames == ("047F 3333",)
    point = coded(DEVICE, "P1082")
    told = frames_for(DEVICE, point, 0, {}, asked())
    assert "task 3 write_double_word" in told.notes[0]
    assert "STW control_word goes along as 0000h" in told.notes[1]
    assert len(frames_for(DEVICE, point, 0, {coded(DEVICE, "STW").name: 0x047E}, asked()).notes) == 1


def test_explained() -> None:
    rows = dict(explain_point(DEVICE, coded(DEVICE, "P1082")).rows)
    assert "PKW 143A 0000 0000 0000; telegram to unit 1 (PKW variable, PZD 2): 02 0E 01 14 3A" in rows["Read"]
    assert "task 3 write_double_word (RAM) or task 13 store_double_word (EEPROM too)" in rows["Write"]
    rows = dict(explain_point(DEVICE, coded(DEVICE, "ZSW")).rows)
    assert rows["Read"].startswith("word 1 of the process data of every answer")
    rows = dict(explain_point(DEVICE, coded(DEVICE, "HSW")).rows)
    assert rows["Write"].startswith("word 2 of the process data of every request")
    assert [match.point.index for match in find(DEVICE, "P2010[1]")] == [1]
    assert [match.point.index for match in find(DEVICE, "wire:2010[0]")] == [0]
    assert find(DEVICE, "P2010[9]") == []
    assert [match.point.index for match in find(DEVICE, "P2010")] == [0, 1]


def test_every_point_is_explained() -> None:
    for one in DEVICE.points:
        rows = dict(explain_point(DEVICE, one).rows)
        assert ("Read" in rows) == (one.generated and one.readable), one.name
        assert ("Write" in rows) == (one.generated and one.writable), one.name


@pytest.mark.parametrize(("pkw_words", "keep"), [(127, False), (127, True), (4, False), (4, True)])
def test_every_point_comes_back_from_its_telegram(pkw_words: int, keep: bool) -> None:
    for one in DEVICE.points:
        raw = sample_raw(one) if one.writable and one.generated else None
        if raw is None or (keep and one.telegram is not None):
            continue
        raw = with_fixed(one, raw)
        options = asked(pkw=pkw_words, pzd=8, keep=keep)
        (frame,) = frames_for(DEVICE, one, raw, {}, options).frames
        (decoded,) = decode_all(frame, options=asked(pkw=pkw_words, pzd=8))
        assert not decoded.faults
        items = [item for item in decoded.items if item.point in (one.item, one.name)]
        assert [item.raw for item in items] == [raw], one.name
