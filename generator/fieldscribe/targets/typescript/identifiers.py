"""The final TypeScript identifiers of a device, by namespace, and what a family offers the target."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from fieldscribe.families import family
from fieldscribe.model import Device, Flag, Special
from fieldscribe.targets.identifiers import Names, Owner
from fieldscribe.targets.runtime_calls.scope import ClassNames, Scope, shared_identifiers
from fieldscribe.text import camel, pascal


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


def scope_of(device: Device, names: Identifiers) -> Scope:
    """Return the scope of a device in which nothing is used yet."""
    return Scope.of(device, names, attribute)


_SPACES = "TypeScript, the points", "TypeScript, the names of numbers and flags"


NODE_MODULES = frozenset(
    {"assert", "buffer", "child_process", "cluster", "console", "constants", "crypto", "dgram", "dns", "domain"}
    | {"events", "fs", "http", "http2", "https", "inspector", "module", "net", "os", "path", "perf_hooks", "process"}
    | {"punycode", "querystring", "readline", "repl", "stream", "string_decoder", "sys", "timers", "tls"}
    | {"trace_events", "tty", "url", "util", "v8", "vm", "wasi", "worker_threads", "zlib"}
)
"""The modules of Node that programs import by a plain name."""

_PACKAGES = frozenset({"fieldscribe_runtime", "modbus_serial", "node_modules", "serialport"})
"""Packages beside that of a device: the runtime, its optional peers, and the folder of npm itself."""


def device_name_taken(name: str) -> str:
    """Return why no package may have that name; empty if it may."""
    if name in NODE_MODULES:
        return "is a module of Node's own, which a program would get instead of the package"
    return "is a package of npm that the generated one needs beside it" if name in _PACKAGES else ""


def identifiers(device: Device) -> Iterator[Names]:
    """Yield every name that depends on the description, and the fixed names in the same namespaces."""
    names = Identifiers(device)
    yield Names(_SPACES[1], Owner("device", device.id), (names.device_class, names.options))
    for axis in device.variants:
        yield Names("TypeScript, the options", Owner("variant", axis), (option(axis),))
    yield from shared_identifiers(device, names, _SPACES, attribute, lambda flag: (word_attribute(flag),))
    for point in device.points:
        space, owner = f"TypeScript, the special codes of `{point.item}`", Owner("point", point.item)
        for special in point.specials if point.generated else ():
            yield Names(space, Owner("code", special.name, owner), (code_attribute(special),))
