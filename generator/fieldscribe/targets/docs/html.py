"""The HTML page of a device: its data as one structure, its code as one script, and all files of the page in one.

Tables are plain texts, in which marks say what is code, a link, or the end of a cell: private characters, which `line`
removes from every text of a description. The page makes elements and text nodes of the text between them, so that no
text can become markup.

The generated TypeScript is one classic script, because a page from a file system may run no modules. All modules of the
runtime share one scope, because their names differ. Those of the device have a scope inside it, because points may have
names of the runtime. Nothing runs before the page calls the code.
"""

import json
import re
from base64 import b64encode
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from hashlib import sha256
from posixpath import dirname, join, normpath

from fieldscribe.code_view import for_code
from fieldscribe.families import family
from fieldscribe.model import Device, Erratum, Frame, Message
from fieldscribe.resources import Render, templates_dir
from fieldscribe.targets import knows
from fieldscribe.targets.docs import device_tables
from fieldscribe.targets.docs.cells import DocsScope, Form
from fieldscribe.targets.docs.device_tables import bus_view, identifier_text, role_text
from fieldscribe.targets.docs.html_points import Points
from fieldscribe.targets.docs.tables import items_of
from fieldscribe.targets.identifiers import head_lines
from fieldscribe.targets.python.syntax import Identifiers
from fieldscribe.targets.typescript import scripts
from fieldscribe.targets.typescript.syntax import Identifiers as TypeScriptIdentifiers
from fieldscribe.targets.vectors import text_of
from fieldscribe.text import html_code, line
from fieldscribe.wording.numbers import misprint_text, spaced

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
        kind=TypeScriptIdentifiers(plain).device_class,
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


_START, _MIDDLE, _END, _CELL, _ROW = "\ue000", "\ue001", "\ue002", "\ue003", "\ue004"
_TARGET = "="
"""Begins the kind of a target of links."""


def _marked(kind: str, text: str) -> str:
    return f"{_START}{kind}{_MIDDLE}{line(text)}{_END}"


def _code(text: str) -> str:
    return _marked("", text)


def _target(kind: str, name: str) -> str:
    return _marked(_TARGET + kind, name)


def _lay_out(rows: Sequence[Sequence[str]]) -> str:
    return _ROW.join(_CELL.join(row) for row in rows)


MARKED = Form(line, line, _code, _marked, _marked, _target, _target, "\n", _lay_out)


_SCRIPTS = ("shared.js", "search.js", "drawings.js", "snippets.js", "exchange.js", "calculator.js", "point.js")
_DECODER = ("pasted.js", "meanings.js", "decoding.js", "decoding_{}.js", "decoder.js", "conformance.js")
"""Scripts of devices with generated code; frames are decoded by their family."""
_STYLES = ("shared.css", "page.css")

Section = tuple[str, list[tuple[str, str]]]
"""A section of the page: its title, and its texts or tables with their headings."""


def html_of(scope: DocsScope, render: Render, index: str) -> str:
    """Return the page of a device, with a link to `index`."""
    made, command, licence = head_lines(scope.device, "docs", line)
    code, vectors = code_and_vectors(scope.device, render)
    decoder = [name.format(scope.device.family) for name in _DECODER] if code else []
    style, script = source(_STYLES), source((*_SCRIPTS, *decoder, "page.js"))
    digests = " ".join(f"'{_digest(text)}'" for text in filter(None, (code, script)))
    context = {
        "head": [_comment(text) for text in (made, command, licence)],
        "title": html_code(f"{line(scope.device.vendor)} {line(scope.device.model)}"),
        "style": style,
        "script": script,
        "code": code,
        "vectors": vectors,
        "policy": f"default-src 'none'; style-src '{_digest(style)}'; script-src {digests}; "
        "base-uri 'none'; form-action 'none'",
        "data": _json(({"index": index} if index else {}) | page_data(scope, made)),
    }
    return render("docs/page/device.html.j2", context)


def page_data(scope: DocsScope, made: str) -> dict[str, object]:
    """Return all that the page shows of a device."""
    device = scope.device
    languages = _languages(device)
    points = Points(scope, languages)
    return {
        "id": device.id,
        "name": line(f"{device.vendor} {device.model}"),
        "title": points.titles(device.title),
        "note": points.titles(device.note),
        "version": line(device.version),
        "made": made,
        "family": device.family,
        "framings": list(device.bus.framings),
        "languages": languages,
        "variants": {line(axis): list(map(line, values)) for axis, values in device.variants.items()},
        "documents": [line(document.title) for document in device.documents],
        "groups": [
            [line(group.name), points.titles(group.title), points.titles(group.note)] for group in device.groups
        ],
        "telegrams": [
            [line(each.name), points.titles(each.title), each.direction, each.words] for each in device.telegrams
        ],
        "messages": [_message(message, points) for message in device.messages],
        "errata": [_erratum(erratum, points, items_of(device)) for erratum in device.errata],
        "sections": dict(_sections(scope)),
        "bus": _bus(device),
        "frames": [_frame(frame) for frame in device.frames if frame.framing != "broadcast"],
        "commands": [
            [line(each.name), each.space, each.address, each.value, points.titles(each.title)]
            for each in device.commands
        ]
        + [[line(each.name), "", 0, None, points.titles(each.title)] for each in device.stepped_commands],
        **points.data(),
        "names": {
            "c": device.id,
            "python": Identifiers(device).device_class,
            "rust": device.id,
            "typescript": TypeScriptIdentifiers(device).device_class,
        },
    }


