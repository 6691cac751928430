"""Snapshots of devices, what differs between them, and restoring them: in which order, and with which journal."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from errno import ENOSPC
from pathlib import Path

import pytest
from fieldscribe.live.restoring import Journal, interrupted, ordered
from fieldscribe.live.snapshots import Held, Snapshot, compared, defaults, read_snapshot
from fieldscribe.simulation import Simulated, simulated
from support.described import DEVICES, described, loaded_in, shipped
from support.quick import full_but
from support.small_drive import Output

pytestmark = pytest.mark.usefixtures("loads_once")

Run = Callable[..., Output]
Values = dict[str, str | int | float]
BEFORE: Values = {"maximum_frequency": 60, "base_frequency": 50, "acceleration_time": 7.5, "run_command": "stop"}
AFTER: Values = {"maximum_frequency": 400, "base_frequency": 390, "acceleration_time": 20, "run_command": "run"}
FIRST = ["F002 acceleration_time", "A004 maximum_frequency", "A020 base_frequency"]

DYING = """\
import os, sys
from fieldscribe.cli import main
from fieldscribe.live.writing import Write

number, after, *line = sys.argv[1:]
left, carry_out = iter(range(9)), Write.carry_out

def dying(write, device):
    dies = next(left) == int(number)
    if not dies or int(after):
        carry_out(write, device)
    if dies:
        os._exit(9)

Write.carry_out = dying
main(["restore", "a.json", "--yes", *line])
"""
"""A restore that ends at once, before or after it writes a setting."""


@pytest.fixture
def drive() -> Iterator[Simulated]:
    with simulated("hitachi_l200", values=BEFORE) as running:
        yield running


@pytest.fixture
def on_line(drive: Simulated, run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Take a snapshot in `a.json`, change the drive, and run commands on its line."""
    monkeypatch.chdir(tmp_path)
    line = ("--line", f"tcp://127.0.0.1:{drive.port}", "--timeout", "0.5")
    assert run("snapshot", "hitachi_l200", "--out", "a.json", *line) == Output(0, "234 points in a.json\n", "")
    drive.values.update(AFTER)
    return lambda *words: run(*words, *(() if words[0] == "compare" else line))


@pytest.mark.full(seconds=0.7)
def test_restored_settings_are_as_before(drive: Simulated, on_line: Run) -> None:
    """A command that the description does not call a setting stays, unless it is named."""
    assert on_line("snapshot", "hitachi_l200", "--out", "b.json").code == 0
    different = on_line("compare", "a.json", "b.json")
    assert (different.code, different.out.splitlines()[-1]) == (1, "4 differences")
    assert "  A020 base_frequency     50 Hz -> 390 Hz\n" in different.out
    tried = on_line("restore", "a.json", "--dry-run")
    assert (tried.code, drive.values["base_frequency"]) == (0, 390)
    assert "would be written: A020 base_frequency = 50 Hz: raw 500" in tried.out
    assert "A020" not in on_line("restore", "a.json", "--dry-run", "--without", "A020").out
    assert "no point or group `nope`" in on_line("restore", "a.json", "--dry-run", "--only", "nope").err
    restored = on_line("restore", "a.json", "--yes", "--keep")
    assert restored.code == 0
    assert "written: enter" in restored.out
    assert "note: " not in restored.err
    assert "does not say that they are settings: run_command; --only NAME" in restored.err
    assert on_line("restore", "a.json", "--yes", "--only", "run_command").code == 0
    assert {name: drive.values[name] for name in BEFORE} == BEFORE
    on_line("snapshot", "hitachi_l200", "--out", "b.json")
    assert on_line("compare", "a.json", "b.json").code == 0
    drive.restart()
    assert drive.values["base_frequency"] == 50
    drive.values["base_frequency"] = 390
    again = on_line("restore", "a.json", "--yes")
    assert "note: 1 of 1 write lost when switched off, without --keep\n" in again.err


def test_a_snapshot_has_all_but_the_point_without_an_answer(drive: Simulated, on_line: Run) -> None:
    """The first request, the point alone; then all answers come."""
    drive.fault("silent x2")
    done = on_line("snapshot", "hitachi_l200", "--out", "b.json", "--retries", "0")
    assert (done.code, done.out) == (1, "233 points in b.json, 1 without a number\n")
    assert "did not reply" in done.err


@pytest.mark.full(seconds=20)
def test_what_no_description_calls_a_setting_is_restored_by_all(run: Run, tmp_path: Path) -> None:
    """No parameter of the MPU2-S has a word on how it is kept."""
    file, line = str(tmp_path / "a.json"), ("--line", "can://virtual/woodward_mpu2s", "--timeout", "5")
    with simulated("woodward_mpu2s", on="can", time_scale=10) as genset:
        assert run("snapshot", "woodward_mpu2s", "--out", file, *line).code in (0, 1)
        held = genset.values["generator_rated_frequency"]
        genset.values["generator_rated_frequency"] = 60
        left = run("restore", file, *line, "--yes")
        assert "settings: generator_rated_frequency; --only NAME or GROUP restores some, --all" in left.err, left
        assert genset.values["generator_rated_frequency"] == 60
        assert "written: " in run("restore", file, *line, "--yes", "--all").out
        assert genset.values["generator_rated_frequency"] == held


