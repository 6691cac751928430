"""Modbus in generated Python: the profile with its functions, and the planned reads."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.modbus import BROADCAST, FRAMINGS, of_bus, profile_of
from fieldscribe.targets.python.families import RUNTIME, Flavour, Line, PythonFamily, usual_maker
from fieldscribe.targets.python.layout import Group, Node, call
from fieldscribe.text import python_string

if TYPE_CHECKING:
    from fieldscribe.model import Device
    from fieldscribe.targets.python.scope import PackageScope


def _profile(device: Device, scope: PackageScope) -> Node:
    """The profile: the requests that the device accepts."""
    scope.used.add("Profile")
    bus = device.bus
    taken = profile_of(bus)
    functions = [f"0x{function:02X}: {most}" for function, most in taken.most.items()]
    exceptions = [f"0x{code.number:02X}: {python_string(code.name)}" for code in bus.exceptions]
    arguments: list[Node] = [
        Group("functions={", tuple(functions), "}"),
        f"units=({bus.units[0]}, {bus.units[1]})",
        f"broadcast={bus.broadcast}",
    ]
    if of_bus(bus).pad_coil_bytes == "even":
        arguments.append("pad_coil_bytes_even=True")
    if taken.broadcasts != BROADCAST:
        arguments.append(Group("broadcasts=(", tuple(f"0x{function:02X}" for function in sorted(taken.broadcasts))))
    if taken.framings != FRAMINGS:
        arguments.append(Group("framings=(", tuple(python_string(framing) for framing in taken.framings)))
    if exceptions:
        arguments.append(Group("exceptions={", tuple(exceptions), "}"))
    return call("Profile", arguments)


def _blocks(device: Device, scope: PackageScope) -> Node | None:
    """The planned reads of each group."""
    if not device.blocks:
        return None
    scope.used.add("Block")
    groups = []
    for group, reads in device.blocks.items():
        calls = [
            call(
                "Block",
                (python_string(block.space), f"0x{block.function:02X}", f"0x{block.address:04X}", str(block.count)),
            )
            for block in reads
        ]
        groups.append(Group(f"{python_string(group)}: (", tuple(calls)))
    return Group("{", tuple(groups), "}")


SERIAL = Line("serial", 'SerialLine("/dev/ttyUSB0", 9600)', 'AsyncSerialLine(SerialLine("/dev/ttyUSB0", 9600))')
NETWORK = Line("tcp", 'TcpLine("192.168.0.20")', 'AsyncTcpLine("192.168.0.20")')


def _line(device: Device) -> Line:
    return SERIAL if "rtu" in device.bus.framings else NETWORK


IN_PYTHON = PythonFamily(
    module=RUNTIME,  # the Modbus names come from the runtime itself
    exports=frozenset({"Block", "Profile"}),
    blocking=Flavour("Device", "Transport"),
    awaiting=Flavour("AsyncDevice", "AsyncTransport"),
    settings=(),
    profile=_profile,
    blocks=_blocks,
    maker=usual_maker,
    line=_line,
)
