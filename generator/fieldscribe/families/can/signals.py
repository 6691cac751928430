"""Signals of messages: their places in the words of the telegram of the message, packing and unpacking.

Signals under the same condition are neighbours in the telegram: first those that are always present, then those for
each value of a selector.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import groupby
from typing import Generic, TypeVar

from fieldscribe.conditions import Clause
from fieldscribe.model import Field, Message, Place, Point

When = tuple[tuple[int, tuple[int, ...]], ...]
"""Places among the fields of a message, with the raw numbers that select a signal."""
Selection = Mapping[str, tuple[int, ...]]
"""The raw numbers of other signals, by name, that select a signal."""
_MOST_RAWS = 256

T = TypeVar("T")


def placed(message: Message, points: Sequence[Point]) -> tuple[Message, list[Place]]:
    """Return the message with its fields, and the place of each of its points in the words of its telegram."""
    listed = {point.name: number for number, point in enumerate(points)}
    selections = {point.name: dict(selected(point, listed) or ()) for point in points}
    whens = {name: _with_those_of_selectors(name, selections) for name in selections}
    order = sorted(points, key=lambda point: _rank(whens[point.name], listed))
    numbers = {point.name: number for number, point in enumerate(order)}
    fields: list[Field] = []
    places: dict[int, Place] = {}
    word = 0
    for point in order:
        bit, low_first = point.place.bit or 0, point.place.low_first
        when = tuple((numbers[name], raws) for name, raws in whens[point.name].items())
        fields.append(Field(bit, point.width, low_first, word, when))
        places[id(point)] = replace(point.place, addresses=tuple(range(word, word + fields[-1].words)))
        word += fields[-1].words
    return replace(message, fields=tuple(fields)), [places[id(point)] for point in points]


def _with_those_of_selectors(name: str, selections: Mapping[str, Selection]) -> Selection:
    """Return the selection of a signal, with the selections of its selectors."""
    result, open_names = dict[str, tuple[int, ...]](), [name]
    while open_names and len(result) <= len(selections):
        for selector, raws in selections.get(open_names.pop(), {}).items():
            if selector not in result:
                result[selector] = raws
                open_names.append(selector)
    return result


def _rank(when: Selection, listed: Mapping[str, int]) -> list[tuple[int, tuple[int, ...]]]:
    return sorted((listed[name], raws) for name, raws in when.items())


def selected(point: Point, names: Collection[str]) -> tuple[tuple[str, tuple[int, ...]], ...] | None:
    """Return the raw numbers of other signals that select a point; None if `when` is not such a condition.

    Comparisons of variants and of points elsewhere select nothing here.
    """
    clauses = () if point.when is None else point.when.clauses
    found = [_raws(clause, point.name, names) for clause in clauses]
    if not found or not any(found):
        return ()
    first = found[0]
    if first is None or any(each is None or [*each] != [*first] for each in found):
        return None
    if len(found) > 1 and len(first) > 1:
        return None
    return tuple((name, tuple(sorted({raw for each in found if each for raw in each[name]}))) for name in first)


def _raws(clause: Clause, name: str, names: Collection[str]) -> dict[str, tuple[int, ...]] | None:
    """Return the raw numbers of other signals in a clause; None if it compares anything else."""
    raws: dict[str, tuple[int, ...]] = {}
    for comparison in clause:
        if comparison.of in names and comparison.of != name:
            if comparison.test not in ("==", "in") or comparison.of in raws or len(comparison.than) > _MOST_RAWS:
                return None
            raws[comparison.of] = tuple(map(int, comparison.than))
    return raws


def parts(message: Message) -> list[tuple[range, When]]:
    """Return the words that are present together, with their selection, in the order of the words."""
    return [
        (range(run[0].word, run[-1].word + run[-1].words), when)
        for when, group in groupby(message.fields, lambda field: field.when)
        if (run := list(group))
    ]


def comes(message: Message, when: When, words: Sequence[int]) -> bool:
    """Return True if the words of a frame satisfy this selection."""
    return all(_raw(message.fields[place], words) in raws for place, raws in when)


def _raw(field: Field, words: Sequence[int]) -> int:
    return sum(words[field.word + place] << 16 * (field.words - 1 - place) for place in range(field.words))


def exclude(field: Field, other: Field) -> bool:
    """Return True if no frame has both fields: a selector would need different numbers."""
    raws_of = dict(other.when)
    return any(place in raws_of and not {*raws} & {*raws_of[place]} for place, raws in field.when)


class TakenBits(Generic[T]):
    """The owners of the bits of a message, by selection: signals that no frame has together are not compared."""

    def __init__(self, message: Message) -> None:
        self._message = message
        self._of: dict[int, dict[int | None, dict[int, list[tuple[Field, T]]]]] = {}

    def _selected(self, field: Field) -> tuple[int | None, tuple[int, ...]]:
        """Return the outermost selector of a field with the numbers that select it."""
        return next((choice for choice in field.when if not self._message.fields[choice[0]].when), (None, (0,)))

    def others(self, field: Field) -> Iterator[T]:
        """Yield the owners of bits of a field in frames that have the field."""
        selector, raws = self._selected(field)
        for bit in field.bits:
            for place, by_raw in self._of.get(bit, {}).items():
                known = raws if place == selector else tuple(by_raw)
                for other, owner in (one for raw in known for one in by_raw.get(raw, ())):
                    if not exclude(field, other):
                        yield owner

    def take(self, field: Field, owner: T) -> None:
        """Add the owner of a field."""
        selector, raws = self._selected(field)
        for bit in field.bits:
            by_raw = self._of.setdefault(bit, {}).setdefault(selector, {})
            for raw in raws:
                by_raw.setdefault(raw, []).append((field, owner))


def words_of(message: Message, data: bytes) -> tuple[int, ...]:
    """Return the words of all fields in the bytes of a message, also of absent ones."""
    words: list[int] = []
    for field in message.fields:
        raw = sum((data[bit >> 3] >> (bit & 7) & 1) << place for place, bit in enumerate(field.bits))
        words += [raw >> 16 * place & 0xFFFF for place in reversed(range(field.words))]
    return tuple(words)


def data_of(message: Message, raws: Mapping[int, int]) -> bytes:
    """Return the bytes of a message whose fields, by number, have these raw numbers; all other bits are 0."""
    data = bytearray(message.length)
    for number, raw in raws.items():
        for place, bit in enumerate(message.fields[number].bits):
            data[bit >> 3] |= (raw >> place & 1) << (bit & 7)
    return bytes(data)


def field_of(message: Message, point: Point) -> tuple[int, Field]:
    """Return the number and the field of a point."""
    first = point.addresses[0]
    return next((number, field) for number, field in enumerate(message.fields) if field.word == first)


def selectors(message: Message) -> Iterator[int]:
    """Yield the numbers of the fields that select others."""
    yield from dict.fromkeys(place for field in message.fields for place, _ in field.when)
