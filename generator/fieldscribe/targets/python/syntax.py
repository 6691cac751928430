"""Python as this target writes it: the final identifiers of a device, and expressions laid out as formatters do.

An expression is on one line if it fits, else it has a line for each item. `live` uses the same identifiers. A family
offers the target a `PythonFamily`.
"""

import re
import textwrap
from collections.abc import Callable, Iterable, Sequence
from functools import cached_property
from typing import NamedTuple

from fieldscribe.families import family
from fieldscribe.model import Device
from fieldscribe.targets.runtime_calls import Branch, Call, ClassNames, Hex, Leaf, Name, Node, Scope
from fieldscribe.text import pascal, python_doc, python_string

WIDTH = 88
"""The narrowest common line length, so that formatters with longer lines change nothing either."""
DOC = WIDTH - 4 - 6
"""The width of a docstring inside a class, less the indentation and two triple quotes."""
_LITERAL = 64
"""The longest parameter of a type: longer ones would have to be broken."""

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


# The family.


RUNTIME = "fieldscribe_runtime"
"""The package that all generated devices share."""


class Line(NamedTuple):
    """A transport of the runtime for examples: its module, and expressions that open it, for both kinds of devices."""

    module: str
    blocking: str
    awaiting: str
    first: tuple[str, ...] = ()
    """Further lines of import that the expressions need."""
    settings: tuple[str, ...] = ()
    """Further arguments of the device after the line and the unit."""

    def imports(self, wait: str) -> tuple[str, ...]:
        """Return the classes that the expression names, in order."""
        classes = [part.partition("(")[0] for part in (self.blocking, self.awaiting)]
        if not wait:
            return (classes[0],)
        return (classes[1], classes[0]) if f"({classes[0]}(" in self.awaiting else (classes[1],)


class PythonFamily(NamedTuple):
    """What generated modules import for a family.

    `module` of the runtime has the names in `exports`, the class `device` and its `transport`, and both with `Async`
    before their names. `line` returns the usual transport. `settings` are further parameters of a device's constructor
    (name, class).
    """

    module: str
    exports: frozenset[str]
    device: str
    transport: str
    line: Callable[[Device], Line]
    settings: tuple[tuple[str, str], ...] = ()


def in_python(device: Device) -> PythonFamily:
    """Return the part `targets.calls` of the device's family."""
    part: PythonFamily = family(device.family).part("targets.calls").IN_PYTHON
    return part


# Identifiers.


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


# Texts and expressions.


def comment(text: str) -> str:
    """Return text for a `#` comment, in which no second `#` can start a directive for some tool."""
    return python_doc(text).replace("#", "")


def laid_out(node: Node, indent: int, before: str = "") -> str:
    """Return the lines of the expression at that indentation, with room for a comma after it.

    `before` precedes the expression on its line, such as `allowed=`.
    """
    if node is None or isinstance(node, (str, int, float)):
        return before + leaf(node)
    line = before + flat(node)
    return line if indent + len(line) < WIDTH else _spread(node, indent, before)


def arguments(made: Call, indent: int) -> tuple[str, ...]:
    """Return the lines of each argument of a call that stands on its own line."""
    return tuple([laid_out(item, indent, before) for before, item in _items(made)])


def _spread(node: Branch, indent: int, before: str) -> str:
    """Return a line for each item.

    A tuple of a single item is spread only if the item is spread itself: formatters with longer lines would join it
    again, even with a comma after the item.
    """
    (opening, closing), items, inner = _brackets(node), _items(node), " " * (indent + 4)
    only = node[0] if isinstance(node, tuple) and len(node) == 1 else None
    if only is not None and not isinstance(only, (str, int, float)) and _items(only):
        lines = f"{inner}{_spread(only, indent + 4, '')},\n"
    else:
        lines = "".join([f"{inner}{laid_out(item, indent + 4, key)},\n" for key, item in items])
    return f"{before}{opening}\n{lines}{' ' * indent}{closing}"


def flat(node: Node) -> str:
    """Return the expression on one line."""
    if node is None or isinstance(node, (str, int, float)):
        return leaf(node)
    opening, closing = _brackets(node)
    comma = "," if isinstance(node, tuple) and len(node) == 1 else ""
    return f"{opening}{', '.join([key + flat(item) for key, item in _items(node)])}{comma}{closing}"


def _brackets(node: Branch) -> tuple[str, str]:
    if isinstance(node, Call):
        return f"{node.name}{_parameter(node.literals)}(", ")"
    return ("(", ")") if isinstance(node, tuple) else ("{", "}")


def _parameter(literals: tuple[str, ...]) -> str:
    """Return a `Literal` of these texts as the parameter of a type; empty if it does not fit on a line."""
    text = f"[Literal[{', '.join(map(python_string, literals))}]]" if literals else ""
    return text if len(text) <= _LITERAL else ""


def _items(node: Branch) -> list[tuple[str, Node]]:
    """Return the items, each with its keyword or its key."""
    if isinstance(node, tuple):
        return [("", item) for item in node]
    if isinstance(node, Call):
        keywords = [(f"{name}=", item) for name, item in node.keywords.items()]
        return [("", item) for item in node.positional] + keywords
    return [(f"{flat(key)}: ", item) for key, item in node.items()]


def leaf(node: Leaf) -> str:
    """Return a name, a string or a number as text."""
    if isinstance(node, str):
        return node if isinstance(node, Name) else python_string(node)
    if isinstance(node, Hex):
        return f"0x{node:0{node.digits}X}"
    return repr(node)


def wrapped(text: str) -> list[str]:
    """Return the lines of a docstring inside a class."""
    return [text] if len(text) <= DOC else textwrap.wrap(text, DOC, break_long_words=False, break_on_hyphens=False)


def docstring(lines: Sequence[str]) -> str:
    """Return a docstring inside a class."""
    first, *others = lines
    if not others:
        return f'    """{first}"""'
    return "\n".join([f'    """{first}', *(f"    {line}" if line else "" for line in others), '    """'])


def imported(module: str, names: Sequence[str]) -> tuple[str, ...]:
    """Return the lines of an import."""
    line = f"from {module} import {', '.join(names)}"
    return (line,) if len(line) <= WIDTH else (f"from {module} import (", *(f"    {name}," for name in names), ")")
