"""The final Python identifiers of a device."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Self

from fieldscribe.lowered import Lowered, lower, named_numbers
from fieldscribe.model import Device, Point, Shape
from fieldscribe.targets.python.expressions import Node
from fieldscribe.text import pascal

_RESERVED = frozenset(
    {"False", "None", "True", "and", "as", "assert", "async", "await", "break", "case", "class", "continue"}
    | {"def", "del", "elif", "else", "except", "finally", "for", "from", "global", "if", "import", "in", "is"}
    | {"lambda", "match", "nonlocal", "not", "or", "pass", "print", "raise", "return", "self", "try", "type"}
    | {"while", "with", "yield", "_"}
)
"""The reserved words, and built-in names that generated code must not hide."""

DEVICE_MEMBERS = frozenset(
    {
        "broadcast",
        "drop_process_data",
        "find_blocks",
        "forget",
        "identify",
        "layouts",
        "set_base",
        "fresh_for",
        "link",
        "patience",
        "point",
    }
    | {
        "read_at",
        "read_many",
        "repeats",
        "retries",
        "retry_pause",
        "rows",
        "take",
        "traffic",
        "transport",
        "unit",
        "variants",
    }
    | {"write_at"}
)
"""Public members of the runtime's devices, which no point may hide; a test compares them with the runtime."""

HELPERS = frozenset(
    {"coil", "discrete", "enums", "get_args", "holding", "input_register", "parameter", "renamed", "telegram"}
)
"""Lower-case names that the body of the generated class uses."""

WORD_MEMBERS = frozenset(
    {"as_integer_ratio", "bit_count", "bit_length", "cls", "conjugate", "denominator", "from_bytes", "imag"}
    | {"is_integer", "mro", "name", "numerator", "of", "real", "to_bytes", "value"}
)
"""Public members of IntFlag and of words of flags, which no flag may hide."""

_CLASS_TAKEN = _RESERVED | {"Field", "Flag", "Literal", "NamedNumber", "Points", "Self", "Word"}
"""Names that no class may have, because the generated modules use them."""

_ATTRIBUTE_TAKEN = _RESERVED | DEVICE_MEMBERS | HELPERS
_WORD_TAKEN = _RESERVED | WORD_MEMBERS
_PARAMETER_TAKEN = _RESERVED | {"link", "self", "transport", "unit", "variants"}
_DIGITS = re.compile(r"([0-9]+)")


def attribute(name: str) -> str:
    """Return the attribute of a point on the device class. A description's names never end with an underscore."""
    return f"{name}_" if name in _ATTRIBUTE_TAKEN else name


def command_attributes(device: Device) -> dict[str, str]:
    """Return the attributes of the commands of a device by name, which differ from those of the points."""
    points = {name for point in device.points for name in (point.item, point.name)}
    names = [command.name for command in device.all_commands]
    return {name: attribute(f"{name}_command" if name in points else name) for name in names}


def word_attribute(name: str) -> str:
    """Return the attribute of a flag on its word's class."""
    return f"{name}_" if name in _WORD_TAKEN else name


def parameter(name: str) -> str:
    """Return the constructor's parameter for a variant's axis."""
    return f"{name}_" if name in _PARAMETER_TAKEN else name


def sorted_imports(names: Iterable[str]) -> list[str]:
    """Return names sorted as in imports: constants, classes, functions; numbers by value, without regard to case."""
    return sorted(names, key=lambda name: (_kind(name), _natural(name.lower()), _natural(name)))


def sorted_exports(names: Iterable[str]) -> list[str]:
    """Return names sorted as linters want it in `__all__`: as in imports, but capitals first."""
    return sorted(names, key=lambda name: (_kind(name), _natural(name)))


def _kind(name: str) -> int:
    return 0 if name.isupper() and len(name) > 1 else 1 if name[0].isupper() else 2


def _natural(name: str) -> list[tuple[int, int, str]]:
    return [(0, int(part), "") if part.isdigit() else (1, 0, part) for part in _DIGITS.split(name) if part]


class Identifiers:
    """The final names of one device: its package, its classes, and a class for each enum and each word of flags."""

    def __init__(self, device: Device) -> None:
        self.package = attribute(device.id) if device.id in _RESERVED else device.id
        device_name = pascal(device.id)
        self.device_class = f"{device_name}Device" if device_name in _CLASS_TAKEN else device_name
        self.async_class = f"{self.device_class}Async"
        self._taken = {self.device_class, self.async_class, *_CLASS_TAKEN}
        self._enums = {enum.name: self._class(pascal(enum.name), "Enum") for enum in device.enums}
        self._shared = dict(self._enums)
        self._words: dict[str, str] = {}
        self._fields: dict[tuple[str, str], str] = {}
        for point in device.points:
            if point.shape.flags and point.form == "flags" and point.generated:
                self._name_flags(point)
        old_classes = {
            self._class(old, kind): new for new, kind, old_names in self._renamed(device) for old in old_names
        }
        self.old_classes = {old: old_classes[old] for old in sorted_imports(old_classes)}
        """The classes by their old names, sorted for an import."""

    def enum_class(self, enum: str) -> str:
        """Return the class of an enum."""
        return self._enums[enum]

    def numbers_class(self, shape: Shape) -> str:
        """Return the class that names the numbers of a shape, or each of its digits; empty if nothing does."""
        enum = named_numbers(shape)
        return "" if enum is None else self._enums[enum.name]

    def word_class(self, point: Point) -> str:
        """Return the class of a point's flags; empty if it has none."""
        return self._words.get(point.item, "")

    def field_class(self, point: Point, flag: str) -> str | None:
        """Return the class of the named numbers of a flag of several bits; None if they have no names."""
        return self._fields.get((point.item, flag))

    @cached_property
    def imports(self) -> Sequence[str]:
        """The classes of the enums module, sorted for an import."""
        return sorted_imports({*self._enums.values(), *self._words.values(), *self._fields.values()})

    @property
    def exports(self) -> Sequence[str]:
        """All names of the package, sorted for `__all__`."""
        return sorted_exports([self.device_class, self.async_class, *self.imports])

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
class PackageScope:
    """A device with final names and the lowered model; it collects used names of the runtime, and shared codes."""

    device: Device
    names: Identifiers
    lowered: Lowered
    commands: Mapping[str, str]
    """The attributes of the commands, by name."""
    used: set[str] = field(default_factory=set)
    codes: dict[str, Node] = field(default_factory=dict)

    @classmethod
    def of(cls, device: Device, names: Identifiers) -> Self:
        """Return the scope of a device in which nothing is used yet."""
        return cls(device, names, lower(device), command_attributes(device))

    def runtime(self, name: str) -> str:
        """Return a name of the runtime, which the module then imports."""
        self.used.add(name)
        return name
