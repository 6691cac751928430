"""The tables of what targets make of names are those of the targets: held against what they generate."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from fieldscribe.checks.prefixes import C_TAILS, HEADER, LAYOUT
from fieldscribe.names import RUST_CONSTANTS, RUST_UNKNOWN, pascal
from fieldscribe.pipeline import outputs
from fieldscribe.resources import templates_dir
from test_good import sink
from test_good_families import kitchen

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device


KITCHENS = ("kitchen_sink", "kitchen_can", "kitchen_uss")


def c_identifiers(device: Device) -> Iterator[str]:
    """What the headers of a device define, without the device's name, in small letters."""
    made = (text for _, path, text in outputs(device, ["c"]) if path.endswith(".h") and device.id in path)
    text, upper = "\n".join(made), device.id.upper()
    yield from (name.lower() for name in re.findall(rf"^#define {upper}_(\w+)", text, re.MULTILINE))
    yield from (name.lower() for name in re.findall(rf"^\s+{upper}_(\w+) =", text, re.MULTILINE))
    yield from (name.lower() for name in re.findall(rf"^static const .*\b(?i:{upper})_(\w+) =", text, re.MULTILINE))
    yield from re.findall(rf"^static \S.*?\b{device.id}_(\w+)\(", text, re.MULTILINE)


def known(device: Device) -> set[str]:
    """What the tables say that the headers define."""
    names = set(HEADER)
    for point in device.points:
        for item in (point.item, *(old + point.item[len(point.name) :] for old in point.was)):
            names.update(f"{item}_{tail}" for tail in (*C_TAILS, *point.references))
            for holder in (item, point.shared_codes or item):
                names.update(f"{holder}_{tail}" for tail in ("is_special", "special_name", "is_no_value"))
                for special in point.specials:
                    names.update(f"{holder}_{special.name}{end}" for end in ("", "_first", "_last"))
            for flag in point.flags:
                ends = ("", "_mask", "_shift", *(f"_{value.name}" for value in flag.values))
                names.update(f"{item}_{flag.name}{end}" for end in ends)
    for enum in device.enums:
        names.update(f"{enum.name}_{entry.name}" for entry in enum.entries)
        names.add(f"{enum.name}_name")
    bus = device.bus
    names.update(f"command_{one.name}_{tail}" for one in device.commands for tail in ("address", "value"))
    names.update(f"command_{one.name}" for one in device.commands)
    names.update(f"exception_{one.name}" for one in bus.exceptions)
    for kind, codes in (("task", bus.functions), ("response", bus.codes("responses")), ("error", bus.exceptions)):
        names.update((f"{kind}_name", *(f"{kind}_{one.name}" for one in codes)))
    names.update(f"space_{point.space}" for point in device.points)
    names.update(f"{one.name}_{tail}" for one in device.groups for tail in ("blocks", "blocks_count", "group_count"))
    names.update(f"message_{one.name}" for one in device.messages)
    for one in device.telegrams:
        names.update(f"telegram_{one.name}{tail}" for tail in ("", "_words", "_slots"))
    return names


@pytest.mark.parametrize("name", KITCHENS)
def test_c_table(name: str) -> None:
    """Every identifier of the headers is one that the table foresees."""
    device = kitchen(name)
    found = set(c_identifiers(device))
    assert len(found) > 7 * len(device.points)
    assert {name for name in found - known(device) if not LAYOUT.fullmatch(name)} == set()


def test_the_headers_reserve_no_more_than_they_define() -> None:
    """A name that no header of any family defines would be refused for nothing."""
    found = set()
    for device in map(kitchen, KITCHENS):
        made = "\n".join(text for _, path, text in outputs(device, ["c"]) if path.endswith(".h") and device.id in path)
        found |= set(c_identifiers(device))
        found |= set(re.findall(rf"^static const .*\b{device.id}_(\w+)\[\] =", made, re.MULTILINE))
        found |= set(re.findall(rf"^typedef .* {device.id}_(\w+);$", made, re.MULTILINE))
    assert HEADER - found == set()


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
