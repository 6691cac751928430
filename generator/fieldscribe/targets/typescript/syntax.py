"""TypeScript as this target writes it: the identifiers of a device by namespace, and calls laid out as JavaScript.

A call is on one line if it fits, else it has a line for each item. A family offers the target a `TypeScriptFamily`.
"""

import re
import textwrap
from collections.abc import Callable, Mapping
from typing import NamedTuple

from fieldscribe.families import family
from fieldscribe.model import Device, Flag, Special
from fieldscribe.targets.runtime_calls import (
    Call,
    ClassNames,
    Hex,
    Leaf,
    Name,
    Node,
    PointName,
)
from fieldscribe.text import camel, js_string, pascal

WIDTH = 120
_SAFE = 1 << 53
_PLAIN_KEY = re.compile(r"[A-Za-z_$][A-Za-z0-9_$]*")


# The family.


class TypeScriptFamily(NamedTuple):
    """What generated modules import for a family.

    `device` is the class of devices, `makers` name the functions whose names differ from those of the calls, and
    `modules` says which module of the runtime has each name beyond the codecs. `options` are further options of a
    device's constructor: name and type.
    """

    device: str
    makers: Mapping[str, str]
    modules: Mapping[str, str]
    options: tuple[tuple[str, str], ...] = ()


_MAKERS = {"Case": "scaleCase", "Type": "wireType"}
"""Other names for those that JavaScript reserves or that say too little there."""


def in_typescript(device: Device) -> TypeScriptFamily:
    """Return the part `targets.calls` of the device's family."""
    part: TypeScriptFamily = family(device.family).part("targets.calls").IN_TYPESCRIPT
    return part._replace(makers={**_MAKERS, **part.makers})


# Identifiers.


_RESERVED = frozenset(
    {"arguments", "await", "break", "case", "catch", "class", "const", "continue", "debugger", "default", "delete"}
    | {"do", "else", "enum", "eval", "export", "extends", "false", "finally", "for", "function", "if", "implements"}
    | {"import", "in", "instanceof", "interface", "let", "new", "null", "package", "private", "protected", "public"}
    | {"return", "static", "super", "switch", "this", "throw", "true", "try", "typeof", "undefined", "var", "void"}
    | {"while", "with", "yield", "any", "boolean", "never", "number", "object", "string", "symbol", "type", "unknown"}
)
"""The reserved words, also those of types, and names that a strict module must not define."""

OBJECT_MEMBERS = frozenset(
    {"constructor", "hasOwnProperty", "isPrototypeOf", "propertyIsEnumerable", "prototype", "then", "toLocaleString"}
    | {"toJSON", "toString", "valueOf"}
)
"""Properties that every object has or that the language reads, such as `then` of an awaited object."""

MAKERS = frozenset(
    {"bit", "bytes", "codes", "coil", "command", "dateParts", "dateTimeParts", "digits", "discrete", "factor"}
    | {"flags", "floating", "holding", "inputRegister", "integer", "limit", "named", "parameter", "place", "readOnly"}
    | {"readWrite", "rule", "scaleCase", "scaled", "step", "stepWord", "steppedCommand", "stored", "storedWriteOnly"}
    | {"telegram", "text", "time", "timeParts", "wireType", "withCodes", "withWritableCodes", "writeOnly"}
    | {"allCommands", "allPoints", "oldNames"}
)
"""The functions of the runtime that create points, and other names of the points module."""

DEVICE_MEMBERS = frozenset(
    {"broadcast", "dropProcessData", "findBlocks", "forget", "freshFor", "identify", "line", "link", "patience"}
    | {"point", "readAt", "readMany", "repeats", "retries", "retryPause", "setBase", "table", "take", "traffic"}
    | {"unit", "variants", "writeAt", "writeTogether"}
)
"""Public members of the runtime's devices, which no point may hide; a test compares them with the runtime."""

WORD_MEMBERS = frozenset({"raw", "kind"})
"""Public members of words of flags, which no flag may hide."""

_CLASS_TAKEN = frozenset(
    {"Array", "Bits", "Date", "DeviceCommand", "Handles", "Object", "Place", "Promise", "ReadOnly", "ReadWrite"}
    | {"Readonly", "Record", "SpecialCode", "Stored", "StoredWriteOnly", "Uint8Array", "UnknownNumber", "Word"}
    | {"WordKind", "WriteOnly", "U8", "U16", "U32", "U64", "S8", "S16", "S32", "S64", "F32", "F64"}
)
"""Names that generated modules use, so that no class may have them."""
_BESIDE_DEVICE = frozenset({"FieldscribeError", "Iterable", "Line", "Partial", "Pick", "Point", "Requested", "Values"})
"""Names that only the module with the class of the device uses, beside the class of its family."""

_POINT_TAKEN = _RESERVED | OBJECT_MEMBERS | MAKERS | DEVICE_MEMBERS
_WORD_TAKEN = OBJECT_MEMBERS | WORD_MEMBERS


def attribute(name: str) -> str:
    """Return the constant of a point, which is its attribute on a device."""
    found = camel(name)
    return f"{found}_" if found in _POINT_TAKEN else found


