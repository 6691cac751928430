"""Descriptions of made devices as plain values that tests change anywhere, and texts that strangers may write."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml

from support.described import DEVICES
from support.files import write_files
from support.places import TESTS

BAD = TESTS / "bad"

HOSTILE = (
    "*/ int evil(void); /*",
    '"; import os; "',
    "'''\n\"\"\"",
    "line one\nline two\r\nline three\u2028four",
    "right to left \u202e and \u2066 isolates \u2069",
    "escape \x1b[31m and NUL \x00 and bell \x07",
    "{{ 7 * 7 }} {% raw %} {# no #}",
    "ends with a backslash \\",
    "</script><img src=x onerror=alert(1)> [x](javascript:alert(1)) | cell | `code`",
    "??/ trigraph ??= %s %n ${HOME} $(id)",
    "=cmd|'/c calc'!A0",
    "very long " * 190,
    "\U0001f600 \ufeff \u0301 ßẞ",
)


def whole(folder: str) -> dict[str, Any]:
    """The documents of a device's files by name, as plain values that can be changed."""
    texts = {path.name: path.read_text("utf-8") for path in sorted((DEVICES / folder).glob("*.yaml"))}
    return {name: _typed(list(yaml.load_all(text, Loader=yaml.CBaseLoader))) for name, text in texts.items()}


def _typed(value: Any, key: str = "") -> Any:
    """Plain scalars with the types that the schema asks for."""
    if isinstance(value, dict):
        return {one: _typed(two, one) for one, two in value.items()}
    if isinstance(value, list):
        return [_typed(one, key) for one in value]
    if key in _NUMBERS and value.isdigit():
        return int(value)
    return {"~": None, "true": True, "false": False}.get(value, value)


_NUMBERS = {"fieldscribe", "line", "max", "bytes", "broadcast", "wears", "choices", "decimals", "active"} | {
    *("1", "10000"),  # the steps
    *("length", "characters", "count", "index", "set", "pkw", "bitrate", "identifier_bits", "error", "bit"),
}


def rewrite(folder: Path, texts: dict[str, str]) -> Path:
    """Writes the files of a device, and no others; its device.yaml."""
    shutil.rmtree(folder, ignore_errors=True)
    return write_files(texts, folder) / "device.yaml"


def as_texts(files: dict[str, Any]) -> dict[str, str]:
    """The text of each file: its documents."""
    return {
        name: "\n---\n".join(map(as_yaml, value)) if isinstance(value, list) else as_yaml(value)
        for name, value in files.items()
    }


def as_yaml(value: Any) -> str:
    """A value as JSON that is YAML too: no surrogates, and escapes for what YAML does not take as it is."""
    text = json.dumps(value, ensure_ascii=False)
    return re.sub(
        "[\x7f-\x9f\u2028\u2029\ufeff\ufffe\uffff\ud800-\udfff]", lambda found: f"\\u{ord(found[0]):04x}", text
    )


def nodes(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The paths of all values below a value."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, one in items:
        yield (*path, key)
        yield from nodes(one, (*path, key))


def changed(value: Any, path: tuple[Any, ...], new: Any) -> Any:
    """A copy of the value in which one place differs; `...` takes the place away."""
    if not path:
        return new
    copy = dict(value) if isinstance(value, dict) else list(value)
    one = changed(copy[path[0]], path[1:], new)
    if one is ...:
        del copy[path[0]]
    else:
        copy[path[0]] = one
    return copy


SINK = whole("kitchen_sink")
WHOLES = (SINK, whole("kitchen_can"), whole("kitchen_uss"))
