"""The call that creates a point, with all facts about it, and the class of points: profile, variants, commands.

The Python and TypeScript targets write these calls as text, laid out once for many points and filled with the texts of
each; `live` evaluates them. Docstrings have sentences about points, named numbers and flags.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

from fieldscribe.conditions import absent
from fieldscribe.model import Command, Device, Entry, Flag, Point, SteppedCommand, Variant
from fieldscribe.targets.runtime_calls import Call, Hex, Leaf, Name, Node, PointName, Scope, call, family_calls
from fieldscribe.targets.runtime_calls.point_expressions import (
    addresses_of,
    allowed,
    form,
    is_limited,
    number,
    place,
    place_of_command,
    step_of,
    tests_of,
)
from fieldscribe.wording import codes_text, condition_text, overflow_texts, range_text, write_texts

_WITH_RANGE = ("scaled", "float", "integer")
"""The forms whose docstring says the range."""

_KEEPS = {"no": "Lost at power-off", "yes": "Each write wears the memory"}
"""What happens to a written value."""
_MOST_ENDS = 16
"""The ends of at most this many intervals are fields."""
_SINGLE = 4
"""The fields after these have several texts each."""

Encoders = tuple[Callable[[str], str], Callable[[Leaf], str]]
"""How a language writes a string, and how a string or number."""
_Facts = Iterator[tuple[str, Node]]


class PointFields(NamedTuple):
    """The facts of one point, as values or placeholders for them; an absent fact is empty (default and code: None).

    `numbers` is the class of its numbers or flags. `ends` are the bounds of its intervals.
    """

    group: Node
    code: Node
    default: Node
    numbers: str
    addresses: tuple[Node, ...]
    references: tuple[Node, ...]
    ends: tuple[Node, ...]


def fields_of(point: Point, scope: Scope) -> PointFields:
    """Return the fields of a point as values."""
    default = None if point.default is None else number(point.default)
    references = tuple(point.place.references.values())
    return PointFields(
        point.group, point.code or None, default, numbers_of(point, scope), point.addresses, references, ()
    )


def attribute_of(point: Point, scope: Scope) -> str:
    """Return the attribute of a point; one that only a variant has is named after its item."""
    return scope.attribute(point.name if point.variant is None else point.item)


def old_attributes(point: Point, scope: Scope) -> tuple[str, ...]:
    """Return the old attributes of a point; those of one that only a variant has belong to all of its name."""
    return () if point.variant is not None else tuple(map(scope.attribute, point.was))


def variants_call(points: Mapping[Variant, Point], scope: Scope) -> Call:
    """Return the call that creates the attribute of points that have one name in different variants."""
    axis = next(iter(points)).axis
    chosen = {variant.value: Name(attribute_of(point, scope)) for variant, point in points.items()}
    return call(scope.runtime("ByVariant"), axis, chosen)


def old_names_of(points: Mapping[Variant, Point]) -> tuple[str, ...]:
    """Return the old attributes of points that have one name in different variants."""
    return tuple(dict.fromkeys(name for point in points.values() for name in point.was))


def call_of(point: Point, fields: PointFields, scope: Scope) -> Call:
    """Return the call that creates a point."""
    maker = scope.runtime(family_calls(scope.device).maker(point))
    return call(maker, form(point, fields.numbers, scope), **dict(_facts(point, fields, scope)))


def numbers_of(point: Point, scope: Scope) -> str:
    """Return the class of a point's numbers or flags; empty if there is none."""
    return scope.names.word_class(point) if point.form == "flags" else scope.names.numbers_class(point)


def keeps(point: Point, scope: Scope) -> str:
    """Return how a written value is kept; a command by its attribute."""
    return scope.commands.get(point.keeps or "", point.keeps or "")


def places(point: Point, addresses: Iterable[Node], scope: Scope) -> _Facts:
    """Yield where the point is read, and where else it is written."""
    yield "at", place(point, addresses, scope)
    if point.write_place is not None:
        yield "write_at", place(point, addresses_of(point.write_place.addresses, point.space), scope)


def _facts(point: Point, fields: PointFields, scope: Scope) -> _Facts:
    yield from _identity(point, fields, scope)
    if point.unit.symbol and not point.epoch:
        yield "unit", point.unit.symbol
    if point.display is not None:
        yield "display", point.display
    if is_limited(point):
        yield "allowed", allowed(point, fields.ends, scope)
    if fields.default is not None:
        yield "default", fields.default
    if point.fixed is not None:
        yield "fixed", (Hex(point.fixed.mask), Hex(point.fixed.bits))
    if point.changes in ("never", "rarely"):
        yield "changes", point.changes
    if point.changes_with:
        yield "changes_with", tuple(map(PointName, point.changes_with))
    if point.writable:
        yield from _writing(point, scope)
    if point.selects:
        yield "selects", tuple((PointName(name), raw) for name, raw in point.selects)
    yield from _existence(point, scope)


