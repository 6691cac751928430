"""Modbus in generated Python: the profile with its functions, and the planned reads."""

from __future__ import annotations

from fieldscribe.families.modbus import BROADCAST, FRAMINGS, SPACES, profile_of
from fieldscribe.model import Device
from fieldscribe.targets.python.device import RUNTIME, Line, PythonFamily
from fieldscribe.targets.python.identifiers import PackageScope
from fieldscribe.targets.python.layout import Group, Node, assigned, call
from fieldscribe.text import python_string


def _profile(device: Device, scope: PackageScope) -> Node:
    """Return the profile: the requests that the device accepts."""
    bus, profile = device.bus, profile_of(device.bus)
    arguments: list[Node] = [
        Group("functions={", tuple([f"0x{function:02X}: {most}" for function, most in profile.most.items()]), "}"),
        f"units=({bus.units[0]}, {bus.units[1]})",
        f"broadcast={bus.broadcast}",
    ]
    if profile.pad_coil_bytes_even:
        arguments.append("pad_coil_bytes_even=True")
    if profile.broadcasts != BROADCAST:
        arguments.append(Group("broadcasts=(", tuple([f"0x{number:02X}" for number in sorted(profile.broadcasts)])))
    if profile.framings != FRAMINGS:
        arguments.append(Group("framings=(", tuple(map(python_string, profile.framings))))
    if bus.exceptions:
        exceptions = [f"0x{code.number:02X}: {python_string(code.name)}" for code in bus.exceptions]
        arguments.append(Group("exceptions={", tuple(exceptions), "}"))
    return call(scope.runtime("Profile"), arguments)


def _blocks(device: Device, scope: PackageScope) -> Node | None:
    """Return the planned reads of each group that has some."""
    planned = {group: blocks for group, blocks in device.blocks.items() if blocks}
    if not planned:
        return None
    block_class, groups = scope.runtime("Block"), []
    for group, blocks in planned.items():
        rows = [
            (python_string(block.space), f"0x{block.function:02X}", f"0x{block.address:04X}", str(block.count))
            + (() if block.base is None else (python_string(block.base),))
            for block in blocks
        ]
        calls = [call(block_class, row) for row in rows]
        groups.append(Group(f"{python_string(group)}: (", tuple(calls)))
    return Group("{", tuple(groups), "}")


def _bases(device: Device, scope: PackageScope) -> tuple[Node, ...]:
    """Return what addresses count from, what is given for that, and how blocks are found."""
    if not device.bases:
        return ()
    bases, maker = [], scope.runtime("Base")
    for base in device.bases:
        factors = Group("{", tuple([f"{python_string(name)}: {factor}" for name, factor in base.terms]), "}")
        counts = Group("counts={", tuple([f"{at}: {factor}" for _, at, factor in base.counts]), "}")
        facts: tuple[Node, ...] = (str(base.offset), factors) if base.block is None else (f"block={base.block}",)
        facts += () if base.block is None or base.starts_block else (f"offset={base.offset}", counts)
        bases.append(call(f"{python_string(base.name)}: {maker}", facts))
    given = [f"{python_string(each.name)}: ({each.low}, {each.high})" for each in device.given]
    nodes = [assigned("BASES: ClassVar", Group("{", tuple(bases), "}"))]
    nodes += [assigned("GIVEN: ClassVar", Group("{", tuple(given), "}"))] if given else []
    found = device.found
    if found is not None:
        marker, places = (Group("(", tuple(map(str, numbers))) for numbers in (found.words, found.places))
        chain = python_string(found.name), f"0x{SPACES[found.space].read:02X}", marker, places, f"0x{found.end:04X}"
        nodes.append(assigned("CHAIN: ClassVar", call(scope.runtime("Chain"), chain)))
    return tuple(nodes)


SERIAL = Line("serial", 'SerialLine("/dev/ttyUSB0", 9600)', 'AsyncSerialLine(SerialLine("/dev/ttyUSB0", 9600))')
NETWORK = Line("tcp", 'TcpLine("192.168.0.20")', 'AsyncTcpLine("192.168.0.20")')

IN_PYTHON = PythonFamily(
    module=RUNTIME,  # the Modbus names come from the runtime itself
    exports=frozenset({"Base", "Block", "Chain", "Profile"}),
    device="Device",
    transport="Transport",
    profile=_profile,
    blocks=_blocks,
    bases=_bases,
    line=lambda device: SERIAL if "rtu" in device.bus.framings else NETWORK,
)
