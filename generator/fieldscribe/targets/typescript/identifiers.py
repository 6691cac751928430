"""The final TypeScript identifiers of a device."""

from __future__ import annotations

from fieldscribe.model import Device, Flag, Special
from fieldscribe.targets.runtime_calls.scope import ClassNames, Scope
from fieldscribe.text import camel, pascal

_RESERVED = frozenset(
    {"arguments", "await", "break", "case", "catch", "class", "const", "continue", "debugger", "default", "delete"}
    | {"do", "else", "enum", "eval", "export", "extends", "false", "finally", "for", "function", "if", "implements"}
    | {"import", "in", "instanceof", "interface", "let", "new", "null", "package", "private", "protected", "public"}
    | {"return", "static", "super", "switch", "this", "throw", "true", "try", "typeof", "undefined", "var", "void"}
    | {"while", "with", "yield", "any", "boolean", "never", "number", "object", "string", "symbol", "type", "unknown"}
)
"""The reserved words, also those of types, and what a strict module must not define."""

OBJECT_MEMBERS = frozenset(
    {"constructor", "hasOwnProperty", "isPrototypeOf", "propertyIsEnumerable", "prototype", "then", "toLocaleString"}
    | {"toJSON", "toString", "valueOf"}
)
"""What objects have of themselves or are asked for, `then` where they are awaited."""

MAKERS = frozenset(
    {"bit", "bytes", "codes", "coil", "command", "digits", "discrete", "factor", "flags", "floating", "holding"}
    | {"inputRegister", "integer", "limit", "named", "parameter", "place", "readOnly", "readWrite", "rule", "scaleCase"}
    | {"scaled", "step", "stepWord", "steppedCommand", "stored", "storedWriteOnly", "telegram", "text", "time"}
    | {"wireType", "withCodes", "withWritableCodes", "writeOnly", "allCommands", "allPoints", "oldNames"}
)
"""The functions of the runtime that make points, and what the module of points has beside them."""

DEVICE_MEMBERS = frozenset(
    {"broadcast", "dropProcessData", "findBlocks", "forget", "freshFor", "identify", "line", "link", "patience"}
    | {"point", "readAt", "readMany", "repeats", "retries", "retryPause", "setBase", "table", "take", "traffic"}
    | {"unit", "variants", "writeAt"}
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


def scope_of(device: Device, names: Identifiers) -> Scope:
    """Return the scope of a device in which nothing is used yet."""
    return Scope.of(device, names, attribute)
