"""A device as calls of the runtime's constructors, for languages whose generated code has facts and no behaviour.

Python writes the calls as text, TypeScript as JavaScript; `live` executes them. Here are calls as expressions, and what
they need of a language, which brings its names and a layout, and of a family: its facts of a device.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Self

from fieldscribe.families import family
from fieldscribe.lowered import Lowered, lower
from fieldscribe.model import Device, Entry, Flag, Point, Telegram
from fieldscribe.targets.identifiers import Names, Owner
from fieldscribe.text import humanised, pascal, upper


class Name(str):
    """A name, such as `U16` or `enums.Direction`; or a placeholder for an expression."""

    __slots__ = ()


class PointName(str):
    """A text that names a point of this device; the language gives the name."""

    __slots__ = ()


class Hex(int):
    """A number that is written in hexadecimal, with at least this many digits."""

    digits: int

    def __new__(cls, number: int, digits: int = 4) -> Self:
        """Make a number."""
        made = super().__new__(cls, number)
        made.digits = digits
        return made


@dataclass(frozen=True, slots=True)
class Call:
    """A call of a name, with its arguments by position and by keyword.

    `literals` are the texts of its type parameter, for languages that have one.
    """

    name: str
    positional: tuple[Node, ...] = ()
    keywords: Mapping[str, Node] = field(default_factory=dict)
    literals: tuple[str, ...] = ()


Leaf = str | int | float | None
Branch = Call | tuple["Node", ...] | Mapping[Any, "Node"]
Node = Leaf | Branch
"""An expression; a string that is no `Name` is a literal."""


def call(name: str, /, *positional: Node, **keywords: Node) -> Call:
    """Return a call of `name`."""
    return Call(name, positional, keywords)


def reader(flag: Flag, numbers: str | None) -> Call:
    """Return the reader of a flag in its word; `numbers` is the class of its numbers, if they have names."""
    if flag.width == 1:
        return call("Flag", flag.low) if flag.active else call("Flag", flag.low, active=0)
    return call("Field", flag.low, flag.width, *([Name(numbers)] if numbers else ()))


_MAKERS = {"r": "ReadOnly", "w": "WriteOnly", "rw": "ReadWrite"}


def usual_maker(point: Point) -> str:
    """Return the function for the attribute of a point; only its access decides."""
    return _MAKERS["".join(letter for letter in "rw" if letter in point.access)]


class NamedNumbers(NamedTuple):
    """Numbers with names: their class, its title, and the numbers."""

    name: str
    title: str
    entries: tuple[Entry, ...]


class ClassNames:
    """The final names of classes, for each enum and each word of flags; `taken` are names of other things."""

    def __init__(self, device: Device, taken: Iterable[str]) -> None:
        self._device, self._taken = device, set(taken)
        self._enums = {enum.name: self._class(pascal(enum.name), "Enum") for enum in device.enums}
        self._shared = dict(self._enums)
        self._words: dict[str, str] = {}
        self._fields: dict[tuple[str, str], str] = {}
        for point in device.points:
            if point.shape.flags and point.form == "flags" and point.generated:
                self._name_flags(point)
        self.old_classes = {
            self._class(old, kind): new for new, kind, old_names in self._renamed(device) for old in old_names
        }
        """The classes by their old names."""

    def enum_class(self, enum: str) -> str:
        """Return the class of an enum."""
        return self._enums[enum]

    def numbers_class(self, point: Point) -> str:
        """Return the class that names the numbers of a point, or each of its digits; empty if there is none."""
        enum = point.named_numbers
        return "" if enum is None else self._enums[enum.name]

    def word_class(self, point: Point) -> str:
        """Return the class of a point's flags; empty if it has none."""
        return self._words.get(point.item, "")

    def field_class(self, point: Point, flag: str) -> str | None:
        """Return the class of the named numbers of a flag of several bits; None if they have no names."""
        return self._fields.get((point.item, flag))

    @property
    def classes(self) -> set[str]:
        """All classes that name numbers."""
        return {*self._enums.values(), *self._words.values(), *self._fields.values()}

    def in_order(self) -> Iterator[NamedNumbers | Point]:
        """Yield the named numbers of enums, then points with a word of flags, each after the numbers of its flags."""
        for enum in self._device.enums:
            yield NamedNumbers(self._enums[enum.name], humanised(enum.name), enum.entries)
        known = set(self._enums.values())
        for point in (point for point in self._device.points if self.word_class(point)):
            for flag in point.flags:
                name = self.field_class(point, flag.name)
                if name is not None and name not in known:
                    known.add(name)
                    title = humanised(flag.enum) if flag.enum else flag.title["en"]
                    yield NamedNumbers(name, title, flag.values)
            yield point

    def _name_flags(self, point: Point) -> None:
        name = self._class(pascal(point.item), "Flags")
        self._words[point.item] = name
        for flag in point.flags:
            if flag.width > 1 and flag.enum:
                shared = self._shared.get(flag.enum) or self._class(pascal(flag.enum), "Field")
                self._fields[point.item, flag.name] = self._shared[flag.enum] = shared
            elif flag.width > 1 and flag.values:
                self._fields[point.item, flag.name] = self._class(f"{name}{pascal(flag.name)}", "Field")

    def _renamed(self, device: Device) -> Iterator[tuple[str, str, Iterable[str]]]:
        """Yield the classes that are named after a point with old names: each with its kind and its old names."""
        for enum in device.enums:
            yield self._enums[enum.name], "Enum", map(pascal, enum.was)
        for point in device.points:
            for flag, name in ((flag, self.field_class(point, flag.name)) for flag in point.flags if point.was):
                if name is not None and not flag.enum:
                    yield name, "Field", [f"{pascal(item)}{pascal(flag.name)}" for item in point.old_items]
            if point.was and self.word_class(point):
                yield self.word_class(point), "Flags", map(pascal, point.old_items)

    def _class(self, wanted: str, kind: str) -> str:
        while wanted in self._taken:
            wanted += kind
        self._taken.add(wanted)
        return wanted


