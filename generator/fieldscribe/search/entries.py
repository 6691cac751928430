"""The entries of a device that `search` looks through: points, commands, messages, codes, each with its texts."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import partial

from fieldscribe.diagnostics import Span
from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import NumberError, parse_integer
from fieldscribe.model import Entry as EnumEntry
from fieldscribe.model.numbers import Titles
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.points import ResolvedPoint
from fieldscribe.resolve.scope import Scope
from fieldscribe.text import line
from fieldscribe.wording import label, title_text

_FAULT_NAMES = ("fault", "error", "trip", "alarm")
"""A point whose name has one of these words lists faults."""


@dataclass(frozen=True, slots=True)
class Text:
    """A text of an entry: what it is, where it stands, and the number that it names (in an enum)."""

    kind: str
    text: str
    place: Callable[[], Span]
    number: int | None = None


@dataclass(frozen=True, slots=True)
class Entry:
    """A point, command, message, code, ...; `number` is that of a code; `lists_faults` if its numbers are faults."""

    device: str
    kind: str
    name: str
    code: str | None
    heading: str
    texts: list[Text] = field(default_factory=list)
    number: int | None = None
    lists_faults: bool = False


def entries_of(subject: Analysis) -> Iterator[Entry]:
    """Return an entry for everything in a device that has a name."""
    device = str(subject.scope.header["device"])
    for resolved in subject.resolved:
        yield _point(device, subject.scope, resolved)
    for section in ("commands", "messages", "telegrams"):
        for node in subject.scope.listed(section):
            yield _named(device, section[:-1], node)
    for opened in subject.located_frames:
        yield _named(device, "frame", opened.node)
    yield from _codes(device, subject)


def _point(device: str, scope: Scope, resolved: ResolvedPoint) -> Entry:
    point, draft = resolved.point, resolved.facts
    lists_faults = any(word in point.name for word in _FAULT_NAMES)
    heading = f"{label(point)}: {line(title_text(point.title))}"
    of_keys = [
        ("name", "name", dict.fromkeys((point.item, point.name))),
        ("code", "code", [point.code]),
        ("title", "title", _distinct(point.title)),
        ("old name", "was", point.was),
        ("section", "section", [point.source.section]),
    ]
    texts = [Text(kind, text, partial(draft.span, key)) for kind, key, known in of_keys for text in known if text]
    texts.append(Text("group", point.group, draft.span))
    for special in point.specials:
        texts += [Text("special code", text, draft.span) for text in (special.name, *_distinct(special.title))]
    texts += _enum("enum", point.enum.entries if point.enum else (), _enum_map(scope, draft), draft)
    if point.digits is not None:
        texts += _enum("digit", point.digits.enum.entries, None, draft)
    flags = draft.get("flags")
    for flag in point.flags:
        place = _place_of_flag(flags, flag.name, draft)
        texts += [Text("flag", text, place) for text in (flag.name, *_distinct(flag.title))]
        texts += [Text("flag", text, place) for entry in flag.values for text in (entry.name, *_distinct(entry.title))]
    return Entry(device, "point", point.item, point.code, heading, texts, lists_faults=lists_faults)


def _distinct(titles: Titles) -> Iterable[str]:
    return dict.fromkeys(titles.values())


def _enum(kind: str, entries: Iterable[EnumEntry], listed: Map | None, draft: PointFacts) -> Iterator[Text]:
    keys = {_number(key): key for key in listed or ()}
    for entry in entries:
        key = keys.get(entry.raw)
        place = draft.span if listed is None or key is None else partial(listed.key_span, key)
        for text in dict.fromkeys((entry.name, *entry.title.values(), entry.quantity or "")):
            if text:
                yield Text(kind, text, place, entry.raw)


def _enum_map(scope: Scope, draft: PointFacts) -> Map | None:
    """Return the mapping of the point's enum, its own or a shared one; None if there is none."""
    node = draft.get("enum")
    node = scope.named_enums.get(node) if isinstance(node, str) else node
    return node if isinstance(node, Map) else None


def _place_of_flag(flags: object, name: str, draft: PointFacts) -> Callable[[], Span]:
    if isinstance(flags, Map):
        for key, value in flags.items():
            if value == name or (isinstance(value, Map) and value.get("name") == name):
                return partial(flags.key_span, key)
    return draft.span


def _named(device: str, kind: str, node: Map) -> Entry:
    """Return the entry of a command, message, telegram or frame."""
    name, titles = str(node["name"]), node.get("title", {})
    named = [str(text) for text in titles.values()] if isinstance(titles, Map) else []
    heading = line(f"{kind} {name}: {' / '.join(named)}".rstrip(": "))
    texts = [Text("name", name, partial(node.span, "name"))]
    texts += [Text("title", text, partial(node.span, "title")) for text in named]
    if node.get("section"):
        texts.append(Text("section", str(node["section"]), partial(node.span, "section")))
    return Entry(device, kind, name, None, heading, texts)


def _codes(device: str, subject: Analysis) -> Iterator[Entry]:
    """Return the numbered codes of the protocol: functions, exceptions, tasks, errors, ..."""
    bus = subject.scope.bus
    for codes in subject.scope.family.codes:
        listed = None if bus is None else bus.get(codes.section)
        keys = {_number(key): key for key in listed or ()}
        for code in subject.bus.codes(codes.section):
            heading = line(f"{codes.kind} {keys.get(code.number, code.number)} {code.name}: {title_text(code.title)}")
            place = subject.scope.header.span
            if isinstance(listed, Map):
                place = partial(listed.key_span, keys[code.number])
            texts = [Text("name", code.name, place)]
            texts += [Text("title", text, place) for text in _distinct(code.title)]
            texts.append(Text("number", str(code.number), place, code.number))
            yield Entry(device, codes.kind, code.name, None, heading, texts, code.number)


def _number(key: str) -> int | None:
    try:
        return parse_integer(key)
    except NumberError:
        return None