def _writing(point: Point, scope: Scope) -> _Facts:
    """Yield the facts about writing."""
    if point.conditions:
        yield "conditions", point.conditions
    if point.takes_effect:
        yield "takes_effect", point.takes_effect
    if point.write_with:
        yield "write_with", tuple(map(PointName, point.write_with))
    if point.keeps:
        yield "keeps", keeps(point, scope)


def _identity(point: Point, fields: PointFields, scope: Scope) -> _Facts:
    """Yield the places of the point on the wire, and its names in the manual."""
    yield from places(point, fields.addresses, scope)
    if point.bits is not None:
        yield "bits", point.bits
    yield "group", fields.group
    if fields.code is not None:
        yield "code", fields.code
    if fields.references:
        yield "references", dict(zip(point.references, fields.references, strict=True))


def _existence(point: Point, scope: Scope) -> _Facts:
    """Yield the facts that decide in which devices the point exists."""
    if point.variant is not None:
        yield "variant", (point.variant.axis, point.variant.value)
        yield "name", point.name
    others = set() if point.when is None else {*point.when.names}
    if choice := _only_for(point, scope.device.variants):
        yield "only_for", choice
        others.remove(choice[0])
    if others or point.since is not None or point.until is not None or point.to_end:
        yield "uncertain", True  # another axis, a point, the firmware or the length of a block matters too
    if point.when is not None and not scope.device.variants.keys() >= {*point.when.names}:
        yield "when", tests_of(point.when)


def _only_for(point: Point, variants: Mapping[str, tuple[str, ...]]) -> tuple[str, tuple[str, ...]] | None:
    """Return the first axis that decides about the point's existence, and the values for which it can exist."""
    for axis in () if point.when is None else point.when.names:
        values = variants.get(axis, ())
        left = tuple([value for value in values if not absent(point.when, {**variants, axis: (value,)})])
        if left != values:
            return axis, left
    return None


def texts_of(point: Point, numbers: str, ends: tuple[str, ...], encoders: Encoders) -> tuple[str, ...]:
    """Return the texts of `PointFields`, one after the other."""
    string, leaf = encoders
    return (
        string(point.terms.group),
        string(point.code) if point.code else "",
        "" if point.default is None else leaf(number(point.default)),
        numbers,
        *map(leaf, addresses_of(point.place.addresses, point.terms.space)),
        *map(leaf, point.place.references.values()),
        *ends,
    )


def end_texts(point: Point, leaf: Callable[[Leaf], str]) -> tuple[str, ...]:
    """Return the ends of the intervals of raw numbers, if they are fields."""
    limits = point.allowed
    if point.form == "float" or limits.moves or len(limits.intervals) * 2 > _MOST_ENDS or not is_limited(point):
        return ()
    return tuple([leaf(end) for interval in limits.fixed for end in interval])


def fields_of_texts(texts: Sequence[str], point: Point) -> PointFields:
    """Return the fields of a point that have these texts, or placeholders for them."""
    fields = tuple(map(Name, texts))
    addresses = _SINGLE + len(point.place.addresses)
    references = addresses + len(point.place.references)
    group, code, default, numbers = fields[:_SINGLE]
    several = fields[_SINGLE:addresses], fields[addresses:references], fields[references:]
    return PointFields(group, code or None, default or None, numbers, *several)


# Texts of docstrings.


def limits_text(point: Point, scope: Scope) -> str:
    """Return what may be written; empty for a point whose values have no range."""
    return range_text(point, scope.lowered.points) if point.writable and point.form in _WITH_RANGE else ""


def remarks_text(point: Point, scope: Scope, keep: str) -> str:
    """Return sentences about a point; `keep` is the argument with which a program keeps a value over power-off."""
    text = ""
    if point.when is not None:
        text += f" Exists only when {condition_text(point.when, scope.lowered.points)}."
    if point.conditions and point.writable:
        text += f" To write it takes: {', '.join(condition.replace('_', ' ') for condition in point.conditions)}."
    if point.keeps and point.writable:
        text += f" {_kept(point, scope, keep)}."
    text += "".join(f" {each[0].upper()}{each[1:]}." for each in write_texts(point))
    if point.specials:
        text += f" {codes_text(point)}."
    text += "".join(f" O{each[1:]}." for each in overflow_texts(point))
    return text


def sentence(text: str) -> str:
    """Return the text with a full stop at its end."""
    return text if text.endswith(".") else f"{text}."


