"""Modbus in calls of the runtime: the profile with its functions, and the planned reads.

And what generated Python and TypeScript import for it.
"""

from collections.abc import Mapping

from fieldscribe.families.modbus import BROADCAST, FRAMINGS, SPACES, profile_of
from fieldscribe.model import Base, Block, Device
from fieldscribe.targets.python.syntax import RUNTIME, Line, PythonFamily
from fieldscribe.targets.runtime_calls import FamilyCalls, Hex, Node, Scope, call
from fieldscribe.targets.typescript.syntax import TypeScriptFamily


def _profile(device: Device, scope: Scope) -> Node:
    """Return the profile: the requests that the device accepts."""
    bus, profile = device.bus, profile_of(device.bus)
    facts: dict[str, Node] = {
        "functions": {Hex(function, 2): most for function, most in profile.most.items()},
        "units": bus.units,
        "broadcast": bus.broadcast,
    }
    if profile.pad_coil_bytes_even:
        facts["pad_coil_bytes_even"] = True
    if profile.broadcasts != BROADCAST:
        facts["broadcasts"] = tuple(Hex(number, 2) for number in sorted(profile.broadcasts))
    if profile.framings != FRAMINGS:
        facts["framings"] = profile.framings
    if bus.exceptions:
        facts["exceptions"] = {Hex(code.number, 2): code.name for code in bus.exceptions}
    return call(scope.runtime("Profile"), **facts)


def _facts(device: Device, scope: Scope) -> Mapping[str, Node]:
    """Return the planned reads, bases of addresses, given numbers, and the search of blocks."""
    facts: dict[str, Node] = {}
    planned = {group: tuple(_block(block, scope) for block in blocks) for group, blocks in device.blocks.items()}
    if any(planned.values()):
        facts["BLOCKS"] = {group: blocks for group, blocks in planned.items() if blocks}
    if device.bases:
        facts["BASES"] = {base.name: _base(base, scope) for base in device.bases}
        if device.given:
            facts["GIVEN"] = {each.name: (each.low, each.high) for each in device.given}
    if device.bases and device.found is not None:
        found = device.found
        read, end = Hex(SPACES[found.space].read, 2), Hex(found.end)
        facts["CHAIN"] = call(scope.runtime("Chain"), found.name, read, found.words, found.places, end)
    return facts


def _block(block: Block, scope: Scope) -> Node:
    base = () if block.base is None else (block.base,)
    function, address = Hex(block.function, 2), Hex(block.address)
    return call(scope.runtime("Block"), block.space, function, address, block.count, *base)


def _base(base: Base, scope: Scope) -> Node:
    maker = scope.runtime("Base")
    if base.block is None:
        return call(maker, base.offset, dict(base.terms))
    facts: dict[str, Node] = {"block": base.block}
    if not base.starts_block:
        facts.update(offset=base.offset, counts={at: factor for _, at, factor in base.counts})
    return call(maker, **facts)


IN_CALLS = FamilyCalls(profile=_profile, facts=_facts)


SERIAL = Line("serial", 'SerialLine("/dev/ttyUSB0", 9600)', 'AsyncSerialLine(SerialLine("/dev/ttyUSB0", 9600))')
NETWORK = Line("tcp", 'TcpLine("192.168.0.20")', 'AsyncTcpLine("192.168.0.20")')

IN_PYTHON = PythonFamily(
    module=RUNTIME,  # the Modbus names come from the runtime itself
    exports=frozenset({"Base", "Block", "Chain", "Profile"}),
    device="Device",
    transport="Transport",
    line=lambda device: SERIAL if "rtu" in device.bus.framings else NETWORK,
)


IN_TYPESCRIPT = TypeScriptFamily(
    device="ModbusDevice",
    makers={"Profile": "modbusProfile", "Block": "modbusBlock", "Base": "modbusBase", "Chain": "modbusChain"},
    modules={
        "ModbusDevice": "modbus",
        "modbusBlock": "modbus",
        "modbusProfile": "modbus-frames",
        "modbusBase": "bases",
        "modbusChain": "bases",
    },
)
