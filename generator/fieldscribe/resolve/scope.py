"""What the files of one device declare for all its points: units, enums, formats, records, documents, variants."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

from fieldscribe.diagnostics import Report, Span
from fieldscribe.language.load import load
from fieldscribe.language.nodes import Map
from fieldscribe.language.source import SourceFile
from fieldscribe.model import Document, Enum, Source, Titles, Unit

PLAIN = Unit("", "number", "number")
"""The unit of a number without one."""


@dataclass(slots=True)
class Scope:
    """Declarations of a device by name. The first of two with one name wins; the second is a finding."""

    files: tuple[Map, ...]
    report: Report
    units: Mapping[str, Unit] = field(default_factory=dict)
    formats: dict[str, Map] = field(default_factory=dict)
    records: dict[str, Map] = field(default_factory=dict)
    enums: dict[str, Enum] = field(default_factory=dict)
    documents: dict[str, Document] = field(default_factory=dict)

    @property
    def header(self) -> Map:
        """The mapping of device.yaml."""
        return self.files[0]

    @property
    def family(self) -> str:
        """The family's name."""
        return str(self.header["family"])

    def declared(self, section: str) -> Iterator[tuple[str, Map, Map]]:
        """All (name, declaration, its file) of a section over all files; a name declared twice is a finding."""
        seen: dict[str, Map] = {}
        for file in self.files:
            for name, value in file.get(section, {}).items():
                if name in seen:
                    here = file[section].key_span(name)
                    first = (seen[name].key_span(name), "first declared here")
                    self.report.error(
                        "duplicate-name",
                        f"`{name}` is declared twice under `{section}`",
                        here,
                        "rename one of them",
                        [first],
                    )
                    continue
                seen[name] = file[section]
                yield name, value, file[section]

    def listed(self, section: str) -> Iterator[Map]:
        """All items of a list section over all files."""
        for file in self.files:
            yield from file.get(section, ())


def open_scope(files: tuple[Map, ...], report: Report) -> Scope:
    """The declarations of the files; `files[0]` is device.yaml."""
    scope = Scope(files, report)
    scope.units = {**shipped_units(), **_units(scope)}
    scope.formats = {name: value for name, value, _ in scope.declared("formats")}
    scope.records = {name: value for name, value, _ in scope.declared("records")}
    for name, value in scope.header.get("documents", {}).items():
        known = (str(value["title"]), str(value["language"]), value.get("file"), value.get("sha256"))
        scope.documents[name] = Document(name, *known)
    return scope


@lru_cache(maxsize=1)
def shipped_units() -> Mapping[str, Unit]:
    """The units that need no declaration, by symbol."""
    path = Path(__file__).parents[1] / "language" / "units.yaml"
    report = Report()
    table = load(SourceFile(path.name, path.read_text("utf-8")), report)
    if table is None:
        raise ValueError(f"units.yaml is broken: {report.findings}")
    return {symbol: Unit(symbol, one["name"], one["quantity"]) for symbol, one in table.items()}


def _units(scope: Scope) -> dict[str, Unit]:
    return {symbol: Unit(symbol, str(one["name"]), str(one["quantity"])) for symbol, one, _ in scope.declared("units")}


def titles(value: Map | str | None, otherwise: str = "") -> Titles:
    """A title by language from its YAML; `otherwise` is the English one when there is none."""
    if value is None:
        return {"en": otherwise} if otherwise else {}
    return {"en": value} if isinstance(value, str) else {key: str(text) for key, text in value.items()}


def source_of(scope: Scope, *layers: Map) -> Source:
    """The source that the layers (own facts first) give together."""
    found: dict[str, object] = {}
    for layer in layers:
        for key in ("line", "section", "page"):
            if key in layer:
                found.setdefault(key, layer[key])
        for key, value in layer.get("source", {}).items() if isinstance(layer.get("source"), Map) else ():
            found.setdefault(key, value)
    document = str(found.get("document") or next(iter(scope.documents), ""))
    line = found.get("line")
    section, page = found.get("section"), found.get("page")
    return Source(
        document,
        None if section is None else str(section),
        None if page is None else str(page),
        line if isinstance(line, int) else None,
    )


def unknown_name(word: str, known: list[str], what: str) -> str:
    """A hint that names what is nearest to an unknown name."""
    import difflib

    near = difflib.get_close_matches(word, known, 1, 0.6)
    return f"did you mean `{near[0]}`?" if near else f"declare it under `{what}`"


def place(layer: Map, key: str) -> Span:
    """Where a fact of a layer stands."""
    return layer.span(key)
