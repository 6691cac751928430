"""`explain`, `decode` and `encode` as their users ask: for all families, with their options and exit codes."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from io import BytesIO, TextIOWrapper
from pathlib import Path

import pytest
from fieldscribe.families.modbus.frames import crc16
from fieldscribe.resources import descriptions_dir
from support.small_drive import MAIN, Output

L200, CAN, USS = (str(descriptions_dir() / device) for device in ("hitachi_l200", "woodward_mpu2s", "siemens_mm4"))
pytestmark = pytest.mark.usefixtures("loads_once")


def test_the_questions_of_a_commissioning_engineer(run: Callable[..., Output]) -> None:
    explained = run("explain", L200, "A020").out
    for part in ("A020 base_frequency", "1028h (4136)", "4137", "0..400 Hz", "raw x 0.1 Hz", "01 03 10 28 00 01"):
        assert part in explained
    assert "modicon 4137" in run("explain", L200, "4137").out
    decoded = run("decode", L200, "05 06 10 28 01 F4 0C 91").out
    for part in ("RTU, unit 5", "06h", "A020 base_frequency = 50 Hz (raw 500", "reply that repeats it", "ok (0C 91)"):
        assert part in decoded
    wrong = run("decode", L200, "05 06 10 28 01 F4 A8 54")
    assert wrong.code == 1
    for part in ("A020 base_frequency = 50 Hz", "wrong: A8 54; these bytes give 0C 91", "write_base_frequency_crc"):
        assert part in wrong.out
    sent = run("encode", L200, "A020", "50 Hz", "--unit", "5", "--frame")
    assert sent.out == "05 06 10 28 01 F4 0C 91\n"
    assert "A020 base_frequency = 50 Hz: raw 500 = 01F4h" in sent.err


def test_decode(run: Callable[..., Output], small: Path) -> None:
    unquoted = run("decode", "small_drive", *["01", "06", "00", "10", "01", "F4", "88", "18"])
    assert "P1 speed = 50 Hz" in unquoted.out
    for text, message in (("05061", "5 digits"), ("05 zz", "`zz` (piece 2)"), ("", "no bytes")):
        wrong = run("decode", "small_drive", text)
        assert (wrong.code, wrong.out) == (2, "")
        assert message in wrong.err
    request, reply = "01 03 00 14 00 01 C4 0E", "01 03 02 00 64 B9 AF"
    missing = run("decode", "small_drive", reply, "--request", request)
    assert "depends on P2 ratio" in missing.out
    assert "--with P2=VALUE" in missing.out
    assert "P3 voltage = 200 V (raw 100" in run("decode", "small_drive", request, reply, "--with", "ratio=200").out
    data = json.loads(run("decode", "small_drive", request, reply, "--with", "P2=200", "--format", "json").out)
    assert [frame["kind"] for frame in data["frames"]] == ["request", "reply"]
    assert data["frames"][1]["items"][0]["value"] == "200"
    assert run("decode", "small_drive", request, "--unit", "2").out == "no frame of that unit\n"


def test_decode_says_that_limits_could_not_be_checked(run: Callable[..., Output], small: Path) -> None:
    limited = "- {name: limited, title: {en: Limited}, at: 1Ah, range: 0 .. ratio.raw}\n"
    (small / "main.yaml").write_text(MAIN.replace("TITLE", "Speed") + limited, "utf-8")
    frame = run("encode", "small_drive", "limited", "10", "--with", "P2=20", "--frame").out.strip()
    unchecked = run("decode", "small_drive", frame)
    assert unchecked.code == 0
    assert "not compared with its limits, which depend on P2 ratio: give --with ratio=VALUE" in unchecked.out
    assert "not held" not in run("decode", "small_drive", frame, "--with", "P2=20").out
    assert run("decode", "small_drive", frame, "--with", "P2=5").code == 1


def test_encode_as_json(run: Callable[..., Output], small: Path) -> None:
    data = json.loads(run("encode", "small_drive", "P1", "50", "--frame", "--format", "json").out)
    assert (data["raw"], data["hex"], data["frame"]) == (500, "1F4", "01 06 00 10 01 F4 88 18")
    text = json.loads(run("encode", CAN, "fault_text_terminal_62", "OIL", "--frame", "--format", "json").out)
    assert (text["raw"], text["frame"], len(text["frames"])) == (None, None, 8)
    assert text["hex"].startswith("4F494C2020")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (f"decode {CAN} DD00", "or give the identifier with --can-id 321"),
        (f"decode {CAN} 321#00 --pkw 0", "--pkw is for uss devices"),
        (f"decode {CAN} 321#00 --framing rtu", "--framing is for modbus and uss devices"),
        (f"decode {L200} 00 --can-id 1", "--can-id is for can devices"),
        (f"decode {L200} 00 --framing pkw", "it takes rtu, tcp"),
        (f"decode {USS} 143A00000000 --framing pkw --pkw 9", "it has 0, 3, 4, 127"),
        (f"encode {CAN} 2 500 --keep", "--keep is for uss devices"),
        (f"encode {CAN} 2 500 --index 0", "--index is for uss devices"),
    ],
)
def test_options_of_other_families_are_refused(run: Callable[..., Output], words: str, message: str) -> None:
    told = run(*words.split())
    assert (told.code, told.out) == (2, "")
    assert message in told.err


def test_frames_from_standard_input(run: Callable[..., Output], monkeypatch: pytest.MonkeyPatch) -> None:
    frames = b"(1.5) can0 321#DD010302000007D0\n\n(1.6) can0 321#DD00051E13880064\n"
    monkeypatch.setattr(sys, "stdin", TextIOWrapper(BytesIO(frames)))
    data = json.loads(run("decode", CAN, "-", "--format", "json").out)
    assert [frame["time"] for frame in data["frames"]] == ["1.5", "1.6"]
    assert data["frames"][1]["items"][2]["value"] == "100000"


def _rtu(text: str) -> str:
    """Return the bytes with their checksum."""
    data = bytes.fromhex(text)
    return (data + crc16(data).to_bytes(2, "little")).hex(" ")


@pytest.mark.parametrize(
    ("words", "finding"),
    [
        ((L200, _rtu("01 06 10 28 FF FF")), "6553.5 Hz is outside 0..400 Hz"),
        ((L200, _rtu("01 03 10 28 00 05")), "the device takes at most 4 of them in one request"),
        ((L200, _rtu("01 03 00 30 00 01")), "the manual closes 002Fh to 08FFh"),
        ((L200, _rtu("28 03 10 28 00 01")), "the device cannot have unit 40"),
        ((L200, _rtu("01 04 10 28 00 01")), "the device does not know function 04h"),
        ((L200, "00 07 00 00 00 06 05 03 10 28 00 01", "--framing", "tcp"), ""),
        ((L200, _rtu("00 03 10 28 00 01")), "only writes may be sent to all units"),
        ((CAN, "321#DDFF000000000000"), "the manual knows multiplexers 0 to 22 only"),
        ((USS, "A43A 0000 0000 0000", "--framing", "pkw"), "the device cannot do this task"),
        ((USS, "343A 0000 4220", "--framing", "pkw", "--pkw", "3"), "does not fit into this parameter part"),
        ((USS, "007F 0000", "--framing", "pzd"), "breaks what is always written: bit 10 always 1"),
        ((L200, _rtu("01 06 10 28 01 F4")), ""),
        ((L200, _rtu("00 06 10 28 01 F4")), ""),
        ((L200, _rtu("01 03 10 28 00 01"), _rtu("01 03 02 FF FF")), ""),
        ((L200, _rtu("01 03 10 29 00 01")), ""),
        ((USS, "020E01143A0000000000000000000023"), ""),
    ],
)
def test_decode_ends_with_1_for_what_a_sound_frame_asks_wrongly(
    run: Callable[..., Output], words: tuple[str, ...], finding: str
) -> None:
    """Notes, and what replies bring, are no findings."""
    told = run("decode", *words)
    assert (told.code, finding in told.out) == (1 if finding else 0, True), told.out
    data = json.loads(run("decode", *words, "--format", "json").out)["frames"][0]
    assert data["faults"] == []
    assert bool(data["findings"] or any(item["findings"] for item in data["items"])) == bool(finding)
