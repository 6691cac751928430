"""`import dbc`: a description from a CAN database says of every frame what the database says."""

from __future__ import annotations

import os
import random
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

FOLDER = Path(__file__).parent
DBC = (FOLDER / "engine.dbc").read_text("utf-8")
FRAMES = 200


def written(tmp_path: Path, *options: str) -> str:
    """The draft of a database."""
    (tmp_path / "engine.dbc").write_text(DBC, "cp1252")
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


def test_random_frames_mean_the_same_in_and_out(tmp_path: Path) -> None:
    written(tmp_path)
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


@pytest.mark.parametrize("name", ["engine", "car"])
def test_a_database_becomes_a_device(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """FIELDSCRIBE_ACCEPT=1 writes the drafts; look at the difference."""
    path = FOLDER / f"{name}.dbc"
    assert main(["import", "dbc", str(path), "--device", name]) == 0
    printed, report = capsys.readouterr()
    draft = printed + "".join(f"# {line}\n" for line in report.splitlines())
    if os.environ.get("FIELDSCRIBE_ACCEPT"):
        path.with_suffix(".draft").write_text(draft, "utf-8")
    assert draft == path.with_suffix(".draft").read_text("utf-8")


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
