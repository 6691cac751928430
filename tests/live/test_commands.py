"""The commands on a live device: exit codes, answers, refusals, and what is said when a line fails."""

from __future__ import annotations

import io
import json
import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from fieldscribe.cli import live_options, points
from fieldscribe.live.connection import device_class
from fieldscribe.live.writing import Write
from fieldscribe.simulation import Simulated, simulated
from fieldscribe_runtime import AnyDevice
from fieldscribe_runtime.modbus.planner import plan
from support.described import DEVICES, described, group, head, together, write
from support.small_drive import Output

pytestmark = pytest.mark.usefixtures("loads_once")

Run = Callable[..., Output]
VALUES: dict[str, str | int | float] = {
    "base_frequency": 50,
    "maximum_frequency": 60,
    "lower_frequency_limit": 10,
    "run_command": "stop",
}


@pytest.fixture(scope="module")
def drive() -> Iterator[Simulated]:
    with simulated("hitachi_l200", values=VALUES) as running:
        yield running


@pytest.fixture
def other(others: dict[str, str], run: Run) -> Run:
    """Run a command on the line of the device that it names, else on the drive's."""
    return lambda *words: run(*words, "--line", others.get(words[1], others["siemens_mm4"]))


@pytest.fixture(scope="module")
def others() -> Iterator[dict[str, str]]:
    """Lines with a drive on USS, and a genset on CAN whose telegrams come ten times as often."""
    values = {"maximum_frequency": 50}
    with simulated("siemens_mm4", values=values) as mm4, simulated("woodward_mpu2s", on="can", time_scale=10):
        yield {"siemens_mm4": f"uss://{mm4.path}", "woodward_mpu2s": "can://virtual/woodward_mpu2s"}


