"""`list` and `search`: what there is, and where a word stands. The right answers are those of the descriptions."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable
from typing import NamedTuple

import pytest
from fieldscribe.cli import main
from fieldscribe.diagnostics import Report
from fieldscribe.search import Entry, entries_of, near_words, search
from support.described import SHIPPED
from support.loaded_once import load_analysis
from support.places import ROOT

pytestmark = pytest.mark.usefixtures("loads_once")


class Output(NamedTuple):
    """How a command ended, and what it printed."""

    code: int
    out: str
    err: str


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Callable[..., Output]:
    monkeypatch.chdir(ROOT)
    return lambda *words: Output(main(list(words)), *capsys.readouterr())


@pytest.fixture(scope="module")
def entries() -> list[Entry]:
    subjects = [load_analysis(ROOT / "descriptions" / device / "device.yaml", Report()) for device in SHIPPED]
    return [entry for subject in subjects if subject is not None for entry in entries_of(subject)]


@pytest.mark.parametrize(
    ("words", "first", "expected"),
    [
        ("E07", "hitachi_l200 d081 trip_1_error", "enum Overvoltage (E07) enums.yaml:25"),
        ("error:21h", "hitachi_l200 exception 21h value_out_of_range", "number 33 bus.yaml:21"),
        ("exception:33", "hitachi_l200 exception 21h value_out_of_range", "number 33 bus.yaml:21"),
        ("fault:7", "hitachi_l200 d081 trip_1_error", "enum overvoltage enums.yaml:25"),
        ("error:17", "siemens_mm4 error 17 not_in_this_operating_state", "number 17"),
        ("Hochlaufzeit", "hitachi_l200 F002 acceleration_time", "title 1. Hochlaufzeit basic_f.yaml:23"),
        ("HOCHLAUFZEIT jog", "siemens_mm4 P1060 jog_acceleration_time", "title Tippen Hochlaufzeit"),
        ("4.2.40", "woodward_mpu2s part_load_lead_setpoint", "section 4.2.40 parameters_controllers.yaml"),
        ("A020", "hitachi_l200 A020 base_frequency", "code A020 standard_a.yaml"),
        ("acceleration_time", "hitachi_l200 F002 acceleration_time", "name acceleration_time"),
        ("überspannung E07", "hitachi_l200 d081 trip_1_error", "enum Überspannung (E07)"),
        ("ueberspannung e07", "hitachi_l200 d081 trip_1_error", "enum Überspannung (E07)"),
        ("uberspannung e07", "hitachi_l200 d081 trip_1_error", "enum Überspannung (E07)"),
        ("off2", "siemens_mm4 STW control_word", "flag off2"),
        ("visualisation Sendetelegramm", "woodward_mpu2s telegram visualisation", "name visualisation bus.yaml:13"),
        ("ENTER-Befehl", "hitachi_l200 command enter", "title ENTER-Befehl bus.yaml"),
        ("binary_output_1 zero", "jumo_controller binary_outputs", "flag zero process_data.yaml:32"),
        ("monitor_d", "hitachi_l200 d001 output_frequency", "group monitor_d monitor_d.yaml:22"),
        ("addi", "hitachi_l200 A146 frequency_offset_sign", "enum Plus (addiert A145) standard_a.yaml:687"),
        ("7", "siemens_mm4 task 7 write_array_word", "number 7 bus.yaml:42"),
    ],
)
def test_the_first_hit(words: str, first: str, expected: str, entries: list[Entry]) -> None:
    hit = search(entries, words.split())[0]
    assert f"{hit.entry.device} {hit.entry.heading}".startswith(f"{first}:")
    spans = [(text, text.place) for text in hit.texts]
    found = [f"{text.kind} {text.text} {span.file.rpartition('/')[2]}:{span.line}" for text, span in spans]
    assert any(text.startswith(expected) for text in found), found
    for text, span in spans:
        if text.kind in ("title", "code"):
            assert text.text in (ROOT / span.file).read_text("utf-8").splitlines()[span.line - 1]


def test_a_section_is_no_beginning_of_another(entries: list[Entry]) -> None:
    sections = {text.text for hit in search(entries, ["4.2.4"]) for text in hit.texts}
    assert sections <= {"4.2.4", *(f"4.2.4.{number}" for number in range(100))}
    assert {hit.entry.device for hit in search(entries, ["4.2"])} >= {"woodward_mpu2s"}


def test_near_words(entries: list[Entry]) -> None:
    assert search(entries, ["Hochlaufzeitt"]) == []
    assert near_words(entries, ["Hochlaufzeitt"])[0] == "Hochlaufzeit"


@pytest.mark.usefixtures("loads_once")
def test_search(run: Callable[..., Output]) -> None:
    told = run("search", "base_frequency", "--device", "hitachi_l200")
    assert told.out.startswith("hitachi_l200 A020 base_frequency: Base frequency / ")
    assert "descriptions/hitachi_l200/standard_a.yaml:" in told.out
    hits = json.loads(run("search", "Drehrichtung", "--device", "hitachi_l200", "--format", "json").out)["hits"]
    [direction] = [hit for hit in hits if hit["code"] == "F004"]
    assert direction["matched"][0]["file"].endswith("basic_f.yaml")
    for word, matched in (("error:21h", "number `33`, "), ("fault:7", "enum `overvoltage` (7), ")):
        assert run("search", word, "--device", "hitachi_l200").out.splitlines()[1].startswith(f"  {matched}")
    nothing = run("search", "bse_frequency", "--device", "hitachi_l200")
    assert (nothing.code, nothing.out) == (1, "")
    assert "did you mean `base_frequency`" in nothing.err
    few = run("search", "frequency", "--device", "hitachi_l200", "--most", "3")
    assert few.out.count("\nhitachi_l200 ") == 2
    assert few.out.splitlines()[-1].startswith("and ")


def test_the_list_of_devices(run: Callable[..., Output]) -> None:
    told = run("list")
    assert [line.split()[0] for line in told.out.splitlines()] == ["device", *SHIPPED]
    data = json.loads(run("list", "--family", "modbus", "--matching", "*l2*", "--format", "json").out)["devices"]
    assert [" ".join(map(str, device.values())) for device in data] == [
        "hitachi_l200 Hitachi L200 {'en': 'Frequency inverter', 'de': 'Frequenzumrichter'} modbus 1.0.0 256"
    ]
    assert run("list", "--family", "nothing").code == 1
    assert "--unit chooses points" in run("list", "--unit", "Hz").err


@pytest.mark.parametrize(
    ("words", "names"),
    [
        (("--matching", "f00*"), ["frequency_setpoint", "acceleration_time", "deceleration_time", "motor_direction"]),
        (("--matching", "F00?", "--unit", "s"), ["acceleration_time", "deceleration_time"]),
        (("--matching", "*trip_1*", "--type", "u16", "--access", "w"), []),
        (("--space", "coil", "--access", "w", "--matching", "*command*"), ["run_command", "direction_command"]),
        (("--group", "basic_f", "--type", "u16"), ["frequency_setpoint", "motor_direction"]),
    ],
)
def test_the_points_of_a_device(words: tuple[str, ...], names: list[str], run: Callable[..., Output]) -> None:
    told = run("list", "hitachi_l200", *words, "--format", "json")
    assert [point["name"] for point in json.loads(told.out)["points"]] == names
    assert told.code == (0 if names else 1)


def test_points_for_people_and_spreadsheets(run: Callable[..., Output]) -> None:
    first, row = run("list", "hitachi_l200", "--matching", "A020").out.splitlines()
    assert first.split() == ["code", "name", "space", "address", "access", "type", "unit", "range", "group", "title"]
    assert row.split()[:8] == ["A020", "base_frequency", "holding", "1028h", "rw", "u16", "Hz", "0..400"]
    rows = list(csv.reader(io.StringIO(run("list", "hitachi_l200", "--format", "csv").out)))
    assert len(rows) == 257
    assert {len(row) for row in rows} == {10}
