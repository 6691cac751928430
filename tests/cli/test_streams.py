"""`decode` follows streams: each answer is out before more is waited for, and what is kept does not grow."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from io import BytesIO, TextIOWrapper
from pathlib import Path
from random import Random
from typing import NamedTuple

import pytest
from fieldscribe import pipeline
from fieldscribe.cli import main
from fieldscribe.conversation import meanings, point_items
from support.described import shipped
from support.places import ROOT

COMMAND = [sys.executable, "-m", "fieldscribe", "decode", "woodward_mpu2s"]
FIRST, SECOND = "321#DD010302000007D0", "321#DD00051E13880064"
EXPONENTS = {1: "0100", 10: "0000", 14: "0000"}


class Output(NamedTuple):
    """How a command ended, and what it printed."""

    code: int
    out: str
    err: str


@pytest.fixture
def decode(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Callable[..., Output]:
    """Runs the command in this process, with a text as standard input."""
    monkeypatch.chdir(ROOT)

    def run(*words: str, given: str = "", device: str = "woodward_mpu2s") -> Output:
        monkeypatch.setattr(pipeline, "load_device", lambda *_: shipped(device))
        monkeypatch.setattr(sys, "stdin", TextIOWrapper(BytesIO(given.encode())))
        return Output(main(["decode", device, *words]), *capsys.readouterr())

    return run


def log(count: int, *, dumped: bool = False) -> str:
    """So many lines of candump, as it logs or prints them, with numbers that never come again."""
    random, lines = Random(1), []
    for number in range(count):
        slot = number % 23
        data = f"DD{slot:02X}{EXPONENTS.get(slot, f'{random.getrandbits(16):04X}')}{random.getrandbits(32):08X}"
        stamp, spaced = f"({1700000000 + number / 500:.6f})", bytes.fromhex(data).hex(" ").upper()
        lines.append(f" {stamp}  can0  321   [8]  {spaced}\n" if dumped else f"{stamp} can0 321#{data}\n")
    return "".join(lines)


def test_the_logs_of_our_packages(decode: Callable[..., Output]) -> None:
    """As programs write them, with any text before; failures are no frames, and what is cut off is an error."""
    lines = (
        "DEBUG:fieldscribe:unit 1 -> 01 03 10 28 00 01 00 C2 (A020 base_frequency)",
        "2026-11-29 12:00:00,123 unit 1 <- 01 03 02 01 F4 B8 53 after 8.3 ms",
        "WARNING:fieldscribe:unit 1: timeout: unit 1 did not reply to function 03h (A020 base_frequency)",
        "unit 1: not sent: line: 192.168.0.20:502: refused (holding 0x0001)",
    )
    output = decode("-", given="\n".join(lines), device="hitachi_l200")
    assert (output.code, output.err, output.out.count("Says")) == (0, "", 2)
    assert "A020 base_frequency = 50 Hz" in output.out
    data = "DD 00 05 15 13 88 00 64"
    for frame in (f"321: {data} after 8.3 ms", f"321h {data}", f"321h [{data.replace(' ', ', ')}]"):
        assert "telegram_identification = 1301" in decode("-", given=f"DEBUG:fieldscribe:unit 1 <- {frame}").out
    assert decode("-", given="unit 1 -> 01 03 10 2", device="hitachi_l200").code == 2


@pytest.mark.parametrize(
    "form", ["text", *(pytest.param(form, marks=pytest.mark.full(seconds=1)) for form in ("json", "jsonl"))]
)
def test_the_first_answer_is_out_while_the_input_is_open(form: str) -> None:
    command = [*COMMAND, "-", "--format", form]
    with subprocess.Popen(command, cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as running:
        assert running.stdin is not None
        assert running.stdout is not None
        told = b""
        for line, expected in ((FIRST, b"generator_power_exponent"), (SECOND, b"generator_active_power")):
            running.stdin.write(f"{line}\n".encode())
            running.stdin.flush()
            while expected not in told:
                told += os.read(running.stdout.fileno(), 1 << 16)
        running.stdin.close()
        told += running.stdout.read()
    assert running.returncode == 0
    if form == "json":
        assert [frame["multiplexer"] for frame in json.loads(told)["frames"]] == [1, 0]
    if form == "jsonl":
        assert [json.loads(line)["device"] for line in told.splitlines()] == ["woodward_mpu2s"] * 2


POLLED = {
    "woodward_mpu2s": [
        *("321#DD00051E13880064", "321#DD010302000007D0", "321#DD01FF02000007D0", "321#DD02051E13880064"),
        *("33F#FF01000200000303", "321#FF01000201F4FD0C", "33F#EE01000201F51E1E", "321#EE01000201F41919", "7FF#00"),
    ],
    "hitachi_l200": [
        *(
            "01 03 10 13 00 02 31 0E",
            "01 03 04 00 00 13 88 F7 65",
            "01 06 10 28 01 F4 0C D5",
            "01 06 10 28 01 F4 0C D5",
        ),
        *("01 03 10 13 00 02 31 0E", "01 83 02 C0 F1", "01 03 10 13 00 02 31 0F"),
    ],
    "siemens_mm4": [
        *("02 0E 01 143A 0000 0000 0000 047F 3333 72", "02 0E 01 243A 0000 4248 0000 FA31 3000 C4"),
        *("02 0E 01 143A 0000 0000 0000 0000 0000 23", "020E01243A00004248000000000000FF"),
    ],
}
"""Requests, answers, states that later frames change, and what is no frame of the device, by device."""


@pytest.mark.parametrize("device", POLLED)
def test_a_stream_says_what_the_same_frames_say_as_arguments(device: str, decode: Callable[..., Output]) -> None:
    """In the same order, with the state of the frames before: also when all of it comes again and is remembered."""
    frames = [*POLLED[device], *POLLED[device]]
    for form in ("text", "json", "jsonl"):
        told = decode(*frames, "--format", form, device=device)
        assert decode("-", "--format", form, given="\n".join(frames), device=device) == told
    heard = [json.loads(line)["bytes"] for line in told.out.splitlines()]
    assert heard[: len(heard) // 2] == heard[len(heard) // 2 :]
    assert len(heard) == len(frames)


def test_what_is_remembered_gives_way_and_nothing_else_changes(
    decode: Callable[..., Output], monkeypatch: pytest.MonkeyPatch
) -> None:
    text = log(200)
    told = decode("-", given=text)
    monkeypatch.setattr(meanings, "_MOST_SETTINGS", 1)
    monkeypatch.setattr(point_items, "_FEW_BITS", 0)
    assert decode("-", given=text) == told


def test_both_notations_of_candump_say_the_same(tmp_path: Path, decode: Callable[..., Output]) -> None:
    logged, dumped = tmp_path / "logged.log", tmp_path / "dumped.log"
    logged.write_text(log(46))
    dumped.write_text(log(46, dumped=True))
    told = decode("--log", str(logged)).out
    assert told.count("  Frame ") == 46
    assert decode("-", given=dumped.read_text()).out == told
    both = decode("--log", str(logged), "--log", str(dumped), "--format", "json")
    assert len(json.loads(both.out)["frames"]) == 92


def test_a_line_that_is_no_frame_hides_no_other(decode: Callable[..., Output]) -> None:
    done = decode("-", given=f"# taken on Monday\n{FIRST}\n\n{'ab' * 100_000}\n{SECOND}")
    assert done.code == 2
    assert done.out.count("  Frame ") == 2
    assert "standard input:1: not a frame: `# taken on Monday` has no identifier" in done.err
    assert "standard input:4: not a frame: " in done.err
    assert done.err.count("hint: ") == 1
    many = decode("-", given="x\n" * 30 + FIRST)
    assert many.err.count("not a frame") == 10
    assert many.err.endswith("fieldscribe: 20 more lines are no frames\n")


def test_nothing_to_decode(decode: Callable[..., Output]) -> None:
    assert decode().code == 2
    assert json.loads(decode("-", "--format", "json").out) == {"device": "woodward_mpu2s", "frames": []}
    assert decode("-", "--format", "jsonl").out == ""


@pytest.mark.full(seconds=1)
def test_a_closed_pipe_ends_quietly() -> None:
    command = [*COMMAND, "-"]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(command, cwd=ROOT, text=True, **pipes) as running:  # type: ignore[call-overload]  # all three
        running.stdin.write(f"{FIRST}\n")
        running.stdin.flush()
        assert running.stdout.readline() == f"{FIRST}\n"
        running.stdout.close()
        try:
            running.stdin.write(log(2000))
            running.stdin.close()
        except BrokenPipeError:
            running.stdin = None
        assert running.stderr.read() == ""
    assert running.returncode == 141


MEASURED = """
import re, sys, time
from fieldscribe.cli import main
main(["decode", "woodward_mpu2s", "--log", sys.argv[1]])
peak = re.search(r"VmHWM:\\s+(\\d+)", open("/proc/self/status").read())
print(peak[1], time.process_time(), file=sys.stderr)
"""


@pytest.mark.full(seconds=7)
@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells the peak of the memory there")
def test_a_stream_takes_no_more_memory_the_longer_it_lasts(tmp_path: Path) -> None:
    """Once all memories are full."""
    told = []
    for count in (24_000, 72_000):
        file = tmp_path / "long.log"
        file.write_text(log(count))
        command = [sys.executable, "-c", MEASURED, str(file)]
        with open(os.devnull, "w") as nowhere:
            done = subprocess.run(command, cwd=ROOT, stdout=nowhere, stderr=subprocess.PIPE, text=True, check=True)
        told.append([float(number) for number in done.stderr.split()])
    (peak, _), (later_peak, _) = told  # how long it takes is measured by `make bench`
    assert later_peak < 1.04 * peak
