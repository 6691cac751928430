"""Reading and writing a point in one call does what its codec and its frames do, and keeps the other bits of a word."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from fieldscribe.model import Device
from fieldscribe.targets.c.syntax import raw_type, wire_kind
from fieldscribe.targets.c.word_functions import has_form
from support.c_device import program, run_program, write_headers
from support.described import made
from support.python_families import uss_device

HANDLES = {
    "modbus": "{{NULL, &ask, 3U, 0U, 0U, false}}",
    "uss": "{{&line, &ask, sent, heard, 3U, 0U}}",
}
NUMBERS = (0, 1, 2, 3, 7, 10, 99, 100, 101, 255, 400, 1000, 4000, 0x1234, 0x7FFF, 0x8000, 0x8001, 0xFFFF)
VALUES = (-(2**31), -70000, -32769, -129, -5, -1, *NUMBERS, 65536, 70000, 4000000, 2**31, 2**32)
PLAIN = ("enum", "flags", "bit", "integer")


def lines_of(device: Device, folder: Path) -> list[str]:
    """Return a check of each call of a device that takes no raw numbers of other points."""
    header = (folder / f"{device.id}_{device.family}.h").read_text("utf-8")
    codecs = (folder / f"{device.id}.h").read_text("utf-8")
    call = rf"_CALL {device.id}_(read|write|store)_(\w+)\(\s*{device.id}_device \*device, (\w+) \*?(?:count|value)\)"
    points = {point.item: point for point in device.points}
    lines = []
    for verb, item, kind in re.findall(call, header):
        point, name = points[item], f"{device.id}_{item}"
        if has_form(point) or point.selects:  # no layout, or several requests; the conformance program holds its calls
            continue
        types = f"{wire_kind(point)}, {raw_type(point)}, {kind}"
        tail = "_count" if point.has_counts else "" if point.form in PLAIN else None
        if verb == "read":
            fails = re.search(rf"^FIELDSCRIBE_STATUS {name}_decode{tail}\(", codecs, re.M)
            decode = "raw" if tail is None else f"{name}_decode{tail}(raw{', &want' if fails else ''})"
            lines.append(f"READ({item}, {types}, ({decode if fails and tail is not None else f'want = {decode}, 0'}))")
            continue
        frame, way = f"{name}{'_eeprom' * (verb == 'store')}_frame", "write" if point.bits is None else "update"
        encode = f"raw = value, {name}_check(value)" if tail is None else f"{name}_encode{tail}(value, &raw)"
        lines.append(f"WRITE({verb}, {item}, {frame}, {way}, {types}, ({encode}))")
    return lines


def special_words(device: Device) -> set[int]:
    """Return the words of the special codes."""
    ends = {end for point in device.points for code in point.specials for end in (code.low, code.high)}
    return {end >> shift & 0xFFFF for end in ends for shift in (0, 16)}


def check(device: Device, way: str, out: Path) -> None:
    """Hold the calls of a device against its codecs and frames."""
    folder = write_headers(device, out) / "c"
    lines = lines_of(device, folder)
    assert len(lines) > 15
    samples = sorted({*NUMBERS, *special_words(device)})
    text = program("calls").replace("@ASK@", program(f"calls_{device.family}")).replace("LINES", "\n".join(lines))
    text = text.replace("@SAMPLES@", ", ".join(f"{number}U" for number in samples))
    text = text.replace("@VALUES@", ", ".join(f"INT64_C({value})" for value in VALUES))
    selected = ", FIELDSCRIBE_MODBUS_NOTHING_SELECTED}" if device.selecting else "}"
    text = text.replace("@HANDLE@", HANDLES[device.family][:-1] + selected)
    text = text.replace("FAMILY", device.family).replace("DEVICE", device.id)
    run_program(text, way, folder, out, "-Wno-unused-function")


@pytest.mark.parametrize(
    ("device", "way"),
    [
        ("kitchen_codes", "quick"),
        ("sample_uss", "quick"),
        *(
            pytest.param(device, "clang", marks=pytest.mark.full(seconds=seconds))
            for device, seconds in (("kitchen_sink", 4), ("kitchen_codes", 1), ("sample_uss", 1))
        ),
    ],
)
def test_a_call_does_what_codec_and_frames_do(device: str, way: str, tmp_path: Path) -> None:
    check(uss_device() if device == "sample_uss" else made(device), way, tmp_path)
