"""Writes a draft as YAML: the head of a device, its groups and points, and `# ?` for each decision of a person.

The contents of a cell stay inside a text or a comment.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain, count
from typing import NamedTuple

import fieldscribe.language.keys  # noqa: F401  # it reads the descriptions of the families, so it is loaded before them
from fieldscribe.families import family
from fieldscribe.grouping import grouped
from fieldscribe.language.load import as_yaml
from fieldscribe.text import ascii_text, counted, line

_SYMBOLS = str.maketrans(
    {"°": " deg ", "µ": "u", "φ": "phi", "ϕ": "phi", "Ω": "ohm"}
    | {"+": " plus ", ">": " above ", "<": " below ", "%": " percent "}
)
_ARTICLES = re.compile(r"the|an?|of|and|for|d(?:er|ie|as|em|en)|und|fuer|zu[rm]|von")
_LONGEST_NAME, _LONGEST_COMMENT = 48, 400
_KEYS = (
    *("at", "bits", "write_at", "view_of", "access", "format", "type", "untyped", "length", "words", "bytes", "coding"),
    *("notation", "characters", "per_word", "padding", "range", "range_in_units", "scale", "unit", "display"),
    *("default", "default_in_units", "enum", "open", "flags", "special", "fixed", "changes", "when", "since", "sets"),
    *("indices", "most", "each", "reserved", "note"),
)
"""The order of a point's facts."""


class Document(NamedTuple):
    """A file from which the draft was made; if points cite its lines, the audit compares them."""

    file: str
    sha256: str
    name: str = "manual"
    title: str = ""
    has_lines: bool = True


class Head(NamedTuple):
    """The head of the draft: facts of the device and of the source files; the language is that of the titles.

    `facts` are further lines of the head, `kind` is what the files hold.
    """

    device: str
    documents: Sequence[Document]
    family: str
    language: str = "en"
    vendor: str = ""
    model: str = ""
    title: str = ""
    facts: Sequence[str] = ()
    kind: str = "tables"
    blocks: Sequence[DraftBlock] = ()
    """Facts of the head that the compiler may reject."""
    bus: Sequence[str] = ()
    """The lines of the bus, if they are known."""


@dataclass(slots=True)
class DraftPoint:
    """A point of the draft: its facts as YAML text by key, and the questions that a person must settle.

    Line 0: the file has no lines to name.
    """

    line: int
    space: str
    title: str
    code: str = ""
    name: str = ""
    section: str = ""
    facts: dict[str, str] = field(default_factory=lambda: {"at": "~"})
    wire: int | None = None
    reference: tuple[int, str] | None = None
    """The base of a printed reference, and the number as it is printed."""
    flags: dict[str, str] = field(default_factory=dict)
    questions: list[str] = field(default_factory=list)
    titles: Mapping[str, str] = field(default_factory=dict)
    """Its titles in other languages than that of the draft."""
    remarks: list[str] = field(default_factory=list)
    """Remarks that need no decision."""
    views: bool = False
    """True if it may share the words of other points."""

    def share(self, other: DraftPoint, key: str, reason: str) -> None:
        """Become a view of another point at the same address, or let it become one of this; else leave `key` open."""
        viewed = self.facts.get("view_of"), other.facts.get("view_of")
        if not (self.views and other.views) or None not in viewed:
            self.withdraw(key, reason)
        elif viewed[0] is None:
            self.facts["view_of"] = viewed[1] or other.name
        else:
            other.facts["view_of"] = self.name

    def withdraw(self, key: str, reason: str) -> None:
        """Replace a fact that does not compile by a question; if it cannot be told which, replace all facts.

        Raises ValueError if nothing is left to replace.
        """
        value = self.facts.get(key, "~")
        if key == "printed" and self.reference:
            value, self.reference = self.reference[1], None
        elif key == "name" and not self.name.endswith(f"_line_{self.line}"):
            value, self.name = self.name, f"{self.name}_line_{self.line}"
        elif key == "code" and self.code:
            value, self.code = self.code, ""
        elif value != "~":
            self._leave_open(key)
        elif self.facts == {"at": "~"}:
            raise ValueError(reason)
        else:
            key, value = "the row", "; ".join(f"{name}: {text}" for name, text in self.facts.items() if text != "~")
            self.facts, self.reference = {"at": "~"}, None
        self.questions.append(f"{key}: {value}? {reason}")

    def _leave_open(self, key: str) -> None:
        self.views = self.views and key != "view_of"  # a view that does not compile is not tried again
        del self.facts[key]
        if key in ("at", "type", "scale"):
            self.facts[key] = "~"
        if key == "at":
            self.wire = None


