"""CAN in calls of the runtime: the profile with its messages and telegrams.

And what generated Python and TypeScript import for it.
"""

from fieldscribe.families.can import identifier_bits
from fieldscribe.model import Device, Field, Message, Role
from fieldscribe.targets.python.syntax import RUNTIME, Line, PythonFamily
from fieldscribe.targets.runtime_calls import FamilyCalls, Hex, Node, Scope, call, telegrams
from fieldscribe.targets.typescript.syntax import TypeScriptFamily


def _profile(device: Device, scope: Scope) -> Node:
    """Return the profile: the messages and telegrams of the device."""
    bus = device.bus
    telegram_facts = {"telegrams": telegrams(device.telegrams, scope)} if device.telegrams else {}
    return call(
        scope.runtime("Profile"),
        units=bus.units,
        identifier_bits=identifier_bits(bus),
        messages=tuple(_message(message, scope) for message in device.messages),
        **telegram_facts,
    )


def _message(message: Message, scope: Scope) -> Node:
    facts: dict[str, Node] = {"roles": tuple(_role(role, scope) for role in message.roles)}
    signals = tuple(_signal(field, scope) for field in message.fields)
    if not message.roles:
        facts.update(signals=signals, length=message.length)
    if message.bits is not None:
        facts["bits"] = message.bits
    if message.every is not None:
        facts["every"] = message.every
    if message.adds_unit:
        facts["adds_unit"] = True
    if message.answers is not None:
        facts["answers"] = message.answers
    identifier = Hex(message.identifier, 1)
    return call(scope.runtime("Message"), message.name, message.direction, identifier, **facts)


def _signal(field: Field, scope: Scope) -> Node:
    facts: dict[str, Node] = {}
    if field.low_first:
        facts["low_first"] = True
    if field.when:
        facts["when"] = field.when
    return call(scope.runtime("Signal"), field.start, field.width, **facts)


def _role(role: Role, scope: Scope) -> Node:
    if role.kind in ("unit", "multiplexer") and role.number == 0:
        return call(scope.runtime("Role"), role.kind)
    number = Hex(role.number, 2) if role.kind in ("constant", "xor") else role.number
    return call(scope.runtime("Role"), role.kind, number)


IN_CALLS = FamilyCalls(profile=_profile)


_BUS = 'can.Bus("can0", interface="socketcan")'


def _line(_: Device) -> Line:
    return Line("can", f"CanLine({_BUS})", f"AsyncCanLine({_BUS})", ("import can",))


IN_PYTHON = PythonFamily(
    module=f"{RUNTIME}.can",
    exports=frozenset({"Message", "Profile", "Role", "Signal", "Telegram"}),
    device="CanDevice",
    transport="CanTransport",
    line=_line,
)


_FRAMES = "can-frames"

IN_TYPESCRIPT = TypeScriptFamily(
    device="CanDevice",
    makers={
        "Profile": "canProfile",
        "Message": "canMessage",
        "Role": "canRole",
        "Signal": "canSignal",
        "Telegram": "telegramLayout",
    },
    modules={
        "CanDevice": "can",
        **dict.fromkeys(("canProfile", "canMessage", "canRole", "canSignal", "telegramLayout"), _FRAMES),
    },
)