@pytest.mark.full(seconds=0.6)
@pytest.mark.parametrize("device", ["hitachi_l200", "eastron_sdm630"])
def test_another_device_gets_all_settings(device: str, run: Run, tmp_path: Path) -> None:
    """One whose numbers differ: two simulated devices of different seeds."""
    files = [str(tmp_path / name) for name in ("one.json", "other.json", "restored.json")]
    with simulated(device, seed=1) as one, simulated(device, seed=2) as other:
        lines = [("--line", f"tcp://127.0.0.1:{each.port}") for each in (one, other)]
        for line, file in zip(lines, files, strict=False):
            assert run("snapshot", device, "--out", file, *line).code == 0
        assert run("compare", *files[:2]).code == 1
        assert run("restore", files[0], "--yes", *lines[1]).code == 0
        assert run("snapshot", device, "--out", files[2], *lines[1]).code == 0
    left = compared(read_snapshot(Path(files[0])), read_snapshot(Path(files[2])))
    assert left
    assert "setting" not in {each.first.kind for each in left if each.first}


@pytest.mark.parametrize("after", [False, True])
@pytest.mark.parametrize("number", full_but((1,), range(3)))
def test_the_journal_of_a_killed_restore_is_right(number: int, *, after: bool, drive: Simulated, on_line: Run) -> None:
    """The process ends at once, before or after the device has the number; then the restore starts again."""
    assert FIRST[number]  # three settings differ
    line = ("--line", f"tcp://127.0.0.1:{drive.port}", "--timeout", "0.5")
    ended = subprocess.run([sys.executable, "-c", DYING, str(number), str(int(after)), *line], check=False)
    assert ended.returncode == 9
    started = json.loads(Path("a.json.journal").read_text("utf-8").splitlines()[0])["started"]
    parts = {
        "written": FIRST[:number],
        "perhaps written": FIRST[number : number + 1],
        "not written": FIRST[number + 1 :],
    }
    assert interrupted(Path("a.json.journal")) == [
        f"the restore of {started} to hitachi_l200, unit 1, tcp://127.0.0.1:{drive.port} did not end",
        *(f"{what}: {', '.join(names)}" for what, names in parts.items() if names),
    ]
    names = [label.split()[1] for label in FIRST]
    written = [name for name in names if drive.values[name] == BEFORE[name]]
    assert written == names[: number + after]
    again = on_line("restore", "a.json", "--yes")
    assert f"perhaps written: {FIRST[number]}\n" in again.err
    assert (again.code, interrupted(Path("a.json.journal"))) == (0, [])
    assert all(drive.values[name] == BEFORE[name] for name in names)


