"""The tables of what targets make of names are those of the targets: held against what they generate."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING

from fieldscribe.checks.identifiers import RUST_CONSTANTS, RUST_UNKNOWN
from fieldscribe.checks.prefixes import C_TAILS, HEADER
from fieldscribe.names import pascal
from fieldscribe.pipeline import outputs
from fieldscribe.resources import templates_dir
from test_good import sink

if TYPE_CHECKING:
    from collections.abc import Iterator


@lru_cache(maxsize=1)
def headers() -> str:
    """The C headers of the device that uses everything."""
    return "\n".join(text for _, path, text in outputs(sink(), ["c"]) if path.endswith(".h") and "kitchen_sink" in path)


def c_identifiers() -> Iterator[str]:
    """What the headers define, without the device's name, in small letters."""
    text = headers()
    yield from (name.lower() for name in re.findall(r"^#define KITCHEN_SINK_(\w+)", text, re.MULTILINE))
    yield from (name.lower() for name in re.findall(r"^\s+KITCHEN_SINK_(\w+) =", text, re.MULTILINE))
    yield from re.findall(r"^static \S.*?\bkitchen_sink_(\w+)\(", text, re.MULTILINE)


def known() -> set[str]:
    """What the tables say that the headers define."""
    device = sink()
    names = set(HEADER)
    for point in device.points:
        for item in (point.item, *(old + point.item[len(point.name) :] for old in point.was)):
            names.update(f"{item}_{tail}" for tail in (*C_TAILS, *point.references))
            for special in point.specials:
                names.update(f"{item}_{special.name}{end}" for end in ("", "_first", "_last"))
            for flag in point.flags:
                ends = ("", "_mask", "_shift", *(f"_{value.name}" for value in flag.values))
                names.update(f"{item}_{flag.name}{end}" for end in ends)
        if point.enum is not None:
            names.update(f"{point.enum.name}_{entry.name}" for entry in point.enum.entries)
            names.add(f"{point.enum.name}_name")
    names.update(f"command_{one.name}_{tail}" for one in device.commands for tail in ("address", "value", "request"))
    names.update(f"exception_{one.name}" for one in device.bus.exceptions)
    names.update(f"space_{point.space}" for point in device.points)
    names.update(f"{group.name}_{tail}" for group in device.groups for tail in ("blocks", "blocks_count"))
    return names


def test_c_table() -> None:
    """Every identifier of the headers is one that the table foresees."""
    found = set(c_identifiers())
    assert len(found) > 800
    assert found - known() == set()


def test_rust_table() -> None:
    """The traits have the constants that no special code may hide, and the enums the name for other numbers."""
    runtime = templates_dir() / "rust" / "runtime" / "fieldscribe_runtime" / "src" / "point.rs"
    constants = set(re.findall(r"^    const ([A-Z_]+):", runtime.read_text("utf-8"), re.MULTILINE))
    assert {name.lower() for name in constants} <= RUST_CONSTANTS
    [enums] = [text for _, path, text in outputs(sink(), ["rust"]) if path.endswith("kitchen_sink/src/enums.rs")]
    others = set(re.findall(r"^    (\w+)\([iu]\d+\),", enums, re.MULTILINE))
    assert others
    assert others <= set(RUST_UNKNOWN)
    assert f"pub enum {pascal('event_code')} " in enums
