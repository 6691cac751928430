"""Reads `fieldscribe.toml`: the devices of a project, with their points and languages.

out = "drivers"              # below this file's folder; a device may name another one
targets = ["c"]              # c, python, rust, typescript; a device may name others

[[devices]]
device = "hitachi_l200"      # an id, or the path of a description below this file's folder
points = ["A001", "status"]  # codes, names, groups, patterns (default: all)
"""

import os
import re
from collections.abc import Collection, Iterator, Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Any, NamedTuple

from fieldscribe.diagnostics import Report, Span, did_you_mean
from fieldscribe.language.keys.forms import ID
from fieldscribe.pipeline import DEVICE_FILE
from fieldscribe.safe_files import Inputs, path_text, read_regular
from fieldscribe.text import shortened
from fieldscribe.vendoring.requests import LANGUAGE_OF, LANGUAGES, CodeRequest

NAME = "fieldscribe.toml"
_MOST_BYTES = 1 << 20
_KEYS: dict[str, tuple[type, str]] = {
    "device": (str, '"hitachi_l200"'),
    "targets": (list, '["c"]'),
    "points": (list, '["A001", "status"]'),
    "out": (str, '"drivers"'),
    "as": (str, '"first_drive"'),
    **dict.fromkeys(LANGUAGE_OF, (bool, "true")),
}
"""The keys of a device, each with the type of its value, and an example."""
_TYPES = {str: "is a text", list: "is a list of words", bool: "is true or false"}
_COMMON = ("out", "targets")
"""The keys that the file may have for all devices."""
_OF_LINES = ("lines", "stations")
"""The tables for commands that talk to devices, which `live/lines.py` reads."""
_WHERE = re.compile(r"at line (\d+), column (\d+)")


class ProjectDevice(NamedTuple):
    """A device of the project file: its name there, the place of the name, the request, and the output folder."""

    device: str
    place: Span
    request: CodeRequest
    out: Path


def read_project(file: Path, report: Report, inputs: Inputs | None = None) -> list[ProjectDevice]:
    """Return the devices of a project file; report errors in it. Raises OSError.

    `inputs` records the file.
    """
    import tomllib

    content = read_regular(file, _MOST_BYTES)
    if inputs is not None:
        inputs.note(file, content)
    data = content.data
    try:
        text = data.decode("utf-8-sig")
        document = tomllib.loads(text)
    except UnicodeDecodeError:
        report.error("bad-project", "the file is no UTF-8 text", Span(path_text(file), 1, 1))
        return []
    except RecursionError:
        report.error("bad-project", "lists or tables are nested too deeply", Span(path_text(file), 1, 1))
        return []
    except ValueError as error:  # of tomllib, or of a number or a date in it
        report.error("bad-project", f"this is no TOML: {shortened(_message(error))}", _span_of(error, file, text))
        return []
    return list(_Reader(file, text, report).devices(document))


