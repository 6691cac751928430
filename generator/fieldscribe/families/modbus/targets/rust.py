"""Modbus in generated Rust: the profile, block reads, commands and exceptions."""

from collections.abc import Iterator

from fieldscribe.families.modbus import SPACES, framings_of, of_bus, profile_of
from fieldscribe.model import Block, Bus, Code, Command, Device, SteppedCommand
from fieldscribe.targets.rust.layout import Item, Lines, array, binding, chain, sentence
from fieldscribe.targets.rust.scope import RustFamily, code_names, space_variant
from fieldscribe.text import rust_code, rust_string
from fieldscribe.wording.rules import run_text, steps_texts

_WRITE_COILS = 15
_PORTS = {"rtu": 4001, "tcp": 502}
"""The usual port of a serial server, and that of Modbus TCP."""


def context(device: Device) -> dict[str, object]:
    """Return the names that the family's template uses."""
    bus = device.bus
    framings = [f"Framing::{framing.capitalize()}" for framing in framings_of(bus)]
    groups = [f"({rust_string(group)}, blocks::{group.upper()})" for group in device.blocks]
    stepped = tuple(map(_stepped, device.stepped_commands))
    given = [base.name for base in device.bases if base.block is None]
    found = [base.name for base in device.bases if base.starts_block]
    return {
        "example_link": f"{framings[0]}, {bus.units[0]}",
        "functions": array(Item("const FUNCTIONS", "&[Function]"), list(_functions(bus))),
        "framings": ", ".join(framings),
        "exception_type": "u8",
        "exception_names": code_names(bus.exceptions),
        "profile": _profile(bus),
        "exceptions": tuple(map(_exception, bus.exceptions)),
        "bases": tuple(_bases(device)),
        "base_needs": ", ".join(_base_needs(device)),
        "base_lists": (_names_of("GIVEN", "GivenBase", given), _names_of("FOUND", "FoundBlock", found)),
        "blocks": tuple((group, _blocks(group, blocks)) for group, blocks in device.blocks.items()),
        "block_needs": "{Block, Space}" if any(device.blocks.values()) else "Block",
        "groups": array(Item("pub const BLOCKS", "&[(&str, &[Block])]"), groups),
        "commands": tuple(map(_command, device.commands)),
        "stepped": stepped,
        "stepped_commands": array(
            Item("pub const STEPPED_COMMANDS", "&[runtime::modbus::SteppedCommand]"),
            [f"stepped_commands::{name}" for _, name, _ in stepped],
        ),
    }


def _functions(bus: Bus) -> Iterator[str]:
    """Yield each function with its largest count: the device's, within the protocol's."""
    most = profile_of(bus).most
    for code in bus.functions:
        largest = most.get(code.number, 65535 if code.most is None else code.most)
        yield f"Function::new({code.number}, {largest}){'.without_broadcast()' if code.broadcast is False else ''}"


def _exception(code: Code) -> tuple[str, str, str]:
    """Return the comment of an exception code, its constant, and its number."""
    comment = f"{sentence(code.name).rstrip('.')}: exception {code.number:02X}h."
    return comment, code.name.upper(), f"0x{code.number:02X}"


def _profile(bus: Bus) -> Lines:
    broadcast = "None" if bus.broadcast is None else f"Some({bus.broadcast})"
    profile = f"Profile::new(FUNCTIONS, FRAMINGS, ({bus.units[0]}, {bus.units[1]}), {broadcast})"
    pads = of_bus(bus).pad_coil_bytes == "even" and any(code.number == _WRITE_COILS for code in bus.functions)
    steps = [*([".padding_coils()"] if pads else []), *([".naming(exceptions::name)"] if bus.exceptions else [])]
    return chain(Item("pub const PROFILE", "Profile"), profile, steps)


