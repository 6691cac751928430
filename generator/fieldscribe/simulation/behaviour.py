"""Runs the rules of a behaviour on a simulated device, in exact rationals, by the simulator's clock.

Numbers change linearly between events, so the times of the next events can be computed: a ramp ends, a number reaches
a limit of a condition, a delay ends. Time counts in whole milliseconds.
"""

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from math import floor

from fieldscribe.arithmetic.codec import CodecError, encode, rule_in_force, setting_of
from fieldscribe.arithmetic.words import mask_of
from fieldscribe.model import Point
from fieldscribe.simulation.behaviour_rules import TIME, ZERO, Amount, Pair, Ref, Rule, Rules, Step
from fieldscribe.simulation.memory import Memory

SAMPLE = 10
"""The greatest age of a moving number when a request reads it, in milliseconds."""

SILENCE = "silent_master"
"""The quantity that is 1 while the master is silent, that is, after its last telegram."""

_MOST_PASSES = 8
_MOST_EVENTS = 5_000
_DECIMALS = 10**9
_LARGEST = Fraction(10**20)
"""Numbers are rounded to 10^-9 and limited to 10^20, so that they do not grow."""


class Behaviour:
    """Applies the rules of a behaviour to the memory of one device. Times `now` are in seconds of its clock."""

    def __init__(self, rules: Rules, memory: Memory) -> None:
        self.rules, self._memory = rules, memory
        self._points: Mapping[str, Point] = memory.layout.points
        self._rules = [rule for rule in rules.rules if rule.ref.name in {*self._points, *rules.plant}]
        self._readers = _readers(self._rules, self._points)
        self._plant: dict[str, Fraction] = {}
        self._begin(0)
        self.touch()
        for name in rules.start.keys() & self._points.keys():
            self._put(Ref(name, "value"), rules.start[name])

    @property
    def plant(self) -> Mapping[str, Fraction]:
        """The quantities that no point holds, by name."""
        return self._plant

    def set(self, name: str, number: Fraction) -> None:
        """Set a quantity."""
        self._numbers.pop(Ref(name, "plant"), None)
        self._plant[name] = number
        self.touch()

    def touch(self) -> None:
        """Evaluate all rules again at the next step: anything may have changed."""
        self._exact = True
        self._stale.update(range(len(self._rules)))

    def advance(self, now: float) -> None:
        """Update the memory to the time `now`; called before each access."""
        self._advance(_milliseconds(now) - self._origin)

    def written(self, points: Sequence[Point], now: float) -> None:
        """Evaluate the rules after a write; the memory has the new numbers."""
        for point in points:
            self._stale |= self._readers.get(point.name, frozenset())
        self.advance(now)

    def end_silence(self, now: float) -> None:
        """Note a telegram of the master: delays on its silence start anew."""
        self.advance(now)
        for number in (ZERO, Fraction(1)) if SILENCE in self._plant else ():
            self._put(Ref(SILENCE, "plant"), number)
            self._settle()

    def restarted(self, now: float) -> None:
        """Restart: moving numbers start as before, all others have what the memory kept."""
        self._begin(_milliseconds(now))
        for rule in self._rules:
            if rule.ref.kind == "value" and rule.ref.name in self.rules.start:
                self._put(rule.ref, self.rules.start[rule.ref.name])
        self.advance(now)

    def _begin(self, origin: int) -> None:
        self._origin, self._now = origin, 0
        self._numbers: dict[Ref, Fraction] = {}
        self._before: dict[Ref, Fraction] = {}
        self._slopes: dict[Ref, Fraction] = {}
        self._held: dict[Ref, int] = {}
        self._since: dict[Step, int] = {}
        self._done: set[Step] = set()
        self._next: int | None = None
        self._exact = False
        self._stale: set[int] = set(range(len(self._rules)))
        """The indices of the rules to evaluate."""
        self._waiting: set[int] = set()
        """The rules that are in a delay."""
        self._plant.update((name, quantity.start) for name, quantity in self.rules.plant.items())

    def _advance(self, now: int) -> None:
        if self._stale:
            self._settle()
        for _ in range(_MOST_EVENTS):
            if self._next is None or self._next > now:
                break
            self._go(self._next)
            self._settle()
        if not self._slopes and TIME not in self._readers:
            self._now = max(self._now, now)
        elif now - self._now >= (1 if self._exact else SAMPLE):
            self._go(now)
            self._settle()
        self._exact = False

    def _go(self, now: int) -> None:
        """Move all numbers to the time."""
        elapsed = Fraction(now - self._now, 1000)
        self._now = now
        self._stale |= self._waiting | self._readers.get(TIME, frozenset())
        for ref, slope in self._slopes.items():
            self._before[ref] = number = self._read(ref)[0]
            self._put(ref, number + slope * elapsed)

    def _settle(self) -> None:
        """Apply the rules until nothing changes at this time, and plan the next event."""
        for _ in range(_MOST_PASSES):
            for place, rule in enumerate(self._rules):
                if place in self._stale:
                    self._stale.discard(place)
                    self._apply(rule)
            if not self._stale:
                break
        self._stale.clear()
        self._before.clear()
        self._next = min(self._events(), default=None)

    def _apply(self, rule: Rule) -> None:
        """Apply the move of a rule that counts."""
        ready = [step for step in rule.steps if self._is_ready(step)]
        step = next((step for step in ready if not (step.once and step in self._done)), None)
        number = self._read(rule.ref)[0]
        aim: Pair = number, ZERO
        if step is not None:
            aim = self._aim(rule.ref, step, number)
        self._done.update(step for step in ready if step.once)
        if aim != (number, self._slopes.pop(rule.ref, ZERO)) or (step is not None and self._has_other_scale(rule.ref)):
            self._put(rule.ref, aim[0])
        if aim[1]:
            self._slopes[rule.ref] = aim[1]

    def _has_other_scale(self, ref: Ref) -> bool:
        """Return True if another point changed the scale, so that the raw number no longer means the number."""
        point = self._points.get(ref.name) if ref.kind == "value" else None
        if point is None or not point.scale_arguments:
            return False
        return self._encoded(ref, point, self._read(ref)[0]) != self._memory.raw(ref.name)

    def _aim(self, ref: Ref, step: Step, number: Fraction) -> Pair:
        """Return the number and slope that a move gives now; without a result the number stays."""
        found = self._result(step.target)
        if found is None:
            return number, ZERO
        target, slope = found
        if not step.rates:
            return _rounded(target), ZERO if step.once else slope
        target = _rounded(target)
        arrived = (self._before.get(ref, number) - target) * (number - target) <= 0
        rate = self._rate(step, up=target > number)
        if rate is None or (arrived and abs(slope) <= rate):
            return target, slope
        return number, rate if target > number or (arrived and slope > 0) else -rate

    def _rate(self, step: Step, *, up: bool) -> Fraction | None:
        """Return the rate of a move; None if it happens at once."""
        found = self._result(step.rates[0 if up else -1])
        return None if found is None else abs(found[0])

    def _result(self, amount: Amount) -> Pair | None:
        """Return the result of an expression and its slope; None if it has none."""
        try:
            return amount.at(self._read)
        except ArithmeticError:
            return None

    def _is_ready(self, step: Step) -> bool:
        """Return True if the condition of a move has been true for its delay."""
        if step.clauses and not any(
            all(test.holds(self._read(test.ref)[0]) for test in clause) for clause in step.clauses
        ):
            self._since.pop(step, None)
            self._done.discard(step)
            return False
        return self._due(step, self._since.setdefault(step, self._now)) <= self._now

    def _due(self, step: Step, since: int) -> int:
        """Return the time at which a move is due whose condition became true at `since`."""
        delay = None if step.delay is None else self._result(step.delay)
        return since if delay is None else since - floor(-delay[0] * 1000)

    def _events(self) -> Iterator[int]:
        """Yield the times after now at which the result of a rule may change."""
        self._waiting.clear()
        moving = set(self._readers.get(TIME, ()))
        moving.update(*(self._readers.get(ref.name, ()) for ref in self._slopes))
        for place, rule in enumerate(self._rules):
            for step in rule.steps if place in moving or rule.delays else ():
                since = self._since.get(step)
                if step.delay is not None and since is not None and (due := self._due(step, since)) > self._now:
                    self._waiting.add(place)
                    yield due
                for test in {test for clause in step.clauses for test in clause}:
                    for constant in test.constants:
                        yield from self._meeting(self._read(test.ref), (constant, ZERO))
                if step.rates and since is not None and rule.ref in self._slopes:
                    target = self._result(step.target)
                    yield from () if target is None else self._meeting(self._read(rule.ref), target)

    def _meeting(self, first: Pair, second: Pair) -> Iterator[int]:
        """Yield the first millisecond after two numbers become equal, if they do."""
        approach = second[1] - first[1]
        if approach and (wait := (first[0] - second[0]) / approach) >= 0:
            yield self._now + floor(wait * 1000) + 1

    def _read(self, ref: Ref) -> Pair:
        """Return a number and its slope; a write to a moving number takes precedence."""
        if ref.kind == "time":
            return Fraction(self._now, 1000), Fraction(1)
        if ref.kind == "plant":
            return self._numbers.get(ref, self._plant[ref.name]), self._slopes.get(ref, ZERO)
        if ref.name not in self._points:  # of another variant
            return ZERO, ZERO
        held = self._raw(ref)
        if self._held.get(ref) == held:
            return self._numbers[ref], self._slopes.get(ref, ZERO)
        return self._decoded(ref, held), ZERO

    def _raw(self, ref: Ref) -> int:
        """Return the number of a point or a flag."""
        raw = self._memory.raw(ref.name)
        flag = ref.flag
        if flag is None:
            return raw
        bits = raw >> flag.low & mask_of(flag.width)
        return bits if flag.active or flag.width > 1 else 1 - bits

    def _decoded(self, ref: Ref, held: int) -> Fraction:
        """Return the value of a raw number; a special code counts as a number."""
        point = self._points[ref.name]
        if ref.kind != "value":
            return Fraction(held)
        if point.info.floating:
            return Fraction(setting_of(point, held))
        try:
            ratio, offset = rule_in_force(point, self._memory.settings)
        except CodecError:
            return Fraction(held)
        return (held - offset) / ratio

    def _put(self, ref: Ref, number: Fraction) -> None:
        """Set a point or a quantity to the nearest number that its bits allow."""
        number = _rounded(number)
        self._numbers[ref] = number
        self._stale |= self._readers.get(ref.name, frozenset())
        if ref.kind == "plant":
            self._plant[ref.name] = number
            return
        point = self._points[ref.name]
        raw, flag = self._encoded(ref, point, number), ref.flag
        self._held[ref] = raw
        if flag is not None:
            bits = raw if flag.active or flag.width > 1 else 1 - raw
            raw = self._memory.raw(ref.name) & ~mask_of(flag.width, flag.low) | bits << flag.low
        self._memory.put(ref.name, raw)

    def _encoded(self, ref: Ref, point: Point, number: Fraction) -> int:
        flag = ref.flag
        low, high = (point.least, point.greatest) if flag is None else (0, mask_of(flag.width))
        try:
            raw = encode(point, number, self._memory.settings) if ref.kind == "value" else round(number)
        except CodecError:
            raw = round(number)
        return raw if point.info.floating else min(max(raw, low), high)


def _readers(rules: Sequence[Rule], points: Mapping[str, Point]) -> dict[str, frozenset[int]]:
    """Return the indices of the rules that read a point or a quantity, or whose point needs it for its scale."""
    readers: dict[str, set[int]] = {}
    for place, rule in enumerate(rules):
        for ref in (rule.ref, *(ref for step in rule.steps for ref in step.refs)):
            needed = points[ref.name].scale_arguments if ref.name in points else ()
            for name in (ref.name, *needed):
                readers.setdefault(name, set()).add(place)
    return {name: frozenset(places) for name, places in readers.items()}


def _milliseconds(seconds: float) -> int:
    """Return the whole milliseconds; sums of fractions may be a little short of one."""
    return round(seconds * 1_000_000) // 1000


def _rounded(number: Fraction) -> Fraction:
    number = min(max(number, -_LARGEST), _LARGEST)
    return number if _DECIMALS % number.denominator == 0 else Fraction(round(number * _DECIMALS), _DECIMALS)
