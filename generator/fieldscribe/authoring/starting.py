"""Starts a description: the questions, the files, which compile at once, and the schema for editors."""

import os
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from fieldscribe.diagnostics import Report, UnclearError
from fieldscribe.families import FAMILIES, family
from fieldscribe.language.key_tables import SCHEMA_ID, schema_text
from fieldscribe.language.keys import keys_of
from fieldscribe.language.keys.places import DEVICE
from fieldscribe.language.load import as_yaml
from fieldscribe.language.nodes import Map, SourceFile
from fieldscribe.language.shape import check_of
from fieldscribe.output.writing import replace
from fieldscribe.pipeline import DEVICE_FILE, load_analysis
from fieldscribe.schema_types import Place, ValueShape

SCHEMA_FILE = "schema.json"
"""The name of the schema in the folder of a description, or above it."""

_SCHEMA_LINE = "# yaml-language-server: $schema={}\n"
"""The first line of each file; editors look for it."""
_HEAD = """\
fieldscribe: 1
device: {device}
version: 0.1.0
vendor: {vendor}
model: {model}
title: {{en: {title}}}
family: {family}
documents:
  manual: {{title: {manual}, language: {language}}}
parts: [main.yaml]
"""


class Question(NamedTuple):
    """A fact that a new description needs."""

    name: str
    asks: str
    usual: str = ""
    """The default, which may contain names of earlier answers in braces."""


QUESTIONS = (
    Question("device", "the device's id: snake_case, the folder's name and the prefix of all generated names"),
    Question("family", "the family of its bus"),
    Question("vendor", "who makes it"),
    Question("model", "the product's own name"),
    Question("title", "what it is, in English, as in Frequency inverter"),
    Question("manual", "the title of its manual", "{vendor} {model}"),
    Question("language", "the language of the manual, two letters", "en"),
)


def startable() -> dict[str, str]:
    """Return the families, each with its use."""
    parts = {name: family(name).part("description") for name in FAMILIES}
    return {name: part.SERVES for name, part in parts.items() if part is not None}


def wrong_with(name: str, answer: str) -> tuple[str, str] | None:
    """Return what is wrong with an answer, with a hint; None if it is right."""
    if not answer or not answer.isprintable():
        return f"`{name}` is {'empty' if not answer else 'no line of text'}", "write one line of text"
    if name == "family" and answer not in startable():
        return f"there is no family `{answer}` to start with", f"write one of {', '.join(startable())}"
    report = Report()
    holder = Map(SourceFile("", ""), 0)
    holder[name] = answer
    check_of(_shape_of(name))(answer, holder, name, report)
    return next(((finding.message, finding.hint or "") for finding in report.findings), None)


def _shape_of(name: str) -> ValueShape:
    """Return the shape of the key that holds an answer."""
    keys = keys_of(DEVICE)
    if name in keys:
        return keys[name].shape
    (documents,) = (kind for kind in keys["documents"].shape.kinds if isinstance(kind, Place))
    (document,) = (kind for shape in documents.by_form.values() for kind in shape.kinds if isinstance(kind, Place))
    return keys_of(document)["title" if name == "manual" else name].shape


def start(folder: Path, answers: Mapping[str, str]) -> list[Path]:
    """Create the folder of the device, either completely or not at all; return its files.

    Raises FileExistsError, another OSError, or UnclearError if the description would not compile.
    """
    if os.path.lexists(folder):
        raise FileExistsError(str(folder))
    schema_above = is_schema(folder.parent / SCHEMA_FILE)
    with TemporaryDirectory(prefix=".", dir=folder.parent) as temporary:
        made = Path(temporary, folder.name)
        made.mkdir()
        schema = _SCHEMA_LINE.format(f"../{SCHEMA_FILE}" if schema_above else SCHEMA_FILE)
        for name, text in _texts(answers).items():
            (made / name).write_text(schema + text, "utf-8", newline="\n")
        if not schema_above:
            replace(made / SCHEMA_FILE, (schema_text().encode(),))
        report = Report()
        if load_analysis(made / DEVICE_FILE, report) is None:
            finding = report.findings[0]
            raise UnclearError(f"{finding.message}; nothing was written", finding.hint or "")
        names = sorted(os.listdir(made))
        made.rename(folder)
    return [folder / name for name in names]


def is_schema(place: Path) -> bool:
    """Return True if the file is a schema of ours."""
    with suppress(OSError):
        if place.is_file():
            with place.open("rb") as stream:
                return SCHEMA_ID.encode() in stream.read(500)
    return False


def _texts(answers: Mapping[str, str]) -> dict[str, str]:
    """Return the files of the description by name, without their first lines."""
    texts = family(answers["family"]).part("description")
    head = _HEAD.format_map({name: as_yaml(answer) for name, answer in answers.items()})
    return {DEVICE_FILE: head + texts.DEVICE, "main.yaml": texts.GROUP}