@pytest.mark.parametrize(
    ("notes", "state"),
    [
        (0, f"not written: {', '.join(FIRST)}"),
        (1, f"not written: {', '.join(FIRST)}"),
        (2, f"written: {FIRST[0]}; not written: {', '.join(FIRST[1:])}"),
        (4, f"written: {', '.join(FIRST[:2])}; not written: {FIRST[2]}"),
        (7, f"written: {', '.join(FIRST)}"),
    ],
)
def test_a_full_disk_ends_a_restore_with_what_was_written(
    notes: int, state: str, drive: Simulated, on_line: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The journal has room for so many notes."""
    room = iter(range(notes))

    def synchronised(_stream: int) -> None:
        if next(room, None) is None:
            raise OSError(ENOSPC, "No space left on device")

    monkeypatch.setattr("os.fsync", synchronised)
    done = on_line("restore", "a.json", "--yes")
    assert (done.code, done.out) == (2, "")
    assert done.err.splitlines()[-1] == f"fieldscribe: a.json.journal: No space left on device; {state}"
    assert [drive.values[label.split()[1]] == BEFORE[label.split()[1]] for label in FIRST].count(True) == notes // 2


@pytest.mark.parametrize(
    ("point", "change", "message"),
    [
        ("base_frequency", {"raw": 600}, "A020 base_frequency: its raw number 600 is 60 Hz, and its value says 50"),
        ("base_frequency", {"value": 60}, "A020 base_frequency: its raw number 500 is 50 Hz, and its value says 60"),
        ("run_command", {"raw": 1}, "run_command: its raw number 1 is run (Run), and its value says 0"),
        ("base_frequency", {"raw": 600, "value": 60.0}, ""),
        ("base_frequency", {"value": None}, ""),
    ],
)
@pytest.mark.parametrize("words", ["compare a.json", "compare a.json a.json", "restore a.json --dry-run"])
def test_a_snapshot_that_contradicts_itself(
    words: str, point: str, change: dict[str, object], message: str, on_line: Run
) -> None:
    data = json.loads(Path("a.json").read_text("utf-8"))
    data["points"][point].update(change)
    Path("a.json").write_text(json.dumps(data), "utf-8")
    done = on_line(*words.split())
    assert (message in done.err, "its raw number" in done.err) == (True, bool(message))
    assert not message or (done.code, done.out) == (1, "")
    data["digest"] = "that of another edition"
    Path("a.json").write_text(json.dumps(data), "utf-8")
    assert "its raw number" not in on_line(*words.split()).err


LIMITED = """\
import resource, sys

sys.dont_write_bytecode = True  # half a file of it would stay
from fieldscribe.cli import main

resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
sys.exit(main(sys.argv[1:]))
"""
"""A command that cannot write more than 4096 bytes into a file."""


@pytest.mark.parametrize(
    ("command", "message"),
    [
        ("snapshot hitachi_l200 --out b.json", "File too large: {folder}/b.json"),
        ("vendor c hitachi_l200 --out v", "cannot write to v/fieldscribe.h: File too large"),
    ],
)
def test_a_file_without_room_is_named(command: str, message: str, drive: Simulated, tmp_path: Path) -> None:
    line = ("--line", f"tcp://127.0.0.1:{drive.port}") if "snapshot" in command else ()
    words = [sys.executable, "-c", LIMITED, *command.split(), *line]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"fieldscribe: {message.format(folder=tmp_path)}\n")


def test_a_journal_that_ends_anywhere_tells_of_what_is_whole(tmp_path: Path) -> None:
    """Whatever part of the file is there, nothing counts as written that was not noted."""
    path = tmp_path / "journal"
    journal = Journal(path, ["a", "b", "c"], {"device": "x"})
    for number in range(3):
        journal.note(begin=number, raw=1)
        journal.note(**{"refused": 1, "why": "no"} if number == 1 else {"done": number})
    journal.close()
    whole = path.read_bytes()
    told = []
    for size in range(len(whole) + 1):
        path.write_bytes(whole[:size])
        if (found := interrupted(path)) and found[1:] not in told:
            told.append(found[1:])
    assert told == [
        ["not written: a, b, c"],
        ["perhaps written: a", "not written: b, c"],
        ["written: a", "not written: b, c"],
        ["written: a", "perhaps written: b", "not written: c"],
        ["written: a", "perhaps written: c", "not written: b"],
        ["written: a, c", "not written: b"],
    ]


POINTS = """
  - {name: low, at: 1, type: u16, range: 0..high, access: rw, changes: never}
  - {name: high, at: 2, type: u16, range: low..100, access: rw, changes: never}
  - {name: scaled, at: 3, type: u16, scale: value = raw * high, range: 0..50, access: rw, changes: never}
  - {name: reset, at: 4, type: u16, access: rw, default: 1}
  - {name: cleared, at: 5, type: u16, access: rw, changes: never, changes_with: [reset]}
  - {name: baud, at: 6, type: u16, access: rw, changes: never, takes_effect: after a restart}
  - {name: start, at: 7, type: u16, access: rw}
  - {name: mode, at: 8, type: u16, access: rw, changes: never}
  - {name: gain, at: 9, type: u16, access: rw, changes: never, when: mode.raw == 2}
"""


@pytest.mark.parametrize(
    ("now", "wanted", "writes", "others"),
    [
        ({}, {}, [], []),
        ({"low": 1, "high": 5}, {"low": 10, "high": 20}, ["high", "low"], []),
        ({"low": 10, "high": 20}, {"low": 1, "high": 5}, ["low", "high"], []),
        ({"reset": 1, "cleared": 7}, {"reset": 0, "cleared": 7}, ["reset", "cleared"], []),
        ({"baud": 1, "low": 0}, {"baud": 2, "low": 1, "start": 1}, ["low", "baud"], ["start"]),
        ({}, {"gain": 7, "mode": 2}, ["mode", "gain"], []),  # a device in another mode has none
    ],
)
def test_writes_come_in_an_order_that_the_device_allows(
    now: dict[str, int], wanted: dict[str, int], writes: list[str], others: list[str], tmp_path: Path
) -> None:
    model = loaded_in(tmp_path, described(POINTS))
    order = ordered(model, snapshot(now), snapshot(wanted))
    assert (list(order.writes), order.others, order.refused) == (writes, others, {})


def test_a_value_stays_where_the_scale_of_the_other_device_is_another(tmp_path: Path) -> None:
    model = loaded_in(tmp_path, described(POINTS.replace("access: rw, changes: never}", "access: r}", 2)))
    order = ordered(model, snapshot({"high": 10}), snapshot({"high": 20, "scaled": 3}))
    assert order.writes == {"scaled": 6}


def test_what_no_order_allows_is_named(tmp_path: Path) -> None:
    model = loaded_in(tmp_path, described(POINTS))
    order = ordered(model, snapshot({}), snapshot({"low": 60, "high": 50, "elsewhere": 1}))
    assert (order.writes, order.unknown) == ({"high": 50}, ["elsewhere"])
    assert order.refused == {"low": "60 is outside what is allowed here, 0..50"}
    assert ordered(model, snapshot({}), snapshot({"gain": 7})).refused == {"gain": "the device does not have it"}


def snapshot(raws: dict[str, int]) -> Snapshot:
    """A snapshot of the made-up device; what is not given is as always."""
    held = {"low": 0, "high": 30, "baud": 1, "scaled": 1, "cleared": 0, "reset": 1, "start": 0, "mode": 1} | raws
    points = {name: Held(None, raw, "", str(raw), raw, "setting") for name, raw in held.items()}
    return Snapshot("made_up", "1.0.0", "", "tcp://x", 1, "", {}, [], points, {})


def test_the_numbers_that_addresses_depend_on_are_kept(run: Run, tmp_path: Path) -> None:
    device, file = str(DEVICES / "kitchen_blocks"), tmp_path / "x.json"
    with simulated(device, given={"slot": 2}) as served:
        line = ("--line", f"tcp://127.0.0.1:{served.port}")
        assert run("snapshot", device, "--with", "slot=2", "--out", str(file), *line).code == 1  # a block is too short
        assert read_snapshot(file).given == ["slot=2"]
        assert run("restore", str(file), device, *line).code == 0


def test_a_snapshot_is_compared_with_the_defaults() -> None:
    model = shipped("eastron_sdm630")
    usual = defaults(model)
    name, held = next((name, held) for name, held in usual.points.items() if held.raw is not None)
    other = replace(usual, line="tcp://x", points={**usual.points, name: held._replace(value=99.0), "more": held})
    assert [difference.name for difference in compared(other, usual)] == [name]


HEAD = '{"snapshot": 1, "device": "x", "version": "1", "digest": "", "line": "", "taken": "", "variants": {}, '
HEAD += '"given": [], '
NO_SNAPSHOTS = (
    *("", "{}", "[]", "7", '"snapshot"', '{"snapshot": 1}', '{"snapshot": 2}', "[" * 100_000, '{"snapshot": NaN}'),
    HEAD + '"unit": "1", "points": {}, "missing": {}}',
    HEAD + '"unit": 1, "points": {}, "missing": {"a": 1}}',
    HEAD.replace("[]", "[1]") + '"unit": 1, "points": {}, "missing": {}}',
    HEAD + '"unit": 1, "points": {"a": [1, 2, 3, 4, 5, 6]}, "missing": {}}',
    HEAD
    + f'"unit": 1, "missing": {{}}, "points": {{"a": {json.dumps(Held(None, 1, "", "", True, "read")._asdict())}}}}}',
)


@pytest.mark.parametrize("text", NO_SNAPSHOTS)
def test_what_is_no_snapshot_is_said(text: str, run: Run, tmp_path: Path) -> None:
    (tmp_path / "x.json").write_text(text, "utf-8")
    for words in (("compare",), ("restore", "--line", "tcp://127.0.0.1:1")):
        done = run(*words, str(tmp_path / "x.json"))
        assert (done.code, done.out) == (2, "")
        assert "snapshot" in done.err


@pytest.mark.parametrize(
    ("text", "code"), [("[lines]\n", 2), ('{"a": 1}', 2), ("[]", 2), ("", 0), ('{"snapshot": "older"}', 0)]
)
def test_only_a_snapshot_is_replaced(text: str, code: int, on_line: Run, tmp_path: Path) -> None:
    (tmp_path / "kept").write_text(text, "utf-8")
    done = on_line("snapshot", "hitachi_l200", "--out", str(tmp_path / "kept"))
    assert (done.code, "is there, and no snapshot: it would be lost" in done.err) == (code, code == 2)
    assert ((tmp_path / "kept").read_text("utf-8") == text) is (code == 2)


def test_a_device_in_place_of_a_snapshot_is_told_what_comes_first(run: Run) -> None:
    done = run("restore", "hitachi_l200", "x.json")
    assert (done.code, done.out) == (2, "")
    assert "there is no file hitachi_l200" in done.err
    assert "name a snapshot first" in done.err


def test_a_snapshot_is_read_as_it_was_written(tmp_path: Path) -> None:
    usual = defaults(shipped("eastron_sdm630"))
    (tmp_path / "x.json").write_text(usual.as_text(), "utf-8")
    assert read_snapshot(tmp_path / "x.json") == usual
