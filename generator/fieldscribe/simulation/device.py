"""A simulated device: a memory that obeys the rules of the manual. It knows no bus: the core of a family calls it."""

from __future__ import annotations

import time
from collections import ChainMap, deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError
from fieldscribe.arithmetic.words import insert, raw_of, split, with_fixed
from fieldscribe.model import Command, Point, Source
from fieldscribe.simulation.behaviour import Behaviour
from fieldscribe.simulation.behaviour_rules import Rules
from fieldscribe.simulation.layout import Area, Cells, Layout, joined_cells
from fieldscribe.simulation.memory import Memory, Values
from fieldscribe.wording import label
from fieldscribe.wording.rules import condition_text


class Clock:
    """Seconds since the start, `scale` times as fast as real ones; with a scale of 0, only `advance` changes them."""

    def __init__(self, scale: float = 1.0) -> None:
        self.scale = scale
        self._start = time.monotonic()
        self._ahead = 0.0

    def now(self) -> float:
        """Return the seconds since the start."""
        return (time.monotonic() - self._start) * self.scale + self._ahead

    def advance(self, seconds: float) -> None:
        """Advance the clock."""
        self._ahead += seconds

    def real(self, seconds: float) -> float:
        """Return the real seconds of a delay; 0 if the scale is 0."""
        return seconds / self.scale if self.scale else 0.0


BUSY_FOR = 0.05
"""The seconds for which a point reports that a command is being carried out; no manual gives them."""

MOST_COMPLAINTS = 10_000
CYCLIC = 10, 60.0
"""A strict device complains of this many writes to wearing memory within this many seconds."""
_OPENED = frozenset({"password"})
"""Conditions that a write fulfils: the write must match what the point with this name holds."""


OF_VALUES = ("out_of_range", "unknown_value", "special", "missing", "not_a_number")
"""The kinds of refusals of a value: the statuses of `codec.check`."""


class Refusal(Exception):  # noqa: N818  # it is an answer of the device, and no error of ours
    """The device refuses a request.

    `kind` is `address` (nothing is there), `absent` (a point whose condition is false), `part` (a part of a number),
    `write_only`, `read_only`, `condition` (one that must be true before a write), `together` (points that must be
    written with others), or the status of the value: `out_of_range`, `unknown_value`, `special`, ... `point` is the
    point that refuses, if there is one.
    """

    def __init__(self, kind: str, why: str, point: Point | None = None) -> None:
        super().__init__(why)
        self.kind = kind
        self.why = why
        self.point = point


@dataclass(frozen=True, slots=True)
class Complaint:
    """A violation of the manual by a client: the rule, what happened, and the place in the manual."""

    rule: str
    what: str
    source: Source | None = None

    def __str__(self) -> str:
        where = ""
        if self.source is not None:
            places = [f"line {self.source.line}"] if self.source.line else []
            places += [f"page {self.source.page}"] if self.source.page else []
            where = f" ({self.source.document}{', ' if places else ''}{', '.join(places)})"
        return f"{self.rule}: {self.what}{where}"


