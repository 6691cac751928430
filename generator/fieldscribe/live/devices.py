"""Makes the runtime device of a description from the model, like the generated class."""

import enum
from collections.abc import Iterable, Iterator, Mapping
from importlib import import_module
from types import new_class
from typing import Any, Literal, overload

import fieldscribe_runtime as runtime
from fieldscribe_runtime import AnyAsyncDevice, AnyDevice

from fieldscribe.arithmetic.words import mask_of
from fieldscribe.model import Device, Entry, Point
from fieldscribe.targets.python.device import in_python
from fieldscribe.targets.python.enums import reader
from fieldscribe.targets.python.identifiers import Identifiers, attribute, parameter, scope_of, word_attribute
from fieldscribe.targets.runtime_calls.calls import (
    attribute_of,
    call_of,
    class_facts,
    commands_of,
    fields_of,
    members,
    old_attributes,
    old_names_of,
    readable_groups,
    variants_call,
)
from fieldscribe.targets.runtime_calls.scope import Call, Hex, Name, Node, PointName, Scope
from fieldscribe.text import upper


def evaluated(node: Node, names: Mapping[str, Any]) -> Any:
    """Return the object of an expression; `names` are the classes, functions and constants that it may use."""
    if isinstance(node, Call):
        keywords = {name: evaluated(item, names) for name, item in node.keywords.items()}
        return names[node.name](*[evaluated(item, names) for item in node.positional], **keywords)
    if isinstance(node, Name):
        return names[node]
    if isinstance(node, tuple):
        return tuple([evaluated(item, names) for item in node])
    if isinstance(node, Mapping):
        return {evaluated(key, names): evaluated(item, names) for key, item in node.items()}
    if isinstance(node, PointName):
        return str(node)
    return int(node) if isinstance(node, Hex) else node


def classes_of(scope: Scope, runtime: Mapping[str, Any]) -> dict[str, Any]:
    """Return the classes of a device by name, made of names of the runtime."""
    classes: dict[str, Any] = {}
    for named in scope.device.enums:
        name = scope.names.enum_class(named.name)
        classes[name] = _numbers(name, named.entries, runtime)
    for point in scope.device.points:
        if name := scope.names.word_class(point):
            classes[name] = _word(name, point, _readers(point, scope, classes, runtime), runtime)
    return classes


def _numbers(name: str, entries: Iterable[Entry], runtime: Mapping[str, Any]) -> Any:
    return runtime["NamedNumber"](name, {upper(entry.name): entry.raw for entry in entries})


def _readers(point: Point, scope: Scope, classes: dict[str, Any], runtime: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return the flags of a word by attribute; adds the classes of their numbers to the others."""
    readers = {}
    for flag in point.flags:
        named = scope.names.field_class(point, flag.name) or ""
        if named and named not in classes:
            classes[named] = _numbers(named, flag.values, runtime)
        readers[word_attribute(flag.name)] = evaluated(reader(flag, named), {**runtime, **classes})
    return readers


def _word(name: str, point: Point, readers: Mapping[str, Any], runtime: Mapping[str, Any]) -> Any:
    base = type(f"_{name}Flags", (runtime["Word"],), dict(readers))
    bits = {upper(flag.name): mask_of(flag.width, flag.low) for flag in point.flags}
    members = {**bits, "of": _composer(point, readers)} if point.writable else bits
    return new_class(name, (base, enum.IntFlag), {"boundary": enum.KEEP}, lambda body: body.update(members))


def _composer(point: Point, readers: Mapping[str, Any]) -> Any:
    """Return the method `of`; flags with constant bits are not among its parameters."""
    mask, bits = (point.fixed.mask, point.fixed.bits) if point.fixed else (0, 0)
    free = [word_attribute(flag.name) for flag in point.flags if mask_of(flag.width, flag.low) & ~mask]

    def of(cls: Any, /, **flags: int) -> Any:
        """Return the word in which exactly the passed flags are true, active-low bits included."""
        if unknown := flags.keys() - set(free):
            raise TypeError(f"{cls.__name__}.of() takes {', '.join(free)}, not {', '.join(sorted(unknown))}")
        return cls(cls._joined(*(readers[name].place(flags.get(name, 0)) for name in free), bits))

    return classmethod(of)


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
    """Return the class of a device, like the generated class; `awaiting` makes the async one.

    It takes a transport and a unit (and a link, if the family has one), and by keyword the variants and the given
    numbers. `points` is the class of its points, if that exists already.
    """
    bus, names = in_python(device), Identifiers(device)
    base: Any = getattr(import_module(bus.module), f"Async{bus.device}" if awaiting else bus.device)
    name = names.async_class if awaiting else names.device_class
    table = points_class(device) if points is None else points
    made: type[AnyDevice] = type(name, (table, base), {"__init__": _constructor(device, base)})
    return made


def points_class(device: Device) -> type[runtime.PointTable]:
    """Return the class of a device's points without a line, for conversions only."""
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
