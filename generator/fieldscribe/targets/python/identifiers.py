"""The final Python identifiers of a device."""

import re
from collections.abc import Iterable, Sequence
from functools import cached_property

from fieldscribe.model import Device
from fieldscribe.targets.runtime_calls.scope import ClassNames, Scope
from fieldscribe.text import pascal

_RESERVED = frozenset(
    {"False", "None", "True", "and", "as", "assert", "async", "await", "break", "case", "class", "continue"}
    | {"def", "del", "elif", "else", "except", "finally", "for", "from", "global", "if", "import", "in", "is"}
    | {"lambda", "match", "nonlocal", "not", "or", "pass", "print", "raise", "return", "self", "try", "type"}
    | {"while", "with", "yield", "_"}
)
"""The reserved words, and built-in names that generated code must not hide."""

DEVICE_MEMBERS = frozenset(
    {"broadcast", "drop_process_data", "find_blocks", "forget", "identify", "layouts", "set_base", "fresh_for"}
    | {"link", "patience", "point", "read_at", "read_many", "repeats", "retries", "retry_pause", "rows", "take"}
    | {"traffic", "transport", "unit", "variants", "write_at", "write_together"}
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


class Identifiers(ClassNames):
    """The final names of one device: its package, its classes, and a class for each enum and each word of flags."""

    def __init__(self, device: Device) -> None:
        self.package = attribute(device.id) if device.id in _RESERVED else device.id
        device_name = pascal(device.id)
        self.device_class = f"{device_name}Device" if device_name in _CLASS_TAKEN else device_name
        self.async_class = f"{self.device_class}Async"
        super().__init__(device, {self.device_class, self.async_class, *_CLASS_TAKEN})
        self.old_classes = {old: self.old_classes[old] for old in sorted_imports(self.old_classes)}

    @cached_property
    def imports(self) -> Sequence[str]:
        """The classes of the enums module, sorted for an import."""
        return sorted_imports(self.classes)

    @property
    def exports(self) -> Sequence[str]:
        """All names of the package, sorted for `__all__`."""
        return sorted_exports([self.device_class, self.async_class, *self.imports])


def scope_of(device: Device, names: Identifiers) -> Scope:
    """Return the scope of a device in which nothing is used yet."""
    return Scope.of(device, names, attribute, "enums.")