class SimulatedDevice:
    """One device at a `unit` of a line.

    `values` has the values of the points by name, in their units; writing one ignores the rules. `conditions` are what
    must be true before some writes (`stopped`, `password`), all true at the start: set one to False and such writes
    are refused. `complaints` collects violations if `strict` is set. `refusals` may give the exception number for a
    kind of refusal; the core of the family knows the others. `wear` counts the writes that wear the memory.
    """

    def __init__(  # noqa: PLR0913  # all keyword arguments
        self,
        layout: Layout,
        unit: int | None = None,
        *,
        seed: int = 0,
        clock: Clock | None = None,
        strict: bool = False,
        rules: Rules | None = None,
    ) -> None:
        self.device = layout.device
        self.unit = layout.device.bus.usual_unit if unit is None else unit
        self.clock = clock or Clock()
        self.strict = strict
        self.memory = Memory.started(layout, seed)
        self.behaviour = None if rules is None else Behaviour(rules, self.memory)
        self.values = Values(self.memory, self.advance, self.behaviour)
        self.conditions = dict.fromkeys((name for point in layout.points.values() for name in point.conditions), True)
        self.refusals: dict[str, int] = {}
        self.complaints: list[Complaint] = []
        self.on_complaint: Callable[[Complaint], object] = lambda _complaint: None
        self.wear: dict[str, int] = {}
        self._stored_at: dict[str, deque[float]] = {}
        self._lost: dict[str, int] = {}
        self._busy: dict[str, float] = {}

    @property
    def layout(self) -> Layout:
        """Return where its points lie now."""
        return self.memory.layout

    def advance(self) -> None:
        """Update the memory to the present time."""
        now = self.clock.now()
        for name in [name for name, until in self._busy.items() if until <= now]:
            del self._busy[name]
            self.memory.put(name, 0)
        if self.behaviour is not None:
            self.behaviour.advance(now)

    def read(self, area: Area, addresses: Sequence[int]) -> list[int]:
        """Return the cells at these addresses. Raises Refusal if nothing readable is there."""
        self.advance()
        readable = self.layout.readable.get(area, frozenset())
        for address in addresses:
            if address not in readable:
                raise self._unreadable(area, address)
        if self.strict:
            self._look_at_conditions(area, addresses)
            self._look_at_parts(area, addresses)
        return self.memory.held(area, addresses)

    def write(self, area: Area, cells: Mapping[int, int], *, keep: bool | None = None) -> list[Point]:
        """Write cells by address and return the points that they touch; nothing is written if one point refuses.

        `keep`: the values survive a restart, if the request chooses that. Raises Refusal.
        """
        self.advance()
        command = self._command(area, cells)
        if command is not None:
            self.perform(command)
            return []
        points = self._touched(area, cells)
        together = {point.name for point in points}
        numbers = {point.name: self._number(point, cells, together) for point in points}
        for condition in _OPENED.intersection(self.conditions):
            if needed := [point for point in points if condition in point.name]:
                self.conditions[condition] = all(numbers[each.name] == self.memory.raw(each.name) for each in needed)
                return points
        for point in points:
            self._check(point, numbers[point.name], numbers if point.write_with else {})
        for point in points:
            self._remember(point, keep)
        changed = [point for point in points if numbers[point.name] != self.memory.raw(point.name)]
        writers = self.layout.writers.get(area, {})  # steps of commands also write where no point is
        self.memory.areas[area].update((at, word) for at, word in cells.items() if at not in writers)
        for point in changed:
            self.memory.put(point.name, numbers[point.name])
        if self.behaviour is not None and changed:
            self.behaviour.written(changed, self.clock.now())
        return points

    def end_silence(self) -> None:
        """Handle a telegram of the master; the device may watch for its silence."""
        if self.behaviour is not None:
            self.behaviour.end_silence(self.clock.now())

    def perform(self, command: Command) -> None:
        """Carry out a command of one write: store what waits for it, and be busy for a while."""
        if command.wears is not None:
            self._wears(command.name, command.source)
        stored = [name for name in self._lost if self.layout.points[name].keeps == command.name]
        for name in stored:
            del self._lost[name]
        if command.busy is not None and command.busy in self.layout.points:
            self.memory.put(command.busy, 1)
            self._busy[command.busy] = self.clock.now() + BUSY_FOR

    def restart(self) -> None:
        """Switch the device off and on: values that were written but not stored are lost."""
        for name, raw in self._lost.items():
            self.memory.put(name, raw)
        self._lost.clear()
        if self.behaviour is not None:
            self.behaviour.restarted(self.clock.now())

    def meet(self, conditions: Iterable[str], *, holds: bool) -> None:
        """Set conditions true or false. Raises ValueError for one that no write needs."""
        for name in conditions:
            if name not in self.conditions:
                known = ", ".join(self.conditions) or "none"
                raise ValueError(f"no write needs the condition `{name[:40]}`; there are {known}")
            self.conditions[name] = holds

    def complain(self, rule: str, what: str, source: Source | None = None) -> None:
        """Record a violation of the manual, if the device is strict."""
        if self.strict and len(self.complaints) < MOST_COMPLAINTS:
            self.complaints.append(Complaint(rule, what, source))
            self.on_complaint(self.complaints[-1])

    def complain_of(self, refusal: Refusal) -> None:
        """Record a violation that was refused."""
        source = None if refusal.point is None else refusal.point.source
        self.complain(refusal.kind.replace("_", " "), refusal.why, source)

    def _unreadable(self, area: Area, address: int) -> Refusal:
        points = self.layout.readers.get(area, {}).get(address, ())
        if points:
            return Refusal("write_only", f"{label(points[0])} can only be written", points[0])
        return Refusal("address", f"nothing is at {area[0]} {address}")

    def _command(self, area: Area, cells: Mapping[int, int]) -> Command | None:
        if len(cells) != 1:
            return None
        (address, value), *_ = cells.items()
        command = self.layout.commands.get((area, address))
        return command if command is not None and command.value in (None, value) else None

    def _touched(self, area: Area, cells: Mapping[int, int]) -> list[Point]:
        """Return the existing points in these cells. Raises Refusal where there is none."""
        writers, touched = self.layout.writers.get(area, {}), dict[str, Point]()
        steps = self.layout.steps.get(area, ())
        for address in cells:
            points = [point for point in writers.get(address, ()) if self.memory.exists(point)]
            if not points and address in steps:
                continue
            if not points:
                if absent := writers.get(address):
                    raise self._absent(absent)
                raise Refusal("address", f"nothing is at {area[0]} {address}")
            writable = [point for point in points if point.writable]
            if not writable:
                raise Refusal("read_only", f"{label(points[0])} can only be read", points[0])
            touched.update((point.name, point) for point in writable)
        return list(touched.values())

    def _number(self, point: Point, cells: Mapping[int, int], together: set[str]) -> int:
        """Return the new raw number of a point after a write. Raises Refusal for a part of a point."""
        place: Cells = self.layout.written[point.name]
        if missing := [address for address in place.addresses if address not in cells]:
            if self.strict:
                self.complain("a part of a number", f"{label(point)} is written without {missing[0]}", point.source)
            raise Refusal("part", f"the write has a part of {label(point)}", point)
        if left := [name for name in point.write_with if name not in together and name in self.layout.points]:
            raise Refusal("together", f"{label(point)} is written together with {left[0]}", point)
        held = [cells[address] for address in place.addresses]
        words: Sequence[int] = held if place.size == 1 else split(joined_cells(held, place.size), point.words)
        raw = raw_of(point, words)
        if point.fixed is not None and point.bits is not None and insert(point, words[0], raw) != words[0]:
            raise Refusal("out_of_range", f"the bits beside {label(point)} are not those that are fixed", point)
        return _on_a_step(point, raw)

    def _check(self, point: Point, raw: int, numbers: Mapping[str, int]) -> None:
        """Raise Refusal if a point must not take a raw number now; `numbers` are written with it, by name."""
        for condition in point.conditions:
            if not self.conditions[condition]:
                raise Refusal("condition", f"{label(point)} is written only when {condition}", point)
        if point.text is not None:
            return
        new = {name: codec.setting_of(self.layout.points[name], number) for name, number in numbers.items()}
        settings = ChainMap(new, self.memory.settings) if new else self.memory.settings  # type: ignore[arg-type]  # read only
        try:
            codec.check(point, raw, settings)
        except CodecError as error:
            if point.bits is not None and raw == self.memory.raw(point.name):
                return  # the bits of another point in the word that the request does not change
            raise Refusal(error.status, f"{label(point)} does not take raw {raw}", point) from error

    def _remember(self, point: Point, keep: bool | None) -> None:
        """Remember a point's number before its first write that is lost at a restart, and count wear."""
        if point.keeps == "yes" or (point.keeps == "choice" and keep):
            self._lost.pop(point.name, None)
            self._wears(point.name, point.source)
        elif point.keeps is not None:
            self._lost.setdefault(point.name, self.memory.raw(point.name))

    def _wears(self, name: str, source: Source) -> None:
        """Count a write that wears the memory; complain if such writes are cyclic."""
        self.wear[name] = self.wear.get(name, 0) + 1
        times = self._stored_at.setdefault(name, deque(maxlen=CYCLIC[0]))
        times.append(self.clock.now())
        if len(times) == CYCLIC[0] and times[-1] - times[0] < CYCLIC[1]:
            what = f"{name} wrote the memory {CYCLIC[0]} times within {times[-1] - times[0]:.0f} s"
            self.complain("cyclic writes", f"{what}, and each write wears it", source)
            times.clear()

    def _absent(self, points: Sequence[Point]) -> Refusal:
        conditions = dict.fromkeys(condition_text(point.when, self.layout.points) for point in points)
        return Refusal("absent", f"{label(points[0])} exists only when {' or '.join(conditions)}", points[0])

    def _look_at_conditions(self, area: Area, addresses: Sequence[int]) -> None:
        """Raise Refusal if every point at an address exists only under a condition that is false now."""
        for address in addresses:
            points = self.layout.readers.get(area, {}).get(address, ())
            if points and not any(map(self.memory.exists, points)):
                raise self._absent(points)

    def _look_at_parts(self, area: Area, addresses: Sequence[int]) -> None:
        inside = set(addresses)
        for point in {p.name: p for a in addresses for p in self.layout.readers.get(area, {}).get(a, ())}.values():
            if self.memory.exists(point) and not inside.issuperset(self.layout.cells[point.name].addresses):
                self.complain("a part of a number", f"a read has a part of {label(point)}", point.source)


def _on_a_step(point: Point, raw: int) -> int:
    """Return the raw number that the device stores: rounded down to its step."""
    start, step = max(((start, step) for start, step in point.steps if start <= raw), default=(0, 1))
    return with_fixed(point, start + (raw - start) // step * step) if point.steps and point.text is None else raw


def by_unit(devices: Iterable[SimulatedDevice]) -> dict[int, SimulatedDevice]:
    """Return the devices of a line by unit."""
    return {device.unit: device for device in devices}