@dataclass(slots=True)
class DraftGroup:
    """The points below one heading in one space, further facts that they share, and comments about its tables."""

    title: str
    space: str
    section: str
    points: list[DraftPoint] = field(default_factory=list)
    comments: list[str] = field(default_factory=list)
    name: str = ""
    document: str = "manual"
    facts: dict[str, str] = field(default_factory=dict)
    titles: Mapping[str, str] = field(default_factory=dict)

    def withdraw(self, key: str, reason: str) -> None:
        """Replace a fact that does not compile by a comment. Raises ValueError if there is none."""
        if key not in self.facts:
            raise ValueError(reason)
        self.comments.append(f"{key}: {self.facts.pop(key)}? {reason}")


@dataclass(slots=True)
class DraftBlock:
    """Lines of the head that become a question if the compiler rejects them, and further questions."""

    lines: list[str]
    questions: list[str] = field(default_factory=list)

    def withdraw(self, key: str, reason: str) -> None:
        """Replace the lines by a question. Raises ValueError if there are none."""
        if not self.lines:
            raise ValueError(reason)
        self.questions.append(f"{key}: {' '.join(line.strip() for line in self.lines)}? {reason}")
        self.lines = []


class WholeDraft(NamedTuple):
    """The groups and the head of a drafted device."""

    groups: list[DraftGroup]
    head: Head

    @property
    def points(self) -> list[DraftPoint]:
        """The drafted points."""
        return [point for group in self.groups for point in group.points]

    @property
    def not_carried(self) -> Counter[str]:
        """The number of facts that became questions, by kind."""
        texts = [text for group in self.groups for text in group.comments]
        texts += [text for point in self.points for text in point.questions]
        texts += [text for block in self.head.blocks for text in block.questions]
        return Counter(text.removeprefix("not carried: ").partition(":")[0] for text in texts)


class Line(NamedTuple):
    """A line of the draft, with its owner and its key."""

    text: str
    owner: DraftPoint | DraftGroup | DraftBlock | None = None
    key: str = ""


def scalar(value: str) -> str:
    """Return a text from a file as a YAML scalar: one line, without control characters."""
    return as_yaml(line(value))


def comment(value: str) -> str:
    """Return a question as a comment of one line."""
    cleaned = line(value)
    return f"# ? {cleaned if len(cleaned) <= _LONGEST_COMMENT else cleaned[:_LONGEST_COMMENT] + ' …'}"


def snake(title: str, otherwise: str, *, articles: bool = False) -> str:
    """Return a title as a short name in snake_case; `otherwise` if it holds no letter, and before a digit.

    Without `articles` it has no words such as `the` and `a`.
    """
    words = re.findall(r"[a-z0-9]+", ascii_text(title.translate(_SYMBOLS)).lower())
    name = ""
    for word in [word for word in words if articles or not _ARTICLES.fullmatch(word)] or words:
        if name and len(name) + len(word) >= _LONGEST_NAME:
            break
        name = f"{name}_{word}" if name else word[:_LONGEST_NAME]
    if not name:
        return otherwise
    return name if name[0].isalpha() else f"{otherwise}_{name}"[:_LONGEST_NAME].rstrip("_")


