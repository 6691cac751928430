"""Measures what exchanges of generated C and Rust cost on Cortex-M0, beside what an engineer writes by hand in C.

.venv/bin/python tests/bench/m0_bench.py

Bytes are of the linked program without what it is without the calls. Instructions are counted by an emulator of which
each takes as long (-icount).
"""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

from stream_bench import FIELDSCRIBE

ROOT = Path(__file__).resolve().parents[2]
HERE = ROOT / "tests/bench/exchange"
FLAGS = "-std=gnu99 -mcpu=cortex-m0 -mthumb -Os -ffunction-sections -fdata-sections -DFIELDSCRIBE_NO_FLOAT"
LINK = ("-nostartfiles", "-Wl,--gc-sections", "-T", str(ROOT / "tests/firmware/microbit.ld"))
QEMU = "qemu-system-arm -M microbit -display none -monitor none -serial stdio -icount shift=6 -kernel"
RUST = """[package]
name = "point"
edition = "2021"
[dependencies]
hitachi_l200.path = "hitachi_l200"
[features]
both = []
[[bin]]
name = "point"
path = "%s"
[profile.release]
opt-level = "s"
lto = true
codegen-units = 1
panic = "abort"
"""
RUST_TARGET = "thumbv6m-none-eabi"
NOTHING, BUILD, PARSE, ASK, BOTH, POINTS, ENCODE, DECODE, POWER, LONG_ENCODE, LONG_DECODE = range(11)
TICK, INSTRUCTION = 62.5, 64.0
"""Nanoseconds of the timer and of an instruction."""


def _image(folder: Path, source: str, part: int, points: int = 1) -> Path:
    """Return the program that calls a part."""
    image = folder / f"{source}_{part}_{points}"
    defines = f"-DPART={part} -DPOINTS={points} -DANSWER_CRC=0x23,0xAE"
    words = ["arm-none-eabi-gcc", *FLAGS.split(), *defines.split(), f"-I{HERE}", f"-I{folder}", *LINK]
    subprocess.run([*words, HERE / "main.c", HERE / f"{source}.c", "-o", image], check=True)
    return image


def _bytes(image: Path) -> int:
    done = subprocess.run(["arm-none-eabi-size", image], check=True, capture_output=True, text=True)
    return sum(map(int, done.stdout.splitlines()[1].split()[:2]))


def _rust_bytes(folder: Path, *options: str) -> int:
    """Return the bytes of the program in Rust over vendored crates."""
    (folder / "Cargo.toml").write_text(RUST % (HERE / "point.rs"), "utf-8")
    words = ["cargo", "build", "--offline", "--quiet", "--release", "--target", RUST_TARGET, *options]
    subprocess.run(words, cwd=folder, check=True)
    return _bytes(folder / "target" / RUST_TARGET / "release/point")


def _instructions(image: Path) -> float:
    with subprocess.Popen([*QEMU.split(), image], stdout=subprocess.PIPE) as process:
        assert process.stdout is not None
        ticks = int.from_bytes(process.stdout.read(4), "little")
        process.kill()
    if not ticks:
        raise SystemExit(f"{image.name} gives another result")
    return ticks * TICK / INSTRUCTION


def _vendor(target: str, folder: Path, points: str, device: str = "hitachi_l200") -> None:
    words = [FIELDSCRIBE, "vendor", target, device, "--out", str(folder), "--points", points]
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)


def rows(folder: Path) -> Iterator[tuple[str, float, float | None, float]]:
    """Yield what is measured, the figure of generated code, that by hand, and the mark."""
    parts = ",".join(f"fieldscribe_modbus_{name}_rtu" for name in ("build", "parse", "ask"))
    _vendor("c", folder, f"D001,D002,D003,D013,{parts}")
    figures: dict[str, list[float]] = {}
    for source in ("generated", "by_hand"):
        images = {part: _image(folder, source, part) for part in (NOTHING, BUILD, PARSE, ASK, BOTH)}
        sizes = {part: _bytes(image) - _bytes(images[NOTHING]) for part, image in images.items()}
        counts = {part: _instructions(images[part]) - _instructions(images[NOTHING]) for part in (BUILD, PARSE, ASK)}
        figures[source] = [sizes[BOTH], counts[BUILD], counts[PARSE], sizes[ASK], counts[ASK]]
    names = "build and parse, bytes", "build, instructions", "parse, instructions", "ask, bytes", "ask, instructions"
    built, parsed, asked = figures["by_hand"][1:3] + figures["by_hand"][4:]
    marks = 700, 1.6 * built, 1.6 * parsed, 1000, 2 * asked
    yield from zip(names, figures["generated"], figures["by_hand"], marks, strict=True)
    _vendor("c", folder, f"D001,D002,D003,D013,A020,B012,{parts}")
    both, asked = (_bytes(_image(folder, "generated", part)) for part in (BOTH, ASK))
    nothing = _bytes(_image(folder, "generated", NOTHING))
    yield "the same where other points are written: build, parse", both - nothing, None, 860
    yield "and ask, bytes", asked - nothing, None, 1250
    one, two = (_bytes(_image(folder, "generated", POINTS, points)) for points in (1, 2))
    yield "one more point read and written, bytes", two - one, None, 60
    _vendor("c", folder, "main_setpoint,main_actual_value", "siemens_mm4")
    _vendor("c", folder, "generator_voltage_l1_l2", "woodward_mpu2s")
    images = {part: _image(folder, "scales", part) for part in (NOTHING, *range(ENCODE, LONG_DECODE + 1))}
    took = {part: _instructions(image) - _instructions(images[NOTHING]) for part, image in images.items()}
    yield "MM4: setpoint of 25 Hz to raw, instructions", took[ENCODE], None, 400
    yield "MM4: actual value to a count, instructions", took[DECODE], None, 400
    yield "the same of 87.3 Hz, where both are linked: to raw", took[LONG_ENCODE], None, 400
    yield "to a count, instructions", took[LONG_DECODE], None, 400
    yield "MPU2-S: voltage to a count, instructions", took[POWER], None, 100
    yield "and bytes", _bytes(images[POWER]) - _bytes(images[NOTHING]), None, 300
    _vendor("rust", folder, "A020")
    whole, empty = _rust_bytes(folder, "--features", "both"), _rust_bytes(folder)
    yield "Rust: a point read and written in counts, bytes", whole - empty, None, 3000


def print_m0() -> None:
    """Print the table."""
    print(f"\n{'exchanges on Cortex-M0, -Os':<48} {'':8} {'hand':>5} {'ours':>7} {'mark':>6}")
    with tempfile.TemporaryDirectory() as folder:
        for what, ours, hand, mark in rows(Path(folder)):
            by_hand = "" if hand is None else f"{hand:.0f}"
            over = "" if ours <= mark else "  over"
            print(f"{what:<48} {'':8} {by_hand:>5} {ours:7.0f} {mark:6.0f}{over}", flush=True)


if __name__ == "__main__":
    print_m0()
