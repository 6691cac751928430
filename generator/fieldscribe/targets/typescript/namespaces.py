"""All identifiers of a generated package by namespace."""

from __future__ import annotations

from collections.abc import Iterator

from fieldscribe.model import Device, Point
from fieldscribe.targets.identifiers import Names, Owner
from fieldscribe.targets.runtime_calls.scope import command_attributes
from fieldscribe.targets.typescript.identifiers import (
    Identifiers,
    attribute,
    code_attribute,
    option,
    word_attribute,
)
from fieldscribe.text import upper

_POINTS = "TypeScript, the points"
_CLASSES = "TypeScript, the names of numbers and flags"


NODE_MODULES = frozenset(
    {"assert", "buffer", "child_process", "cluster", "console", "constants", "crypto", "dgram", "dns", "domain"}
    | {"events", "fs", "http", "http2", "https", "inspector", "module", "net", "os", "path", "perf_hooks", "process"}
    | {"punycode", "querystring", "readline", "repl", "stream", "string_decoder", "sys", "timers", "tls"}
    | {"trace_events", "tty", "url", "util", "v8", "vm", "wasi", "worker_threads", "zlib"}
)
"""The modules of Node that programs import by a plain name."""

_PACKAGES = frozenset({"fieldscribe_runtime", "modbus_serial", "node_modules", "serialport"})
"""What lies beside the package: the runtime, its optional peers, and the folder of npm itself."""


def device_name_taken(name: str) -> str:
    """Return why no package may have that name; empty if it may."""
    if name in NODE_MODULES:
        return "is a module of Node's own, which a program would get instead of the package"
    return "is a package of npm that the generated one needs beside it" if name in _PACKAGES else ""


def identifiers(device: Device) -> Iterator[Names]:
    """Yield every name that depends on the description, and the fixed names beside them."""
    names = Identifiers(device)
    yield Names(_CLASSES, Owner("device", device.id), (names.device_class, names.options))
    for axis in device.variants:
        yield Names("TypeScript, the options", Owner("variant", axis), (option(axis),))
    for enum in device.enums:
        owner, space = Owner("enum", enum.name), f"TypeScript, the enum `{enum.name}`"
        yield Names(_CLASSES, owner, (names.enum_class(enum.name),))
        for entry in enum.entries:
            yield Names(space, Owner("entry", entry.name, owner), (upper(entry.name),))
    for point in device.points:
        if point.generated:
            yield from _of_point(point, names)
    for command, name in command_attributes(device, attribute).items():
        yield Names(_POINTS, Owner("command", command), (name,))


def _of_point(point: Point, names: Identifiers) -> Iterator[Names]:
    owner, word = Owner("point", point.item), names.word_class(point)
    yield Names(_POINTS, owner, (attribute(point.item),))
    if point.variant is not None:
        yield Names(_POINTS, Owner("point", point.name), (attribute(point.name),))
    for old in point.was:
        yield Names(_POINTS, Owner("old name", old, Owner("point", point.name)), (attribute(old),))
    for special in point.specials:
        space = f"TypeScript, the special codes of `{point.item}`"
        yield Names(space, Owner("code", special.name, owner), (code_attribute(special),))
    if word:
        yield Names(_CLASSES, owner, (word,))
    for flag in point.flags if word else ():
        flag_owner = Owner("flag", flag.name, owner)
        yield Names(f"TypeScript, the flags of `{point.item}`", flag_owner, (word_attribute(flag),))
        if (name := names.field_class(point, flag.name)) is not None:
            yield Names(_CLASSES, Owner("enum", flag.enum) if flag.enum else flag_owner, (name,))
