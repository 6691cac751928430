"""What the files of one device declare for all its points: units, enums, formats, records, documents, variants."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from fieldscribe.families import family
from fieldscribe.language.hints import nearest, quoted
from fieldscribe.language.keys import keys_of
from fieldscribe.language.keys.places import SOURCE
from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import parse_integer
from fieldscribe.language.units import shipped_unit
from fieldscribe.model import Document, Enum, Source, Titles, Unit

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Mapping

    from fieldscribe.diagnostics import Report, Span
    from fieldscribe.families import Family
    from fieldscribe.language.files import Files
    from fieldscribe.resolve.point_facts import PointFacts

_SOURCE = tuple(keys_of(SOURCE))
_STATED, _LINE = {*_SOURCE, "source"}, {"line"}
PLAIN = Unit("", "number", "number")
"""The unit of a number without one."""

SECTIONS = {
    "command": "commands",
    "document": "documents",
    "entry": "enum",
    "exception": "bus",
    "enum": "enums",
    "flag": "points",
    "format": "formats",
    "frame": "frames",
    "function": "bus",
    "member": "points",
    "message": "messages",
    "point": "points",
    "record": "records",
    "response": "bus",
    "space": "space",
    "telegram": "telegrams",
    "unit": "units",
    "variant": "variants",
}
"""What a word can name, each with the key under which that is declared."""


@dataclass(slots=True)
class Scope:
    """Declarations of a device by name. The first of two with one name wins; the second is a finding."""

    files: tuple[Map, ...]
    report: Report
    complete: bool
    units: Mapping[str, Unit] = field(default_factory=dict)
    formats: dict[str, Map] = field(default_factory=dict)
    records: dict[str, Map] = field(default_factory=dict)
    named_enums: dict[str, Map] = field(default_factory=dict)
    enums: dict[tuple[str, int, bool], Enum] = field(default_factory=dict)
    documents: dict[str, Document] = field(default_factory=dict)

    @property
    def header(self) -> Map:
        """The mapping of device.yaml."""
        return self.files[0]

    @property
    def family(self) -> Family:
        """The rules of the device's family."""
        return family(str(self.header["family"]))

    @property
    def axes(self) -> Mapping[str, Map]:
        """The variant axes by name."""
        axes: Map = self.header.get("variants", {})
        return axes

    @property
    def bus(self) -> Map | None:
        """The mapping under `bus`, from the file that says it."""
        return next((file["bus"] for file in self.files if "bus" in file), None)

    def declared(self, section: str) -> dict[str, Map]:
        """All declarations of a section over all files, by name; a name declared twice is a finding."""
        seen: dict[str, Map] = {}
        declarations: dict[str, Map] = {}
        for file in self.files:
            for name, value in file.get(section, {}).items():
                if name in seen:
                    first = (seen[name].key_span(name), "first declared here")
                    message = f"{quoted(name)} is declared twice under `{section}`"
                    self.report.error(
                        "duplicate-name", message, file[section].key_span(name), "rename one of them", [first]
                    )
                    continue
                seen[name] = file[section]
                declarations[name] = value
        return declarations

    def listed(self, section: str) -> Iterator[Map]:
        """All items of a list section over all files."""
        for file in self.files:
            yield from file.get(section, ())

    def unit(self, symbol: str) -> Unit | None:
        """The unit of that symbol: the description's own, else a shipped one."""
        return self.units.get(symbol) or shipped_unit(symbol)

    def is_lost(self, word: str, section: str) -> bool:
        """Whether a word may name something that was left out because it has a finding of its own."""
        marks = {word, f"*{section}"}
        return not self.complete or any(marks & file.file.lost for file in self.files)

    def unknown(self, what: str, word: str, span: Span, known: Collection[str], hint: str | None = None) -> None:
        """A finding for a word that names nothing; `what` is a key of `SECTIONS`, `known` are the existing names."""
        section = SECTIONS[what]
        if self.report.full or self.is_lost(word, section):
            return
        if hint is None:
            near = nearest(word, tuple(known))
            hint = f"did you mean `{near}`?" if near else _known_hint(known, section)
        message = f"there is no {what} {quoted(word)}"
        self.report.error(f"unknown-{what}", message, span.moved(0, max(1, len(word))), hint)


def _known_hint(known: Collection[str], section: str) -> str:
    if known and len(known) <= 12:
        return f"known: {', '.join(known)}"
    return f"declare it under `{section}`"


def open_scope(files: Files, report: Report) -> Scope:
    """The declarations of the files."""
    scope = Scope(files.maps, report, files.complete)
    units = {symbol: Unit(symbol, unit["name"], unit["quantity"]) for symbol, unit in scope.declared("units").items()}
    scope.units = units
    scope.formats = scope.declared("formats")
    scope.records = scope.declared("records")
    scope.named_enums = scope.declared("enums")
    for name, value in scope.header["documents"].items():
        known = (str(value["title"]), str(value["language"]), value.get("file"), value.get("sha256"))
        scope.documents[name] = Document(name, *known)
    return scope


def titles(value: Map | str | None, otherwise: str = "") -> Titles:
    """A title by language from its YAML; `otherwise` is the English one when there is none."""
    if value is None:
        return {"en": otherwise} if otherwise else {}
    if isinstance(value, str):
        return {"en": value}
    return dict(value) if "en" in value else {"en": otherwise, **value}


def first_line(value: object) -> int | None:
    """The line where something begins: of `780..790` the first."""
    if isinstance(value, str):
        return parse_integer(value.partition("..")[0])
    return value if isinstance(value, int) else None


def source_of(scope: Scope, *layers: Map) -> Source:
    """The source that the layers (own facts first) give together; without a document, the first one."""
    return _source(scope, _cited(layers))


class Sources:
    """The sources of points; what their formats and groups cite is read once."""

    def __init__(self, scope: Scope) -> None:
        self._scope = scope
        self._shared: dict[tuple[int, ...], tuple[Mapping[str, object], Source]] = {}

    def of(self, facts: PointFacts) -> Source:
        """The source of a point: mostly that of its group, with a line of its own."""
        own, *others = facts.layers
        key = (*map(id, others), id(facts.group))
        known = self._shared.get(key)
        if known is None:
            cited = _cited((*others, facts.group))
            known = self._shared[key] = cited, _source(self._scope, cited)
        stated = own.keys() & _STATED
        if stated == _LINE:
            return Source(known[1].document, known[1].section, known[1].page, first_line(own["line"]))
        return _source(self._scope, {**known[0], **_cited((own,))}) if stated else known[1]


def _cited(layers: Iterable[Map]) -> dict[str, object]:
    """What the layers say of a source, the first of them that says it."""
    facts: dict[str, object] = {}
    for layer in layers:
        for key in _SOURCE:
            if key in layer:
                facts.setdefault(key, layer[key])
        if "source" in layer and isinstance(layer["source"], Map):
            for key, value in layer["source"].items():
                facts.setdefault(key, value)
    return facts


def _source(scope: Scope, facts: Mapping[str, object]) -> Source:
    document = str(facts.get("document") or next(iter(scope.documents), ""))
    line, section, page = first_line(facts.get("line")), facts.get("section"), facts.get("page")
    return Source(
        document,
        None if section is None else str(section),
        None if page is None else str(page),
        line,
    )