class Names:
    """Gives unique names; `folded` returns the part of a name that must differ, `mark` comes before a number."""

    def __init__(self, folded: Callable[[str], str] = str, mark: str = "") -> None:
        self._taken: set[str] = set()
        self._folded, self._mark = folded, mark

    def give(self, name: str, *suffixes: str) -> str:
        """Return the name; if it is taken, with the first suffix that makes it unique, or else a number."""
        ends = chain(filter(None, suffixes), (f"{self._mark}{number}" for number in count(2)))
        candidates = chain((name,), (f"{name}_{end}" for end in ends))
        given = next(candidate for candidate in candidates if self._folded(candidate) not in self._taken)
        self._taken.add(self._folded(given))
        return given


def label_map(labels: Mapping[str, str], key: str, language: str) -> str:
    """Return numbers or bits with their names as the block of an `enum` (no `key`) or of `flags` (`title`)."""
    titles = {number: _titles(label, language) for number, label in labels.items()}
    return named_numbers(
        (number, label, number.replace("..", "_"), f"{key}: {titles[number]}" if key else titles[number][1:-1])
        for number, label in labels.items()
    )


def named_numbers(entries: Iterable[tuple[object, str, str, str]]) -> str:
    """Return numbers or bits as the block of an `enum` or of `flags`.

    Each has a label that becomes its name, a suffix that makes the name unique, and its further facts.
    """
    names, lines = Names(), []
    for number, label, suffix, facts in entries:
        name = scalar(names.give(snake(label, "number"), suffix))
        lines.append(f"\n  {number}: {{name: {name}, {facts}}}")
    return "".join(lines)


def _titles(title: str, language: str, others: Mapping[str, str] | None = None) -> str:
    return titles_text(title, {} if language == "en" else {language: title}, others or {})


def titles_text(english: str, *others: Mapping[str, str]) -> str:
    """Return a text in English and in other languages, as titles are written."""
    texts = {"en": english} | {language: text for each in others for language, text in each.items()}
    return f"{{{', '.join(f'{language}: {scalar(text)}' for language, text in texts.items())}}}"


def draft_lines(groups: Sequence[DraftGroup], head: Head) -> tuple[list[Line], list[Line], list[Line]]:
    """Return the comments at the top, the head of a device, and a document for each group."""
    points = [point for group in groups for point in group.points]
    questions = sum(len(point.questions) for point in points)
    counts = f"{counted(len(points), 'point')} from {head.kind}, with {counted(questions, 'question')} at points"
    top = [f"# A draft of {counts}: settle what `# ?` asks, then take it out."]
    if head.language != "en":
        top.append(comment(f"titles are in the manual's language ({head.language}): give English names and titles"))
    if head.kind == "tables" and not any("type" in point.facts for point in points):
        top.append(comment("no types are printed: a point is u16 unless it says otherwise"))
    enums = _shared_enums(points)
    body = [
        *([Line("---"), Line("enums:")] if enums else []),
        *(line for block, (name, point) in enums.items() for line in _enum_lines(block, name, point)),
        *(line for group in groups for line in (Line("---"), *_group_lines(group, head.language, enums))),
    ]
    blocks = [line for block in head.blocks for line in _block_lines(block)]
    return [Line(text) for text in top], [*(Line(text) for text in _head_lines(head, groups)), *blocks], body


def _shared_enums(points: Iterable[DraftPoint]) -> dict[str, tuple[str, DraftPoint]]:
    """Return the enums of several points as YAML, each with its name and its first point."""
    names = Names()
    of_points = grouped((point.facts.get("enum", ""), point) for point in points)
    return {
        block: (names.give(users[0].name), users[0]) for block, users in of_points.items() if block and len(users) > 1
    }


def _enum_lines(block: str, name: str, point: DraftPoint) -> Iterator[Line]:
    """Yield an enum that several points share; what is wrong with it is a question at the first."""
    yield Line(f"  {scalar(name)}:", point, "enum")
    yield from (Line(f"  {text}", point, "enum") for text in block[1:].split("\n"))


