"""Turns models of SunSpec into the draft of a device: `import sunspec`.

A group of a model becomes a group of the draft, with addresses counted from the start of the model. Facts that a
description cannot express become questions at the point or comments at the group.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import NamedTuple

from fieldscribe.families import families
from fieldscribe.importing.cells import unit_in
from fieldscribe.importing.draft_text import (
    Document,
    DraftGroup,
    DraftPoint,
    Head,
    Names,
    WholeDraft,
    named_numbers,
    scalar,
    snake,
)
from fieldscribe.importing.sunspec.models import Group, Model, Point
from fieldscribe.text import counted
from fieldscribe.wording.numbers import number_text

_TYPES = {
    **{f"int{bits}": f"s{bits}" for bits in (16, 32, 64)},
    **{f"{name}{bits}": f"u{bits}" for name in ("uint", "enum", "bitfield", "raw") for bits in (16, 32, 64)},
    "float32": "f32",
    "float64": "f64",
    "count": "u16",
}
"""The types of descriptions for SunSpec types of plain numbers."""
_FORMATS = {
    "sunssf": "{type: s16, range: -%d..%d}",
    "acc16": "{type: u16, special: {0FFFFh: ~, 0: {name: not_accumulated, no_value: yes}}}",
    "acc32": "{type: u32, special: {0FFFFFFFFh: ~, 0: {name: not_accumulated, no_value: yes}}}",
    "acc64": "{type: u64, special: {0FFFFFFFFFFFFFFFFh: ~, 0: {name: not_accumulated, no_value: yes}}}",
}
"""Those that are more."""
MOST_EXPONENT = 10
"""The scale factors of SunSpec are exponents from -10 to 10."""
_NOT_IMPLEMENTED = {
    **{f"u{bits}": f"0{'F' * (bits // 4)}h" for bits in (16, 32, 64)},
    **{f"s{bits}": f"8{'0' * (bits // 4 - 1)}h" for bits in (16, 32, 64)},
    "f32": "7FC00000h",
    "f64": "7FF8000000000000h",
}
"""The raw numbers of points that a device does not implement, by type."""
_OF_TYPES = {
    **{
        kind: f"{{special: {{{code}: {{name: not_implemented, no_value: yes}}}}}}"
        for kind, code in _NOT_IMPLEMENTED.items()
    },
    "text": "{padding: 00h}",
}
"""The facts that all points of a type share."""
_BYTES = {"eui48": ("eui48", 4), "ipaddr": ("ipv4", 2), "ipv6addr": ("ipv6", 8)}
"""Types that are bytes: their notation, and the number of their words. Of an eui48 the first word is empty."""
_WORDS = {"16": 1, "32": 2, "64": 4}
_OTHER_UNITS = (
    "Secs=s Sec=s Tms=s Tmh=h Tmd=d mSecs=ms C=°C Pct=% Degrees=° deg=° Var=var Varh=varh AH=Ah kAH=kAh WH=Wh "
    "mps=m/s meters=m ohms=ohm HPa=hPa kO=kohm W/m2=W/m² W/m^2=W/m² Vm=V/m"
)
_UNITS = dict(pair.split("=") for pair in _OTHER_UNITS.split())
"""Units that SunSpec spells differently."""
_NO_UNITS = frozenset(("cos()", "PF", "SF", "text"))
_LONGEST_NOTE, _LONGEST_UNIT = 300, 20


class Facts:
    """States the facts of points, and shared facts; `exponents` bounds the magnitude of scale factors."""

    def __init__(self, exponents: int) -> None:
        self._units: dict[str, str] = {}
        self._formats = _FORMATS | {"sunssf": _FORMATS["sunssf"] % (exponents, exponents)}

    def state(self, point: Point, drafted: DraftPoint, scope: Mapping[str, DraftPoint]) -> None:
        """State the facts of a point."""
        facts, lost = drafted.facts, drafted.questions
        facts["access"] = "rw" if point.access == "RW" else "r"
        if point.type == "pad":
            facts["reserved"] = "yes"
            return
        if point.is_static:
            facts["changes"] = "never"
        note = f"{'Mandatory. ' if point.is_mandatory else ''}{point.text}".strip()
        if note:
            facts["note"] = note_of(note)
        _state_type(point, drafted)
        if point.factor is not None:
            _state_factor(point, drafted, scope)
        if len(point.unit) > _LONGEST_UNIT:
            lost.append(f"unit: {point.unit}")
        elif point.unit and point.unit not in _NO_UNITS:
            facts["unit"] = self._unit(point.unit)
        if point.symbols and point.type.startswith("bitfield"):
            facts["flags"] = _labels(point, "title: ")
        elif point.symbols and point.type.startswith("enum"):
            facts["enum"] = _labels(point, "en: ")
        elif point.symbols:
            lost.append(f"symbols of a {point.type}: {', '.join(symbol.name for symbol in point.symbols)}")

    def _unit(self, text: str) -> str:
        """Return the symbol of a unit; one that is not shipped is declared in the head."""
        text = _UNITS.get(text, text)
        known = unit_in(text)
        return scalar(known) if known else self._units.setdefault(text, scalar(text))

    def shared(self, points: Iterable[DraftPoint]) -> Iterator[str]:
        """Yield shared facts as lines of the head: facts of types, formats, and units that are not shipped."""
        stated = [point.facts for point in points]
        formats = {each["format"] for each in stated if "format" in each}
        types = {each.get("type") for each in stated} | {_FORMATS[name][7:10] for name in formats}
        if types & _OF_TYPES.keys():
            yield from ("types:", *(f"  {kind}: {fact}" for kind, fact in _OF_TYPES.items() if kind in types))
        if formats:
            yield from ("formats:", *(f"  {name}: {self._formats[name]}" for name in sorted(formats)))
        if self._units:
            yield "units:"
            yield from (f"  {unit}: {{name: {unit}, quantity: as SunSpec has it}}" for unit in self._units.values())


def empty_words(point: Point) -> int:
    """Return how many words precede the contents of a point."""
    return int(point.type == "eui48" and point.size == _BYTES["eui48"][1])


def _state_type(point: Point, drafted: DraftPoint) -> None:
    facts = drafted.facts
    kind = _TYPES.get(point.type)
    if kind and _WORDS[kind[1:]] == point.size:
        facts["type"] = kind
    elif point.type in _FORMATS and _WORDS.get(point.type[3:], 1) == point.size:
        facts["format"] = point.type
    elif point.type == "string":
        facts |= {"type": "text", "characters": str(point.size * 2)}
    elif point.type in _BYTES and _BYTES[point.type][1] == point.size:
        facts |= {"type": "bytes", "notation": _BYTES[point.type][0]}
    else:
        facts |= {"type": "~", "length": str(point.size)}
        drafted.questions.append(f"type {point.type}: {counted(point.size, 'word')}")


def _state_factor(point: Point, drafted: DraftPoint, scope: Mapping[str, DraftPoint]) -> None:
    """State the scale: by a point that holds an exponent of 10, or by the exponent itself."""
    factor = point.factor
    if isinstance(factor, int) and abs(factor) <= MOST_EXPONENT:
        drafted.facts["scale"] = f"value = raw * {number_text(Fraction(10) ** factor)}"
    elif isinstance(factor, str) and factor in scope:
        drafted.facts["scale"] = f"value = raw * 10 ** {scope[factor].name}"
    else:
        drafted.facts["scale"] = "~"
        drafted.questions.append(f"scale factor: {factor}")


def _labels(point: Point, key: str) -> str:
    """Return the symbols of a point as the block of its enum or flags."""
    titles = (symbol.text or symbol.name.replace("_", " ").capitalize() for symbol in point.symbols)
    return named_numbers(
        (symbol.number, symbol.name, str(symbol.number), f"{key}{scalar(title)}")
        for symbol, title in zip(point.symbols, titles, strict=True)
    )


def note_of(text: str) -> str:
    """Return a note as YAML, cut off if it is long."""
    return scalar(text if len(text) <= _LONGEST_NOTE else f"{text[:_LONGEST_NOTE]} …")


_FOUND = "found: {models: {text: SunS, at: [40000, 0, 50000], then: [id, length]}}"
_LONGEST_TITLE, _LONGEST_NAME, _LONGEST_CODE = 120, 78, 40


def draft_models(
    models: Sequence[Model], device: str, most: int, counts: Mapping[str, int], exponents: int = MOST_EXPONENT
) -> WholeDraft:
    """Return the draft of a device with these models, with the first `most` elements of each repetition.

    `counts` are the values of counting points of the device, by name; with them, everything after counted elements has
    a fixed place. Scale factors are within -`exponents`..`exponents`.
    """
    names = Counter(name for model in models for name in _names(model.group))
    drafter = _Drafter(names, most, counts, Facts(exponents))
    for model in models:
        drafter.add_model(model)
    documents = [
        Document(
            model.file,
            model.sha256,
            f"model_{model.id}",
            f"SunSpec model {model.id}, {_title(model.group)} ({model.file})",
            has_lines=False,
        )
        for model in models
    ]
    title = f"SunSpec model{'s' if len(models) > 1 else ''} {', '.join(str(model.id) for model in models)}"
    family = next(family for family in families() if "holding" in family.spaces)
    shared = drafter.facts.shared(point for group in drafter.groups for point in group.points)
    facts = ["certainty: imported", _FOUND, *shared]
    head = Head(device, documents, family.name, title=title[:_LONGEST_TITLE], facts=facts, kind="models of SunSpec")
    return WholeDraft(drafter.groups, head)


def _names(group: Group) -> list[str]:
    """Return the names of all points of a group and those within."""
    return [point.name for point in group.points] + [name for inner in group.groups for name in _names(inner)]


def _within(group: Group) -> Iterator[Group]:
    for inner in group.groups:
        yield inner
        yield from _within(inner)


def _title(group: Group) -> str:
    return (group.label or group.name)[:_LONGEST_TITLE]


def _snake(title: str, otherwise: str) -> str:
    """Return a title as a name with all its words; `MaxChaRte` has three."""
    return snake(re.sub("(?<=[a-z]{2})(?=[A-Z])", " ", title), otherwise, articles=True)


def _repeats(group: Group) -> bool:
    return group.count != 1 or any(map(_repeats, group.groups))


class _Words(NamedTuple):
    """A number of words: a fixed number plus multiples of counting points of the model."""

    fixed: int
    counted: Mapping[str, int] = {}

    def plus(self, other: _Words, times: int = 1) -> _Words:
        """Return the sum with a multiple of the other."""
        counted = Counter(self.counted)
        counted.update({name: factor * times for name, factor in other.counted.items()})
        return _Words(self.fixed + other.fixed * times, {name: factor for name, factor in counted.items() if factor})


@dataclass(frozen=True, slots=True)
class _Place:
    """The place of a group: its start, counted from the start of the model; None if only the device knows it.

    `path` has the enclosing groups, `scope` all visible points. `repeats` are the facts that repeat its points,
    `shared` the facts of all points of the group, `suffix` ends their names; `text` describes an enclosing group that
    has no points.
    """

    model: Model
    start: _Words | None
    path: tuple[str, ...] = ()
    scope: Mapping[str, DraftPoint] = field(default_factory=dict)
    repeats: Mapping[str, str] = field(default_factory=dict)
    shared: Mapping[str, str] = field(default_factory=dict)
    suffix: str = ""
    text: str = ""

    def after(self, words: _Words | None, times: int = 1) -> _Words | None:
        """Return the start of the words after a multiple of these."""
        return None if self.start is None or words is None else self.start.plus(words, times)

    def only_while(self, condition: str) -> Mapping[str, str]:
        """Return the shared facts of points that exist only while this is true."""
        return {**self.shared, "when": " and ".join(filter(None, (self.shared.get("when"), condition)))}


class _Drafter:
    """Drafts models one after another."""

    def __init__(self, names: Counter[str], most: int, counts: Mapping[str, int], facts: Facts) -> None:
        self.groups: list[DraftGroup] = []
        self.facts = facts
        self._doubles = {name for name, times in names.items() if times > 1}
        self._group_names, self._names = Names(), Names()
        self._most, self._counts = most, counts
        self._counting: set[str] = set()
        self._held: Mapping[str, int] = {}

    def add_model(self, model: Model) -> None:
        """Draft a model; repeated points exist only while the counting points hold the numbers that the user gave."""
        counting = {inner.count for inner in _within(model.group)}
        self._counting = {point.name for point in model.group.points if point.name in counting and point.size == 1}
        self._held = {name: number for name, number in self._counts.items() if name in self._counting}
        self._add(model.group, _Place(model, _Words(model.header)))

    def _add(self, group: Group, place: _Place) -> None:
        """Draft a group and those within."""
        path, number = (*place.path, group.name), str(place.model.id)
        draft = DraftGroup(_title(group), "holding", "" if not place.path else ".".join(path)[:_LONGEST_TITLE])
        draft.name = self._group_names.give(_snake("_".join(path), "model"), number)
        draft.document = f"model_{number}"
        place = self._repeated(group, place, draft)
        text = " ".join(filter(None, (place.text, group.text)))
        draft.facts |= {"block": number, **({"note": note_of(text)} if text else {}), **place.shared}
        if place.start is not None and place.start.counted:
            counted = [f"{place.scope[name].name} * {factor}" for name, factor in place.start.counted.items()]
            draft.facts["base"] = " + ".join(counted)
        words, scope = 0, dict(place.scope)
        ending = _snake(re.sub(r"\.\d+", "", "_".join(path[1:])), "group") if place.path else ""
        for point in group.points:
            drafted = DraftPoint(0, "holding", (point.label or point.name)[:_LONGEST_TITLE], point.name)
            if point.name in self._doubles or place.suffix:
                code = ".".join((number, *path[1:], point.name))
                drafted.code = code if len(code) <= _LONGEST_CODE else f"{number}.{point.name}"
            name = _snake(drafted.title, "point") + place.suffix
            drafted.name = self._names.give(name, ending[: _LONGEST_NAME - len(name)].rstrip("_"), number)
            if place.start is None:
                drafted.questions.append("place: it lies after elements whose number a point holds; `--count` says it")
            else:
                drafted.facts |= {"at": str(place.start.fixed + words + empty_words(point)), **place.repeats}
            words += point.size
            scope[point.name] = drafted
            draft.points.append(drafted)
        for point, drafted in zip(group.points, draft.points, strict=True):
            self.facts.state(point, drafted, scope)
        self.groups += [draft] if group.points else []
        start = place.after(_Words(words))
        within = replace(place, path=path, scope=scope, start=start, text="" if group.points else text)
        if not place.path and self._held:
            holds = [f"{scope[name].name} == {number}" for name, number in self._held.items()]
            within = replace(within, shared={"when": " and ".join(holds)})
        for inner in group.groups:
            for element, at in self._elements(inner, within):
                self._add(element, at)
            within = replace(within, start=within.after(self._all_words(inner)))

    def _elements(self, group: Group, place: _Place) -> Iterator[tuple[Group, _Place]]:
        """Yield a group and its place; each element separately if a point gives the size of the elements."""
        words, counter = self._words(group), place.scope.get(str(group.count))
        if words is None or not words.counted or counter is None or place.suffix or place.repeats:
            yield group, place
            return
        for number in range(1, (self._number(group) or self._most) + 1):
            shared, start = place.only_while(f"{counter.name} >= {number}"), place.after(words, number - 1)
            named = replace(group, count=1, name=f"{group.name}.{number}")
            yield named, replace(place, shared=shared, start=start, suffix=f"_set_{number}")

    def _repeated(self, group: Group, place: _Place, draft: DraftGroup) -> _Place:
        """Return the place of a group with its repetition; the draft has a comment if that cannot be expressed."""
        count, words = group.count, self._words(group)
        if count == 1:
            return place
        times = "to the end of the model" if count == 0 else f"{count} times"
        plural, singular = ("sets", "set") if any(map(_repeats, group.groups)) else ("indices", "index")
        counter = place.scope.get(str(count))
        known = words is not None and not words.counted and (counter is not None or not isinstance(count, str))
        if place.start is None or words is None or not known or plural in place.repeats:
            draft.comments.append(f"repeats: {times}; here is the first")
            return place
        shared = dict(place.shared)
        shared["addressing"] = f"{shared.get('addressing', 'number')} + ({singular} - 1) * {words.fixed}"
        number = self._number(group)
        if number is None:
            repeats = {plural: "to end" if counter is None else f"1..{counter.name}", "most": str(self._most)}
        else:
            repeats = {plural: str(number)}
        return replace(place, repeats={**place.repeats, **repeats}, shared=shared)

    def _number(self, group: Group) -> int | None:
        """Return the number of elements of a group; None if the device decides."""
        return self._held.get(group.count) if isinstance(group.count, str) else group.count or None

    def _words(self, group: Group) -> _Words | None:
        """Return the number of words of an element of a group; None if nothing counts them."""
        words = _Words(sum(point.size for point in group.points))
        for inner in group.groups:
            inside = self._all_words(inner)
            if inside is None:
                return None
            words = words.plus(inside)
        return words

    def _all_words(self, group: Group) -> _Words | None:
        """Return the number of words of all elements of a group; None if nothing counts them."""
        number, words = self._number(group), self._words(group)
        if words is None or number is not None:
            return None if words is None or number is None else _Words(0).plus(words, number)
        is_counted = not words.counted and group.count in self._counting
        return _Words(0, {str(group.count): words.fixed}) if is_counted else None
