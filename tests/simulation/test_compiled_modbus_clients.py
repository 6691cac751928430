"""Our clients in C and Rust on simulated Modbus devices: every point, over TCP, RTU over TCP and a pseudo terminal."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
from fieldscribe.arithmetic.words import words_of
from fieldscribe.diagnostics import Report
from fieldscribe.model import Point
from fieldscribe.simulation import Simulated, simulated
from support.loaded_once import load_device
from support.modbus_points import CODES, LINES, SINK, VALUE, Talk, beyond, samples
from support.places import ROOT
from support.rust_programs import built_programs
from support.toolchains import compiled, succeed

PROGRAM = Path(__file__).parent / "programs/points_modbus.c"
HEADERS = ROOT / "generated/c"
FLAGS = ("-std=c99", "-D_POSIX_C_SOURCE=200809L", "-Wall", "-Wextra", "-O1", f"-I{HEADERS}")
DEVICES = [name for name in CODES if name != SINK]


def bases_of(name: str) -> dict[str, int]:
    """Return the number of the block that each point counts from; 0 without one."""
    model = load_device(ROOT / "descriptions" / name / "device.yaml", Report())
    assert model is not None
    return {point.name: int((point.base or "0").rpartition("_")[2]) for point in model.points}


def in_order(point: Point, raw: int, talk: Talk) -> list[int]:
    """Return the words of a raw number as they stand in a request."""
    words = dict(zip(talk.layout.written[point.name].addresses, words_of(point, raw), strict=True))
    return [words[address] for address in sorted(words)]


def array(words: Sequence[int]) -> str:
    """Return words as the program takes them."""
    return f"(const uint16_t[]){{{', '.join(map('{}U'.format, words))}}}" if words else "NULL"


class Row:
    """What the program in C does with a point, and what it shall print of that."""

    def __init__(self, point: Point, kind: str, talk: Talk) -> None:
        self.point, self.kind = point, kind
        held, is_read = talk.memory.raw(point.name), "r" in kind
        wanted = samples(point, held, talk) if "w" in kind else []
        wrong = beyond(point, talk) if wanted else None
        self.taken = in_order(point, wanted[0], talk) if wanted else []
        self.refused = [] if wrong is None else in_order(point, wrong, talk)
        self.expected: list[object] = [0, *in_order(point, held, talk)] if is_read else []
        if wanted:
            self.expected += [0, 0, *self.taken, 0] if is_read else [0]
        self.is_refused = wrong is not None

    def call(self, device: str, block: int) -> str:
        """Return the statement for the program."""
        frame = f"{device}_{self.point.item}_frame"
        taken, refused = map(array, (self.taken, self.refused))
        read = f"&{frame}.read" if "r" in self.kind else "NULL"
        write = f"&{frame}.write" if self.taken else "NULL"
        return f'point("{self.point.item}", {block}U, {read}, {write}, {taken}, {refused});'


def rows_of(name: str, talk: Talk) -> Iterator[Row]:
    """Yield the points that the generated header has, and that are there."""
    points = {point.item: point for point in talk.points()}
    header = (HEADERS / f"{name}_modbus.h").read_text("utf-8")
    for kind, item in re.findall(rf"static const fieldscribe_modbus_(?:text_)?(rw|r|w) {name}_(\w+)_frame\b", header):
        if item in points:
            yield Row(points[item], kind, talk)


def in_c(name: str, rows: Sequence[Row], folder: Path) -> Path:
    """Build the program for these rows."""
    blocks = bases_of(name)
    chain = "&fronius_datamanager_models" if any(blocks.values()) else "NULL"
    profile = f"#define PROFILE {name}_modbus_profile\n#define CHAIN {chain}\n"
    (folder / "device.inc").write_text(f'#include "{name}_modbus.h"\n{profile}', "utf-8")
    (folder / "points.inc").write_text("\n".join(row.call(name, blocks[row.point.name]) for row in rows), "utf-8")
    return compiled("gcc", (*FLAGS, f"-I{folder}"), PROGRAM, folder / "points")


def words_for(device: Simulated, framing: str) -> list[str]:
    """Return the arguments that lead a program to a device."""
    return ["serial" if device.path else framing, device.path or str(device.port), str(device.unit)]


@pytest.mark.full(seconds=4)
@pytest.mark.parametrize("name", DEVICES)
def test_c(name: str, tmp_path: Path) -> None:
    """What is read is what the device holds; a number is taken and read back; another gets the manual's exception."""
    program: Path | None = None
    for on, framing in LINES.values():
        with simulated(name, on=on) as device:
            talk = Talk(device)
            rows = [*rows_of(name, talk)]
            assert [row.point.name for row in rows] == [point.name for point in talk.points() if point.generated]
            program = program or in_c(name, rows, tmp_path)
            printed = succeed([program, *words_for(device, framing)]).splitlines()
            assert [line.split(" ")[0] for line in printed] == [row.point.item for row in rows]
            for row, line in zip(rows, printed, strict=True):
                refused = [CODES[name][VALUE]] if row.is_refused else []
                assert line.split(" ")[1:] == [str(each) for each in (*row.expected, *refused)], line


@pytest.mark.full(seconds=4)
@pytest.mark.parametrize("name", DEVICES)
def test_rust(name: str, tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest) -> None:
    """What is read is what the device holds; it is written back; a number beyond the limits is not sent."""
    program = built_programs(tmp_path_factory, request.config) / "simulated"
    for on, framing in LINES.values():
        with simulated(name, on=on) as device:
            points = {point.item: point for point in Talk(device).points() if point.generated and point.readable}
            numbers = {item: device.values[point.name] for item, point in points.items() if point.text is None}
            writable = {item for item in numbers if points[item].writable}
            lines = (line.split(" ") for line in succeed([program, name, *words_for(device, framing)]).splitlines())
            printed = {words[0]: words[1:] for words in lines if words[0] in numbers}
        assert printed.keys() == numbers.keys()
        wrong = {
            item: (words, numbers[item]) for item, words in printed.items() if not is_right(words[0], numbers[item])
        }
        assert wrong == {}
        assert {item for item, words in printed.items() if words[1] == "true"} == writable
        refused = {item for item, words in printed.items() if words[2] == "true"}
        assert refused
        assert refused <= writable


def is_right(printed: str, value: str | float) -> bool:
    """Return True if a printed value is that of the device."""
    if isinstance(value, str):
        return printed == value
    return float(printed) == pytest.approx(float(value))
