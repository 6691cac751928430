"""USS in generated Python: the profile with its tasks and telegrams, and parameters that may be kept in EEPROM."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.uss import of_bus
from fieldscribe.targets.python.families import RUNTIME, Flavour, Line, PythonFamily, no_blocks, telegrams, usual_maker
from fieldscribe.targets.python.layout import Group, Node, call
from fieldscribe.text import python_string

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from fieldscribe.model import Device, Point, Variant
    from fieldscribe.targets.python.scope import PackageScope

_STORED = {"ReadWrite": "Stored", "WriteOnly": "StoredWriteOnly"}


def _profile(device: Device, scope: PackageScope) -> Node:
    """The profile: the tasks and telegrams that the device accepts."""
    scope.used.add("Profile")
    bus = device.bus
    arguments: list[Node] = [
        f"units=({bus.units[0]}, {bus.units[1]})",
        _numbers("pkw=(", of_bus(bus).pkw),
        f"pzd=({of_bus(bus).pzd[0]}, {of_bus(bus).pzd[1]})",
        Group("tasks={", tuple([_numbers(f"{code.number}: (", code.answers) for code in bus.functions]), "}"),
    ]
    if bus.broadcast is not None:
        arguments.append(f"broadcast={bus.broadcast}")
    if bus.exceptions:
        errors = [f"{code.number}: {python_string(code.name)}" for code in bus.exceptions]
        arguments.append(Group("errors={", tuple(errors), "}"))
    if device.telegrams:
        arguments.append(Group("telegrams=(", telegrams(device.telegrams, scope)))
    if fewer := _variant_pzd(device):
        pairs = [
            _numbers(f"({python_string(variant.axis)}, {python_string(variant.value)}): (", limits)
            for variant, limits in fewer.items()
        ]
        arguments.append(Group("variant_pzd={", tuple(pairs), "}"))
    return call("Profile", arguments)


def _variant_pzd(device: Device) -> Mapping[Variant, tuple[int, int]]:
    """The process data lengths of variants that take fewer words than the whole product."""
    low, high = of_bus(device.bus).pzd
    return {variant: (low, most) for variant, most in of_bus(device.bus).variant_pzd if most < high}


def _numbers(head: str, numbers: Iterable[int]) -> Group:
    return Group(head, tuple([str(number) for number in numbers]))


def _maker(point: Point) -> str:
    """Lets the caller choose whether a written parameter survives power-off, where the description does not."""
    usual = usual_maker(point)
    stored = point.telegram is None and point.keeps in (None, "choice")
    return _STORED.get(usual, usual) if stored else usual


def _line(device: Device) -> Line:
    own = of_bus(device.bus)
    pkw = own.pkw[0] if own.pkw and 4 not in own.pkw else 4  # a bus with errors may have none
    pzd = min(max(2, own.pzd[0]), own.pzd[1])
    return Line(
        "serial",
        'UssLine("/dev/ttyUSB0", 9600)',
        'AsyncSerialLine(UssLine("/dev/ttyUSB0", 9600))',
        first=(f"from {RUNTIME}.uss import Link",),
        settings=(f"Link(pkw={pkw}, pzd={pzd})",),
    )


IN_PYTHON = PythonFamily(
    module=f"{RUNTIME}.uss",
    exports=frozenset({"Profile", "Stored", "StoredWriteOnly", "Telegram"}),
    blocking=Flavour("UssDevice", "UssTransport"),
    awaiting=Flavour("AsyncUssDevice", "AsyncUssTransport"),
    settings=(("link", "Link"),),
    profile=_profile,
    blocks=no_blocks,
    maker=_maker,
    line=_line,
)
