"""Expressions for what belongs to the bus: the profile, the planned reads and the commands."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.modbus import BROADCAST, profile_of
from fieldscribe.model import Command, Device, Place
from fieldscribe.targets.python.forms import Scope, place
from fieldscribe.targets.python.identifiers import attribute
from fieldscribe.targets.python.layout import Group, Node, call, laid_out
from fieldscribe.text import python_doc, python_string

if TYPE_CHECKING:
    from collections.abc import Iterable


def profile(device: Device) -> Node:
    """What the device takes from the bus."""
    bus = device.bus
    taken = profile_of(bus)
    functions = [f"0x{function:02X}: {most}" for function, most in taken.most.items()]
    exceptions = [f"0x{one.number:02X}: {python_string(one.name)}" for one in bus.exceptions]
    arguments: list[Node] = [
        Group("functions={", tuple(functions), "}"),
        f"units=({bus.units[0]}, {bus.units[1]})",
        f"broadcast={bus.broadcast}",
    ]
    if bus.pad_coil_bytes == "even":
        arguments.append("pad_coil_bytes_even=True")
    if taken.broadcasts != BROADCAST:
        arguments.append(Group("broadcasts=(", tuple(f"0x{one:02X}" for one in sorted(taken.broadcasts))))
    if exceptions:
        arguments.append(Group("exceptions={", tuple(exceptions), "}"))
    return call("Profile", arguments)


def blocks(device: Device) -> Node:
    """The planned reads of each group."""
    made = []
    for group, reads in device.blocks.items():
        calls = [
            call("Block", (python_string(one.space), f"0x{one.function:02X}", f"0x{one.address:04X}", str(one.count)))
            for one in reads
        ]
        made.append(Group(f"{python_string(group)}: (", tuple(calls)))
    return Group("{", tuple(made), "}")


def variants(device: Device) -> Node:
    """The values of each variant axis."""
    made = [
        Group(f"{python_string(axis)}: (", tuple(map(python_string, values)))
        for axis, values in device.variants.items()
    ]
    return Group("{", tuple(made), "}")


def commands(device: Device, scope: Scope) -> Iterable[tuple[str, str, tuple[str, ...], tuple[str, ...]]]:
    """Each command: its attribute, what makes it, the arguments and the docstring."""
    points = {point.item for point in device.points} | {point.name for point in device.points}
    for one in device.commands:
        scope.used.add("Command")
        name = f"{one.name}_command" if one.name in points else one.name
        where = place("at", Place("write", one.space, (one.address,), one.function), scope)
        value = () if one.value is None else (f"value={one.value}",)
        yield attribute(name), "Command", (laid_out(where, 8), *value), (_command_doc(one),)


def _command_doc(command: Command) -> str:
    text = command.title["en"].rstrip(".") + "."
    if command.wears:
        text += f" The memory stands {command.wears} of them."
    return python_doc(text)
