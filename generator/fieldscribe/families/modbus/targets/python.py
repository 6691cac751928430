"""Modbus in generated Python: the profile with its functions, and the planned reads."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.modbus.facts import of_bus
from fieldscribe.families.modbus.functions import BROADCAST, FRAMINGS, profile_of
from fieldscribe.targets.python.families import RUNTIME, Flavour, PythonFamily, usual_maker
from fieldscribe.targets.python.layout import Group, Node, call
from fieldscribe.text import python_string

if TYPE_CHECKING:
    from fieldscribe.model import Device
    from fieldscribe.targets.python.scope import PackageScope


def _profile(device: Device, scope: PackageScope) -> Node:
    """What the device takes from the bus."""
    scope.used.add("Profile")
    bus = device.bus
    taken = profile_of(bus)
    functions = [f"0x{function:02X}: {most}" for function, most in taken.most.items()]
    exceptions = [f"0x{one.number:02X}: {python_string(one.name)}" for one in bus.exceptions]
    arguments: list[Node] = [
        Group("functions={", tuple(functions), "}"),
        f"units=({bus.units[0]}, {bus.units[1]})",
        f"broadcast={bus.broadcast}",
    ]
    if of_bus(bus).pad_coil_bytes == "even":
        arguments.append("pad_coil_bytes_even=True")
    if taken.broadcasts != BROADCAST:
        arguments.append(Group("broadcasts=(", tuple(f"0x{one:02X}" for one in sorted(taken.broadcasts))))
    if taken.framings != FRAMINGS:
        arguments.append(Group("framings=(", tuple(python_string(one) for one in taken.framings)))
    if exceptions:
        arguments.append(Group("exceptions={", tuple(exceptions), "}"))
    return call("Profile", arguments)


def _blocks(device: Device, scope: PackageScope) -> Node | None:
    """The planned reads of each group."""
    if not device.blocks:
        return None
    scope.used.add("Block")
    made = []
    for group, reads in device.blocks.items():
        calls = [
            call("Block", (python_string(one.space), f"0x{one.function:02X}", f"0x{one.address:04X}", str(one.count)))
            for one in reads
        ]
        made.append(Group(f"{python_string(group)}: (", tuple(calls)))
    return Group("{", tuple(made), "}")


IN_PYTHON = PythonFamily(
    module=RUNTIME,  # the names of Modbus are those of the runtime itself
    exports=frozenset({"Block", "Profile"}),
    blocking=Flavour("Device", "Transport"),
    awaiting=Flavour("AsyncDevice", "AsyncTransport"),
    settings=(),
    profile=_profile,
    blocks=_blocks,
    maker=usual_maker,
)
