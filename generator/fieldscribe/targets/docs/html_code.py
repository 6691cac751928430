"""The generated TypeScript of a device as one classic script: a page from a file system may run no modules.

All modules of the runtime share one scope, because their names differ. Those of the device have a scope inside it,
because points may have names of the runtime. Nothing runs before the page calls the code.
"""

import re
from collections.abc import Callable
from functools import cache
from posixpath import dirname, join, normpath

from fieldscribe.code_view import for_code
from fieldscribe.model import Device
from fieldscribe.resources import Render, templates_dir
from fieldscribe.targets import knows
from fieldscribe.targets.typescript import scripts
from fieldscribe.targets.typescript.identifiers import Identifiers
from fieldscribe.targets.vectors import text_of

_RUNTIME = "typescript/runtime"
_RUNNER = "fieldscribe-conformance/vectors"
_DATES = "fieldscribe-runtime/dates.js"
_MOST_TESTED = 1000
"""With more points a page carries no vectors."""
_IMPORT = re.compile(r'^(?:import|export \*)[^;]*?from "([^"]+)";\n', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:async )?(?:const|function|class) (\w+))", re.MULTILINE)
_LEFT_OUT = re.compile(
    r"^[ \t]*/\*\*(?:(?!\*/).)*\*/\n|^[ \t]*//[^\n]*\n|^export \{\};\n|/\* @__PURE__ \*/ ", re.MULTILINE | re.DOTALL
)
"""Matches comments, and the statement that marks a file without exports as a module."""
_SCRIPT = """"use strict";
globalThis.openCode = () => {{
{runtime}const generatedDevice = (() => {{
{device}return {kind};
}})();
return {{ Device: generatedDevice, {names} }};
}};
"""


def code_and_vectors(device: Device, render: Render) -> tuple[str, str]:
    """Return the script with the code of a device, and the vectors that the page runs.

    Both are empty for a family without TypeScript; the vectors also for a device with very many points.
    """
    if not knows("typescript", device):
        return "", ""
    plain = for_code(device)
    texts = dict(scripts(plain, render))
    tested = text_of(plain) if len(plain.points) <= _MOST_TESTED else ""
    imported = {found for text in texts.values() for found in _IMPORT.findall(text)} | ({_RUNNER} if tested else set())
    dated = any(point.text is not None and point.text.parts for point in plain.points)
    runtime, names = _runtime(tuple(sorted(imported)), left_out="" if dated else _DATES)
    script = _SCRIPT.format(
        runtime=runtime,
        device=_EXPORT.sub("", _joined("index.js", texts.__getitem__, set())),
        kind=Identifiers(plain).device_class,
        names=names,
    )
    return _safe(script), tested.replace("<", "%3c")


@cache
def _runtime(imported: tuple[str, ...], left_out: str) -> tuple[str, str]:
    """Return the modules of the runtime that a device imports, but for the one left out, and their names."""
    root, seen = templates_dir() / _RUNTIME, {left_out}

    def text(path: str) -> str:
        return (root / path).read_text("utf-8")

    packages = [_located("", name) for name in imported if not name.startswith(".")]
    joined = "".join(_joined(path, text, seen) for path in packages)
    return _EXPORT.sub("", joined), ", ".join(dict.fromkeys(_EXPORT.findall(joined)))


def _joined(path: str, text_of: Callable[[str], str], seen: set[str]) -> str:
    """Return a module after those that it imports, without imports, exports and comments."""
    if path in seen:
        return ""
    seen.add(path)
    text = text_of(path)
    before = (_located(path, name) for name in _IMPORT.findall(text) if name.startswith(".") or "/" in path)
    return "".join(_joined(each, text_of, seen) for each in before) + _LEFT_OUT.sub("", _IMPORT.sub("", text))


def _located(path: str, imported: str) -> str:
    """Return the path of a module that another one imports."""
    if imported.startswith("."):
        return normpath(join(dirname(path), imported))
    package, _, part = imported.partition("/")
    return f"{package}/{part or 'index'}.js"


def _safe(script: str) -> str:
    """Return a script that neither ends nor hides its element, with the same texts."""
    return script.replace("</", "<\\/").replace("<!--", "<\\!--")
