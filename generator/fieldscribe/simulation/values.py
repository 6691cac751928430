"""The values of a simulated device by name, in units, as a test or a person writes and reads them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, MutableMapping
from decimal import Decimal
from fractions import Fraction
from typing import Protocol

from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError
from fieldscribe.arithmetic.texts import text_of
from fieldscribe.conversation.selection import choose_point
from fieldscribe.conversation.typed_values import read_value
from fieldscribe.model import Point
from fieldscribe.simulation.memory import LOCK, Memory
from fieldscribe.user_errors import UnclearError

Value = str | int | float
"""A name of an enum or of a special code, a text, a whole number, or a number in the unit."""


class Plant(Protocol):
    """The quantities of a behaviour, which no point holds."""

    @property
    def plant(self) -> Mapping[str, Fraction]:
        """The quantities by name."""

    def set(self, name: str, number: Fraction) -> None:
        """Let a quantity be a number from now on."""

    def touch(self) -> None:
        """Take notice that points were written."""


class Values(MutableMapping[str, Value]):
    """The values by name or code; writing one asks no rule, so that a device may hold what it would refuse.

    The quantities of a behaviour are values, too.
    """

    def __init__(self, memory: Memory, advance: Callable[[], None], plant: Plant | None = None) -> None:
        self._memory, self._advance, self._plant = memory, advance, plant

    def __getitem__(self, name: str) -> Value:
        with LOCK:
            self._go_on()
            if self._plant is not None and name in self._plant.plant:
                return _plain(self._plant.plant[name])
            point = self._point(name)
            return value_of(point, self._memory.raw(point.name), self._memory.settings)

    def __setitem__(self, name: str, value: Value | Fraction | Decimal) -> None:
        with LOCK:
            self._go_on()
            if self._plant is not None and name in self._plant.plant:
                self._plant.set(name, _number(name, value))
            else:
                point = self._point(name)
                self._memory.put(point.name, raw_for(point, value, self._memory.settings))
            self._go_on()

    def __delitem__(self, name: str) -> None:
        raise TypeError("a device has all of its points")

    def __iter__(self) -> Iterator[str]:
        return iter(self._memory.layout.points)

    def __len__(self) -> int:
        return len(self._memory.layout.points)

    def _go_on(self) -> None:
        """Bring the memory to the present, and let what is written now have its effect."""
        if self._plant is not None:
            self._plant.touch()
        self._advance()

    def _point(self, name: str) -> Point:
        points = self._memory.layout.points
        try:
            return points[name] if name in points else points[choose_point(self._memory.layout.device, name).name]
        except UnclearError as error:
            raise KeyError(f"{error.message}; {error.hint}".rstrip("; ")) from None


def value_of(point: Point, raw: int, settings: codec.Settings) -> Value:
    """Return the value of a raw number: a name, a text, or a number in the unit."""
    special = point.special(raw)
    if special is not None:
        return special.name
    if point.text is not None:
        try:
            return text_of(point.text, raw)
        except UnicodeDecodeError:
            return raw
    if point.enum is not None:
        return next((entry.name for entry in point.enum.entries if entry.raw == raw), raw)
    try:
        value = codec.decode(point, raw, settings)
    except CodecError:
        return codec.float_of(point, raw) if point.info.floating else raw
    return float(value) if point.info.floating else _plain(value)


def _number(name: str, value: Value | Fraction | Decimal) -> Fraction:
    """Return the number that a quantity shall be. Raises ValueError for what is none."""
    try:
        return Fraction(value)
    except (ValueError, OverflowError, ZeroDivisionError):
        raise ValueError(f"{name} is a number, not {value}") from None


def _plain(value: Fraction) -> int | float:
    return int(value) if value.denominator == 1 else float(value)


def raw_for(point: Point, value: Value | Fraction | Decimal, settings: codec.Settings) -> int:
    """Return the raw number of a value. Raises ValueError if the bits cannot hold it, or the point has no such name."""
    try:
        if isinstance(value, str):
            typed = read_value(point, value)
            raw = typed.raw if typed.value is None else codec.encode(point, typed.value, settings)
        elif point.form in ("enum", "flags", "bit", "digits"):
            raw = int(value)
        else:
            raw = codec.encode(point, Fraction(value), settings)
    except UnclearError as error:
        raise ValueError(f"{error.message}; {error.hint}".rstrip("; ")) from None
    except (CodecError, OverflowError) as error:
        raise ValueError(f"{point.name} cannot hold {value}: {error}") from None
    if point.text is None and not point.least <= raw <= point.greatest:
        raise ValueError(f"{point.name} cannot hold {value}")
    return raw
