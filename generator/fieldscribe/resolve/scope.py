"""Finds what the files of a device declare for all points: units, enums, formats, records, documents, variants.

`open_scope` makes the scope from the files; every later step of `resolve` asks it by name and reports through it.
"""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from fieldscribe.diagnostics import Report, Span
from fieldscribe.families import Family, family
from fieldscribe.language.files import Files
from fieldscribe.language.hints import nearest, quoted
from fieldscribe.language.keys import keys_of
from fieldscribe.language.keys.places import SOURCE
from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import parse_integer
from fieldscribe.language.units import shipped_unit
from fieldscribe.model import Base, Document, Enum, Found, Given, Source, Titles, Unit

_SOURCE = tuple(keys_of(SOURCE))
PLAIN = Unit("", "number", "number")
"""The unit of a number that has none."""
_NO_TITLES: Titles = {}
"""One for all points without a note: thousands of empty ones are a megabyte."""

_SECTIONS = {
    **dict.fromkeys(("exception", "function", "response"), "bus"),
    **dict.fromkeys(("flag", "member"), "points"),
    "entry": "enum",
    "space": "space",
}
"""The keys of declarations that are not the plural of their kind, as `formats` is."""


@dataclass(slots=True)
class Scope:
    """The declarations of one device by name. Of two with the same name the second is reported and ignored."""

    files: tuple[Map, ...]
    report: Report
    complete: bool
    units: Mapping[str, Unit] = field(default_factory=dict)
    formats: dict[str, Map] = field(default_factory=dict)
    records: dict[str, Map] = field(default_factory=dict)
    named_enums: dict[str, Map] = field(default_factory=dict)
    enums: dict[tuple[str, int, bool], Enum] = field(default_factory=dict)
    documents: dict[str, Document] = field(default_factory=dict)
    given: Mapping[str, Given] = field(default_factory=dict)
    found: Found | None = None
    bases: dict[int, Base] = field(default_factory=dict)
    """The base of the addresses of each group, by the id of the group; `read_bases` adds it."""

    def base_of(self, group: Map) -> Base | None:
        """Return the base of the addresses of a group; None if they count from 0."""
        return self.bases.get(id(group))

    @property
    def header(self) -> Map:
        """Return the mapping of device.yaml."""
        return self.files[0]

    @property
    def family(self) -> Family:
        """Return the rules of the device's family."""
        return family(str(self.header["family"]))

    @property
    def axes(self) -> Mapping[str, Map]:
        """Return the variant axes by name."""
        axes: Map = self.header.get("variants", {})
        return axes

    @property
    def bus(self) -> Map | None:
        """Return the mapping under `bus`, from the first file that has one."""
        return next((file["bus"] for file in self.files if "bus" in file), None)

    @property
    def groups(self) -> Iterator[Map]:
        """Yield the groups of the device in the order of the text."""
        for file in self.files:
            if "group" in file and "space" in file:
                yield file

    def declared(self, section: str) -> dict[str, Map]:
        """Return the declarations of a section in all files by name; report a name that is declared twice."""
        holders: dict[str, Map] = {}
        for node in [file[section] for file in self.files if section in file]:
            for name in node:
                if name in holders:
                    message = f"{quoted(name)} is declared twice under `{section}`"
                    related = [(holders[name].key_span(name), "first declared here")]
                    self.report.error("duplicate-name", message, node.key_span(name), "rename one of them", related)
                holders.setdefault(name, node)
        return {name: node[name] for name, node in holders.items()}

    def listed(self, section: str) -> Iterator[Map]:
        """Yield the items of a list section in all files."""
        for file in self.files:
            yield from file.get(section, ())

    def unique(self, section: str, key: str = "name") -> Iterator[Map]:
        """Yield the items of a list section in all files; report and skip those whose `key` was given before."""
        first: dict[str, Span] = {}
        for node in self.listed(section):
            name, span = str(node[key]), node.span(key)
            if name in first:
                message = f"two {section} have the {key} `{name}`"
                related = [(first[name], "first given here")]
                self.report.error("duplicate-name", message, span, "rename one of them", related)
            else:
                first[name] = span
                yield node

    def unit(self, symbol: str) -> Unit | None:
        """Return the unit of that symbol: the description's own, else a shipped one; None if there is none."""
        return self.units.get(symbol) or shipped_unit(symbol)

    def is_lost(self, word: str, section: str) -> bool:
        """Return True if the word may name something that was left out because of an earlier finding."""
        marks = {word, f"*{section}"}
        return not self.complete or any(marks & file.file.lost for file in self.files)

    def unknown(self, what: str, word: str, span: Span, known: Collection[str], hint: str | None = None) -> None:
        """Report a word that names nothing; `what` is its kind, `known` are the existing names."""
        section = _SECTIONS.get(what, f"{what}s")
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
    """Return the declarations of the files."""
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
    """Return a title by language from its YAML value; `otherwise` replaces a missing English one."""
    if value is None:
        return {"en": otherwise} if otherwise else _NO_TITLES
    if isinstance(value, str):
        return {"en": value}
    return dict(value) if "en" in value else {"en": otherwise, **value}


def first_line(value: object) -> int | None:
    """Return the first line of a citation: 780 for `780..790`."""
    if isinstance(value, str):
        return parse_integer(value.partition("..")[0])
    return value if isinstance(value, int) else None


def source_of(scope: Scope, *layers: Map) -> Source:
    """Return the source that the layers cite together, nearest first; without a document, the device's first one."""
    facts: dict[str, Any] = {}
    for layer in layers:
        for key in _SOURCE:
            if key in layer:
                facts.setdefault(key, layer[key])
        if "source" in layer and isinstance(layer["source"], Map):
            for key, value in layer["source"].items():
                facts.setdefault(key, value)
    document = str(facts.get("document") or next(iter(scope.documents), ""))
    line, section, page = first_line(facts.get("line")), facts.get("section"), facts.get("page")
    return Source(
        document,
        None if section is None else str(section),
        None if page is None else str(page),
        line,
    )