@dataclass(frozen=True, slots=True)
class Scope:
    """A device with the names of a language and the lowered model; it collects the names that its calls use.

    `attribute` returns the name of a point, `enums` precedes a class that names numbers, `used` are names of the
    runtime, and `codes` the special codes that points share.
    """

    device: Device
    names: ClassNames
    lowered: Lowered
    attribute: Callable[[str], str]
    enums: str
    used: set[str] = field(default_factory=set)
    codes: dict[str, Node] = field(default_factory=dict)
    commands: dict[str, str] = field(default_factory=dict)
    """The attributes of the commands by name, which differ from those of the points."""

    @classmethod
    def of(cls, device: Device, names: ClassNames, attribute: Callable[[str], str], enums: str = "") -> Self:
        """Return the scope of a device in which nothing is used yet."""
        return cls(device, names, lower(device), attribute, enums, commands=command_attributes(device, attribute))

    def runtime(self, name: str) -> str:
        """Return a name of the runtime, which the module then imports."""
        self.used.add(name)
        return name


def command_attributes(device: Device, attribute: Callable[[str], str]) -> dict[str, str]:
    """Return the attributes of the commands of a device by name, which differ from those of the points."""
    points = {name for point in device.points for name in (point.item, point.name)}
    names = [command.name for command in device.all_commands]
    return {name: attribute(f"{name}_command" if name in points else name) for name in names}


def shared_identifiers(
    device: Device,
    names: ClassNames,
    spaces: tuple[str, str],
    attribute: Callable[[str], str],
    flag_attributes: Callable[[Flag], Sequence[str]],
) -> Iterator[Names]:
    """Yield the names of enums, flags, points and commands; `spaces` are the namespaces of points and of classes."""
    points, classes = spaces
    language, _, _ = points.partition(",")
    for enum in device.enums:
        owner, space = Owner("enum", enum.name), f"{language}, the enum `{enum.name}`"
        yield Names(classes, owner, (names.enum_class(enum.name),))
        for entry in enum.entries:
            yield Names(space, Owner("entry", entry.name, owner), (upper(entry.name),))
    for point in (point for point in device.points if point.generated):
        owner, word = Owner("point", point.item), names.word_class(point)
        yield Names(points, owner, (attribute(point.item),))
        if point.variant is not None:
            yield Names(points, Owner("point", point.name), (attribute(point.name),))
        for old in point.was:
            yield Names(points, Owner("old name", old, Owner("point", point.name)), (attribute(old),))
        if word:
            yield Names(classes, owner, (word,))
        for flag in point.flags if word else ():
            of_flag = Owner("flag", flag.name, owner)
            yield Names(f"{language}, the flags of `{point.item}`", of_flag, flag_attributes(flag))
            if (name := names.field_class(point, flag.name)) is not None:
                yield Names(classes, Owner("enum", flag.enum) if flag.enum else of_flag, (name,))
    for command, name in command_attributes(device, attribute).items():
        yield Names(points, Owner("command", command), (name,))


class FamilyCalls(NamedTuple):
    """The facts of a family in calls: the profile, the function that creates a point, and class variables.

    `facts` are class variables such as planned reads and bases of addresses.
    """

    profile: Callable[[Device, Scope], Node]
    maker: Callable[[Point], str] = usual_maker
    facts: Callable[[Device, Scope], Mapping[str, Node]] = lambda _device, _scope: {}


def family_calls(device: Device) -> FamilyCalls:
    """Return the part `targets.calls` of the device's family."""
    part: FamilyCalls = family(device.family).part("targets.calls").IN_CALLS
    return part


def telegrams(named_telegrams: Iterable[Telegram], scope: Scope) -> tuple[Node, ...]:
    """Return the telegrams of a device."""
    made = scope.runtime("Telegram")
    facts = ((each, () if each.message is None else (each.message,)) for each in named_telegrams)
    return tuple(call(made, each.name, each.direction, each.words, *message) for each, message in facts)
