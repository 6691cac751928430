# SPDX-License-Identifier: 0BSD
"""What a device is asked, in which order: the part of all devices that does no I/O and knows no bus.

Each operation is a generator: it yields what its family sends, is sent what came back, and returns a result. How words
travel is the family's part: a subclass with `_get_steps` and `_store_steps`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Generator, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

from .about import About, needing, of_group
from .arguments import check_name, shown
from .errors import AccessError, EchoError, FieldscribeError, RequestError
from .points import Decoding, Encoding, Point
from .rules import NO_RAWS
from .special import Special
from .table import NamedPoints, check_variants
from .traffic import Traffic

if TYPE_CHECKING:
    from .facts import Place
    from .rules import Raws

T = TypeVar("T")
Steps = Generator[Any, Any, T]
"""What goes in and out between the steps is the family's own."""
Value = float | str | tuple[int, ...] | Special
"""What reading a point can give (also bool, IntEnum and IntFlag)."""

_NEVER = "never"
_KEPT = frozenset({_NEVER, "rarely"})


class Session(NamedPoints, ABC):
    """The state of one device on a bus: its unit number, its variants, and what is remembered of it."""

    unit: int
    traffic: Traffic
    retries: int = 0
    """So often a request is sent again after the line lost it or its reply; a command is sent once."""

    def __init__(self, unit: int, variants: Mapping[str, str | None]) -> None:
        check_variants(self.VARIANTS, variants)
        self.unit = unit
        self.traffic = Traffic(unit)
        self.variants = variants
        self._kept: dict[str, int] = {}

    def __repr__(self) -> str:
        known = "".join(f", {axis} {value}" for axis, value in self.variants.items() if value is not None)
        return f"<{type(self).__name__} unit {self.unit}{known}>"

    @abstractmethod
    def _get_steps(self, place: Place) -> Steps[tuple[int, ...]]:
        """Read the words or bits of a place, in ascending order of address."""

    @abstractmethod
    def _store_steps(self, place: Place, values: tuple[int, ...]) -> Steps[None]:
        """Write words or bits at a place, in ascending order of address."""

    def _retried_steps(self, left: int, ask: Callable[..., Steps[T]], *arguments: Any) -> Steps[T]:
        """Carry out one request, again while the line loses it, as often as is left; failures are counted."""
        while True:
            try:
                return (yield from ask(*arguments))
            except FieldscribeError as error:
                self.traffic.failed(error)
                if left <= 0 or not error.lost:
                    raise
            left -= 1

    def _gather_steps(self, points: Sequence[Point], group: str | None) -> Steps[dict[str, int]]:
        """Read the raw numbers of several points (of a whole `group`, where one is named), by item: place by place."""
        del group
        words: dict[Place, tuple[int, ...]] = {}
        raws: dict[str, int] = {}
        for point in points:
            at = point.facts.at
            if at not in words:
                with About(self.traffic, point):
                    words[at] = yield from self._get_steps(at)
            raws[point.facts.item] = self._taken(point, words[at])
        return raws

    def _shared_word_steps(self, point: Point) -> Steps[int]:
        """Yield the word that a bit group shares with others, as it is before the group is written."""
        if not isinstance(point, Decoding):
            raise AccessError("the other bits of its word cannot be read back")
        return (yield from self._get_steps(point.facts.at))[0]

    def forget(self) -> None:
        """Read everything anew that was remembered because it changes rarely or never."""
        self._kept.clear()

    def _read_raw_steps(self, point: Point) -> Steps[int]:
        """Read a point's raw number."""
        with About(self.traffic, point):
            return self._taken(point, (yield from self._get_steps(point.facts.at)))

    def _taken(self, point: Point, words: Sequence[int]) -> int:
        """Return the raw number in words that came; it is remembered if the description says when it changes."""
        raw = point.joined(words) if len(words) == point.size else point.from_words(words)
        if point.facts.changes in _KEPT or point.facts.changes_with:
            self._kept[point.facts.item] = raw
        return raw

    def _raws_steps(
        self, point: Point, names: Iterable[str], known: Mapping[str, int] = NO_RAWS, *, writes: bool = False
    ) -> Steps[dict[str, int]]:
        """Yield the raw numbers that a point needs of others: those known (by item), those remembered, the rest read.

        What is written must not follow from a number that has changed meanwhile, by another master or by hand: then
        only what never changes is taken from memory.
        """
        raws: dict[str, int] = {}
        for name in names:
            other = self._needed(point, name)
            item = other.facts.item
            if item in known:
                raws[name] = known[item]
            elif item in self._kept and (not writes or other.facts.changes == _NEVER):
                raws[name] = self._kept[item]
            else:
                with needing(self.traffic, point, other):
                    raws[name] = yield from self._read_raw_steps(other)
        return raws

    def _read_steps(self, point: Decoding[T]) -> Steps[T]:
        """Read a point's value."""
        raws = (yield from self._raws_steps(point, point.scale_needs)) if point.scale_needs else NO_RAWS
        raw = yield from self._read_raw_steps(point)
        return point.decode(raw, raws)

    def _write_steps(self, point: Encoding[T], value: T, place: Place | None = None) -> Steps[None]:
        """Write a value, to another `place` than the usual one where one is named."""
        point.require(value)
        needs = dict.fromkeys((*point.scale_needs, *point.limit_needs))
        raws = yield from self._raws_steps(point, needs, writes=True)
        yield from self._put_raw_steps(point, point.encode(value, raws), place, raws)

    def _write_raw_steps(self, point: Encoding[Any], raw: int, place: Place | None = None) -> Steps[None]:
        """Write a raw number that the range allows."""
        point.require_raw(raw)
        raws = yield from self._raws_steps(point, point.limit_needs, writes=True)
        point.check(raw, raws)
        yield from self._put_raw_steps(point, raw, place, raws)

    def _put_raw_steps(self, point: Point, raw: int, place: Place | None, raws: Raws) -> Steps[None]:
        """Write a raw number that was checked; raises EchoError if the device confirms another one."""
        words = point.to_words(raw)
        with About(self.traffic, point):
            if point.facts.bits is not None:
                words = (point.insert((yield from self._shared_word_steps(point)), raw),)
            try:
                yield from self._put_steps(place or point.facts.write_at or point.facts.at, words)
            except EchoError as error:
                if point.facts.bits is not None or len(error.answered) != point.size:
                    raise
                answered = point.from_words(error.answered)
                if not point.same(raw, answered):
                    wrote, has = (point.told_exactly(one, raws) for one in (raw, answered))
                    text = f"{wrote} was written, and the device answered {has}"
                    raise EchoError(text, error.written, error.answered) from None

    def _put_steps(self, place: Place, values: tuple[int, ...]) -> Steps[None]:
        """Write words or bits at a place, and forget what they change."""
        for item in list(self._kept):
            kept = self.POINTS[item].facts
            changing = [one.facts for one in self.POINTS.values() if one.facts.name in kept.changes_with]
            if any(place.overlaps(at) for facts in (kept, *changing) for at in (facts.at, facts.write_at) if at):
                del self._kept[item]
        yield from self._store_steps(place, values)

    def _read_many_steps(self, what: str | Iterable[str | Point], errors: str) -> Steps[dict[str, Any]]:
        """Read a group, or any points, with as few requests as the device allows.

        Of a group those points are left out that do not travel the way the link is set. With `errors` "return", a point
        that the device refuses, or whose number has no value, has the error as its value: all are read one by one then.
        """
        if errors not in ("raise", "return"):
            raise RequestError("bad_errors", f"errors is 'raise' or 'return', not {shown(errors)}")
        group = what if isinstance(what, str) else None
        points = self._group(what) if isinstance(what, str) else self._listed(what)
        try:
            with of_group(group):
                return (yield from self._values_steps(points, group))
        except FieldscribeError as error:
            if errors == "raise" or error.lost:
                raise
        values: dict[str, Any] = {}
        for point in points:
            try:
                values.update((yield from self._values_steps([point], None)))
            except FieldscribeError as error:
                if error.lost:
                    raise
                values[point.facts.name] = error
        return values

    def _values_steps(self, points: Sequence[Decoding[Any]], group: str | None) -> Steps[dict[str, Value]]:
        """Yield the values of points, by name, and before them what their scales need."""
        needed = [self._needed(point, name) for point in points for name in point.scale_needs]
        wanted: dict[str, Point] = {point.facts.item: point for point in points}
        wanted.update({point.facts.item: point for point in needed if point.facts.item not in self._kept})
        raws = yield from self._gather_steps(list(wanted.values()), group)
        values: dict[str, Value] = {}
        for point in points:
            known = yield from self._raws_steps(point, point.scale_needs, raws)
            values[point.facts.name] = point.decode(raws[point.facts.item], known)
        return values

    def _group(self, group: str) -> list[Decoding[Any]]:
        check_name("group", group)
        members = [point for point in self.POINTS.values() if point.facts.group == group and self._has(point)]
        if not members:
            raise AccessError(f"there is no group {group}{self._meant_by_group(group)}")
        return [point for point in members if isinstance(point, Decoding) and self._travels(point)]

    def _travels(self, point: Point) -> bool:
        """Return True if the link carries a point, and all that its scale needs."""
        needed = [self._found(name) for name in point.scale_needs]
        return all(self._carried(one) for one in (point, *needed) if one is not None)

    def _carried(self, point: Point) -> bool:
        """Return True if the words of a point travel the way the link is set; families say where that differs."""
        del point
        return True
