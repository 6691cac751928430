"""Opens a line, scans it for units that answer, and makes devices of the Python runtime on it.

The commands that talk to devices open a `Connection`. Its devices are like those of generated Python: their classes
are made of the same calls, evaluated here instead of written as text.
"""

import enum
from collections.abc import Iterable, Iterator, Mapping
from importlib import import_module
from types import new_class
from typing import Any, NamedTuple

import fieldscribe_runtime as runtime
from fieldscribe_runtime import (
    AnyDevice,
    FieldscribeError,
    LineError,
    NoReplyError,
    OtherDeviceError,
    RequestError,
)

from fieldscribe.arithmetic.words import mask_of
from fieldscribe.diagnostics import UnclearError
from fieldscribe.live.lines import LineAddress, OpenLine, families_of, require_line
from fieldscribe.live.readings import GOOD, Choice, Reader
from fieldscribe.model import Device, Entry, Point
from fieldscribe.targets.python.syntax import Identifiers, attribute, in_python, parameter, scope_of, word_attribute
from fieldscribe.targets.runtime_calls import Call, Hex, Name, Node, PointName, Scope, reader
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
from fieldscribe.text import shortened, upper

__all__ = ["Answer", "AnyDevice", "Connection", "FieldscribeError", "Scanner", "advice", "read_units"]

_OF_OTHERS = frozenset({"exception", "wrong_unit", "wrong_transaction"})
"""The statuses of answers that a gateway, or another unit, gave."""
_SETTINGS = {"bad_unit": "give --unit", "bad_framing": "take another kind of line"}


class Connection:
    """A line with devices. It opens when it is first used."""

    def __init__(self, line: LineAddress, timeout: float | None) -> None:
        """Raises UnclearError for a line that cannot be opened."""
        self.line = line
        self.part = families_of(line)[0].part("lines")
        try:
            transport = self.part.open_line(line, {} if timeout is None else {"timeout": timeout})
        except FieldscribeError as error:
            raise line.wrong(str(error)) from error
        except ModuleNotFoundError as error:
            raise UnclearError(f"{line.scheme}://: {error}", "pip install 'fieldscribe[live]'") from error
        self.open = OpenLine(line, transport, timeout)
        self._classes: dict[str, type[AnyDevice]] = {}

    def device(self, model: Device, unit: int, retries: int = 0) -> AnyDevice:
        """Return a runtime device on this line. Raises UnclearError if line and device do not fit."""
        require_line(self.line, model)
        if model.id not in self._classes:
            self._classes[model.id] = device_class(model)
        chosen = {parameter(axis): values[0] for axis, values in model.variants.items() if len(values) == 1}
        try:
            made: AnyDevice = self.part.device_on(self.open, self._classes[model.id], model, unit, chosen)
            made.retries = retries
        except FieldscribeError as error:
            raise UnclearError(f"{model.id}: {error}", _SETTINGS.get(error.status, "")) from error
        return made

    def close(self) -> None:
        """Close the line."""
        self.open.transport.close()


def advice(error: FieldscribeError) -> str:
    """Return a hint after an error of the line; empty if the device refused."""
    if not error.lost:
        return ""
    if error.status == "line":
        return "is the line right, is the device on, and does no other program use the port?"
    return "are the unit and the settings of the line right? `fieldscribe scan` shows who answers"


# Scanning a line.


class Answer(NamedTuple):
    """The answer of a unit, if any: `answers`, `is_other` (another device than the one looked for).

    `is_of_another`: the answer was from another unit.
    """

    unit: int
    answers: bool
    text: str = ""
    is_other: bool = False
    is_of_another: bool = False


def read_units(text: str | None, ends: tuple[int, int]) -> list[int]:
    """Return the unit numbers of a list such as `1-31,40`; all of a device without a list. Raises UnclearError."""
    units: dict[int, None] = {}
    for part in (f"{ends[0]}-{ends[1]}" if text is None else text).split(","):
        low, dash, high = part.strip().partition("-")
        numbers = [low, high if dash else low]
        if not all(number.isascii() and number.isdigit() and len(number) < 6 for number in numbers):
            raise UnclearError(f"`{shortened(part)}` is no unit", "write --units 1-31,40")
        first, last = map(int, numbers)
        if not ends[0] <= first <= last <= ends[1]:
            raise UnclearError(f"units are {ends[0]} to {ends[1]}, not `{shortened(part)}`", "write --units 1-31,40")
        units.update(dict.fromkeys(range(first, last + 1)))
    return list(units)


