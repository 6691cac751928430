"""The group of a table that is new: its head as the groups of such tables have theirs."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.tables import yaml_text
from fieldscribe.audit.editions.tables.naming import snake
from fieldscribe.language.nodes import Map, Seq

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.audit.editions.likeness import Described
    from fieldscribe.audit.editions.tables import Seen
    from fieldscribe.audit.editions.tables.drafts import DraftPoint
    from fieldscribe.audit.editions.titles import Titles
    from fieldscribe.resolve.analysis import Analysis

_WORD = re.compile(r"[^\W_]+(?:[.-][^\W_]+)*")
_SHARED = ("space", "numbering", "addressing", "type")
"""What a group of the same kind of table says of its addresses and types, and the new one says, too."""


@dataclass(frozen=True, slots=True)
class NewGroup:
    """The head of a group: its title in the manual's words, section, access; what it shares; where it is to stand."""

    title: str
    section: str
    document: str
    access: str | None
    shared: tuple[str, ...]
    heads: str
    place: str
    in_a_document: bool

    def head(self, titles: Titles) -> list[str]:
        """Its lines down to `points:`."""
        access = self.access and f"access: {self.access}"
        return [
            *(["---"] if self.in_a_document else []),
            f"group: {snake(self.title, 'points')}",
            f"title: {titles.titled(self.title)}",
            *self.shared,
            access or yaml_text.question("access is not printed; without the key it is rw"),
            f"source: {{document: {self.document}, section: {yaml_text.text(self.section)}}}",
            *([f"looked_through: [{{lines: {self.heads}, why: Heads of the table.}}]"] if self.heads else []),
            "points:",
        ]


def new_group(
    subject: Analysis, seen: Seen, points: list[DraftPoint], alike: list[tuple[list[Described], Seen]]
) -> NewGroup:
    """The group of these points; `alike` are described rows of tables with the same heads, the nearest first."""
    heading = _heading(seen)
    title, section = heading, seen.table.section or heading
    document = next(iter(subject.scope.documents))
    shared: tuple[str, ...] = (f"space: {points[0].space}  {yaml_text.question('is it?')}",)
    model = alike[0][0][0].group if alike else None
    if model is not None:
        source = model.get("source", {})
        document = str(source.get("document", document))
        if str(source.get("section")) != alike[0][1].table.section:
            section = _in_place_of(str(source.get("section", "")), _heading(alike[0][1]), heading) or section
        titles = (_titled_like(rows[0].group, other, heading) for rows, other in alike)
        title = next(filter(None, titles), "") or _behind(section, heading) or heading
        shared = tuple(f"{key}: {_flow(model[key])}" for key in _SHARED if key in model)
    accesses = {point.access for point in points}
    access = accesses.pop() if len(accesses) == 1 else None
    place, in_a_document = _place(subject, model)
    above = [row.line for row in seen.table.rows if row.line < points[0].line]
    heads = f"{above[0]}..{above[-1]}" if above[1:] else "".join(map(str, above))
    return NewGroup(title, section, document, access, shared, heads, place, in_a_document)


def _heading(seen: Seen) -> str:
    return seen.columns.title or seen.table.heading


def _titled_like(group: Map, seen: Seen, heading: str) -> str:
    """The title that a heading gives a group, if it has that from the heading of its table."""
    title = group.get("title")
    texts = title.values() if isinstance(title, Map) else [title]
    return next(filter(None, (_in_place_of(str(text), _heading(seen), heading) for text in texts)), "")


def _in_place_of(phrase: str, above: str, heading: str) -> str:
    """The words of a heading that stand where a phrase stands in another: `Group E` for `Group H`; none if unlike."""
    olds, news, wanted = (_WORD.findall(text) for text in (above, heading, phrase))
    for start in range(len(olds) - len(wanted) + 1):
        if wanted and olds[start : start + len(wanted)] == wanted:
            behind = len(olds) - start - len(wanted)
            inside = news[start : len(news) - behind]
            return " ".join(inside) if olds[:start] == news[:start] else ""
    return ""


def _behind(phrase: str, heading: str) -> str:
    """The words of a heading behind a phrase."""
    words, wanted = _WORD.findall(heading), _WORD.findall(phrase)
    places = (start for start in range(len(words)) if words[start : start + len(wanted)] == wanted)
    return " ".join(words[next(places, len(words)) + len(wanted) :])


def _flow(value: object) -> str:
    """A fact of a group in flow style."""
    if isinstance(value, Map):
        return "{" + ", ".join(f"{key}: {_flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, Seq):
        return "[" + ", ".join(map(_flow, value)) + "]"
    return "~" if value is None else yaml_text.printed(str(value))


def _place(subject: Analysis, model: Map | None) -> tuple[str, bool]:
    """Where it is to stand, and whether as a document of a file that has several."""
    header = subject.scope.header
    parts = header.get("parts")
    if isinstance(parts, Seq):
        name = model.file.name.rpartition("/")[2] if model is not None else ""
        number = list(parts).index(name) if name in parts else len(parts) - 1
        span = parts.span(number)
        return f"in a file of its own, named under `parts` below {span.file}:{span.line}:{span.column}", False
    last = next(_groups(subject, header.file.name))
    return f"behind the group at {last}", True


def _groups(subject: Analysis, name: str) -> Iterator[str]:
    """The places of the groups of a file, the last one first."""
    for file in reversed(subject.scope.files):
        if file.file.name == name:
            span = file.span("group") if "group" in file else file.span()
            yield f"{span.file}:{span.line}:{span.column}"
