"""Each member of a group's struct comes from the words of its point."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from support.c_device import write_headers
from support.described import made, shipped

BLOCKS = re.compile(r"_(\w+)_blocks\[\] = \{\n(.*?)\n\};", re.DOTALL)
DECODE = re.compile(r"_(\w+)_group_decode\(.*?\n\{\n(.*?)\n\}\n", re.DOTALL)
MEMBER = re.compile(r"group->(\w+?)_(?:count|raw|text)\b")


@pytest.mark.parametrize("device", ["hitachi_l200", "jumo_controller", "nord_sk5xxe", "kitchen_sink", "kitchen_codes"])
def test_members_have_the_words_of_their_points(device: str, tmp_path: Path) -> None:
    """At the address of the point, by its own functions, once each."""
    model = made(device) if "kitchen" in device else shipped(device)
    text = (write_headers(model, tmp_path) / f"c/{device}_modbus.h").read_text("utf-8")
    points = {item: point for point in model.points for item in (point.item, *point.old_items)}
    blocks = {
        group.removeprefix(f"{device}_"): [int(row, 16) for row in re.findall(r"\{\d+U, (0x\w+)U,", table)]
        for group, table in BLOCKS.findall(text)
    }
    found: list[str] = []
    for group, body in DECODE.findall(text):
        for case, statements in re.findall(r"case (\d+)U:\n(.*?)\n\s+break;", body, re.DOTALL):
            begin = blocks[group.removeprefix(f"{device}_")][int(case)]
            for statement in statements.split(";")[:-1]:
                [item], [at] = MEMBER.findall(statement), re.findall(r"words\[(\d+)\]", statement)
                place = points[item].place.addresses
                assert begin + int(at) == (min(place) if place else points[item].address), item
                called = set(re.findall(rf"{device}_(\w+?)_(?:extract|from_words|decode_count|decode)\(", statement))
                assert called <= {points[item].item}, item
                found.append(item)
    assert len(found) == len(set(found)) > 5
    assert text.count("group->") == len(found)