@pytest.fixture
def on_line(drive: Simulated, run: Run, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Run a command on the line of the drive; nobody can be asked."""
    monkeypatch.setattr(sys, "stdin", io.StringIO())
    return lambda *words: run(*words, "--line", f"tcp://127.0.0.1:{drive.port}", "--timeout", "0.5")


def answers(*texts: str) -> io.StringIO:
    """A terminal on which somebody types these lines."""
    terminal = io.StringIO("".join(f"{text}\n" for text in texts))
    terminal.isatty = lambda: True  # type: ignore[method-assign]  # nobody types in a test
    return terminal


@pytest.mark.parametrize(
    ("words", "code", "out", "err"),
    [
        ("read hitachi_l200 A020", 0, r"^A020 base_frequency  50 Hz\n$", "^$"),
        ("read hitachi_l200 0x1028 run_command", 0, r"^A020 .* 50 Hz\nrun_command +stop \(Stop\)\n$", "^$"),
        ("read hitachi_l200 A020 --unit 1 -v", 0, "50 Hz", r"01 03 10 28 00 01 \(A020 .*\n.*\n1 request\n$"),
        (
            "read hitachi_l200 A020 --unit 9",
            2,
            "^$",
            r"exception 0Bh .*\n  hint: are the unit .*fieldscribe scan`",
        ),
        ("read hitachi_l200 A020 --unit 999", 2, "^$", "the device can be unit 1 to 32, not 999\n  hint: .*--unit"),
        ("read hitachi_l200 A02", 2, "^$", "no point or group `A02`\n  hint: did you mean"),
        ("read hitachi_l200 stattus", 2, "^$", "no point or group `stattus`\n  hint: did you mean `status`"),
        (
            "read siemens_mm4 P1082",
            2,
            "^$",
            "siemens_mm4 is a uss device, and none is on a line tcp://\n  hint: .*uss://",
        ),
        ("write hitachi_l200 A020=401 --yes", 1, "^$", "A020 base_frequency: 401 Hz is outside 0..400 Hz"),
        ("write hitachi_l200 A061=70 --yes", 1, "^$", r"upper_frequency_limit: 70 Hz is outside .* 10..60 Hz"),
        ("write hitachi_l200 d001=1 --yes", 1, "^$", "d001 output_frequency is read only"),
        ("write hitachi_l200 A020=x --yes", 2, "^$", "base_frequency: `x` is no number"),
        (
            "write hitachi_l200 A020 --yes",
            2,
            "^$",
            "no command of hitachi_l200, and has no value\n  hint: write POINT=",
        ),
        (
            "write hitachi_l200 A020=50.04 --yes",
            0,
            "^written: .* = 50 Hz: raw 500",
            "^note: 50.04 Hz .* rounded to 50 Hz",
        ),
        ("write hitachi_l200 A020=40", 2, "^$", "A020 .* = 40 Hz(.|\n)*nothing was written\n  hint: give --yes"),
        ("write hitachi_l200 run_command=run --keep --yes", 2, "^$", "does not say how it is kept\n  hint: leave out"),
        ("monitor hitachi_l200 A020 --count 2 --every 0", 0, r"^[\d:.]{12}  A020 base_frequency  50 Hz\n$", "^$"),
        ("monitor hitachi_l200 A020 --count 2 --every 0 --all", 0, r"^(.* 50 Hz\n){2}$", "^$"),
        ("monitor hitachi_l200 A020 --unit 9 --count 2", 2, "^$", "exception 0Bh"),
        ("monitor hitachi_l200 A020 --every -1", 2, "^$", "no number of seconds"),
        ("monitor hitachi_l200 A020 --count 0", 2, "^$", "`0` is no number of times from 1 to 100000000"),
        ("read hitachi_l200 A020 --timeout 0", 2, "^$", "`0` is no number of seconds above 0"),
        ("read hitachi_l200 A020 --timeout 1e9", 2, "^$", "`1e9` is no number of seconds above 0, up to 100000000"),
        ("read hitachi_l200 A020 --retries -1", 2, "^$", "`-1` is no number of times from 0 to 100000000"),
        (
            "read hitachi_l200 A020 --retries 99999999999999999999",
            2,
            "^$",
            "`99999999999999999999` is no number of times",
        ),
        ("read hitachi_l200 A020 --unit 0", 2, "^$", "unit 0 is all units at once, and nobody .*\n  hint: give --unit"),
        ("monitor hitachi_l200 A020 --unit 0 --count 1", 2, "^$", "unit 0 is all units at once"),
        ("snapshot hitachi_l200 --unit 0 --out all.json", 2, "^$", "unit 0 is all units at once"),
        (
            "write hitachi_l200 A020=abc --yes",
            2,
            "^$",
            "base_frequency: `abc` is no number\n  hint: it takes 0..400 Hz; hexadecimal is 0xabc",
        ),
        ("write hitachi_l200 A020=50 base_frequency=60 --yes", 2, "^$", "A020 base_frequency is given twice: nothing"),
        (
            "read hitachi_l200 overvoltage_deceleration_level_200v --variant voltage_class=400V",
            2,
            "^$",
            "has `overvoltage_deceleration_level_200v` only in another variant\n  hint: it is there with `--variant",
        ),
        (
            "write hitachi_l200 overvoltage_deceleration_level_200v=390 --variant voltage_class=400V --yes",
            2,
            "^$",
            "only in another variant\n  hint: it is there with `--variant voltage_class=200V`\n",
        ),
        ("listen hitachi_l200 --for nan", 2, "^$", "`nan` is no number of seconds above 0"),
        ("listen hitachi_l200 --for -1", 2, "^$", "`-1` is no number of seconds above 0"),
        (
            "read hitachi_l200 A020 --with slot=3",
            2,
            "^$",
            "nothing .* given or found as `slot=3`\n  hint: leave it out",
        ),
        ("scan hitachi_l200 --with slot=3", 2, "^$", "hitachi_l200 has nothing that is given or found as `slot=3`"),
        ("identify fronius_datamanager --with slot=3", 2, "^$", "has nothing that is given or found as `slot=3`"),
        ("write hitachi_l200 A020=1e400 --yes", 1, "^$", r"^.{,200} is outside 0..400 Hz\n.*nearest allowed value"),
        ("write hitachi_l200 =5 --yes", 2, "^$", "no point is named\n  hint: give its code, name or address"),
        ("write hitachi_l200 A020= --yes", 2, "^$", "A020 base_frequency: the value is missing\n  hint: write POINT="),
        ("read hitachi_l200 A020=5", 2, "^$", "`A020=5` is no point\n  hint: `fieldscribe write` writes values"),
        ("write hitachi_l200 enter:5 --yes", 2, "^$", "the command enter takes no arguments"),
        ("snapshot hitachi_l200 --out .", 2, "^$", "it is a folder: "),
        ("snapshot hitachi_l200 --out /dev/null", 2, "^$", "it is a device: /dev/null"),
        ("restore . --yes", 2, "^$", "it is a folder: "),
        ("scan --units 1-2", 0, "^unit 1  holding 0x0000: .* exception 02h \\(illegal_data_address\\)\n$", "^$"),
        ("scan --units 2", 1, "^no unit answers\n$", "^$"),
        ("scan --units=", 2, "^$", "`` is no unit"),
        ("scan --units 5-2", 2, "^$", "units are 1 to 247, not `5-2`"),
        ("scan hitachi_l200 --units 1 -v", 0, "^unit 1  running = stopped", "1 request\n$"),
        (
            "identify hitachi_l200",
            1,
            "^not asked for, as their descriptions have no `identify`: hitachi_l200\n$",
            "^$",
        ),
        ("identify fronius_datamanager", 1, "^it is not fronius_datamanager: ", "^$"),
    ],
)
def test_a_command_ends_and_answers(words: str, code: int, out: str, err: str, on_line: Run) -> None:
    done = on_line(*words.split())
    assert done.code == code, done
    assert re.search(out, done.out), done.out
    assert re.search(err, done.err), done.err


@pytest.mark.parametrize(
    ("words", "code", "out", "err"),
    [
        (
            "read siemens_mm4 P1082 -v",
            0,
            "^P1082 maximum_frequency  50 Hz\n$",
            "^unit 1 -> 02 0E 01 14(.|\n)*1 req",
        ),
        (
            "read siemens_mm4 P2010",
            0,
            r"^P2010\S* uss_baud_rate_index_0 .*\nP2010\S* uss_baud_rate_index_1 .*\n$",
            "^$",
        ),
        ("read siemens_mm4 uss_baud_rate", 0, "^(P2010.*\n){2}$", "^$"),
        ("read siemens_mm4 P1082 r0021", 1, "50 Hz\noutput_frequency +documented only: ", "^$"),
        ("read siemens_mm4 P1082 --unit 7", 2, "^$", r"unit 7 did not reply .*\n  hint: "),
        ("write siemens_mm4 P1082=45 --keep", 2, "^$", "write only when: stopped\n.*each write wears the memory"),
        ("write siemens_mm4 P1082=45 --keep --yes", 0, "^written: P1082 maximum_frequency = 45 Hz", "^$"),
        ("write siemens_mm4 HSW=10 --yes", 2, "^$", "differs between variants\n  hint: give --variant interface="),
        ("write siemens_mm4 STW=047Eh --keep --yes", 2, "^$", "cannot be kept"),
        ("scan --units 0-2", 0, "^unit 1  word 1 of its process data is [0-9A-F]{4}h\n$", "^$"),
        ("listen siemens_mm4 --port 5020", 2, "^$", "--port would have no effect on a line"),
        ("scan siemens_mm4 --units 1", 0, r"^unit 1  \S+ \S+ = ", "^$"),
        ("read woodward_mpu2s generator_frequency generator_active_power", 0, "frequency +50 Hz\n", "^$"),
        ("write woodward_mpu2s power_measurement_phases=three_phase --yes -v", 0, "^written: ", "2 requests"),
        ("monitor woodward_mpu2s generator_frequency --count 2 --every 0", 0, "^.* generator_frequency  50 Hz\n$", ""),
        ("scan woodward_mpu2s --units 1", 0, r"^unit 1  \S+ .*= .*\n$", "^$"),
        ("scan woodward_mpu2s --units 2 --timeout 0.1", 1, "no unit answers", "^$"),
    ],
)
def test_other_families(words: str, code: int, out: str, err: str, other: Run) -> None:
    done = other(*words.split())
    assert done.code == code, done
    assert re.search(out, done.out), done.out
    assert re.search(err, done.err), done.err


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("tcp://127.0.0.1:1", "Connection refused\n  hint: is the line right"),
        ("rtu:///dev/nothing_here", "could not open port"),
        ("bench", "`bench` is no line, and no name of one\n  hint: there is no fieldscribe.toml here"),
        ("/dev/ttyUSB0", "a line itself is rtu:///dev/ttyUSB0, or uss:///dev/ttyUSB0\n"),
        ("can://slcan/dev/nothing_here", "a path has its own slash: can://slcan//dev/nothing_here\n"),
        ("192.168.0.20:502", "a line itself is tcp://192.168.0.20:502\n"),
        ("5020", "a line itself is tcp://HOST:PORT\n"),
    ],
)
def test_a_line_that_cannot_be_opened(line: str, message: str, run: Run, small: object) -> None:
    device = ("woodward_mpu2s", "generator_frequency") if line.startswith("can:") else ("hitachi_l200", "A020")
    done = run("read", *device, "--line", line)
    assert (done.code, done.out) == (2, "")
    assert message in done.err


def test_answers_as_json(on_line: Run) -> None:
    read = json.loads(on_line("read", "hitachi_l200", "A020", "--format", "json").out)
    value = {"name": "base_frequency", "code": "A020", "value": 50.0, "unit": "Hz", "text": "50 Hz", "raw": 500}
    assert read["values"] == [{**value, "status": "ok", "detail": ""}]
    words = ("A020=50", "A061=inactive", "run_command=stop")
    written = json.loads(on_line("write", "hitachi_l200", *words, "--yes", "--format", "json").out)
    read = json.loads(on_line("read", "hitachi_l200", "A020", "A061", "run_command", "--format", "json").out)
    assert written["written"] == read["values"]
    assert read["values"][1].items() > {"value": None, "status": "special", "detail": "inactive", "raw": 0}.items()
    shown = on_line("monitor", "hitachi_l200", "A020", "--count", "1", "--format", "jsonl").out
    assert json.loads(shown).items() >= value.items()
    scanned = json.loads(on_line("scan", "hitachi_l200", "--units", "1,3", "--format", "json").out)
    assert (scanned["asked"], [one["unit"] for one in scanned["answers"]]) == ([1, 3], [1])


def test_identify_answers_in_json_beside_a_description_with_errors(on_line: Run, tmp_path: Path) -> None:
    write(tmp_path / "wrong", described("- {name: a, at: b}\n"))
    done = on_line("identify", "--descriptions", str(tmp_path), "--format", "json")
    assert (json.loads(done.out)["fits"], done.code) == ({}, 1)
    assert "wrong/device.yaml" in done.err


@pytest.mark.parametrize(("answer", "ends"), [("y", (0, 45.0)), ("", (1, 50.0)), ("n", (1, 50.0))])
def test_a_write_is_asked_for(
    answer: str, ends: tuple[int, float], drive: Simulated, on_line: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    drive.values["base_frequency"] = 50
    monkeypatch.setattr(sys, "stdin", answers(answer))
    done = on_line("write", "hitachi_l200", "A020=45")
    assert (done.code, drive.values["base_frequency"]) == ends
    assert "lost when switched off, without --keep" in done.err
    drive.values["base_frequency"] = 50


def test_what_is_kept_is_there_after_a_restart(drive: Simulated, on_line: Run) -> None:
    for words, held in ((("A020=30",), 50.0), (("A020=30", "--keep"), 30.0)):
        drive.values["base_frequency"] = 50
        on_line("write", "hitachi_l200", "enter", "--yes")
        assert on_line("write", "hitachi_l200", *words, "--yes").code == 0
        drive.restart()
        assert drive.values["base_frequency"] == held
    drive.values.update(VALUES)


def test_nothing_is_written_if_one_value_is_refused(drive: Simulated, on_line: Run) -> None:
    assert on_line("write", "hitachi_l200", "A020=45", "A003=9999", "--yes").code == 1
    assert drive.values["base_frequency"] == 50


@pytest.mark.parametrize(("fault", "code"), [(KeyboardInterrupt, 130), (TimeoutError, 2)])
def test_a_write_that_ends_early_says_what_was_written(
    fault: type[BaseException], code: int, drive: Simulated, on_line: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    carry_out = Write.carry_out

    def failing(write: Write, device: AnyDevice) -> None:
        if write.item != "motor_rated_frequency":
            return carry_out(write, device)
        if fault is KeyboardInterrupt:
            raise KeyboardInterrupt
        drive.fault("silent x1")
        return carry_out(write, device)

    monkeypatch.setattr(Write, "carry_out", failing)
    done = on_line("write", "hitachi_l200", "A020=50", "A003=50", "A061=50", "--yes")
    assert done.code == code
    assert (
        "written: A020 base_frequency; perhaps written: A003 motor_rated_frequency; "
        "not written: A061 upper_frequency_limit" in done.err
    )


@pytest.mark.parametrize(
    ("fault", "words", "answer"),
    [
        ("silent x1", "A020", (0, "A020 base_frequency  50 Hz\n")),
        ("damaged 7 x1", "A020", (0, "A020 base_frequency  50 Hz\n")),
        ("silent x1", "A020 --retries 0", (2, "")),
        ("silent x2", "A020 --retries 2", (0, "A020 base_frequency  50 Hz\n")),
        (
            "silent x2",
            "A020 A004 A061 --retries 0",
            (1, r"A020 base_frequency +unit 1 did not reply.*\nA004 .* 60 Hz\nA061 .*\n"),
        ),
        ("silent x3", "A020 A004 A061 --retries 0", (2, "")),
    ],
)
def test_a_read_is_tried_again_and_a_lost_point_loses_no_other(
    fault: str, words: str, answer: tuple[int, str], drive: Simulated, on_line: Run
) -> None:
    drive.fault(fault)
    done = on_line("read", "hitachi_l200", *words.split())
    assert done.code == answer[0], done
    assert re.fullmatch(answer[1], done.out), done.out


def test_a_write_is_sent_once(drive: Simulated, on_line: Run) -> None:
    before = drive.requests
    drive.fault("silent x1")
    assert on_line("write", "hitachi_l200", "A020=50", "--yes", "--retries", "5").code == 2
    assert drive.requests == before + 1


@pytest.mark.parametrize(
    ("faults", "text"), [("late 0.3 x1", r"unit 1  running = stopped"), ("late 0.3 x2", "unit 1  it answers late")]
)
def test_a_unit_whose_answer_comes_late_is_asked_once_more(faults: str, text: str, run: Run) -> None:
    with simulated("hitachi_l200", on="serial") as drive:
        drive.fault(faults)
        line = f"rtu://{drive.path}?baud=19200"
        done = run("scan", "hitachi_l200", "--line", line, "--units", "1-3", "--timeout", "0.2")
    assert (done.code, len(done.out.splitlines())) == (0, 1)
    assert re.match(text, done.out), done.out


@pytest.mark.parametrize(
    ("fault", "text"),
    [
        ("function x1", "unit 1  an answer that is damaged: .*the reply is to function "),
        ("cut 9 x1", "unit 1  an answer that is damaged: .*9 bytes came "),
        ("unit x4", "unit 1  an answer that is damaged: .*unit 2 answered instead of 1"),
        ("silent x1", "no unit answers"),
    ],
)
def test_a_unit_with_a_wrong_answer_answers(fault: str, text: str, drive: Simulated, on_line: Run) -> None:
    drive.fault(fault)
    done = on_line("scan", "hitachi_l200", "--units", "1-2")
    assert re.fullmatch(f"{text}.*\n", done.out), done


def test_monitor_goes_on_after_a_lost_answer(drive: Simulated, on_line: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    rounds = iter(range(9))

    def between(_seconds: float) -> None:
        if next(rounds) == 0:
            drive.fault("silent x1")
        else:
            drive.values["base_frequency"] = 41

    monkeypatch.setattr("time.sleep", between)
    done = on_line("monitor", "hitachi_l200", "A020", "--count", "3", "--every", "0", "--retries", "0")
    drive.values["base_frequency"] = 50
    assert done.code == 0
    assert re.fullmatch(r"\S+  A020 base_frequency  50 Hz\n\S+  A020 base_frequency  41 Hz\n", done.out)
    assert re.fullmatch(r".* did not reply .*; going on\n", done.err)


def test_monitor_ends_at_ctrl_c(on_line: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(_seconds: float) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("time.sleep", interrupted)
    done = on_line("monitor", "hitachi_l200", "status")
    assert done.code == 0
    assert "ended after 2 requests; nothing was written" in done.err


@pytest.mark.parametrize(
    ("word", "code", "message"),
    [
        ("dim:percent=40", 0, "written: dim (Dim), percent 40"),
        ("dim", 2, "the command dim takes percent\n  hint: write dim:percent=NUMBER"),
        ("dim:percent=101", 1, "percent of dim is 0..100, not 101"),
        ("dim:percent=x", 2, "percent of dim: `x` is not a number"),
    ],
)
def test_a_command_has_arguments(word: str, code: int, message: str, run: Run) -> None:
    given = ("--with", "slot=3", "--with", "half=1")
    with simulated(DEVICES / "kitchen_blocks", given={"slot": 3, "half": 1}, values={"energy": 0}) as blocks:
        line = f"tcp://127.0.0.1:{blocks.port}"
        done = run("write", str(DEVICES / "kitchen_blocks"), word, "--yes", *given, "--line", line)
        assert (done.code, message in done.out + done.err) == (code, True), done
        if code == 0:
            assert blocks.values["level"] == 40.0


def test_a_page_that_is_written_before_is_said_before(run: Run) -> None:
    with simulated(DEVICES / "kitchen_sink") as sink:
        words = (
            "write",
            str(DEVICES / "kitchen_sink"),
            "input_delay_index_2=2",
            "--line",
            f"tcp://127.0.0.1:{sink.port}",
        )
        asked = run(*words).err
        sent = run(*words, "--yes", "-v").err
    assert "    written first if different: page = inputs (Inputs)\n" in asked
    assert "    written first if different: array_index = 11\n" in asked
    names = re.findall(r" -> .*\((\w+)\)$", sent, re.MULTILINE)
    assert names == ["page", "array_index", "input_delay_index_2"]


@pytest.mark.parametrize(
    ("words", "refused"),
    [
        (["target_torque=2"], True),
        (["control_mode=by_torque", "target_torque=2"], False),
        (["control_mode=by_torque", "target_speed=100"], True),
        (["target_torque=2", "control_mode=by_torque"], True),
    ],
)
def test_a_point_is_written_only_while_it_exists(run: Run, words: list[str], refused: bool) -> None:
    """What is written before it in the same call counts."""
    with simulated(DEVICES / "kitchen_sink") as sink:
        line = f"tcp://127.0.0.1:{sink.port}"
        asked = run("write", str(DEVICES / "kitchen_sink"), *words, "--line", line).err
    condition = "it exists only when control_mode == by_"
    assert (f"does not exist now: {condition}" in asked, f"    {condition}" in asked) == (refused, not refused)


def test_a_base_that_only_a_given_number_moves_and_steps_where_no_point_lies(tmp_path: Path, run: Run) -> None:
    """The words of a mailbox belong to no point: the device takes them, and nothing else beside them."""
    modules = head(
        given="{slot: {range: 1..15, title: {en: Slot}}}",
        commands="[{name: reset, title: {en: Reset}, arguments: {key: 1..9}, steps: [{at: 7000, words: [key, 5]}]}]",
    )
    device = write(tmp_path, together(modules, group("- {name: level, at: 5}\n", base="slot * 1000")))
    with simulated(tmp_path, given={"slot": 3}, values={"level": 7}) as drive:
        words = (str(device), "--with", "slot=3", "--line", f"tcp://127.0.0.1:{drive.port}")
        assert run("read", words[0], "level", *words[1:]).out == "level  7\n"
        assert run("write", words[0], "level=8", "reset:key=4", "--yes", *words[1:]).code == 0
        assert (drive.values["level"], drive.device.read(("holding", 0), (7000, 7001))) == (8, [4, 5])


def test_monitor_sends_as_few_requests_as_the_planner_needs(run: Run) -> None:
    """98 points of three groups, each round, and the one that says which exist; a strict device complains of others."""
    with simulated("eastron_sdm630", strict=True, values={"system_type": "three_phase_four_wire"}) as meter:
        words = ("measurements", "settings", "maintenance", "--count", "5", "--every", "0", "--format", "csv")
        done = run("monitor", "eastron_sdm630", *words, "--line", f"tcp://127.0.0.1:{meter.port}")
    assert done.code == 0
    readable = [point for point in meter.device.device.points if point.name in done.out]
    assert len(readable) > 90
    kind = device_class(meter.device.device)
    places = [kind.POINTS[point.item].facts.at for point in readable]
    assert meter.requests == 1 + 5 * len(plan(places, kind.PROFILE))  # type: ignore[attr-defined]  # as each of Modbus has


def test_a_terminal_shows_a_table_in_its_place(drive: Simulated, on_line: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(points, "is_coloured", lambda _stream: True)
    monkeypatch.setattr(points, "terminal_size", lambda: (40, 4))
    monkeypatch.setattr("time.sleep", lambda _seconds: drive.values.update(base_frequency=41))
    done = on_line("monitor", "hitachi_l200", "A020", "A061", "A062", "--count", "2", "--every", "0")
    drive.values["base_frequency"] = 50
    first, second = done.out.split("\x1b[3F\x1b[J")
    assert re.match(r"A020 base_frequency +50 Hz\n.*\n.*, 1 more below the screen; Ctrl-C ends", first)
    assert re.match(r"A020 base_frequency +41 Hz\nA061", second)


def test_work_that_takes_long_shows_how_far_it_is(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.undo()
    progress = live_options.Progress()
    progress.show("early")
    progress._next = float("-inf")
    progress.show("unit 3 of 9")
    assert capsys.readouterr().err == "unit 3 of 9\n"


def test_points_that_do_not_exist_now_are_left_out_of_groups(run: Run, tmp_path: Path) -> None:
    """The phases of a meter, by its wiring; one that is asked for by name is read, and its condition told."""
    with simulated("eastron_sdm630", strict=True, values={"system_type": "single_phase_two_wire"}) as meter:
        line = ("eastron_sdm630", "--line", f"tcp://127.0.0.1:{meter.port}")
        assert meter.device.complaints == []
        group = run("read", *line, "measurements")
        assert (group.code, "phase_1_voltage" in group.out, "phase_2_voltage" in group.out) == (0, True, False)
        assert run("snapshot", *line, "--out", str(tmp_path / "one.json")).code == 0
        assert meter.device.complaints == []
        meter.values["system_type"] = "three_phase_four_wire"
        assert "phase_2_voltage" in run("monitor", *line, "measurements", "--count", "1").out
        meter.values["system_type"] = "three_phase_three_wire"
        named = run("read", *line, "phase_2_voltage")
        why = "(illegal_data_address); it exists only when system_type == three_phase_four_wire\n"
        assert (named.code, named.out.endswith(why)) == (1, True), named
        meter.device.complaints.clear()


CLOCK = """\
- {name: hour, at: 0, range: 0..23, write_with: [minute, second], changes: never}
- {name: minute, at: 1, range: 0..59, write_with: [hour, second], changes: never}
- {name: second, at: 2, range: 0..59, write_with: [hour, minute], changes: never}
- {name: level, at: 3, range: 0..9, changes: never}
"""


@pytest.fixture
def clock(tmp_path: Path) -> Iterator[tuple[Simulated, tuple[str, ...]]]:
    """A device whose time is written in one request, and the words that name it on its line."""
    device = write(tmp_path, described(CLOCK))
    with simulated(tmp_path, values={"hour": 1, "minute": 2, "second": 3, "level": 4}) as drive:
        yield drive, (str(device), "--line", f"tcp://127.0.0.1:{drive.port}")


def test_points_that_are_written_together_travel_in_one_request(
    clock: tuple[Simulated, tuple[str, ...]], run: Run
) -> None:
    drive, (device, *line) = clock
    before = drive.requests
    done = run("write", device, "second=56", "level=5", "minute=34", "hour=12", "--yes", *line)
    assert (done.code, drive.requests - before, done.out.count("written: ")) == (0, 2, 4), done
    assert [drive.values[name] for name in ("hour", "minute", "second", "level")] == [12, 34, 56, 5]
    half = run("write", device, "hour=1", "second=2", "--yes", *line)
    assert (half.code, half.out) == (2, "")
    assert "hour is written in one request with minute\n  hint: write minute=VALUE, too" in half.err
    drive.fault("exception")
    refused = run("write", device, "level=7", "hour=1", "minute=2", "second=3", "--yes", *line)
    assert (refused.code, "nothing was written" in refused.err) == (1, False)
    assert "perhaps written: level; not written: hour, minute, second" in refused.err


def test_restore_writes_together_what_the_device_takes_together(
    clock: tuple[Simulated, tuple[str, ...]], run: Run, tmp_path: Path
) -> None:
    """Only the minute differs, and the others travel with it; a device that is strict refuses a half."""
    drive, (device, *line) = clock
    file = tmp_path / "a.json"
    assert run("snapshot", device, "--out", str(file), *line).code == 0
    drive.values["minute"] = 30
    assert run("restore", str(file), device, "--yes", *line).code == 0
    assert [drive.values[name] for name in ("hour", "minute", "second")] == [1, 2, 3]
    drive.values["minute"] = 30
    alone = run("restore", str(file), device, "--yes", "--only", "minute", *line)
    assert (alone.code, drive.values["minute"]) == (1, 30)
    assert "minute: it is written in one request with hour, second, which is not restored" in alone.err
    drive.fault("silent")
    lost = run("restore", str(file), device, "--yes", "--timeout", "0.2", "--retries", "0", *line)
    assert lost.code == 2
