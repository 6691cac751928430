"""Turns models of SunSpec into the draft of a device: `import sunspec`.

A group of a model is a group of the draft, and its places are counted from the model's start. What a description
cannot say stays as a question at the point or at the group.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import NamedTuple

from fieldscribe.families import families
from fieldscribe.importing.cells import unit_in
from fieldscribe.importing.draft_text import Document, DraftGroup, DraftPoint, Head, Names, scalar, snake
from fieldscribe.importing.sunspec.models import Group, Model, Point
from fieldscribe.wording.exact import number_text

_TYPES = {
    **{f"int{bits}": f"s{bits}" for bits in (16, 32, 64)},
    **{f"{name}{bits}": f"u{bits}" for name in ("uint", "enum", "bitfield", "raw") for bits in (16, 32, 64)},
    "float32": "f32",
    "float64": "f64",
    "count": "u16",
}
"""The types of descriptions for those of SunSpec that are plain numbers."""
_FORMATS = {
    "sunssf": "{type: s16, range: -10..10}",
    "acc16": "{type: u16, special: {0FFFFh: ~, 0: {name: not_accumulated, no_value: yes}}}",
    "acc32": "{type: u32, special: {0FFFFFFFFh: ~, 0: {name: not_accumulated, no_value: yes}}}",
    "acc64": "{type: u64, special: {0FFFFFFFFFFFFFFFFh: ~, 0: {name: not_accumulated, no_value: yes}}}",
}
"""Those that are more."""
_NOT_IMPLEMENTED = {
    **{f"u{bits}": f"0{'F' * (bits // 4)}h" for bits in (16, 32, 64)},
    **{f"s{bits}": f"8{'0' * (bits // 4 - 1)}h" for bits in (16, 32, 64)},
    "f32": "7FC00000h",
    "f64": "7FF8000000000000h",
}
"""What a device holds in a point that it does not have, by type."""
_OF_TYPES = {
    **{
        kind: f"{{special: {{{code}: {{name: not_implemented, no_value: yes}}}}}}"
        for kind, code in _NOT_IMPLEMENTED.items()
    },
    "text": "{padding: 00h}",
}
"""The facts that all points of a type share."""
_WORDS = {"16": 1, "32": 2, "64": 4}
_OTHER_UNITS = (
    "Secs=s Sec=s Tms=s Tmh=h Tmd=d mSecs=ms C=°C Pct=% Degrees=° deg=° Var=var Varh=varh AH=Ah kAH=kAh WH=Wh "
    "mps=m/s meters=m ohms=ohm HPa=hPa kO=kohm W/m2=W/m² W/m^2=W/m² Vm=V/m"
)
_UNITS = dict(pair.split("=") for pair in _OTHER_UNITS.split())
"""Units that SunSpec writes otherwise."""
_NO_UNITS = frozenset(("cos()", "PF", "SF", "text"))
_LONGEST_NOTE, _LONGEST_TITLE, _LONGEST_UNIT = 300, 120, 20


class Imported(NamedTuple):
    """The drafted groups and the head, and how many points of the models are whole in them."""

    groups: list[DraftGroup]
    head: Head

    @property
    def points(self) -> list[DraftPoint]:
        """The drafted points."""
        return [point for group in self.groups for point in group.points]

    def lost(self) -> Counter[str]:
        """Return what is not carried, each with how often."""
        questions = [question for point in self.points for question in point.questions]
        comments = [comment for group in self.groups for comment in group.comments]
        return Counter(text.partition(":")[0] for text in (*questions, *comments))


def draft_models(models: Sequence[Model], device: str, most: int) -> Imported:
    """Return the draft of a device with these models, each with the first `most` elements of what repeats."""
    drafter = _Drafter(
        Counter(point.name for model in models for point in _points(model.group) if point.name not in ("ID", "L")), most
    )
    for model in models:
        drafter.add(model)
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
    title = f"SunSpec {counted_models(models)}"
    family = next(family for family in families() if "holding" in family.spaces)
    head = Head(device, documents, family.name, title=title, facts=list(drafter.head_facts()), kind="models of SunSpec")
    return Imported(drafter.groups, head)


def counted_models(models: Sequence[Model]) -> str:
    """Return the numbers of the models as a phrase."""
    return f"model{'s' if len(models) > 1 else ''} {', '.join(str(model.id) for model in models)}"


def _points(group: Group) -> Iterator[Point]:
    yield from group.points
    for inner in group.groups:
        yield from _points(inner)


def _title(group: Group) -> str:
    return (group.label or group.name)[:_LONGEST_TITLE]


@dataclass(frozen=True, slots=True)
class _Place:
    """Where a group begins, counted from the start of the model; None if that is known only at the device.

    `path` has the groups around it, `scope` all points that it sees, `facts` what repeats its points.
    """

    model: Model
    start: int | None
    path: tuple[str, ...] = ()
    scope: Mapping[str, DraftPoint] = field(default_factory=dict)
    facts: Mapping[str, str] = field(default_factory=dict)
    addressing: str = ""
    text: str = ""
    """What is said of a group around it that has no points of its own."""

    def behind(self, words: int | None) -> int | None:
        """Return where the words behind these begin."""
        return None if self.start is None or words is None else self.start + words


def _words(group: Group) -> int | None:
    """Return how many words an element of a group has; None if the device says how many."""
    words = sum(point.size for point in group.points)
    for inner in group.groups:
        one = _words(inner)
        if one is None or not isinstance(inner.count, int) or not inner.count:
            return None
        words += inner.count * one
    return words


class _Drafter:
    """Drafts models one after another."""

    def __init__(self, names: Counter[str], most: int) -> None:
        self.groups: list[DraftGroup] = []
        self._doubles = {name for name, times in names.items() if times > 1}
        self._group_names, self._names = Names(), Names()
        self._units: dict[str, str] = {}
        self._most = most

    def add(self, model: Model) -> None:
        """Draft a model."""
        self._add(model.group, _Place(model, model.header))

    def head_facts(self) -> Iterator[str]:
        """Yield what the whole device has: the codes and formats of the types that it uses, and further units."""
        yield "certainty: imported"
        yield "found: {models: {text: SunS, at: [40000, 0, 50000], then: [id, length]}}"
        facts = [point.facts for group in self.groups for point in group.points]
        formats = {each["format"] for each in facts if "format" in each}
        types = {each.get("type") for each in facts} | {_FORMATS[name][7:10] for name in formats}
        if types & _OF_TYPES.keys():
            yield from ("types:", *(f"  {kind}: {fact}" for kind, fact in _OF_TYPES.items() if kind in types))
        if formats:
            yield from ("formats:", *(f"  {name}: {_FORMATS[name]}" for name in sorted(formats)))
        if self._units:
            yield "units:"
            yield from (f"  {unit}: {{name: {unit}, quantity: as SunSpec has it}}" for unit in self._units.values())

    def _add(self, group: Group, place: _Place) -> None:
        """Draft a group and those within."""
        path = (*place.path, group.name)
        draft = DraftGroup(_title(group), "holding", "" if not place.path else ".".join(path)[:_LONGEST_TITLE])
        draft.name = self._group_names.give(snake("_".join(path), "model"), str(place.model.id))
        draft.document = f"model_{place.model.id}"
        draft.facts["block"] = str(place.model.id)
        if place.addressing:
            draft.facts["addressing"] = place.addressing
        text = " ".join(filter(None, (place.text, group.text)))
        if text:
            draft.facts["note"] = _note(text)
        place = self._repeated(group, place, draft)
        points, words, scope = group.points, 0, dict(place.scope)
        self.groups += [draft] if points else []
        for point in points:
            drafted = DraftPoint(0, "holding", (point.label or point.name)[:_LONGEST_TITLE], point.name)
            if point.name in self._doubles:
                drafted.code = ".".join((*path, point.name))
            drafted.name = self._names.give(snake(drafted.title, "point"), draft.name)
            if place.start is not None:
                drafted.facts |= {"at": str(place.start + words), **place.facts}
            else:
                drafted.questions.append("place: it lies behind a group whose number the device says")
            words += point.size
            scope[point.name] = drafted
            draft.points.append(drafted)
        for point, drafted in zip(points, draft.points, strict=True):
            self._state(point, drafted, scope)
        within = replace(place, path=path, scope=scope, start=place.behind(words), text="" if points else text)
        for inner in group.groups:
            self._add(inner, within)
            each = _words(inner)
            all_words = (
                each * inner.count if each is not None and isinstance(inner.count, int) and inner.count else None
            )
            within = replace(within, start=within.behind(all_words))

    def _repeated(self, group: Group, place: _Place, draft: DraftGroup) -> _Place:
        """Return the place of a group with what repeats it; where that cannot be said, the draft has a comment."""
        words, count = _words(group), group.count
        if count == 1:
            return place
        times = "to the end of the model" if count == 0 else f"{count} times"
        if place.start is None or words is None or place.facts or (isinstance(count, str) and count not in place.scope):
            draft.comments.append(f"repeats: {times}; here is the first")
            return place
        draft.facts["addressing"] = f"number + (index - 1) * {words}"
        if isinstance(count, str):
            facts = {"indices": f"1..{place.scope[count].name}", "most": str(self._most)}
        else:
            facts = {"indices": str(count)} if count else {"indices": "to end", "most": str(self._most)}
        return replace(place, facts=facts, addressing=draft.facts["addressing"])

    def _state(self, point: Point, drafted: DraftPoint, scope: Mapping[str, DraftPoint]) -> None:
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
            facts["note"] = _note(note)
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


def _state_type(point: Point, drafted: DraftPoint) -> None:
    facts = drafted.facts
    kind = _TYPES.get(point.type)
    if kind and _WORDS[kind[1:]] == point.size:
        facts["type"] = kind
    elif point.type in _FORMATS and _WORDS.get(point.type[3:], 1) == point.size:
        facts["format"] = point.type
    elif point.type == "string":
        facts |= {"type": "text", "characters": str(point.size * 2)}
    else:
        facts |= {"type": "~", "length": str(point.size)}
        drafted.questions.append(f"type {point.type}: {point.size} words")


def _state_factor(point: Point, drafted: DraftPoint, scope: Mapping[str, DraftPoint]) -> None:
    """State the scale: by a point that holds an exponent of 10, or by the exponent itself."""
    factor = point.factor
    if isinstance(factor, int) and abs(factor) <= 10:
        drafted.facts["scale"] = f"value = raw * {number_text(Fraction(10) ** factor)}"
    elif isinstance(factor, str) and factor in scope:
        drafted.facts["scale"] = f"value = raw * 10 ** {scope[factor].name}"
    else:
        drafted.facts["scale"] = "~"
        drafted.questions.append(f"scale factor: {factor}")


def _labels(point: Point, key: str) -> str:
    """Return the symbols of a point as the block of its enum or flags."""
    names = Names()
    lines = []
    for symbol in point.symbols:
        name = names.give(snake(symbol.name, "number"), str(symbol.number))
        title = symbol.text or symbol.name.replace("_", " ").capitalize()
        lines.append(f"\n  {symbol.number}: {{name: {scalar(name)}, {key}{scalar(title)}}}")
    return "".join(lines)


def _note(text: str) -> str:
    return scalar(text if len(text) <= _LONGEST_NOTE else f"{text[:_LONGEST_NOTE]} …")
