"""Clients in C and Rust of simulated USS and CAN devices: each point is what the device holds; pipes are the lines."""

from __future__ import annotations

import os
import re
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from fieldscribe.arithmetic.words import joined
from fieldscribe.families import family
from fieldscribe.simulation.bench import layout_of
from fieldscribe.simulation.device import Clock, SimulatedDevice
from fieldscribe.simulation.line import Line, Stream
from support.places import ROOT
from support.rust_workspace import rust_program
from support.toolchains import compiled

PROGRAMS = Path(__file__).parent / "programs"
HEADERS = ROOT / "generated/c"
FLAGS = ("-std=c99", "-D_POSIX_C_SOURCE=200809L", "-Wall", "-Wextra", "-O1", f"-I{HEADERS}")


def frames_of(device: SimulatedDevice) -> dict[str, str]:
    """The type of the frames of each point in the generated header, by its name in C."""
    text = (HEADERS / f"{device.device.id}_{device.device.family}.h").read_text("utf-8")
    found = re.findall(rf"static const fieldscribe_(?:uss|can)_(rw|ru|r|h) {device.device.id}_(\w+)_frame\b", text)
    return {item: kind for kind, item in found}


def in_c(device: SimulatedDevice, folder: Path, includes: list[str], *flags: str) -> Path:
    """The program in C for these points."""
    (folder / "points.inc").write_text("\n".join(includes), "utf-8")
    source = PROGRAMS / f"points_{device.device.family}.c"
    return compiled("gcc", (*FLAGS, f"-I{folder}", *flags), source, folder / "points")


def heard_of(device: SimulatedDevice, program: Path) -> dict[str, tuple[int, str]]:
    """What a program says of the points: a status and a value each, while the device answers it."""
    name = device.device.family
    line = Line(family(name).part("simulation").core_of([device]), device.clock)
    answers = (through_stream if name == "uss" else through_frames)(line)
    with subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as running:
        assert running.stdin is not None
        assert running.stdout is not None
        assert running.stderr is not None
        for _ in range(70):
            device.clock.advance(0.2)
            running.stdin.write(b"".join(map(packed, line.due()[0])))
            running.stdin.flush()
        while data := os.read(running.stdout.fileno(), 4096):
            running.stdin.write(answers(data))
            running.stdin.flush()
        lines = running.stderr.read().decode().splitlines()
    return {item: (int(status), value) for item, status, value in map(str.split, lines)}


def through_stream(line: Line) -> Callable[[bytes], bytes]:
    """Bytes in, bytes out."""
    stream = Stream(line)
    return lambda data: b"".join(outcome.data for outcome in stream.received(data))


def through_frames(line: Line) -> Callable[[bytes], bytes]:
    """Frames of identifier, length and data; in front of each answer comes what the devices send by themselves."""
    come = bytearray()

    def answered(data: bytes) -> Iterator[bytes]:
        come.extend(data)  # Rust writes a frame with the byte of a line feed in two pieces
        while len(come) >= 13:
            frame = bytes(come[:13])
            del come[:13]
            line.clock.advance(0.2)
            yield from line.due()[0]
            yield from (each.data for each in line.answer(frame[:4] + frame[5:]))

    return lambda data: b"".join(map(packed, answered(data)))


def packed(frame: bytes) -> bytes:
    """A frame with its length behind the identifier."""
    return frame[:4] + bytes((len(frame) - 4,)) + frame[4:]


@pytest.mark.full(seconds=4)
@pytest.mark.parametrize("pkw", [4, 127])
def test_uss_in_c(tmp_path: Path, pkw: int) -> None:
    device = SimulatedDevice(layout_of("siemens_mm4", ("model=mm440",)), clock=Clock(0), seed=pkw)
    device.values["uss_pkw_length_index_0"] = pkw
    points = {point.item: point for point in device.layout.points.values() if point.space == "parameter"}
    frames = {item: kind for item, kind in frames_of(device).items() if item in points}
    lines = []
    for item, kind in frames.items():
        frame, kept = f"siemens_mm4_{item}_frame", f"siemens_mm4_{item}_eeprom_frame"
        writes = f"&{frame}.write, &{kept}.write" if kind == "rw" else "NULL, NULL"
        lines.append(f'point("{item}", &{frame}.read, {writes});')
    heard = heard_of(device, in_c(device, tmp_path, lines, f"-DPKW={pkw}U"))
    expected = {item: (0, str(device.memory.raw(points[item].name))) for item in frames}
    assert {item: heard[item] for item in frames} == expected
    assert len(frames) > 25
    assert heard["-"] == (heard["-"][0] or -1, "0")
    assert heard["status_word"] == (0, str(device.memory.raw("status_word")))


@pytest.mark.full(seconds=4)
def test_can_in_c(tmp_path: Path) -> None:
    device = SimulatedDevice(layout_of("woodward_mpu2s", ("voltage=400V",)), 3, clock=Clock(0), seed=4)
    points = {point.item: point for point in device.layout.points.values()}
    lines, frames = dict[str, str](), frames_of(device)
    for item, kind in frames.items():
        if item in points and kind != "h":
            frame = f"woodward_mpu2s_{item}_frame"
            writes = {"rw": f"&{frame}.write", "ru": f"&{frame}.update", "r": "NULL"}[kind]
            lines[item] = f'point("{item}", &{frame}.read, {writes});'
    for item, kind in frames.items():
        if item in points and kind == "h":
            lines[item] = f'value("{item}", &woodward_mpu2s_{item}_frame.heard, {points[item].words}U);'
    heard = heard_of(device, in_c(device, tmp_path, [*lines.values()]))
    cells = {item: device.layout.cells[points[item].name] for item in lines}
    areas = device.memory.areas
    assert heard == {item: (0, str(joined(areas[at.area][a] for a in at.addresses))) for item, at in cells.items()}
    assert len(heard) > 200


@pytest.mark.full(seconds=3)
@pytest.mark.parametrize(
    ("device_and_variant", "unit", "least"),
    [("siemens_mm4 model=mm440", 1, 30), ("woodward_mpu2s voltage=400V", 3, 180)],
)
def test_in_rust(device_and_variant: str, unit: int, least: int, rust_libraries: Path, tmp_path: Path) -> None:
    name, variant = device_and_variant.split(" ")
    device = SimulatedDevice(layout_of(name, (variant,)), unit, clock=Clock(0), seed=3)
    if name == "siemens_mm4":
        device.values["uss_pzd_length_index_0"] = 4
    crates = [rust_libraries / f"lib{crate}.rlib" for crate in ("fieldscribe_runtime", name)]
    program = rust_program(PROGRAMS / f"points_{device.device.family}.rs", tmp_path / "points", *crates)
    heard = heard_of(device, program)
    points = {point.item: point.name for point in device.layout.points.values()}
    compared = {item: value for item, (_, value) in heard.items() if item in points}
    for item, value in compared.items():
        held = device.values[points[item]]
        assert value == str(held) if isinstance(held, str) else float(value) == pytest.approx(float(held)), item
    assert len(compared) > least