class _Reader:
    """Reads one project file."""

    def __init__(self, file: Path, text: str, report: Report) -> None:
        self._file, self._report = file, report
        self._lines = text.split("\n")
        self._heads = [number for number, line in enumerate(self._lines) if _is_device_head(line)]

    def devices(self, document: Mapping[str, Any]) -> Iterator[ProjectDevice]:
        """Yield the entries under `devices`, once for each language."""
        common = {key: value for key, value in document.items() if key not in ("devices", *_OF_LINES)}
        self._check(common, None, _COMMON)
        devices = document.get("devices")
        if not isinstance(devices, list) or not devices or not all(isinstance(entry, dict) for entry in devices):
            hint = 'write `[[devices]]`, and `device = "hitachi_l200"` below it'
            self._wrong("the file names no devices", None, "devices", hint)
            return
        for number, entry in enumerate(devices):
            self._check(entry, number, _KEYS)
            if not self._report.has_errors:
                yield from self._of_device({**common, **entry}, number, entry)

    def _of_device(self, settings: Mapping[str, Any], number: int, entry: Mapping[str, Any]) -> Iterator[ProjectDevice]:
        for key in ("device", "out", "targets"):
            if not settings.get(key):
                self._wrong(f"`{key}` is missing", number, key, f"write `{key} = {_KEYS[key][1]}`")
        if self._report.has_errors:
            return
        out = self._inside(settings["out"], self._span(number if "out" in entry else None, "out"))
        place = self._span(number, "device")
        path = self._inside(settings["device"], place)
        is_id = re.fullmatch(ID.pattern, settings["device"]) is not None
        device = settings["device"] if is_id and not (path / DEVICE_FILE).is_file() else str(path)
        for key in LANGUAGE_OF.keys() & settings.keys():
            if LANGUAGE_OF[key] not in settings["targets"]:
                message = f"`{key}` is for {LANGUAGE_OF[key]}, which is not among the targets"
                self._wrong(message, number, key, "leave it out")
        for language in dict.fromkeys(settings["targets"]):
            switches = {key: settings[key] for key in LANGUAGE_OF if key in settings and LANGUAGE_OF[key] == language}
            yield ProjectDevice(
                device,
                place,
                CodeRequest(language, tuple(settings.get("points", ())), settings.get("as"), **switches),
                out,
            )

    def _wrong(self, message: str, number: int | None, key: str, hint: str | None = None) -> None:
        """Report an error at the place of a key, of the n-th device or of the file (None)."""
        self._report.error("bad-project", message, self._span(number, key), hint)

    def _check(self, settings: Mapping[str, Any], number: int | None, known: Collection[str]) -> None:
        for key, value in settings.items():
            if key not in known:
                hint = did_you_mean(get_close_matches(key, sorted(known), 1)) or f"there are {', '.join(sorted(known))}"
                self._wrong(f"there is no key `{shortened(key)}` here", number, key, hint)
            elif not _fits(key, value):
                self._wrong(f"`{key}` {_TYPES[_KEYS[key][0]]}", number, key, f"write `{key} = {_KEYS[key][1]}`")
            elif key == "targets" and (unknown := [name for name in value if name not in LANGUAGES]):
                message = f"`{shortened(unknown[0])}` is not a language for code"
                self._wrong(message, number, key, f"there are {', '.join(LANGUAGES)}")

    def _inside(self, path: str, span: Span) -> Path:
        """Return the full path; report one that leads out of the file's folder."""
        root = os.path.realpath(self._file.parent)
        if os.path.commonpath([root, os.path.realpath(os.path.join(root, path))]) != root:
            message = f"`{shortened(path)}` leads out of the folder of {self._file.name}"
            self._report.error("bad-project", message, span)
        return self._file.parent / path

    def _span(self, number: int | None, key: str) -> Span:
        """Return the place of a key, of the n-th device or of the file (None); its first line if the key is missing."""
        first = 0 if number is None or number >= len(self._heads) else self._heads[number]
        ends = [head for head in self._heads if number is None or head > first]
        for line in range(first, ends[0] if ends else len(self._lines)):
            match = re.match(rf"\s*(\"?){re.escape(key)}\1\s*=", self._lines[line])
            if match is not None:
                return Span(path_text(self._file), line + 1, self._lines[line].index(key) + 1, len(key))
        return Span(path_text(self._file), first + 1, 1)


def _is_device_head(line: str) -> bool:
    return "".join(line.split("#", maxsplit=1)[0].split()) == "[[devices]]"


def _fits(key: str, value: object) -> bool:
    kind = _KEYS[key][0]
    if kind is list:
        return isinstance(value, list) and all(isinstance(word, str) and word for word in value)
    return isinstance(value, kind) and value != "" and "\0" not in str(value)


def _message(error: ValueError) -> str:
    return _WHERE.sub("", str(error)).removesuffix("()").strip().removesuffix("(").strip()


def _span_of(error: ValueError, file: Path, text: str) -> Span:
    """Return the place of a TOML error: from its message, or the end of the file."""
    match = _WHERE.search(str(error))
    lines = text.rstrip().split("\n")
    line, column = (int(match[1]), int(match[2])) if match else (len(lines), len(lines[-1]) + 1)
    return Span(path_text(file), line, column)