class Scanner:
    """Sends a harmless read to the units of a line, one after the other."""

    def __init__(self, connection: Connection, model: Device | None) -> None:
        """Raises UnclearError if the line needs a description."""
        self._connection, self._model = connection, model
        self.requests = 0
        if model is None and not hasattr(connection.part, "any_device"):
            scheme = connection.line.scheme
            raise UnclearError(f"on {scheme}:// nothing can be asked without a description", "give DEVICE")
        self.ends: tuple[int, int] = connection.part.UNITS if model is None else model.bus.units
        self._points = [] if model is None else _harmless_points(model)

    def answers(self, units: list[int]) -> Iterator[Answer]:
        """Yield the answer of each unit; a unit whose answer came late is asked once more.

        Raises FieldscribeError if the line itself fails.
        """
        silent: int | None = None
        for unit in units:
            answer = self._answer(unit)
            if answer.is_of_another and silent is not None:
                again = self._answer(silent)
                late = Answer(silent, True, "it answers late: try a longer --timeout")
                yield again._replace(answers=True) if again.answers or again.is_of_another else late
                answer = self._answer(unit)
            yield answer
            silent = None if answer.answers else unit

    def _answer(self, unit: int) -> Answer:
        line = self._connection
        device: AnyDevice = line.device(self._model, unit) if self._model else line.part.any_device(line.open, unit)
        try:
            return Answer(unit, True, self._identification(device))
        except OtherDeviceError as error:
            return Answer(unit, True, f"another device: {error}", True)
        except (LineError, RequestError):
            raise
        except NoReplyError as error:
            return Answer(unit, bool(error.received), _remark(error))
        except FieldscribeError as error:
            answers = not error.lost or error.status not in _OF_OTHERS
            return Answer(unit, answers, _remark(error), is_of_another=error.status == "wrong_unit")
        finally:
            self.requests += device.traffic.requests

    def _identification(self, device: AnyDevice) -> str:
        if self._model is None:
            return str(self._connection.part.probe(device))
        found = device.identify() if self._model.identifications else {}
        name = self._model.id if self._model.identifications else ""
        variants = [f"{axis}={value}" for axis, value in found.items()]
        readings = Reader(self._model, device).read(Choice(self._points, frozenset())) if not name else []
        for reading in readings:
            if reading.status not in GOOD:
                return f"{reading.label}: {reading.text}"
        return ", ".join([*filter(None, [name]), *variants, *(f"{one.label} = {one.text}" for one in readings)])


def _remark(error: FieldscribeError) -> str:
    """Return the text for an invalid answer."""
    if error.lost:
        return f"an answer that is damaged: {error}; two units of one number, or other settings of the line?"
    return str(error)


def _harmless_points(model: Device) -> list[str]:
    """Return the point to read from each unit: the first that needs no other, a read-only one if possible."""
    readable = [point for point in model.points if point.readable and point.generated and point.base is None]
    alone = [point for point in readable if point.telegram is None and not point.arguments and not point.variant]
    simple = [point for point in alone if not point.flags] or alone
    only_read = [point for point in simple if not point.writable]
    return [point.item for point in (only_read or simple or readable)[:1]]


# Classes of devices.


def device_class(device: Device) -> type[AnyDevice]:
    """Return the class of a device, like the generated class.

    It takes a transport and a unit (and a link, if the family has one), and by keyword the variants and the given
    numbers.
    """
    bus = in_python(device)
    base: Any = getattr(import_module(bus.module), bus.device)
    name = Identifiers(device).device_class
    made: type[AnyDevice] = type(name, (points_class(device), base), {"__init__": constructor(device, base)})
    return made


def points_class(device: Device) -> type[runtime.PointTable]:
    """Return the class of a device's points without a line, for conversions only."""
    bus, scope = in_python(device), scope_of(device, Identifiers(device))
    module: Any = import_module(bus.module)
    names = {**vars(runtime), **{name: getattr(module, name) for name in bus.exports}}
    return type("Points", (runtime.PointTable,), _members(scope, names))


def constructor(device: Device, base: Any) -> Any:
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


# Calls evaluated, and classes of numbers and words.


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
