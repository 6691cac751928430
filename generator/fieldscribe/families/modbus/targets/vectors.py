"""Vectors of Modbus frames, commands, bases of addresses, and batched reads."""

import itertools
from collections.abc import Mapping

from fieldscribe.families.modbus import FRAMINGS, profile_of
from fieldscribe.families.modbus.targets.base_vectors import KINDS as BASE_KINDS
from fieldscribe.families.modbus.targets.base_vectors import BaseVectors
from fieldscribe.families.modbus.targets.wire import ModbusWire
from fieldscribe.model import Bus, Device, SteppedCommand, Word
from fieldscribe.targets.vectors.lines import NO_BROADCAST, Lines

KINDS = {
    "build": "status:word bytes:bytes? frame:note?",
    "reply": "bytes:bytes? status:word values_out:ints? exception:int? frame:note?",
    "step": "command:word index:int with:pairs? read:int? write:int? address:int held:ints words:ints within:int? "
    "conditional:int base:word?",
    "block": "group:word space:word function:int address:int count:int",
    **BASE_KINDS,
}
"""The kinds of vectors for frames, batched reads and bases."""

_MOST_BYTES = {"rtu_bytes": 256, "tcp_bytes": 260}
"""The longest frames that the protocol allows."""


def wires(lines: Lines, device: Device) -> list[ModbusWire]:
    """Return one for each framing of the device, in the order of the description."""
    return [ModbusWire(lines, device, framing) for framing in device.bus.framings or ("rtu",)]


def frames(lines: Lines, device: Device) -> None:
    """Add all vectors of Modbus frames."""
    own = wires(lines, device)
    own[0].add_codes("code", "exception", device.bus.exceptions)
    for wire in own:
        wire.opens()
        for command in device.commands:
            value = 1 if command.value is None else command.value
            script = wire.script(command.function, (command.address,), (value,))
            if script is not None:
                lines.add("command", command.name, value, script, "ok")
    own[0].opens()
    BaseVectors(own[0]).add()
    spoken = [wire for wire in own if wire.framing in device.bus.framings]
    for wire in spoken:
        wire.add_builds(wire.requests())
    for framing in [framing for framing in FRAMINGS if framing not in own[0].profile.framings]:
        foreign = ModbusWire(lines, device, framing)
        foreign.add_builds(itertools.islice(foreign.requests(), 1))
    for wire in spoken:
        wire.add_all_replies()
    own[0].add_examples()
    for stepped in device.stepped_commands:
        _steps(lines, stepped)
    for group, block in [(group, block) for group, blocks in device.blocks.items() for block in blocks]:
        lines.add("block", group, block.space, block.function, block.address, block.count)


def _steps(lines: Lines, command: SteppedCommand) -> None:
    """Add the words of each step for the ends of the arguments, over what the device held."""
    ends = {end: {name: both[end] for name, both in command.arguments.items()} for end in (0, 1)}
    for index, step in enumerate(command.steps):
        for given, filled in itertools.product((ends[0], ends[1]) if command.arguments else ({},), (0x0000, 0xA5C3)):
            words = tuple(_word(word, given, f"{filled:016b}") for word in step.words)
            facts = step.read, step.write, step.address, (filled,) * len(words), words, step.within
            lines.add("step", command.name, index, given or None, *facts, int(step.when is not None), step.base)


def _word(word: Word, given: Mapping[str, int], held: str) -> int:
    """Return a word for these arguments over what the device held, bit by bit."""
    number = f"{(word.constant + word.factor * given.get(word.argument or '', 0)) % 0x10000:016b}"
    bits = zip(number, f"{word.mask:016b}", held, strict=True)
    return int("".join([new if mask == "1" else old for new, mask, old in bits]), 2)


def limits(lines: Lines, bus: Bus) -> None:
    """Add the limits of the functions and of the protocol."""
    profile = profile_of(bus)
    known = [code.number for code in bus.functions if code.number in profile.most]
    for index, number in enumerate(known):
        lines.add("function", index, number, profile.most[number], int(number in profile.broadcasts))
    lines.add_limits(functions=len(known), broadcast=NO_BROADCAST if bus.broadcast is None else bus.broadcast)
    lines.add_limits(no_broadcast=NO_BROADCAST, **_MOST_BYTES)
