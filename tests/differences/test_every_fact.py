"""Every field of the model, changed alone, is a difference with a class; so is every key of the exported model.

A field that is new fails here until the export says it and the table of facts gives it a class.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields as dataclass_fields
from dataclasses import is_dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import fieldscribe
import pytest
from fieldscribe import model
from fieldscribe.conditions import Comparison, Condition
from fieldscribe.differences import differences
from fieldscribe.differences.classes import CLASSES
from fieldscribe.differences.devices import table_of
from fieldscribe.differences.table import Fact
from fieldscribe.export import export_model
from fieldscribe.families import FAMILIES, family
from fieldscribe.model import Own
from support.described import made
from support.models import sample_device

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.differences.table import Table

SCHEMA: dict[str, Any] = json.loads((Path(fieldscribe.__file__).parent / "export/schema.json").read_text("utf-8"))

SAYS_NOTHING = {
    "Device.id": "tells the device",
    "Device.asked": "is no fact",
    "Device.version": "is what differences ask to change",
    "Device.digest": "follows from all facts",
    "Device.blocks": "follow from points, limits and gaps",
    "Device.enums": "are those of the points",
    "Block": "follows from points, limits and gaps",
    "Enum.title": "is its name in words",
    "Enum.was": "follows from the old names of its point",
    "Erratum.facts": "are `printed` as structure",
    "Factor.exponents": "follow from the range of the point",
    "Named": "is `where`, which is told as text",
    "Point.errata": "is told of the erratum",
    "Place.references": "follow from the address where the numbering stays",
    "ScaleCase.written": "is how documents write the formula",
    "Shape.width": "follows from type and bits",
    "Shape.encodes_values": "follows from the scale",
    "Shape.most_raw": "follows from the scale",
    "Special.hexadecimal": "is how documents write the number",
    "Special.own": "is told by `special_of`",
    "Terms.untyped": "is told where there is no type",
    "Terms.reason": "is told where nothing is generated",
    "TypeInfo": "follows from the type",
}
"""Fields, and records, that say nothing of their own, and why."""

OTHER = {
    "Device.family": "can",
    "Text.characters": 20,
    "Shape.type": "s16",
    "Shape.access": "w",
    "Role.kind": "multiplexer",
    "Comparison.test": ">",
}
"""Values that a field takes where no text that is made up would do."""


def names_of(kind: Any) -> list[str]:
    """Return the names of the fields of a dataclass or of an object of one."""
    return [field.name for field in dataclass_fields(kind)]


def children_of(thing: Any) -> tuple[Any, ...]:
    """What a thing of the model is made of."""
    if is_dataclass(thing):
        return tuple(getattr(thing, name) for name in names_of(thing))
    return tuple(thing.values()) if isinstance(thing, Mapping) else thing if isinstance(thing, tuple) else ()


def records_of(device: model.Device) -> Iterator[Any]:
    """All records of a device, each once."""
    seen: dict[int, Any] = {}
    left: list[Any] = [device]
    while left:
        thing = left.pop(0)
        children = children_of(thing)
        if children and id(thing) not in seen:
            seen[id(thing)] = thing
            left += children
            if is_dataclass(thing):
                yield thing


class Rewriting:
    """A copy of a device with one record in place of another, wherever that is shared."""

    def __init__(self, old: Any, new: Any) -> None:
        self._known = {id(old): new}
        self._kept: list[Any] = []

    def of(self, thing: Any) -> Any:
        """The thing with the new record in it."""
        if not children_of(thing):
            return thing
        if id(thing) not in self._known:
            self._kept.append(thing)
            self._known[id(thing)] = self._made(thing)
        return self._known[id(thing)]

    def _made(self, thing: Any) -> Any:
        if isinstance(thing, Mapping):
            return {key: self.of(value) for key, value in thing.items()}
        if isinstance(thing, tuple):
            return tuple(map(self.of, thing))
        changes = {name: self.of(getattr(thing, name)) for name in names_of(thing)}
        return replace(thing, **{name: new for name, new in changes.items() if new is not getattr(thing, name)})


def another(value: Any) -> Any:  # noqa: PLR0911  # a line for each kind of value
    """Another value of the same kind; None where there is none."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | Fraction):
        return value + 1
    if isinstance(value, str):
        return f"{value}x"
    if isinstance(value, bytes):
        return b"x" + value
    if isinstance(value, tuple) and value:
        last = another(value[-1])
        return value[:-1] if last is None else (*value[:-1], last)
    if isinstance(value, Mapping) and value:
        last = another(list(value.values())[-1])
        return dict(list(value.items())[:-1]) if last is None else {**value, list(value)[-1]: last}
    return None


