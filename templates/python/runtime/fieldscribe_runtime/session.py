# SPDX-License-Identifier: 0BSD
"""The order of requests to a device: the part of all devices that does no I/O and knows no bus.

Each operation is a generator: it yields what its family sends, receives the answer, and returns a result. Subclasses
of the families define how words travel: `_get_steps` and `_store_steps`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Generator, Iterable, Mapping, Sequence
from contextlib import suppress
from copy import copy
from itertools import groupby
from typing import TYPE_CHECKING, Any, TypeVar

from .about import About, add_points, needing, of_group
from .arguments import check_name, check_number, check_seconds, shown
from .conditions import may_hold, names_in
from .errors import (
    AccessError,
    EchoError,
    ExceptionReplyError,
    FieldscribeError,
    MalformedError,
    OtherDeviceError,
    RefusedError,
    RequestError,
    undecided,
)
from .points import Decoding, Encoding, Point
from .receiving import Broadcast, Pause
from .rules import NO_RAWS
from .special import Special
from .table import NamedPoints, check_variants
from .traffic import Traffic

if TYPE_CHECKING:
    from .conditions import Test
    from .facts import Identification, Place
    from .rules import Raws

T = TypeVar("T")
Steps = Generator[Any, Any, T]
"""The family defines what is yielded and sent between the steps."""
Refusals = dict[str, FieldscribeError] | None
"""Collects what the device refuses, by item; None raises it instead."""
Value = float | str | tuple[int, ...] | Special
"""What reading a point can return (also bool, IntEnum and IntFlag)."""


_TRIES = frozenset({"retries", "repeats"})
_SECONDS = frozenset({"retry_pause", "patience", "fresh_for"})
_NEVER = "never"
_JOINT = frozenset({"coil", "holding", "telegram"})
"""The spaces where one request can write several points."""
_KEPT = frozenset({_NEVER, "rarely"})
_LASTING = frozenset({0x01, 0x02, 0x03})
"""Exceptions for requests that the device will always refuse: illegal function, address, or number of words."""


def _is_lasting(error: FieldscribeError) -> bool:
    return isinstance(error, ExceptionReplyError) and error.code in _LASTING


class Session(NamedPoints, ABC):
    """The state of one device on a bus: its unit number, its variants, and what was read before."""

    unit: int
    traffic: Traffic
    retries: int = 0
    """How often a request is repeated after it or its reply was lost; a command is never repeated."""
    retry_pause: float = 0.0
    """Seconds between a failure and the repetition."""

    def __init__(self, unit: int, variants: Mapping[str, str | None]) -> None:
        check_variants(self.VARIANTS, variants)
        self.unit = unit
        self.traffic = Traffic(unit)
        self.variants = variants
        self._kept: dict[str, int] = {}
        self._refused: dict[str, FieldscribeError] = {}
        """Refusals that last, by item: `read_many` does not request these points again."""
        self._first = self.AUTOMATIC.get("first", ())
        """Commands that are sent before anything else."""
        self._selected: dict[str, int] = {}
        """The current selection, by point; forgotten when an exchange fails or something else is written."""
        self._gaps: frozenset[tuple[str, int]] = frozenset()
        """Addresses between points that no read may span: space and address."""

    if not TYPE_CHECKING:

        def __setattr__(self, name: str, value: object) -> None:
            """Refuse invalid values of `retries` and `retry_pause`."""
            if name in _TRIES:
                check_number(f"bad_{name}", name, value, (0, 0xFFFF))
            elif name in _SECONDS:
                check_seconds(f"bad_{name}", name, value)
            super().__setattr__(name, value)

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
        """Carry out one request; repeat it up to `left` times while it or its reply is lost, and count failures.

        A repetition first writes the selection again: the device may have restarted.
        """
        selected = self._selected
        while True:
            try:
                result = yield from ask(*arguments)
            except FieldscribeError as error:
                is_final = left <= 0 or not error.lost
                self._selected = {}
                self.traffic.failed(error, is_final=is_final)
                if is_final:
                    raise
            else:
                self.traffic.answered()
                return result
            if self.retry_pause:
                yield Pause(self.retry_pause)
            yield from self._select_steps(tuple(selected.items()))
            left -= 1

    def _to_all_steps(self, frame: bytes) -> Steps[tuple[()]]:
        """Send a broadcast, which no unit answers."""
        with suppress(TimeoutError):
            self.traffic.sent(frame)
            yield Broadcast(frame)
        return ()

    def _gather_steps(self, points: Sequence[Point], group: str | None, refusals: Refusals) -> Steps[dict[str, int]]:
        """Read the raw numbers of several points (or of a whole `group`), by item, place by place."""
        del group
        places: dict[Place, list[Point]] = {}
        for point in points:
            places.setdefault(point.facts.at, []).append(point)
        raws: dict[str, int] = {}
        for place, inside in places.items():
            raws.update((yield from self._part_steps(inside, refusals, self._place_steps, place, inside)))
        return raws

    def _place_steps(self, place: Place, points: Sequence[Point]) -> Steps[dict[str, int]]:
        words = yield from self._get_steps(place)
        return {point.facts.item: self._taken(point, words) for point in points}

    def _part_steps(
        self, points: Sequence[Point], refusals: Refusals, ask: Callable[..., Steps[dict[str, int]]], *arguments: Any
    ) -> Steps[dict[str, int]]:
        """Read some points in one request; if the device refuses it and `refusals` are collected, one request each."""
        self.traffic.is_split = refusals is not None and len(points) > 1
        try:
            yield from self._select_steps(points[0].facts.selects)
            with About(self.traffic, *points):
                return (yield from ask(*arguments))
        except FieldscribeError as error:
            if refusals is None or error.lost:
                raise
            if len(points) == 1:
                self._add_condition(error, points[0])
                self._note(points[0], error, refusals)
                return {}
            is_lasting = _is_lasting(error)
        finally:
            self.traffic.is_split = False
        raws: dict[str, int] = {}
        for point in points:
            raws.update((yield from self._gather_steps([point], None, refusals)))
        if is_lasting and len(raws) == len(points):
            self._note_gaps(points, *arguments)
        return raws

    def _note_gaps(self, points: Sequence[Point], *arguments: object) -> None:
        """Record that the device refuses addresses between points; each point is read by itself from then on."""
        del points, arguments

    def _note(self, point: Point, error: FieldscribeError, refusals: dict[str, FieldscribeError]) -> None:
        """Record that a point is refused; remember it if the refusal lasts."""
        refusals[point.facts.item] = error
        if _is_lasting(error):
            self._refused[point.facts.item] = copy(error)

    def _shared_word_steps(self, point: Point) -> Steps[int]:
        """Read the word that a bit group shares with other points, before the group is written."""
        if not isinstance(point, Decoding):
            raise AccessError("the other bits of its word cannot be read back")
        return (yield from self._get_steps(point.facts.at))[0]

    def _after_first_steps(self, steps: Steps[T]) -> Steps[T]:
        """Send the commands that must come first, then carry out an operation; skip them once all have succeeded."""
        try:
            for command in self._first:
                yield from command.steps(self, {})
            self._first = ()
            return (yield from steps)
        finally:
            steps.close()

    def _variant(self, axis: str) -> str:
        """Return the value of a variant axis; raises AccessError if the device was made without it."""
        value = self.variants.get(axis)
        if value is None:
            raise undecided(AccessError(f"depends on {axis}"), axis)
        return value

    def _raw_of_steps(self, name: str) -> Steps[int]:
        """Read the raw number of a point by its name."""
        return (yield from self._read_raw_steps(self._resolved(name)))

    def forget(self) -> None:
        """Forget what was read: numbers that change rarely or never, and what the device has refused.

        The commands that come before anything else are sent again, as after a restart of the device.
        """
        self._first = self.AUTOMATIC.get("first", ())
        self._kept.clear()
        self._selected = {}
        self._refused.clear()
        self._gaps = frozenset()

    def _read_raw_steps(self, point: Point) -> Steps[int]:
        """Read a point's raw number."""
        facts = point.facts
        if facts.selects:
            yield from self._select_steps(facts.selects)
        self.traffic.about = (point,)
        try:
            return self._taken(point, (yield from self._get_steps(facts.at)))
        except FieldscribeError as error:
            add_points(error, (point,))
            self._add_condition(error, point)
            raise

    def _add_condition(self, error: FieldscribeError, point: Point) -> None:
        """Add to a refusal the condition on other points under which the point exists."""
        if point.facts.when and isinstance(error, (ExceptionReplyError, RefusedError)):
            clauses = [" and ".join(map(self._told_test, clause)) for clause in point.facts.when]
            error.exists_when = " or ".join(clauses)

    def _told_test(self, compared: Test) -> str:
        of, test, than = compared
        point = self._found(of)
        told = [str(one) if point is None else point.name_of(int(one)) or point.told_exactly(int(one)) for one in than]
        return f"{of} {test} {', '.join(told)}"

    def _taken(self, point: Point, words: Sequence[int]) -> int:
        """Return the raw number in received words; remember it if the description says how often it changes."""
        raw = point.joined(words) if len(words) == point.size else point.from_words(words)
        if point.facts.changes in _KEPT or point.facts.changes_with:
            self._kept[point.facts.item] = raw
        if self._refused:
            self._refused.pop(point.facts.item, None)
        return raw

    def _raws_steps(
        self,
        point: Point,
        names: Iterable[str],
        known: Mapping[str, int] = NO_RAWS,
        refusals: Refusals = None,
        *,
        writes: bool = False,
    ) -> Steps[dict[str, int]]:
        """Return the raw numbers of others that a point needs: known ones (by item), remembered ones, or read now.

        Before a write, only numbers that never change are taken from memory: another master, or a person, may have
        changed the others since.
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
                    if refusals and item in refusals:
                        raise copy(refusals[item])
                    raws[name] = yield from self._read_raw_steps(other)
        return raws

    def _read_steps(self, point: Decoding[T]) -> Steps[T]:
        """Read what a point's scale needs, then its value."""
        raws = yield from self._raws_steps(point, point.scale_needs)
        raw = yield from self._read_raw_steps(point)
        return point.decode(raw, raws)

    def _write_steps(self, point: Encoding[T], value: T, place: Place | None = None) -> Steps[None]:
        """Write a value, to the point's own place or to `place`."""
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
        """Write a checked raw number; raises EchoError if the device confirms another one."""
        self._require_partners((point,))
        words = point.to_words(raw)
        for command in self.AUTOMATIC.get("before write", ()):
            yield from command.steps(self, {})
        yield from self._select_steps(point.facts.selects)
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
                    text = f"{wrote} was written, but the device answered {has}"
                    raise EchoError(text, error.written, error.answered) from None
            except FieldscribeError as error:
                self._add_condition(error, point)
                raise
        self._selected = dict(point.facts.selects)

    def _write_together_steps(self, values: Mapping[Any, Any], *, as_raw: bool = False) -> Steps[None]:
        """Write several points in one request; each is checked with the new numbers of the points before it."""
        points = {self._writable_point(one): value for one, value in values.items()}
        place = self._joint_place(points)
        raws: dict[str, int] = {}
        for point, value in points.items():
            (point.require_raw if as_raw else point.require)(value)
            needs = dict.fromkeys((*point.scale_needs, *point.limit_needs))
            known = yield from self._raws_steps(point, needs, raws, writes=True)
            raws[point.facts.item] = value if as_raw else point.encode(value, known)
            point.check(raws[point.facts.item], known)
        for command in self.AUTOMATIC.get("before write", ()):
            yield from command.steps(self, {})
        words: dict[int, int] = {}
        yield from self._select_steps(next(iter(points)).facts.selects)
        with About(self.traffic, *points):
            for point in points:
                raw, addresses = raws[point.facts.item], sorted((point.facts.write_at or point.facts.at).addresses)
                if point.facts.bits is not None:
                    held = words[addresses[0]] if addresses[0] in words else (yield from self._shared_word_steps(point))
                    words[addresses[0]] = point.insert(held, raw)
                else:
                    words.update(zip(addresses, point.to_words(raw), strict=True))
            yield from self._put_steps(place, tuple([words[address] for address in place.addresses]))
        self._selected = dict(next(iter(points)).facts.selects)

    def _writable_point(self, one: Any) -> Encoding[Any]:
        point = self._own(one)
        self._require(point)
        if not isinstance(point, Encoding):
            raise AccessError(f"{point.label} cannot be written")
        return point

    def _require_partners(self, points: Collection[Point]) -> None:
        """Raise RequestError (not_together) if a point is missing that one request has to write with these."""
        names = {point.facts.name for point in points}
        for point in points:
            if missing := [name for name in point.facts.write_with if name not in names and self._found(name)]:
                text = f"{point.label} is written in one request with {', '.join(missing)}"
                raise RequestError("not_together", f"{text}: write_together takes them all")

    def _joint_place(self, points: Collection[Point]) -> Place:
        """Return the common place of points that one request writes; raises RequestError (not_together)."""
        self._require_partners(points)
        places = [point.facts.write_at or point.facts.at for point in points]
        addresses = sorted({address for place in places for address in place.addresses})
        kinds = {
            (place.replaced(addresses=()), point.facts.selects) for point, place in zip(points, places, strict=True)
        }
        if len(kinds) != 1 or places[0].space not in _JOINT or addresses[-1] - addresses[0] >= len(addresses):
            raise RequestError("not_together", "takes points that one request can write: adjacent, and in one space")
        return places[0].replaced(addresses=tuple(addresses))

    def _put_steps(self, place: Place, values: tuple[int, ...]) -> Steps[None]:
        """Write words or bits at a place, and forget what they change."""
        for item in list(self._kept):
            kept = self.POINTS[item].facts
            changing = [one.facts for one in self.POINTS.values() if one.facts.name in kept.changes_with]
            if any(place.overlaps(at) for facts in (kept, *changing) for at in (facts.at, facts.write_at) if at):
                del self._kept[item]
        for item in [item for item in self._refused if self.POINTS[item].facts.when]:
            del self._refused[item]  # perhaps it exists now
        yield from self._store_steps(place, values)
        self._selected = {}

    def _select_steps(self, selects: tuple[tuple[str, int], ...]) -> Steps[None]:
        """Write what points must hold before the address means another point, except what they hold already."""
        before = self._selected
        for count, (name, raw) in enumerate(selects):
            if before.get(name) != raw:
                self._selected = dict(selects[:count])
                yield from self._put_raw_steps(self._resolved(name), raw, None, NO_RAWS)
        self._selected = dict(selects) or before

    def _read_many_steps(self, what: str | Iterable[str | Point], errors: str) -> Steps[dict[str, Any]]:
        """Read a group, or any points, with as few requests as the device allows.

        A group leaves out points that the link, as it is set, does not carry, and points whose condition is false now.
        With `errors` "return", a point that is absent, that the device refuses, or whose number has no value has the
        error as its value.
        """
        if errors not in ("raise", "return"):
            raise RequestError("bad_errors", f"errors is 'raise' or 'return', not {shown(errors)}")
        absent: dict[str, FieldscribeError] | None = None if errors == "raise" else {}
        group = what if isinstance(what, str) else None
        points = self._group(what) if isinstance(what, str) else self._listed(what, absent)
        with of_group(group):
            if group is not None:
                points = yield from self._existing_steps((yield from self._there_steps(list(points))))
            values = yield from self._values_steps(points, group, None if absent is None else dict(self._refused))
        return {**values, **absent} if absent else values

    def _there_steps(self, points: list[Decoding[Any]]) -> Steps[list[Decoding[Any]]]:
        """Return the points of a group that this device has; families with blocks look there."""
        yield from ()
        return points

    def _existing_steps(self, points: list[Decoding[Any]]) -> Steps[list[Decoding[Any]]]:
        """Return the points whose conditions may be true now; reads the points that conditions compare."""
        names = dict.fromkeys(
            name for point in points for name in names_in(point.facts.when) if name not in dict(point.facts.selects)
        )
        compared = [one for name in names if (one := self._found(name)) is not None and self._carried(one)]
        items = [one for one in compared if one.facts.item not in self._kept.keys() | self._refused.keys()]
        raws = {**self._kept, **(yield from self._gather_steps(items, None, {}))} if compared else {}
        held = {**self.variants, **{one.facts.name: raws.get(one.facts.item) for one in compared}}
        return [point for point in points if may_hold(point.facts.when, {**held, **dict(point.facts.selects)})]

    def _selected_steps(self, points: Sequence[Point], group: str | None, refusals: Refusals) -> Steps[dict[str, int]]:
        """Read the raw numbers of several points, together where they need the same selection."""
        parts: dict[tuple[tuple[str, int], ...], list[Point]] = {}
        for point in points:
            parts.setdefault(point.facts.selects, []).append(point)
        raws: dict[str, int] = {}
        for selects, inside in parts.items():
            raws.update((yield from self._gather_steps(inside, None if selects else group, refusals)))
        return raws

    def _values_steps(
        self, points: Sequence[Decoding[Any]], group: str | None, refusals: Refusals
    ) -> Steps[dict[str, Any]]:
        """Read what the scales of points need, then return the values by name."""
        find = self._needed if refusals is None else lambda _, name: self._found(name)
        needed = [find(point, name) for point in points for name in point.scale_needs]
        wanted: dict[str, Point] = {point.facts.item: point for point in points}
        wanted.update({point.facts.item: point for point in needed if point and point.facts.item not in self._kept})
        left = [point for item, point in wanted.items() if not refusals or item not in refusals]
        ask = self._selected_steps if any(point.facts.selects for point in left) else self._gather_steps
        raws = yield from ask(left, group, refusals)
        values: dict[str, Any] = {}
        for point in points:
            try:
                if refusals and point.facts.item in refusals:
                    raise copy(refusals[point.facts.item])
                known = yield from self._raws_steps(point, point.scale_needs, raws, refusals)
                values[point.facts.name] = point.decode(raws[point.facts.item], known)
            except FieldscribeError as error:
                if refusals is None or (error.lost and not refusals):  # their contents were read already
                    raise
                error.group = group
                values[point.facts.name] = error
        return values

    def _identify_steps(self) -> Steps[dict[str, str]]:
        """Read what identifies the device, then its variants, until one value of each axis matches."""
        held: dict[str, int | str] = {}
        variants: dict[str, str] = {}
        for variant, rows in groupby(self.IDENTIFICATIONS, lambda row: row.variant):
            misfit = None if variant and variant[0] in variants else (yield from self._misfit_steps(rows, held))
            if variant and misfit is None:
                variants.setdefault(*variant)
            elif not variant and misfit is not None:
                raise OtherDeviceError(misfit)
        return variants

    def _misfit_steps(self, rows: Iterable[Identification], held: dict[str, int | str]) -> Steps[str | None]:
        """Return the first difference from what the points should hold; None if all match."""
        for row in rows:
            name, values = row.point, row.values
            point = self.POINTS[name]
            if name not in held:
                try:
                    raw = yield from self._read_raw_steps(point)
                    is_text = isinstance(values[0], str)
                    held[name] = point.decode(raw) if is_text and isinstance(point, Decoding) else raw
                except ExceptionReplyError as error:
                    return f"{name}: {error}"
                except MalformedError as error:
                    return str(error)
            if held[name] not in values:
                return f"{name} is {shown(held[name])}, not {' or '.join(map(shown, values))}"
        return None

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
        """Return True if the link, as it is set, carries the words of a point; families override it."""
        del point
        return True
