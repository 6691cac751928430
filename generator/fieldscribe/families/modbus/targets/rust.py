"""Modbus in generated Rust: the profile, block reads, commands and exceptions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.modbus import framings_of, of_bus
from fieldscribe.targets.rust.documentation import sentence
from fieldscribe.targets.rust.families import OfFamily
from fieldscribe.targets.rust.families.numbers import code_names
from fieldscribe.targets.rust.families.spaces import space_variant
from fieldscribe.targets.rust.layout import Item, Lines, array, chain
from fieldscribe.text import rust_string

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Bus, Code, Device

_MOST = {1: 2000, 2: 2000, 3: 125, 4: 125, 5: 1, 6: 1, 8: 1, 15: 1968, 16: 123}
"""The functions that the runtime supports, with the limits of the protocol."""

_COILS = 15
"""The function that writes several coils; some devices want its bytes padded."""

_PORTS = {"rtu": 4001, "tcp": 502}
"""The usual port of a serial server, and that of Modbus TCP."""


def context(device: Device) -> dict[str, object]:
    """The names that the family's template uses."""
    bus = device.bus
    functions = [
        f"Function::new({code.number}, {_most(code)})" + (".without_broadcast()" if code.broadcast is False else "")
        for code in bus.functions
    ]
    return {
        "example_link": f"Framing::{framings_of(bus)[0].capitalize()}, {bus.units[0]}",
        "functions": array(Item("const FUNCTIONS", "&[Function]"), functions),
        "framings": ", ".join(f"Framing::{framing.capitalize()}" for framing in framings_of(bus)),
        "exception_type": "u8",
        "exception_names": code_names(bus.exceptions),
        "profile": _profile(bus),
        "exceptions": tuple(map(_exception, bus.exceptions)),
        "blocks": tuple(_blocks(device)),
        "block_needs": "{Block, Space}" if any(device.blocks.values()) else "Block",
        "groups": array(
            Item("pub const BLOCKS", "&[(&str, &[Block])]"),
            [f"({rust_string(group)}, blocks::{group.upper()})" for group in device.blocks],
        ),
        "commands": tuple(_commands(device)),
    }


def _exception(code: Code) -> tuple[str, str, str]:
    """The comment of an exception code, its constant, and its number."""
    return (
        f"{sentence(code.name).rstrip('.')}: exception {code.number:02X}h.",
        code.name.upper(),
        f"0x{code.number:02X}",
    )


def _profile(bus: Bus) -> Lines:
    broadcast = "None" if bus.broadcast is None else f"Some({bus.broadcast})"
    profile = f"Profile::new(FUNCTIONS, FRAMINGS, ({bus.units[0]}, {bus.units[1]}), {broadcast})"
    pads = of_bus(bus).pad_coil_bytes == "even" and any(code.number == _COILS for code in bus.functions)
    steps = [*([".padding_coils()"] if pads else []), *([".naming(exceptions::name)"] if bus.exceptions else [])]
    return chain(Item("pub static PROFILE", "Profile"), profile, steps)


def _most(code: Code) -> int:
    """The largest count of items in one request: the device's, within the protocol's."""
    own = 65535 if code.most is None else code.most
    return min(own, _MOST.get(code.number, own))


def _blocks(device: Device) -> Iterator[tuple[str, Lines]]:
    """For each group: its name, and the lines of its constant."""
    for group, blocks in device.blocks.items():
        items = [
            f"Block::new(Space::{space_variant(block.space)}, {block.function}, 0x{block.address:04X}, {block.count})"
            for block in blocks
        ]
        yield group, array(Item(f"pub const {group.upper()}", "&[Block]"), items)


def _commands(device: Device) -> Iterator[tuple[str, str, str]]:
    for command in device.commands:
        value = "None" if command.value is None else f"Some({command.value})"
        doc = sentence(command.name).rstrip(".") + (": any value does" if command.value is None else "")
        doc += f"; the memory stands {command.wears} writes" if command.wears is not None else ""
        yield f"{doc}.", command.name.upper(), f"{command.function}, 0x{command.address:04X}, {value}"


def _line(device: Device) -> str:
    """A device that speaks RTU is behind a serial server."""
    return f'TcpLine::new("192.168.0.20:{_PORTS[framings_of(device.bus)[0]]}")'


IN_RUST = OfFamily(
    context,
    names=("Framing",),
    transports=("std", "tokio-modbus", "embedded-io", "embedded-io-async"),
    line=_line,
    line_names="tcp::TcpLine",
)
