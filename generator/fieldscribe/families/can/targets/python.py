"""CAN in generated Python: the profile with its messages and telegrams."""

from __future__ import annotations

from fieldscribe.families.can import identifier_bits
from fieldscribe.model import Device, Field, Message, Role
from fieldscribe.targets.python.device import RUNTIME, Line, PythonFamily, telegrams
from fieldscribe.targets.python.identifiers import PackageScope
from fieldscribe.targets.python.layout import Group, Node, call
from fieldscribe.text import python_string


def _profile(device: Device, scope: PackageScope) -> Node:
    """Return the profile: the messages and telegrams of the device."""
    bus = device.bus
    arguments: list[Node] = [
        f"units=({bus.units[0]}, {bus.units[1]})",
        f"identifier_bits={identifier_bits(bus)}",
        Group("messages=(", tuple([_message(message, scope) for message in device.messages])),
    ]
    if device.telegrams:
        arguments.append(Group("telegrams=(", telegrams(device.telegrams, scope)))
    return call(scope.runtime("Profile"), arguments)


def _message(message: Message, scope: PackageScope) -> Node:
    roles = [_role(role, scope) for role in message.roles]
    signals = [_signal(field, scope) for field in message.fields]
    arguments: list[Node] = [
        python_string(message.name),
        python_string(message.direction),
        f"0x{message.identifier:X}",
        Group("roles=(", tuple(roles)),
    ]
    if not message.roles:
        arguments += [Group("signals=(", tuple(signals)), f"length={message.length}"]
    arguments += [
        f"{name}={number}" for name, number in (("bits", message.bits), ("every", message.every)) if number is not None
    ]
    if message.adds_unit:
        arguments.append("adds_unit=True")
    if message.answers is not None:
        arguments.append(f"answers={python_string(message.answers)}")
    return call(scope.runtime("Message"), arguments)


def _signal(field: Field, scope: PackageScope) -> Node:
    when = [f"({number}, ({', '.join(map(str, raws))}{',' * (len(raws) == 1)}))" for number, raws in field.when]
    arguments: list[Node] = [str(field.start), str(field.width)]
    arguments += ["low_first=True"] if field.low_first else []
    arguments += [Group("when=(", tuple(when))] if when else []
    return call(scope.runtime("Signal"), arguments)


def _role(role: Role, scope: PackageScope) -> Node:
    if role.kind in ("unit", "multiplexer") and role.number == 0:
        return call(scope.runtime("Role"), (python_string(role.kind),))
    number = f"0x{role.number:02X}" if role.kind in ("constant", "xor") else str(role.number)
    return call(scope.runtime("Role"), (python_string(role.kind), number))


_BUS = 'can.Bus("can0", interface="socketcan")'


def _line(_: Device) -> Line:
    return Line("can", f"CanLine({_BUS})", f"AsyncCanLine({_BUS})", ("import can",))


IN_PYTHON = PythonFamily(
    module=f"{RUNTIME}.can",
    exports=frozenset({"Message", "Profile", "Role", "Signal", "Telegram"}),
    device="CanDevice",
    transport="CanTransport",
    profile=_profile,
    line=_line,
)
