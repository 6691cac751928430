"""`watch`: each saved change is compiled, what is wrong is said, and stopping is clean."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from fieldscribe.authoring.watching import Outcome, Watch
from support.described import described

POINTS = "- {name: speed, at: 1, range: 0..100}\n"


def describe(folder: Path, device: str, points: str = POINTS) -> Path:
    """Save a description, as editors do: a new file in place of the old one."""
    (folder / device).mkdir(parents=True, exist_ok=True)
    file = folder / device / "device.yaml"
    new = file.with_suffix(".new")
    new.write_text(described(points, device=device), "utf-8")
    new.replace(file)
    return file


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def outcomes(*steps: Callable[[], object]) -> list[Outcome]:
    """What a watch of this folder says at the start, and after each step; all steps happen between two looks."""
    left = list(steps)

    def stopped(seconds: float) -> bool:
        if seconds < 0.1:  # it waits until nobody is writing
            return False
        if not left:
            return True
        left.pop(0)()
        return False

    watch = Watch([Path()], Path("made"), ("docs",), lambda: None)
    return list(watch.outcomes(stopped))


def printout(outcome: Outcome) -> tuple[list[str], list[str], set[str]]:
    """The devices that were compiled, the rules of their findings, and the devices of which something was written."""
    names = {Path(path).name.partition(".")[0] for path in outcome.result.written}
    written = {name.removesuffix("_meanings") for name in names}
    return outcome.devices, [finding.rule for finding in outcome.report.findings], written


def test_only_what_changed_is_compiled(tmp_path: Path) -> None:
    for device in ("first_drive", "second_drive"):
        describe(tmp_path, device)
    start, change = outcomes(
        lambda: None,
        lambda: describe(tmp_path, "second_drive", POINTS.replace("100", "200")),
        lambda: (tmp_path / "first_drive/notes.txt").write_text("nothing of ours"),
    )
    assert printout(start) == (["first_drive", "second_drive"], [], {"first_drive", "second_drive"})
    assert printout(change) == (["second_drive"], ["version-not-raised"], {"second_drive"})
    assert "0..200" in Path("made/docs/second_drive.md").read_text("utf-8")


def test_what_is_broken_leaves_its_output_and_is_tried_with_every_change(tmp_path: Path) -> None:
    first, second = (describe(tmp_path, device) for device in ("first_drive", "second_drive"))
    seen = []

    def breaks() -> None:
        seen.append(Path("made/docs/first_drive.md").read_bytes())
        first.write_text("", "utf-8")

    _, broken, other, mended = outcomes(
        breaks,
        lambda: describe(tmp_path, "second_drive", POINTS.replace("100", "200")),
        lambda: describe(tmp_path, "first_drive"),
    )
    assert printout(broken) == (["first_drive"], ["file-empty"], set())
    assert printout(other) == (["first_drive", "second_drive"], ["file-empty", "version-not-raised"], {"second_drive"})
    assert printout(mended) == (["first_drive"], [], set())  # a warning is no reason to compile again
    assert Path("made/docs/first_drive.md").read_bytes() == seen[0]
    assert second.exists()


def test_devices_come_and_go(tmp_path: Path) -> None:
    describe(tmp_path, "first_drive")
    _, copied, named, gone, none, back = outcomes(
        lambda: shutil.copytree("first_drive", "copy"),
        lambda: describe(tmp_path, "copy", POINTS).write_text(described(POINTS, device="second_drive"), "utf-8"),
        lambda: shutil.rmtree("copy"),
        lambda: shutil.rmtree("first_drive"),
        lambda: describe(tmp_path, "first_drive"),
    )
    assert printout(copied) == (["copy"], ["duplicate-device"], set())
    assert printout(named) == (["copy"], [], {"second_drive"})
    assert (gone.devices, gone.gone) == ([], ["copy"])
    assert (none.gone, [finding.rule for finding in none.report.findings]) == (["first_drive"], ["no-device"])
    assert printout(back) == (["first_drive"], [], set())
    assert Path("made/docs/first_drive.md").exists()


def test_what_cannot_be_written_is_tried_again(tmp_path: Path) -> None:
    describe(tmp_path, "first_drive")
    Path("made").write_text("in the way", "utf-8")

    def clears() -> None:
        Path("made").unlink()
        describe(tmp_path, "second_drive")

    trouble, fine = outcomes(clears)
    assert trouble.trouble is not None
    assert printout(fine) == (["first_drive", "second_drive"], [], {"first_drive", "second_drive"})


class Process:
    """`fieldscribe watch` as people run it."""

    def __init__(self, *words: str) -> None:
        command = [sys.executable, "-m", "fieldscribe", "watch", "--out", "made", *words]
        with open("log", "wb") as log:
            self.process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT)

    def until(self, *texts: str) -> str:
        """What it printed, as soon as these are among it."""
        for _ in range(400):
            printed = Path("log").read_text("utf-8")
            if all(text in printed for text in texts):
                return printed
            assert self.process.poll() is None, printed
            time.sleep(0.05)
        raise AssertionError((texts, printed))

    def stop(self, number: int) -> int:
        self.process.send_signal(number)
        return self.process.wait(20)


@pytest.mark.full(seconds=4)
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_person_edits_and_stops(number: int, tmp_path: Path) -> None:
    file = describe(tmp_path, "first_drive")
    watch = Process("first_drive")
    watch.until("first_drive: ", " unchanged in made (")
    header = Path("made/c/first_drive.h")
    before = header.read_bytes()
    with file.open("a", encoding="utf-8") as text:  # half saved
        text.write("- {name: torque, at")
    printed = watch.until("error[yaml", "1 error in 1 file; the output stays as it was (")
    assert "--> first_drive/device.yaml:1" in printed
    assert header.read_bytes() == before
    describe(tmp_path, "first_drive", POINTS + "- {name: torque, at: 2}\n")
    for _ in range(400):
        if b"FIRST_DRIVE_TORQUE_ADDRESS" in header.read_bytes():
            break
        time.sleep(0.05)
    assert b"FIRST_DRIVE_TORQUE_ADDRESS" in header.read_bytes()
    assert watch.stop(number) == 0
    printed = Path("log").read_text("utf-8")
    assert "Traceback" not in printed
    assert not [name for _, _, names in os.walk("made") for name in names if name.startswith(".fieldscribe")]


@pytest.mark.full(seconds=6)
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_stop_waits_for_the_run_that_goes_on(number: int, tmp_path: Path) -> None:
    """What stands in the output folder is whole: the lock shows that it is writing when the stop comes."""
    points = "".join(f"- {{name: point_{number}, at: {number}, range: 0..100}}\n" for number in range(1000))
    describe(tmp_path, "first_drive", points)
    watch = Process(".")
    while not Path("made/.fieldscribe-lock").exists():
        assert watch.process.poll() is None
        time.sleep(0.01)
    assert watch.stop(number) == 0
    assert "first_drive: " in Path("log").read_text("utf-8")
    check = subprocess.run(
        [sys.executable, "-m", "fieldscribe", "generate", ".", "--out", "made", "--check"], check=False
    )
    assert check.returncode == 0


@pytest.mark.full(seconds=2)
def test_programs_read_a_line_for_each_run(tmp_path: Path) -> None:
    describe(tmp_path, "first_drive")
    watch = Process(".", "--format", "json", "--target", "docs")
    watch.until("\n")
    describe(tmp_path, "first_drive", "- {name: speed}\n")
    watch.until("missing-key")
    assert watch.stop(signal.SIGINT) == 0
    start, wrong = map(json.loads, Path("log").read_text("utf-8").splitlines())
    assert (start["devices"], start["findings"]) == (["first_drive"], [])
    assert "docs/first_drive.md" in start["written"]
    assert [finding["rule"] for finding in wrong["findings"]] == ["missing-key"]
