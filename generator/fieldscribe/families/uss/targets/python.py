"""USS in generated Python: the profile with its tasks and telegrams, and parameters that may be kept in EEPROM."""

from __future__ import annotations

from collections.abc import Iterable

from fieldscribe.families.uss import of_bus
from fieldscribe.model import Device, Point
from fieldscribe.targets.python.device import RUNTIME, Line, PythonFamily, telegrams, usual_maker
from fieldscribe.targets.python.identifiers import PackageScope
from fieldscribe.targets.python.layout import Group, Node, call
from fieldscribe.text import python_string

_STORED = {"ReadWrite": "Stored", "WriteOnly": "StoredWriteOnly"}


def _profile(device: Device, scope: PackageScope) -> Node:
    """Return the profile: the tasks and telegrams that the device accepts."""
    bus, (low, high) = device.bus, of_bus(device.bus).pzd
    arguments: list[Node] = [
        f"units=({bus.units[0]}, {bus.units[1]})",
        _numbers("pkw=(", of_bus(bus).pkw),
        f"pzd=({low}, {high})",
        Group("tasks={", tuple([_numbers(f"{code.number}: (", code.answers) for code in bus.functions]), "}"),
    ]
    if bus.broadcast is not None:
        arguments.append(f"broadcast={bus.broadcast}")
    if bus.exceptions:
        errors = [f"{code.number}: {python_string(code.name)}" for code in bus.exceptions]
        arguments.append(Group("errors={", tuple(errors), "}"))
    if device.telegrams:
        arguments.append(Group("telegrams=(", telegrams(device.telegrams, scope)))
    fewer = [
        _numbers(f"({python_string(variant.axis)}, {python_string(variant.value)}): (", (low, most))
        for variant, most in dict(of_bus(bus).variant_pzd).items()
        if most < high
    ]
    if fewer:
        arguments.append(Group("variant_pzd={", tuple(fewer), "}"))
    return call(scope.runtime("Profile"), arguments)


def _numbers(head: str, numbers: Iterable[int]) -> Group:
    return Group(head, tuple(map(str, numbers)))


def _maker(point: Point) -> str:
    """Return the maker of an attribute; the caller chooses RAM or EEPROM where the description does not."""
    usual = usual_maker(point)
    stored = point.telegram is None and point.keeps in (None, "choice")
    return _STORED.get(usual, usual) if stored else usual


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
    profile=_profile,
    line=_line,
    maker=_maker,
    settings=(("link", "Link"),),
)
