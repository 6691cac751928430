"""`import dbc`: a description from a CAN database says of every frame what the database says."""

from __future__ import annotations

import random
import re
import sys
from pathlib import Path
from typing import Any

import cantools
import corpus.__main__ as corpus
import pytest
from fieldscribe.cli import main
from fieldscribe.diagnostics import Report
from fieldscribe.families.can.dbc import export
from fieldscribe.pipeline import load_device

DBC = (Path(__file__).parent / "engine.dbc").read_text("utf-8")
FRAMES = 200


def written(tmp_path: Path, *options: str, text: str = DBC) -> str:
    """The draft of a database."""
    (tmp_path / "engine.dbc").write_text(text, "cp1252")
    out = tmp_path / "engine" / "device.yaml"
    assert main(["import", "dbc", str(tmp_path / "engine.dbc"), "--device", "engine", "--out", str(out), *options]) == 0
    return out.read_text("utf-8")


def database(text: str) -> Any:
    """The database as cantools reads it."""
    return cantools.database.load_string(text, "dbc", strict=False)


def values_of(message: Any, data: bytes) -> list[str]:
    """What cantools says of a frame, in the order of the numbers; of a frame that it refuses, that."""
    try:
        return sorted(map(repr, map(float, message.decode(data, decode_choices=False).values())))
    except cantools.database.DecodeError:
        return ["none"]


def test_random_frames_mean_the_same_in_and_out(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(tmp_path)
    said = capsys.readouterr().err
    device = load_device(tmp_path / "engine" / "device.yaml", Report())
    assert device is not None
    first, again = database(DBC), database(export(device).decode("latin-1"))
    chance = random.Random(25)
    for message in (one for one in first.messages if one.signals):
        other = next(one for one in again.messages if one.frame_id == message.frame_id)
        assert (other.is_extended_frame, other.length, other.cycle_time) == (
            message.is_extended_frame,
            message.length,
            message.cycle_time,
        )
        for _ in range(FRAMES):
            data = chance.randbytes(message.length)
            if message.name == "Sensors":
                data = bytes([chance.choice((2, 3, 4, 5, 7)) << 4 | data[0] & 15, data[1] & 15 | 32, *data[2:]])
            assert values_of(other, data) == values_of(message, data), message.name
    assert "13 of 13 signals in 4 messages" in said
    assert "names of numbers that the signal cannot hold (1)" in said
    assert "messages without signals (1)" in said


def test_what_the_draft_says(tmp_path: Path) -> None:
    text = written(tmp_path)
    for line in (
        "certainty: imported",
        "- {name: eec1, title: {en: EEC1}, direction: cyclic, can_id: 0CF004FEh, identifier_bits: 29, every: 20 ms}",
        "  furlong: {name: furlong, quantity: unknown}",
        "bytes: low first",
        "- code: EngSpeed",
        "  name: eng_speed",
        "  scale: value = raw * 0.125",
        "  note: {en: Actual engine speed}",
        "- name: eec1_counter",
        '  when: "page in (3, 7)"',
        "  when: page == 4 and sub == 2",
        "  view_of: whole",
    ):
        assert f"{line}\n" in text, line


def test_names_differ_in_more_than_underscores(tmp_path: Path) -> None:
    """In languages that write no underscores, such names would be one."""
    signals = "".join(f' SG_ {name} : {8 * at}|8@1+ (1,0) [0|0] "" D\n' for at, name in enumerate(("temp1", "temp_1")))
    text = written(tmp_path, text=f'VERSION ""\nBU_: D\nBO_ 1 M: 8 D\n{signals}')
    assert "name: temp1" in text
    assert "name: temp_1_n2" in text


@pytest.mark.parametrize(("sign", "least", "greatest"), [("-", -128, 127), ("+", 0, 255)])
def test_numbers_that_a_signal_can_hold_have_their_names(
    sign: str, least: int, greatest: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    names = f'VAL_ 1 A {least - 1} "under" {least} "least" {greatest} "greatest" {greatest + 1} "over" ;\n'
    signals = f' SG_ B : 8|8@1+ (1,0) [0|0] "" D\n SG_ A : 0|8@1{sign} (1,0) [0|0] "" D\n'
    text = written(tmp_path, text=f'VERSION ""\nBU_: D\nBO_ 1 M: 8 D\n{signals}{names}')
    assert "names of numbers that the signal cannot hold (2)" in capsys.readouterr().err
    assert [word in text for word in (f"{least}: ", f"{greatest}: ", "under", "over")] == [True, True, False, False]
    assert re.findall("line: ([0-9]+)", text) == ["5", "4"]


def test_a_node_receives_what_others_send(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = written(tmp_path, "--node", "ENGINE")
    assert "{name: limits, title: {en: Limits}, direction: request" in text
    assert "{name: sensors, title: {en: Sensors}, direction: cyclic" in text
    path = str(tmp_path / "engine.dbc")
    assert main(["import", "dbc", path, "--node", "Motor"]) == 1
    assert "the database has no node `Motor`" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"BO_ 1 A: 8\n SG_", "this is no CAN database"),
        (b"\xff\x00\x01", "this is no CAN database"),
        (b'VERSION ""\nBO_ 1 A: 8 X\n', "holds no signals"),
        (b"", "this is no CAN database"),
    ],
)
def test_what_is_no_database(tmp_path: Path, capsys: pytest.CaptureFixture[str], data: bytes, why: str) -> None:
    path = tmp_path / "x.dbc"
    path.write_bytes(data)
    assert main(["import", "dbc", str(path)]) == 1
    assert why in capsys.readouterr().err


def test_without_cantools(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "x.dbc").write_text(DBC, "utf-8")
    monkeypatch.setitem(sys.modules, "cantools.database", None)
    assert main(["import", "dbc", str(tmp_path / "x.dbc")]) != 0
    assert "fieldscribe[dbc]" in capsys.readouterr().err


def test_a_collection_is_equal_in_random_frames(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "engine.dbc").write_text(DBC, "cp1252")
    (tmp_path / "empty.dbc").write_text('VERSION ""\n', "cp1252")
    (tmp_path / "broken.dbc").write_text("BO_", "cp1252")
    assert corpus.main(tmp_path) == 0
    assert "| dbc | 1 | 1 | 1 | 13 | 100.00% |" in capsys.readouterr().out
