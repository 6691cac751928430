"""Rows of points stand in a static table; reading and writing one does what the functions of its point do."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest
from fieldscribe.cli import main
from fieldscribe.resources import render, templates_dir
from fieldscribe.targets.c import outputs, runtime
from support.c_device import SANITIZING, STANDARDS, program, run_program
from support.models import HERTZ, allowed, device_of, point, scaled
from support.places import ROOT

KINDS = device_of(
    "kinds",
    (
        point("plain", 0x10, "s32", allowed=allowed((-70000, 70000))),
        point("unlimited", 0x12, "u32"),
        point("wide", 0x14, "u32", scale=scaled("1/3"), decimals=2, unit=HERTZ),
        point("fine", 0x16, "s16", scale=scaled(256), decimals=3, allowed=allowed((-3000, 3000))),
        point("sevenths", 0x17, "u16", scale=scaled("3/7"), decimals=1, allowed=allowed((5, 700))),
        point("shifted", 0x18, "s32", scale=scaled(10, -273), decimals=1, allowed=allowed((-5000, 90000))),
        point("falling", 0x1A, "s16", scale=scaled(-10), decimals=1),
        point("gaps", 0x1B, allowed=allowed((0, 5), (9, 9))),
        point("part", 0x1C, "s8", bits=(13, 6), allowed=allowed((-9, 9))),
        point("scaled_part", 0x1C, "u8", bits=(5, 0), scale=scaled("1/5"), decimals=0),
        point("coil", 3, "bit", space="coil"),
        point("low_first", 0x1D, "s32", swapped=True, scale=scaled("1/10"), decimals=1, allowed=allowed((-900, 70000))),
        point("low_part", 0x1F, "s8", bits=(11, 5), swapped=True, allowed=allowed((-9, 9))),
        point("decimal", 0x26, coding="bcd"),
        point("huge", 0x20, "u64"),
        point("real", 0x24, "f32"),
        *(point(f"more_{number}", 0x30 + number, access="r") for number in range(3)),
    ),
)
CALL = re.compile(r"^FIELDSCRIBE_MODBUS_CALL (\w+?)_(read|write)_(\w+)\(\1_device \*device, (\w+) \*?\w+\)", re.M)
ROW = re.compile(r"^#define (\w+_ROW) FIELDSCRIBE_MODBUS_ROW\(((?:.*\\\n)*.*)\)$", re.M)
DEVICES = ("hitachi_l200", "jumo_controller", "nord_sk5xxe")


def rows_of(text: str) -> dict[str, list[str]]:
    """Return what each row of a header stands for: its arguments, by the name of its macro."""
    return {name: [each.strip() for each in body.replace("\\\n", " ").split(",")] for name, body in ROW.findall(text)}


def vendored(device: str, out: Path) -> Path:
    """Return a folder with the headers of one of our devices."""
    assert main(["vendor", "c", str(ROOT / "descriptions" / device), "--out", str(out / "drivers"), "--rows"]) == 0
    return out / "drivers"


def check(folder: Path, device: str, way: str, out: Path) -> dict[str, list[str]]:
    """Hold each row of a device against the functions of its point, and return the rows."""
    rows, lines = rows_of((folder / f"{device}_rows.h").read_text("utf-8")), []
    for prefix, verb, item, kind in CALL.findall((folder / f"{device}_modbus.h").read_text("utf-8")):
        name = f"{device.upper()}_{item.upper()}_ROW"
        row = rows.get(name)
        if row and row[9] != "FIELDSCRIBE_MODBUS_RAW" and row[2 if verb == "read" else 3] != "NULL":
            lines.append(f"{verb.upper()}({prefix}_{verb}_{item}, {name}, {kind})")
    assert len(lines) > 10
    table = f"static const fieldscribe_modbus_row table[] = {{{', '.join(rows)}}};"
    source = program("rows").replace("DEVICE", device).replace("TABLE", table).replace("LINES", "\n".join(lines))
    run_program(source, way, folder, out, "-DFIELDSCRIBE_NAMES", "-Wno-unused-function")
    return rows


@pytest.mark.parametrize("way", SANITIZING)
def test_rows_of_all_kinds(way: str, tmp_path: Path) -> None:
    for path, text in outputs(KINDS, render, tests=False, rows=True):
        (tmp_path / Path(path).name).write_text(text, "utf-8")
    for path, source in runtime(KINDS, tests=False):
        shutil.copy(templates_dir() / source, tmp_path / Path(path).name)
    rows = check(tmp_path, "kinds", way, tmp_path)
    facts = {name[len("KINDS_") : -len("_ROW")].lower(): row for name, row in rows.items()}
    assert facts["wide"][4:] == ["-149", "1288490188649", "1", "0", "300", "2", '"wide"', '"Hz"']
    assert facts["shifted"][6:10] == ["1", "-273", "1", "1"]
    assert [name for name, row in facts.items() if row[9] == "FIELDSCRIBE_MODBUS_RAW"] == ["falling", "real"]
    assert [name for name, row in facts.items() if row[3] == "NULL"] == ["gaps", "real", "more_0", "more_1", "more_2"]
    assert not {"huge", "decimal"} & facts.keys()


@pytest.mark.full(seconds=4)
@pytest.mark.parametrize("device", DEVICES)
def test_a_row_does_what_the_functions_of_its_point_do(device: str, tmp_path: Path) -> None:
    check(vendored(device, tmp_path), device, "quick", tmp_path)


@pytest.mark.full(seconds=4)
def test_rows_need_no_names(tmp_path: Path) -> None:
    folder = vendored("hitachi_l200", tmp_path)
    rows = ", ".join(rows_of((folder / "hitachi_l200_rows.h").read_text("utf-8")))
    source = f"""#define FIELDSCRIBE_IMPLEMENTATION
#include "hitachi_l200_rows.h"
static const fieldscribe_modbus_row table[] = {{{rows}}};
int main(void) {{ return (table[0].read == NULL) && (table[1].write == NULL); }}
"""
    for standard in STANDARDS:
        run_program(source, "quick", folder, tmp_path, "-Wno-unused-function", standard=standard)


def test_what_has_no_rows_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["vendor", "c", "woodward_mpu2s", "--out", str(tmp_path), "--rows"]) == 2
    assert "`woodward_mpu2s` has no rows" in capsys.readouterr().err