def _head_lines(head: Head, groups: Sequence[DraftGroup]) -> Iterator[str]:
    """Yield the head of the device, with a bus that reaches the spaces of its groups."""
    yield from ("fieldscribe: 1", f"device: {head.device}", "version: 0.1.0")
    yield f"vendor: {_known(head.vendor, 'Unknown', 'who makes it')}"
    yield f"model: {_known(head.model, 'Unknown', 'its name at the maker')}"
    yield f"title: {_known(head.title, head.device.replace('_', ' ').capitalize(), 'what it is')}"
    yield f"family: {head.family}"
    yield from head.facts
    yield "documents:"
    for document in head.documents:
        yield f"  {document.name}:{'' if document.title else '  ' + comment('its title')}"
        yield f"    title: {scalar(document.title or document.file)}"
        yield f"    language: {head.language}"
        if document.has_lines:
            yield f"    file: {scalar(document.file)}"
            yield f"    sha256: {document.sha256}"
        else:
            yield f"    edition: sha256 {document.sha256}"
    if head.bus:
        yield from head.bus
        return
    yield comment("framings, unit addresses and functions, with the most of each request")
    yield from family(head.family).part("description").bus_of({group.space for group in groups}).splitlines()


def _block_lines(block: DraftBlock) -> Iterator[Line]:
    yield from (Line(text, block, block.lines[0].partition(":")[0]) for text in block.lines)
    yield from (Line(comment(question)) for question in block.questions)


def _known(text: str, otherwise: str, question: str) -> str:
    return scalar(text) if text else f"{scalar(otherwise)}  {comment(question)}"


def _group_lines(group: DraftGroup, language: str, enums: Mapping[str, tuple[str, DraftPoint]]) -> Iterator[Line]:
    accesses = [point.facts.get("access", "") for point in group.points]
    access = "" if "" in accesses else max(sorted(set(accesses)), key=accesses.count)
    yield Line(f"group: {scalar(group.name)}")
    yield Line(f"title: {_titles(group.title, language, group.titles)}")
    yield Line(f"space: {group.space}")
    yield Line(f"access: {access}" if access else comment("not every row prints an access; without the key it is rw"))
    yield Line(f"source: {{document: {group.document}, section: {scalar(line(group.section or group.title)[:200])}}}")
    yield from (Line(f"{key}: {value}", group, key) for key, value in group.facts.items())
    references = {_numbering(point.reference[1]): point.reference[0] for point in group.points if point.reference}
    if references:
        numberings = ", ".join(f"{name}: wire + {base}" for name, base in references.items())
        yield Line(f"numbering: {{{numberings}}}")
    yield from (Line(comment(text)) for text in group.comments)
    yield Line("points:")
    for point in group.points:
        for number, (key, text) in enumerate(_point_lines(point, group, access, language, enums)):
            yield Line(f"{'  ' if number else '- '}{text}", point, key)


def _numbering(printed: str) -> str:
    """Return the name of a numbering: references of six digits have one of their own beside those of five."""
    return "long_reference" if len(printed) > 5 else "reference"


def _point_lines(
    point: DraftPoint, group: DraftGroup, access: str, language: str, enums: Mapping[str, tuple[str, DraftPoint]]
) -> Iterator[tuple[str, str]]:
    """Yield the key and the text of each line of a point; its questions come last."""
    if point.code:
        yield "code", f"code: {scalar(point.code)}"
    yield "name", f"name: {scalar(point.name)}"
    yield "title", f"title: {_titles(point.title or point.name, language, point.titles)}"
    for key in sorted(point.facts, key=_KEYS.index):
        value = point.facts[key]
        if key == "enum" and value in enums:
            value = scalar(enums[value][0])
        if not (key == "access" and value == access):
            first, *further = f"{key}: {value}".replace(": \n", ":\n").split("\n")
            yield key, first
            yield from ((key, text) for text in further)
    if point.section and point.section != group.section:
        yield "section", f"section: {scalar(point.section)}"
    if point.line:
        yield "line", f"line: {point.line}"
    if point.reference and point.facts["at"] != "~":
        yield "printed", f"printed: {{{_numbering(point.reference[1])}: {point.reference[1]}}}"
    yield from (("", comment(question)) for question in point.questions)
    yield from (("", f"# {line(remark)}") for remark in point.remarks)