def command_text(command: Command | SteppedCommand) -> str:
    """Return sentences about a command."""
    text = sentence(command.title["en"])
    wears = command.wears if isinstance(command, Command) else None
    return f"{text} The memory is rated for {wears} of them." if wears else text


def entry_text(entry: Entry) -> str:
    """Return a sentence about a named number; empty if its name says it all."""
    if entry.quantity:
        return sentence(f"{entry.title['en']} ({entry.quantity})")
    return "" if _says_the_same(entry.title["en"], entry.name) else sentence(entry.title["en"])


def flag_text(flag: Flag) -> str:
    """Return sentences about a flag, also whether it is true while its bit is 0; empty if its name says it all."""
    meaning = "; ".join(f"{value.raw}: {value.title['en']}" for value in flag.values) if flag.width == 1 else ""
    if not meaning and flag.active and _says_the_same(flag.title["en"], flag.name):
        return ""
    text = sentence(f"{flag.title['en']} ({meaning})" if meaning else flag.title["en"])
    return text if flag.active else f"{text} True while the bit is 0."


def _says_the_same(title: str, name: str) -> bool:
    return title.casefold() == name.replace("_", " ")


def _kept(point: Point, scope: Scope, keep: str) -> str:
    if point.keeps == "choice":
        return f"{keep} keeps it and wears the EEPROM"
    return _KEEPS.get(point.keeps or "") or f"`{keeps(point, scope)}.send()` keeps it"


# The class of points.


def members(device: Device) -> dict[str, list[Point | dict[Variant, Point]]]:
    """Return the points that have attributes, group by group; after them those that have one name in variants."""
    groups: dict[str, list[Point | dict[Variant, Point]]] = {group.name: [] for group in device.groups}
    by_name: dict[str, dict[Variant, Point]] = {}
    for point in device.points:
        group = groups.setdefault(point.terms.group, [])
        if not point.terms.generated:
            continue
        group.append(point)
        if point.variant is not None:
            by_name.setdefault(point.name, {})[point.variant] = point
    for same in by_name.values():
        groups[next(iter(same.values())).group].append(same)
    return groups


def class_facts(scope: Scope) -> Mapping[str, Node]:
    """Return the class variables by name, in order."""
    device, family = scope.device, family_calls(scope.device)
    facts: dict[str, Node] = {"PROFILE": family.profile(device, scope), **family.facts(device, scope)}
    if device.variants:
        facts["VARIANTS"] = device.variants
    if device.identifications:
        facts["IDENTIFICATIONS"] = _identifications(scope)
    documented = [point for point in device.points if not point.terms.generated]
    if documented:
        facts["DOCUMENTED"] = {scope.attribute(point.item): _documented(point, scope) for point in documented}
    return facts


def readable_groups(device: Device) -> tuple[str, ...]:
    """Return the groups with points to read."""
    return tuple(dict.fromkeys([point.group for point in device.points if point.generated and point.readable]))


def commands_of(scope: Scope) -> Iterator[tuple[Command | SteppedCommand, Call]]:
    """Yield the commands, each with the call that creates it."""
    for command in scope.device.commands:
        facts: dict[str, Node] = {"at": place_of_command(command, scope)}
        if command.value is not None:
            facts["value"] = command.value
        yield command, call(scope.runtime("Command"), **facts)
    for stepped in scope.device.stepped_commands:
        yield stepped, _stepped(stepped, scope)


def _stepped(command: SteppedCommand, scope: Scope) -> Call:
    facts: dict[str, Node] = {}
    if command.arguments:
        facts["arguments"] = command.arguments
    if command.run in ("first", "before write"):
        facts["run"] = command.run
    if command.every is not None:
        facts["every"] = number(Fraction(command.every, 1000), binary=True)
    return call(scope.runtime("SteppedCommand"), *(step_of(step, scope) for step in command.steps), **facts)


def _documented(point: Point, scope: Scope) -> Call:
    """Return why the point has no attribute, and the addresses of its words, if they can be reached."""
    facts: dict[str, Node] = {}
    if point.raw_only:
        facts.update(places(point, addresses_of(point.addresses, point.space), scope))
    if point.code:
        facts["code"] = point.code
    return call(scope.runtime("Documented"), point.reason or "no reason given", **facts)


def _identifications(scope: Scope) -> Node:
    """Return what identifies the device and its variants."""
    made = scope.runtime("Identification")
    return tuple(
        call(
            made,
            PointName(each.point),
            (*each.raws, *each.texts),
            *(() if each.variant is None else ((each.variant.axis, each.variant.value),)),
        )
        for each in scope.device.identifications
    )