def word_attribute(flag: Flag) -> str:
    """Return the attribute of a flag on its word."""
    found = camel(flag.name)
    return f"{found}_" if found in _WORD_TAKEN else found


def code_attribute(special: Special) -> str:
    """Return the attribute of a special code."""
    found = camel(special.name)
    return f"{found}_" if found in OBJECT_MEMBERS else found


def option(name: str) -> str:
    """Return the constructor's option for a variant's axis or a given number."""
    found = camel(name)
    return f"{found}_" if found in OBJECT_MEMBERS | {"unit", "link", "given"} else found


class Identifiers(ClassNames):
    """The final names of one device: its package, its class, and a name for each enum and each word of flags."""

    def __init__(self, device: Device) -> None:
        self.folder = device.id
        self.package = device.id.replace("_", "-")
        name = pascal(device.id)
        taken = {*_CLASS_TAKEN, *_BESIDE_DEVICE, f"{pascal(device.family)}Device"}
        self.device_class = f"{name}Device" if name in taken else name
        self.options = f"{self.device_class}Options"
        super().__init__(device, {self.device_class, self.options, *_CLASS_TAKEN})


class Layout:
    """Lays out calls. `makers` are functions whose names differ from those of the calls; `name_of` names a point."""

    def __init__(self, makers: Mapping[str, str], name_of: Callable[[str], str]) -> None:
        self._makers, self._name_of = makers, name_of

    def maker(self, name: str) -> str:
        """Return the function or the constant of the runtime for a name in a call."""
        return self._makers.get(name) or (name if name.isupper() else camel(f"{name[0].lower()}{name[1:]}"))

    def laid_out(self, node: Node, indent: int, before: str = "") -> str:
        """Return the lines of the expression at that indentation; `before` precedes it on its line."""
        if node is None or isinstance(node, (str, int, float)):
            return before + self.leaf(node)
        line = before + self.flat(node)
        if indent + len(line) < WIDTH:
            return line
        opening, closing, items = self._parts(node)
        inner = " " * (indent + 2)
        lines = "".join([f"{inner}{self.laid_out(item, indent + 2, key)},\n" for key, item in items])
        return f"{before}{opening.rstrip()}\n{lines}{' ' * indent}{closing.lstrip()}"

    def flat(self, node: Node) -> str:
        """Return the expression on one line."""
        if node is None or isinstance(node, (str, int, float)):
            return self.leaf(node)
        opening, closing, items = self._parts(node)
        if not items:
            return opening.rstrip() + closing.lstrip()
        return f"{opening}{', '.join([key + self.flat(item) for key, item in items])}{closing}"

    def flat_keyword(self, name: str, node: Node) -> str:
        """Return a keyword of a call, as a property of its object."""
        return f"{camel(name)}: {self.flat(node)}"

    def leaf(self, node: Leaf) -> str:
        """Return a name, a string or a number as text; an integer beyond 2^53 is a bigint."""
        if isinstance(node, str):
            if isinstance(node, Name):
                return self.maker(node) if node.isidentifier() and node.isupper() else node
            return js_string(self._name_of(node) if isinstance(node, PointName) else node)
        if node is None or isinstance(node, bool):
            return "null" if node is None else str(node).lower()
        if isinstance(node, float):
            return repr(node).removesuffix(".0")
        text = f"0x{node:0{node.digits}x}" if isinstance(node, Hex) else str(int(node))
        return text if abs(node) < _SAFE else f"{text}n"

    def key(self, key: Node) -> str:
        """Return the key of a value in an object; no name begins with `_`, so none is that of the prototype."""
        if isinstance(key, str):
            text = self._name_of(key) if isinstance(key, PointName) else key
            return f"{text if _PLAIN_KEY.fullmatch(text) else js_string(text)}: "
        return f"{self.flat(key)}: "

    def _parts(self, node: Node) -> tuple[str, str, list[tuple[str, Node]]]:
        """Return brackets and items, each with its key. Keywords become one object after the other items."""
        if isinstance(node, Call):
            items: list[tuple[str, Node]] = [("", item) for item in node.positional]
            if node.keywords:
                items.append(("", {camel(name): item for name, item in node.keywords.items()}))
            return f"{self.maker(node.name)}(", ")", items
        if isinstance(node, tuple):
            return "[", "]", [("", item) for item in node]
        assert isinstance(node, Mapping)
        if any(isinstance(key, tuple) for key in node):
            return "[", "]", [("", (key, item)) for key, item in node.items()]
        return "{ ", " }", [(self.key(key), item) for key, item in node.items()]


def lazily(made: str) -> str:
    """Return an expression that bundlers drop whole if its constant is unused, including calls in arguments."""
    return f"/* @__PURE__ */ (() => {made})()"


def doc_lines(text: str) -> tuple[str, ...]:
    """Return the lines of a `/** */` comment."""
    if len(text) + 7 <= WIDTH:
        return (f"/** {text} */",)
    lines = textwrap.wrap(text, WIDTH - 3, break_long_words=False, break_on_hyphens=False)
    return ("/**", *(f" * {line}" for line in lines), " */")