def _bases(device: Device) -> Iterator[tuple[str, Lines]]:
    """Yield the comment and the lines of each constant: given numbers, bases, and the search of blocks."""
    found, given = device.found, {each.name: each for each in device.given}
    if found is not None:
        name = found.name.upper()
        for what, addresses in (("MARKER", found.words), ("PLACES", found.places)):
            words = [f"0x{number:04X}" for number in addresses]
            yield "", array(Item(f"const {name}_{what}", "&[u16]"), words)
        chain = f"Chain::new({SPACES[found.space].read}, {name}_MARKER, {name}_PLACES, 0x{found.end:04X})"
        yield f"The blocks behind {rust_code(found.marker)}.", binding(4, Item(f"pub const {name}", "Chain"), chain)
    for base in device.bases:
        name, text = base.name.upper(), rust_string(base.name)
        if base.block is not None and not base.starts_block:
            continue  # a program makes it after reading the counting points
        if found is not None and base.block is not None:
            made = f"FoundBlock::new({text}, &{found.name.upper()}, {base.block})"
            yield f"Block {base.block}.", binding(4, Item(f"pub const {name}", "FoundBlock"), made)
            continue
        numbers = [(given[each], factor) for each, factor in base.terms]
        items = [f"Given::new({each.low}, {each.high}, {factor})" for each, factor in numbers]
        yield "", array(Item(f"const {name}_GIVEN", "&[Given]"), items)
        made = f"GivenBase::new({text}, {base.offset}, {name}_GIVEN)"
        order = ", ".join(each.name for each, _ in numbers)
        doc = f"{rust_code(base.formula)}: takes {order or 'no number'}."
        yield doc, binding(4, Item(f"pub const {name}", "GivenBase"), made)


def _names_of(name: str, kind: str, bases: list[str]) -> Lines:
    """Return the list of bases of one kind for the conformance test."""
    names = [f"device::bases::{base.upper()}" for base in bases]
    return array(Item(f"const {name}", f"&[device::runtime::modbus::{kind}]"), names)


def _base_needs(device: Device) -> list[str]:
    found = ["Chain", "FoundBlock"] if device.found is not None else []
    return found + (["Given", "GivenBase"] if any(base.block is None for base in device.bases) else [])


def _blocks(group: str, blocks: tuple[Block, ...]) -> Lines:
    """Return the lines of a group's constant."""
    items = [
        f"Block::new(Space::{space_variant(block.space)}, {block.function}, 0x{block.address:04X}, {block.count})"
        + (f".counted_from({rust_string(block.base)})" if block.base else "")
        for block in blocks
    ]
    return array(Item(f"pub const {group.upper()}", "&[Block]"), items)


def _command(command: Command) -> tuple[str, str, str]:
    """Return the comment of a command, its constant, and its arguments."""
    value = "None" if command.value is None else f"Some({command.value})"
    doc = sentence(command.name).rstrip(".") + (": any value does" if command.value is None else "")
    doc += f"; the memory is rated for {command.wears} writes" if command.wears is not None else ""
    return f"{doc}.", command.name.upper(), f"{command.function}, 0x{command.address:04X}, {value}"


def _stepped(command: SteppedCommand) -> tuple[list[str], str, list[str]]:
    """Return the documentation of a command with steps, its constant, and its rows."""
    texts = [f"{number}. `{text}`" for number, text in enumerate(steps_texts(command), 1)]
    doc = [f"{sentence(command.name).rstrip('.')}: `{run_text(command)}`.", "", *texts]
    ends = [f"{rust_string(name)} {low} {high}" for name, (low, high) in command.arguments.items()]
    return doc, command.name.upper(), [f"{rust_string(command.name)} {', '.join(ends)}".rstrip(), *_rows(command)]


def _rows(command: SteppedCommand) -> Iterator[str]:
    numbers = {name: at for at, name in enumerate(command.arguments)}
    for step in command.steps:
        functions = ["None" if function is None else f"Some({function})" for function in (step.read, step.write)]
        words = [
            " ".join([*(f"0x{number & 0xFFFF:04X}" for number in (word.constant, word.factor, word.mask)), str(at)])
            for word in step.words
            for at in [numbers.get(word.argument or "", 0)]
        ]
        facts = *functions, f"0x{step.address:04X}", str(step.within or 0), "true" if step.when else "false"
        facts = *facts, rust_string(step.base or "")
        yield f"{', '.join(facts)}: {', '.join(words)}"


IN_RUST = RustFamily(
    context,
    names=("Framing",),
    transports=("std", "tokio-modbus", "embedded-io", "embedded-io-async"),
    line=lambda device: f'TcpLine::new("192.168.0.20:{_PORTS[framings_of(device.bus)[0]]}")',
    line_names="tcp::TcpLine",
)
