"""A draft as text: a description in YAML, with `# ?` wherever a person must decide."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.tables import yaml_text
from fieldscribe.audit.editions.tables.naming import Names, snake

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from fieldscribe.audit.editions.tables import Drafted
    from fieldscribe.audit.editions.tables.drafts import DraftErratum, DraftGroup, DraftPoint

    Titled = Callable[[str], str]

_MEANINGS = ("range_in_units", "resolution", "choices")


@dataclass(frozen=True, slots=True)
class Head:
    """What the draft says of the device, and of the file that it was made from."""

    device: str
    file: str
    sha256: str
    family: str


def draft_text(drafted: Drafted, head: Head | None) -> str:
    """The whole draft: the head of a device if there is one, then a document for each group."""
    points = [point for group in drafted.groups for point in group.points]
    asked = sum(len(point.questions) for point in points)
    said = f"{_counted(len(points), 'point')} from tables, with {_counted(asked, 'question')} at points"
    lines = [f"# A draft of {said}: settle what `# ?` asks, then take it out."]
    if drafted.language != "en":
        lines.append(
            yaml_text.question(f"names and titles are in the manual's language ({drafted.language}): give English ones")
        )
    if not any(point.type for point in points):
        lines.append(yaml_text.question("no types are printed: a point is u16 unless it says otherwise"))
    if head is not None:
        lines += _head(head, drafted)
    for group in drafted.groups:
        lines += ["---"] * (head is not None or group is not drafted.groups[0])
        lines += _group(group, drafted.language)
    return "\n".join(lines) + "\n"


def _counted(count: int, what: str) -> str:
    return f"{count} {what}{'s' * (count != 1)}"


def _head(head: Head, drafted: Drafted) -> list[str]:
    title = yaml_text.text(head.device.replace("_", " ").capitalize())
    return [
        "fieldscribe: 1",
        f"device: {head.device}",
        "version: 0.1.0",
        f"vendor: Unknown  {yaml_text.question('who makes it')}",
        f"model: Unknown  {yaml_text.question('how the maker calls it')}",
        f"title: {title}  {yaml_text.question('what it is')}",
        f"family: {head.family}",
        "documents:",
        f"  manual:  {yaml_text.question('its title')}",
        f"    title: {yaml_text.text(head.file)}",
        f"    language: {drafted.language}",
        f"    file: {yaml_text.text(head.file)}",
        f"    sha256: {head.sha256}",
        f"bus:  {yaml_text.question('framings, unit addresses and functions, with the most of each request')}",
        *(f"  {line}" for line in _bus(head.family, {group.space for group in drafted.groups})),
    ]


def _bus(family_name: str, spaces: set[str]) -> list[str]:
    """What the family starts with; one that has nothing to start with is left to `check`."""
    from fieldscribe.families import family

    bus_of = getattr(family(family_name).part("description"), "bus_of", None)
    return bus_of(spaces).splitlines()[1:] if bus_of is not None else ["units: 1..31"]


def _group(group: DraftGroup, language: str) -> list[str]:
    section = group.section or group.title
    access = _usual([point.access for point in group.points])
    lines = [
        f"group: {group.name}",
        f"title: {_titled(group.title, language)}",
        f"space: {group.space}",
        *([f"access: {access}"] if access else [yaml_text.question("access is not printed; without the key it is rw")]),
        f"source: {{document: manual, section: {yaml_text.text(section)}}}",
    ]
    if group.numberings:
        said = ", ".join(f"{name}: wire + {offset}" for name, offset in group.numberings.items())
        lines.append(f"numbering: {{{said}}}")
    if all(point.at is None for point in group.points):
        lines.append(yaml_text.question("no addresses are printed: which follow from the codes?"))
    lines.append("points:")
    for point in group.points:
        lines += point_lines(point, access, group.section, partial(_titled, language=language))
    errata = [(point, erratum) for point in group.points for erratum in point.errata]
    if errata:
        lines += [yaml_text.question("misprints, as other printed numbers show them: is that so?"), "errata:"]
        names = Names()
        for point, erratum in errata:
            lines += _erratum(point, erratum, names)
    return lines


def _usual(said: list[str | None]) -> str | None:
    known = [access for access in said if access]
    return max(sorted(set(known)), key=known.count) if known else None


def _titled(title: str, language: str) -> str:
    words = yaml_text.text(title)
    return f"{{en: {words}}}" if language == "en" else f"{{en: {words}, {language}: {words}}}"


def point_lines(point: DraftPoint, access: str | None, section: str, titled: Titled) -> list[str]:
    """A point of a group that has this access and section; `titled` writes the titles of a text of the table."""
    lines = list(_facts(point, access, section, titled))
    return [f"- {lines[0]}", *(f"  {line}" for line in lines[1:])]


def _facts(point: DraftPoint, access: str | None, section: str, titled: Titled) -> Iterator[str]:
    """The lines of a point, in the order of our descriptions; its questions come last."""
    if point.code:
        yield f"code: {yaml_text.text(point.code)}"
    yield f"name: {point.name}"
    yield f"title: {titled(point.title or point.name)}"
    yield f"at: {point.shown}"
    if point.index is not None:
        yield f"index: {point.index}"
    if point.bits:
        yield f"bits: {point.bits}"
    if point.access and point.access != access:
        yield f"access: {point.access}"
    if point.reserved:
        yield "reserved: yes"
    else:
        yield from _meaning(point, titled)
    if point.section and point.section != section:
        yield f"section: {yaml_text.text(point.section)}"
    yield f"line: {point.line}"
    if point.lines:
        cited = (f"{key}: {lines[0] if len(lines) == 1 else lines}" for key, lines in point.lines.items())
        yield f"lines: {{{', '.join(cited)}}}"
    if printed := _printed(point):
        yield f"printed: {{{printed}}}"
    yield from map(yaml_text.question, point.questions)


def _meaning(point: DraftPoint, titled: Titled) -> Iterator[str]:
    facts = {
        "type": point.type,
        "length": point.length,
        "words": point.words,
        "range": point.range,
        "range_in_units": point.range_in_units,
        "scale": point.scale,
        "unit": point.unit if point.unit.startswith("°") else point.unit and yaml_text.text(point.unit),
        "default": point.default,
        "default_in_units": point.default_in_units,
    }
    yield from (f"{key}: {value}" for key, value in facts.items() if value)
    if point.special:
        codes = (f"{number}: {_writable(label, titled)}" for number, label in point.special.items())
        yield f"special: {{{', '.join(codes)}}}"
    for key, told in (("enum", point.labels), ("flags", point.flags)):
        if told:
            yield f"{key}:"
            yield from (f"  {line}" for line in _names(told, "title" if key == "flags" else "", titled))


def _names(told: Mapping[int, str] | Mapping[str, str], key: str, titled: Titled) -> Iterator[str]:
    """A line for each number or bit with a name."""
    names = Names()
    for number, label in told.items():
        name, titles = yaml_text.text(names.give(snake(label, "number"), str(number))), titled(label)
        yield f"{number}: {{name: {name}, {f'{key}: {titles}}}' if key else titles[1:]}"


def _writable(label: str, titled: Titled) -> str:
    """A special code that may be written."""
    return f"{{name: {yaml_text.text(snake(label, 'code'))}, writable: yes, {titled(label)[1:]}"


def _printed(point: DraftPoint) -> str:
    """What is printed twice: addresses by numbering, then ranges and steps. Without an address no number of it."""
    parts = []
    for key, values in point.printed.items():
        if point.reserved and key in _MEANINGS:
            continue
        if key not in _MEANINGS and point.at is None:
            continue
        shown = [yaml_text.printed(value) for value in values]
        parts.append(f"{key}: {shown[0] if len(shown) == 1 else '[' + ', '.join(shown) + ']'}")
    return ", ".join(parts)


def _erratum(point: DraftPoint, erratum: DraftErratum, names: Names) -> list[str]:
    return [
        f"- id: {names.give('_'.join((snake(point.code or point.name), erratum.fact or 'scale')))}",
        f"  point: {point.name}",
        f"  line: {point.line}",
        f"  printed: {_told(erratum.fact, erratum.printed)}",
        f"  taken: {_told(erratum.fact, erratum.taken)}",
        f"  why: {yaml_text.text(erratum.why)}",
        "  certainty: likely",
    ]


def _told(fact: str, value: str) -> str:
    return f"{{{fact}: {yaml_text.printed(value)}}}" if fact else yaml_text.text(value)
