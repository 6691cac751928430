"""The device of the Python runtime for a description, made from the model as the generated class is."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from typing import TYPE_CHECKING, Any, Literal, overload

from fieldscribe.live.evaluation import evaluated
from fieldscribe.live.numbers import classes_of
from fieldscribe.model import Device, Point
from fieldscribe.resources import use_python_runtime
from fieldscribe.targets.python.device import in_python
from fieldscribe.targets.python.identifiers import Identifiers, attribute, parameter, scope_of
from fieldscribe.targets.runtime_calls.class_facts import class_facts, commands_of, members, readable_groups
from fieldscribe.targets.runtime_calls.expressions import Call
from fieldscribe.targets.runtime_calls.point_call import (
    attribute_of,
    call_of,
    fields_of,
    old_attributes,
    old_names_of,
    variants_call,
)
from fieldscribe.targets.runtime_calls.scope import Scope

use_python_runtime()

import fieldscribe_runtime as runtime  # noqa: E402 - it is found from here on

if TYPE_CHECKING:
    from fieldscribe_runtime import AnyAsyncDevice, AnyDevice


@overload
def device_class(
    device: Device, *, awaiting: Literal[False] = False, points: type[runtime.PointTable] | None = None
) -> type[AnyDevice]: ...
@overload
def device_class(
    device: Device, *, awaiting: Literal[True], points: type[runtime.PointTable] | None = None
) -> type[AnyAsyncDevice]: ...
def device_class(
    device: Device, *, awaiting: bool = False, points: type[runtime.PointTable] | None = None
) -> type[AnyDevice | AnyAsyncDevice]:
    """Return the class of a device, with all that the generated class has; `awaiting` is the one with `await`.

    It is made with a transport and a unit (and a link, where the family has one), and by keyword with the variants and
    the numbers that are given. `points` is the class of its points, where that is made already.
    """
    bus, names = in_python(device), Identifiers(device)
    base: Any = getattr(import_module(bus.module), f"Async{bus.device}" if awaiting else bus.device)
    name = names.async_class if awaiting else names.device_class
    table = points_class(device) if points is None else points
    made: type[AnyDevice] = type(name, (table, base), {"__init__": _constructor(device, base)})
    return made


def points_class(device: Device) -> type[runtime.PointTable]:
    """Return the class of a device's points, without a line: pure codecs."""
    use_python_runtime()
    bus, scope = in_python(device), scope_of(device, Identifiers(device))
    module: Any = import_module(bus.module)
    names = {**vars(runtime), **{name: getattr(module, name) for name in bus.exports}}
    return type("Points", (runtime.PointTable,), _members(scope, names))


def _constructor(device: Device, base: Any) -> Any:
    """Return the constructor, which takes variants and given numbers by keyword."""
    axes = {axis: parameter(axis) for axis in device.variants}
    given = {each.name: parameter(each.name) for each in device.given} if device.bases else {}

    def construct(made: Any, transport: object, unit: int, *settings: object, **chosen: Any) -> None:
        """Make the device on a transport."""
        variants = {axis: chosen.pop(name, None) for axis, name in axes.items()}
        numbers = {number: chosen.pop(name, None) for number, name in given.items()}
        base.__init__(made, transport, unit, *settings, variants=variants, **chosen)
        if given:
            made._give(numbers)

    return construct


def _members(scope: Scope, names: dict[str, Any]) -> dict[str, Any]:
    """Return the members of the class; `names` are those of the runtime."""
    names.update({f"enums.{name}": made for name, made in classes_of(scope, names).items()})
    found: dict[str, Any] = {name: evaluated(node, names) for name, node in class_facts(scope).items()}
    found["GROUPS"] = readable_groups(scope.device)
    for name, call, old_names in _points(scope):
        names.update({code: evaluated(node, names) for code, node in scope.codes.items() if code not in names})
        found[name] = evaluated(call, {**names, **found} if call.name == "ByVariant" else names)
        found.update({old: runtime.renamed(found[name], name) for old in old_names})
    return found | {scope.commands[command.name]: evaluated(call, names) for command, call in commands_of(scope)}


def _points(scope: Scope) -> Iterator[tuple[str, Call, tuple[str, ...]]]:
    """Yield the attributes of points: the name, the call that makes it, and its old names."""
    for group in members(scope.device).values():
        for member in group:
            if isinstance(member, Point):
                yield (
                    attribute_of(member, scope),
                    call_of(member, fields_of(member, scope), scope),
                    old_attributes(member, scope),
                )
            else:
                name = attribute(next(iter(member.values())).name)
                yield name, variants_call(member, scope), old_names_of(member)
