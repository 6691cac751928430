"""The TypeScript target: a package of ES modules with types per device, their names, and the runtime that all share."""

from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from operator import eq

from fieldscribe import __version__
from fieldscribe.code_view import DeviceCache
from fieldscribe.model import Device
from fieldscribe.resources import Render, runtime_files
from fieldscribe.targets.identifiers import Names, Owner, head_lines
from fieldscribe.targets.runtime_calls import shared_identifiers
from fieldscribe.targets.typescript.syntax import Identifiers, attribute, code_attribute, option, word_attribute
from fieldscribe.text import js_comment, line
from fieldscribe.wording import open_texts

FAMILY_PART = "targets.calls"
WEIGHT = 0.7

_RUNTIME = "fieldscribe-runtime"
_SPACES = "TypeScript, the points", "TypeScript, the names of numbers and flags"
_PACKAGES = frozenset({"fieldscribe_runtime", "modbus_serial", "node_modules", "serialport"})
"""Packages beside that of a device: the runtime, its optional peers, and the folder of npm itself."""
NODE_MODULES = frozenset(
    {"assert", "buffer", "child_process", "cluster", "console", "constants", "crypto", "dgram", "dns", "domain"}
    | {"events", "fs", "http", "http2", "https", "inspector", "module", "net", "os", "path", "perf_hooks", "process"}
    | {"punycode", "querystring", "readline", "repl", "stream", "string_decoder", "sys", "timers", "tls"}
    | {"trace_events", "tty", "url", "util", "v8", "vm", "wasi", "worker_threads", "zlib"}
)
"""The modules of Node that programs import by a plain name."""


def outputs(device: Device, render: Render, *, tests: bool = True) -> Iterable[tuple[str, str]]:
    """Yield the files of the device's package, as paths below the output folder and their text."""
    import json  # `check` starts without it

    del tests  # they are not generated
    names = Identifiers(device)
    folder = f"typescript/{names.folder}"
    yield f"{folder}/package.json", json.dumps(_package(device, names), indent=2, ensure_ascii=True) + "\n"
    views = _last.of(device, _views)
    for name, text in chain(_rendered(views, "js", render), _rendered(_typed(views, device, names), "d.ts", render)):
        yield f"{folder}/{name}", text


def scripts(device: Device, render: Render) -> Iterable[tuple[str, str]]:
    """Yield the modules of the device's package by their names, without their types."""
    return _rendered(_last.of(device, _views), "js", render)


Views = Mapping[str, dict[str, object]]
"""The context of each module by its name."""


_last: DeviceCache[Views] = DeviceCache(eq)
"""Shared by a package and a page, which have the same scripts."""


def _views(device: Device) -> Views:
    from fieldscribe.targets.typescript.views import device_context, enums_context, points_context

    names = Identifiers(device)
    head = {
        "head": head_lines(device, "typescript", js_comment),
        "product": js_comment(f"{device.vendor} {device.model}"),
    }
    device_view = {**device_context(device, names), "doubts": open_texts(device.doubts, js_comment)}
    views = {"enums": enums_context(names), "points": points_context(device, names), "index": device_view}
    return {name: {**head, "view": view} for name, view in views.items()}


def _typed(views: Views, device: Device, names: Identifiers) -> Views:
    """Return the contexts of the types; that of points is larger than the context of their code."""
    from fieldscribe.targets.typescript.views import types_context

    return {**views, "points": {**views["points"], "view": types_context(device, names)}}


def _rendered(views: Views, kind: str, render: Render) -> Iterable[tuple[str, str]]:
    for name, context in views.items():
        yield f"{name}.{kind}", render(f"typescript/{name}.{kind}.j2", context)


def runtime(device: Device, *, tests: bool = True) -> Iterable[tuple[str, str]]:
    """Yield the files copied beside the package: output path, and path under the templates folder.

    It is the same for all families: devices of several share one copy.
    """
    del device, tests  # its tests are not generated
    for name in runtime_files(f"typescript/runtime/{_RUNTIME}"):
        yield f"typescript/{_RUNTIME}/{name}", f"typescript/runtime/{_RUNTIME}/{name}"


def _package(device: Device, names: Identifiers) -> dict[str, object]:
    modules = {".": "index", "./points": "points", "./enums": "enums"}
    return {
        "name": names.package,
        "version": device.version + (f"+{device.digest[:8]}" if device.command else ""),
        "description": line(f"{device.vendor} {device.model}"),
        "license": "0BSD",
        "type": "module",
        "sideEffects": False,
        "exports": {key: {"types": f"./{name}.d.ts", "default": f"./{name}.js"} for key, name in modules.items()},
        "files": ["*.js", "*.d.ts"],
        "peerDependencies": {_RUNTIME: __version__},
    }


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


# Expressions and comments.
