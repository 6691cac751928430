"""What can be found in a device: its points and all beside them, each with the texts that it is known by."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import NumberError, parse_integer
from fieldscribe.text import line
from fieldscribe.wording import label, title_text

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from fieldscribe.diagnostics import Span
    from fieldscribe.model import Entry
    from fieldscribe.model.numbers import Titles
    from fieldscribe.resolve.analysis import Analysis
    from fieldscribe.resolve.point_facts import PointFacts
    from fieldscribe.resolve.points import ResolvedPoint
    from fieldscribe.resolve.scope import Scope

_OF_FAULTS = ("fault", "error", "trip", "alarm")
"""Names of points whose numbers are numbers of faults have one of these words."""


@dataclass(frozen=True, slots=True)
class Fact:
    """A text that a thing is known by: what it is, where it stands, and the number that it names (of an entry)."""

    kind: str
    text: str
    place: Callable[[], Span]
    number: int | None = None


@dataclass(frozen=True, slots=True)
class Thing:
    """A point, command, message, code, ...: `number` is that of a code; `tells_faults`, if its numbers are faults."""

    device: str
    kind: str
    name: str
    code: str | None
    heading: str
    facts: list[Fact] = field(default_factory=list)
    number: int | None = None
    tells_faults: bool = False


def things_of(subject: Analysis) -> Iterator[Thing]:
    """Everything of a device that has a name."""
    device = str(subject.scope.header["device"])
    for resolved in subject.resolved:
        yield _point(device, subject.scope, resolved)
    for section in ("commands", "messages", "telegrams"):
        for node in subject.scope.listed(section):
            yield _named(device, section[:-1], node)
    for opened in subject.open_frames:
        yield _named(device, "frame", opened.node)
    yield from _codes(device, subject)


def _point(device: str, scope: Scope, resolved: ResolvedPoint) -> Thing:
    point, draft = resolved.point, resolved.facts
    tells_faults = any(word in point.name for word in _OF_FAULTS)
    heading = f"{label(point)}: {line(title_text(point.title))}"
    thing = Thing(device, "point", point.item, point.code, heading, tells_faults=tells_faults)
    facts = thing.facts
    facts += [Fact("name", name, lambda: draft.span("name")) for name in dict.fromkeys((point.item, point.name))]
    facts += [Fact("code", point.code, lambda: draft.span("code"))] if point.code else []
    facts += [Fact("title", text, lambda: draft.span("title")) for text in _texts(point.title)]
    facts += [Fact("old name", name, lambda: draft.span("was")) for name in point.was]
    if point.source.section:
        facts.append(Fact("section", point.source.section, lambda: draft.span("section")))
    facts.append(Fact("group", point.group, draft.span))
    for special in point.specials:
        facts += [Fact("special code", text, draft.span) for text in (special.name, *_texts(special.title))]
    facts += _entries("enum", point.enum.entries if point.enum else (), _named_map(scope, draft, "enum"), draft)
    if point.digits is not None:
        facts += _entries("digit", point.digits.enum.entries, None, draft)
    flags = draft.get("flags")
    for flag in point.flags:
        place = _place_of_flag(flags, flag.name, draft)
        facts += [Fact("flag", text, place) for text in (flag.name, *_texts(flag.title))]
        facts += [Fact("flag", text, place) for entry in flag.values for text in (entry.name, *_texts(entry.title))]
    return thing


def _texts(titles: Titles) -> Iterable[str]:
    return dict.fromkeys(titles.values())


def _entries(kind: str, entries: Iterable[Entry], listed: Map | None, draft: PointFacts) -> Iterator[Fact]:
    keys = {_number(key): key for key in listed or ()}
    for entry in entries:
        key = keys.get(entry.raw)
        place = draft.span if listed is None or key is None else _key_place(listed, key)
        for text in dict.fromkeys((entry.name, *entry.title.values(), entry.quantity or "")):
            if text:
                yield Fact(kind, text, place, entry.raw)


def _key_place(listed: Map, key: str) -> Callable[[], Span]:
    return lambda: listed.key_span(key)


def _named_map(scope: Scope, draft: PointFacts, key: str) -> Map | None:
    """The mapping behind a fact that is one, or the name of a shared one."""
    node = draft.get(key)
    shared = scope.named_enums.get(node) if isinstance(node, str) else node
    return shared if isinstance(shared, Map) else None


def _place_of_flag(flags: object, name: str, draft: PointFacts) -> Callable[[], Span]:
    for key, value in flags.items() if isinstance(flags, Map) else ():
        if value == name or (isinstance(value, Map) and value.get("name") == name):
            return _key_place(flags, key)  # type: ignore[arg-type]  # it is a Map, else there is no key
    return draft.span


def _named(device: str, kind: str, node: Map) -> Thing:
    """A thing with a name and a title."""
    name, titles = str(node["name"]), node.get("title", {})
    texts = [str(text) for text in titles.values()] if isinstance(titles, Map) else []
    thing = Thing(device, kind, name, None, line(f"{kind} {name}: {' / '.join(texts)}".rstrip(": ")))
    facts = thing.facts
    facts.append(Fact("name", name, lambda: node.span("name")))
    facts += [Fact("title", text, lambda: node.span("title")) for text in texts]
    if node.get("section"):
        facts.append(Fact("section", str(node["section"]), lambda: node.span("section")))
    return thing


def _codes(device: str, subject: Analysis) -> Iterator[Thing]:
    """The numbered codes of the protocol: functions, exceptions, tasks, errors, ..."""
    bus = subject.scope.bus
    for codes in subject.scope.family.codes:
        listed = None if bus is None else bus.get(codes.section)
        keys = {_number(key): key for key in listed or ()}
        for code in subject.bus.codes(codes.section):
            heading = line(f"{codes.kind} {keys.get(code.number, code.number)} {code.name}: {title_text(code.title)}")
            place = _key_place(listed, keys[code.number]) if isinstance(listed, Map) else subject.scope.header.span
            thing = Thing(device, codes.kind, code.name, None, heading, number=code.number)
            facts = thing.facts
            facts.append(Fact("name", code.name, place))
            facts += [Fact("title", text, place) for text in _texts(code.title)]
            facts.append(Fact("number", str(code.number), place, code.number))
            yield thing


def _number(key: str) -> int | None:
    try:
        return parse_integer(key)
    except NumberError:
        return None