def fields() -> list[str]:
    """All fields of records of the model that say something, as `Shape.type`."""
    kinds = [getattr(model, name) for name in model.__all__] + [Comparison, Condition, *_own_kinds(Own)]
    records = [kind for kind in kinds if isinstance(kind, type) and is_dataclass(kind) and kind is not Own]
    names = [f"{kind.__name__}.{name}" for kind in records for name in names_of(kind)]
    return [name for name in names if not {name, name.partition(".")[0]} & SAYS_NOTHING.keys()]


def _own_kinds(kind: Any) -> list[Any]:
    for name in FAMILIES:
        family(name)
    return [own for own in kind.__subclasses__() if own.__module__.startswith("fieldscribe.")]


def devices() -> Iterator[model.Device]:
    """Devices in which every field says something."""
    sample, uss = sample_device(), made("kitchen_uss")
    noted = replace(sample.points[0], note={"en": "Careful"})
    manual = model.Document("manual", "Manual", "de", "manual.txt", "0123")
    own: Any = uss.bus.own
    link = replace(own, bitrate=9600, variant_pzd=((model.Variant("size", "small"), 2),))
    yield replace(sample, points=(noted, *sample.points[1:]), documents=(manual,))
    yield replace(uss, bus=replace(uss.bus, own=link))
    yield from (made(name) for name in ("kitchen_can", "kitchen_sink"))


@pytest.fixture(scope="module")
def samples() -> dict[str, list[tuple[model.Device, Any]]]:
    """For each field the records that say something there, with their devices; none where the field is a record."""
    known: dict[str, list[tuple[model.Device, Any]]] = {}
    for device in devices():
        for record in records_of(device):
            for name in names_of(record):
                value, field = getattr(record, name), f"{type(record).__name__}.{name}"
                if value not in (None, "", (), {}):
                    examples = known.setdefault(field, [])
                    if len(examples) < 4 and not is_dataclass(value):
                        examples.append((device, record))
    return known


@pytest.mark.full(seconds=2)
@pytest.mark.parametrize("field", fields())
def test_a_field(field: str, samples: dict[str, list[tuple[model.Device, Any]]]) -> None:
    name = field.partition(".")[2]
    if not samples[field]:
        return  # a record of its own
    for device, record in samples[field]:
        value = OTHER.get(field) or another(getattr(record, name))
        changed = Rewriting(record, replace(record, **{name: value})).of(device)
        try:
            told = differences(export_model(device), export_model(changed))
        except KeyError:  # the name of a point that others need: another record will do
            continue
        if told:
            assert {difference.weight for difference in told} <= CLASSES.keys()
            return
    pytest.fail(f"{field} says nothing: give it a class in the table of differences, or a reason above")


def test_fields_that_say_nothing_exist() -> None:
    kinds = {kind.__name__: kind for kind in vars(model).values() if isinstance(kind, type)}
    for field in SAYS_NOTHING:
        kind, _, name = field.partition(".")
        assert not name or name in names_of(kinds[kind]), field


def test_classes_are_known() -> None:
    def weights(table: Table) -> Iterator[object]:
        for entry in table.values():
            if isinstance(entry, Fact):
                yield entry.weight
            else:
                yield from (entry.added, entry.removed, entry.renamed)
                yield from weights(entry.facts)

    for name in FAMILIES:
        assert all(callable(weight) or weight in CLASSES for weight in weights(table_of(name)))
