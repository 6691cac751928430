"""USS in calls of the runtime: the profile with its tasks and telegrams, and parameters that may be kept in EEPROM.

And what generated Python and TypeScript import for it.
"""

from fieldscribe.families.uss import of_bus
from fieldscribe.model import Device, Point
from fieldscribe.targets.python.syntax import RUNTIME, Line, PythonFamily
from fieldscribe.targets.runtime_calls import FamilyCalls, Node, Scope, call, telegrams, usual_maker
from fieldscribe.targets.typescript.syntax import TypeScriptFamily

_STORED = {"ReadWrite": "Stored", "WriteOnly": "StoredWriteOnly"}


def _profile(device: Device, scope: Scope) -> Node:
    """Return the profile: the tasks and telegrams that the device accepts."""
    bus, uss = device.bus, of_bus(device.bus)
    low, high = uss.pzd
    facts: dict[str, Node] = {"units": bus.units, "pkw": uss.pkw, "pzd": uss.pzd}
    facts["tasks"] = {code.number: code.answers for code in bus.functions}
    if bus.broadcast is not None:
        facts["broadcast"] = bus.broadcast
    if bus.exceptions:
        facts["errors"] = {code.number: code.name for code in bus.exceptions}
    if device.telegrams:
        facts["telegrams"] = telegrams(device.telegrams, scope)
    fewer = {
        (variant.axis, variant.value): (low, most) for variant, most in dict(uss.variant_pzd).items() if most < high
    }
    if fewer:
        facts["variant_pzd"] = fewer
    return call(scope.runtime("Profile"), **facts)


def _maker(point: Point) -> str:
    """Return the function that creates an attribute; the caller chooses RAM or EEPROM if the description does not."""
    usual = usual_maker(point)
    stored = point.telegram is None and point.keeps in (None, "choice")
    return _STORED.get(usual, usual) if stored else usual


IN_CALLS = FamilyCalls(profile=_profile, maker=_maker)


def _line(device: Device) -> Line:
    lengths, (low, high) = of_bus(device.bus).pkw, of_bus(device.bus).pzd
    pkw = lengths[0] if lengths and 4 not in lengths else 4  # a bus with errors may have none
    return Line(
        "serial",
        'UssLine("/dev/ttyUSB0", 9600)',
        'AsyncSerialLine(UssLine("/dev/ttyUSB0", 9600))',
        first=(f"from {RUNTIME}.uss import Link",),
        settings=(f"Link(pkw={pkw}, pzd={min(max(2, low), high)})",),
    )


IN_PYTHON = PythonFamily(
    module=f"{RUNTIME}.uss",
    exports=frozenset({"Profile", "Stored", "StoredWriteOnly", "Telegram"}),
    device="UssDevice",
    transport="UssTransport",
    line=_line,
    settings=(("link", "Link"),),
)


IN_TYPESCRIPT = TypeScriptFamily(
    device="UssDevice",
    makers={"Profile": "ussProfile", "Telegram": "telegramLayout"},
    modules={"UssDevice": "uss", "ussProfile": "uss-frames", "telegramLayout": "can-frames"},
    options=(("link", 'import("fieldscribe-runtime/uss-frames").UssLink'),),
)