def _languages(device: Device) -> list[str]:
    """Return the languages of the titles, English first."""
    return list(dict.fromkeys(["en", *(language for point in device.points for language in point.title)]))


def _bus(device: Device) -> dict[str, object]:
    """Return what the decoder needs of the protocol: closed addresses, codes with names and titles, its own facts."""
    codes = {kind: device.bus.codes(kind) for kind in ("functions", "exceptions", "responses")}
    return {
        "gaps": {line(space): gaps for space, gaps in device.bus.gaps.items()},
        "protocol": getattr(family(device.family).part("bus_facts"), "PROTOCOL", {}),
        **{
            kind: {str(code.number): [line(code.name), line(code.title["en"])] for code in each}
            for kind, each in codes.items()
        },
    }


def _frame(frame: Frame) -> list[str]:
    """Return the direction of a worked frame as logs write it, its bytes, and a text if they are misprinted."""
    note = "" if frame.valid or frame.family_facts is not None else misprint_text(frame)
    return ["RX" if frame.direction == "response" else "TX", spaced(frame.printed), *([note] if note else [])]


def _message(message: Message, points: Points) -> list[object]:
    roles = [role_text(role) for role in message.roles]
    return [line(message.name), points.titles(message.title), message.direction, identifier_text(message), roles]


def _erratum(erratum: Erratum, points: Points, items: Mapping[str, list[str]]) -> dict[str, object]:
    about = [item for name in erratum.points for item in items.get(name, ())]
    texts = {"printed": erratum.printed, "taken": erratum.taken, "why": erratum.why, "certainty": erratum.certainty}
    return {
        "id": line(erratum.id),
        "points": about,
        "where": "" if about else line(str(erratum.where)),
        **{key: line(text) for key, text in texts.items()},
        "open": [[line(fact), line(text)] for fact, text in erratum.leaves_open],
        "source": points.source(erratum.source),
    }


def _sections(scope: DocsScope) -> Iterable[Section]:
    """Yield the sections of the page with their contents; empty tables are left out."""
    device, form = scope.device, MARKED
    bus = bus_view(device, form)
    sections: dict[str, list[tuple[str, str]]] = {
        "bus": [("", bus.note), ("Line", bus.facts), *bus.sections],
        "frames": [("Worked frames", device_tables.frames(scope, form))],
        "device": [
            ("Facts", device_tables.facts(device, form)),
            ("Documents", device_tables.documents(device, form)),
            ("Identification", device_tables.identifications(scope, form)),
            ("Bases", device_tables.bases(device, form)),
            ("Found blocks", device_tables.found(device.found, form)),
            ("Special codes", device_tables.codes(device, form)),
            ("Documented only", device_tables.missing(device, form)),
        ],
    }
    return ((name, [part for part in parts if part[1]]) for name, parts in sections.items())


@cache
def source(names: tuple[str, ...]) -> str:
    """Return files of the page as one text."""
    folder = templates_dir() / "docs/page"
    return "\n".join((folder / name).read_text("utf-8").strip() for name in names) + "\n"


def _digest(text: str) -> str:
    """Return the digest by which a browser accepts an inlined text, which has a line break on either side."""
    return "sha256-" + b64encode(sha256(f"\n{text}".encode()).digest()).decode()


_ENCODER = json.JSONEncoder(ensure_ascii=False, separators=(",", ":"))


def _json(data: Mapping[str, object]) -> str:
    """Return JSON that cannot end its element, with a line for each member and item of lists."""
    members = [
        f"{_json_line(key)}:{_items(value) if isinstance(value, list) else _json_line(value)}"
        for key, value in data.items()
    ]
    return "{" + ",\n".join(members) + "}"


def _items(values: list[object]) -> str:
    return "[" + ",\n".join(map(_json_line, values)) + "]"


def _json_line(data: object) -> str:
    return _ENCODER.encode(data).replace("<", "\\u003c")


def _comment(text: str) -> str:
    return text.replace("--", "- -").replace(">", "")
