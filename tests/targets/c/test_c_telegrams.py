"""Structs of telegrams: a frame fills in the members that it brings, with what the receiver gives for their points."""

from __future__ import annotations

from pathlib import Path

import pytest
from fieldscribe.targets.c.syntax import raw_type, wire_kind
from fieldscribe.targets.c.word_functions import has_form
from support.c_device import SANITIZING, program, run_program, write_headers
from support.described import made, shipped
from targets.c.test_c_frames import DRAW

NO_NUMBERS = {"kitchen_can": {"operating_hours", "display"}, "woodward_mpu2s": {"operating_hours"}}
"""Points whose words come in two frames, which are no members, and texts."""


@pytest.mark.parametrize("way", SANITIZING)
@pytest.mark.parametrize(("name", "telegram"), [("kitchen_can", "measurements"), ("woodward_mpu2s", "visualisation")])
def test_a_frame_fills_in_its_members(name: str, telegram: str, way: str, tmp_path: Path) -> None:
    device = made(name) if name == "kitchen_can" else shipped(name)
    folder = write_headers(device, tmp_path) / "c"
    struct = f"{name}_{telegram}_values"
    declared = (folder / f"{name}_can.h").read_text("utf-8").partition(f"typedef struct {struct} {{\n")[2]
    members = {line.split(";")[0].split()[-1] for line in declared.partition("}")[0].splitlines()} - {"display_text[3]"}
    checks = {}
    for point in device.points:
        if point.generated and point.telegram == telegram and point.item not in NO_NUMBERS[name]:
            item, counted = f"{name}_{point.item}", f"{point.item}_count" in members
            member = f"{point.item}_{'count' if counted else 'raw'}"
            number = f"{item}_decode_count(raw)" if counted else "raw"
            take = f"fieldscribe_take_{wire_kind(point)}({item}_frame.layout, words, 4U, &raw)"
            take = f"(raw = {item}_from_words(words), true)" if has_form(point) else take
            checks[member] = f"MEMBER({item}, {take}, {raw_type(point)}, {member}, {number})"
    assert members == checks.keys()
    texts = {
        "@DRAW@": DRAW,
        "MEMBERS": "\n".join(checks.values()),
        "DEVICE_SLOTS": f"{name}_telegram_{telegram}_slots".upper(),
        "DEVICE_telegram_TELEGRAM": f"{name}_telegram_{telegram}",
        "DEVICE_TELEGRAM_values": struct,
        "DEVICE": name,
    }
    text = program("can_values")
    for place, content in texts.items():
        text = text.replace(place, content)
    run_program(text, way, folder, tmp_path)
