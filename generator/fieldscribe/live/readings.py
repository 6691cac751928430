"""Reads points of a device, and returns their values with names and units."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from fieldscribe_runtime import AnyDevice, FieldscribeError, LineError

from fieldscribe.conditions import absent
from fieldscribe.conversation.lookup import find
from fieldscribe.conversation.meanings import Meanings
from fieldscribe.conversation.selection import choose_point
from fieldscribe.diagnostics import UnclearError
from fieldscribe.model import Device, Point
from fieldscribe.text import shortened

_MOST_SILENT = 2
"""The most points without an answer before the first answer."""


class PartialReads:
    """Reads points of one device. `gone` is the error if the line was lost in between."""

    def __init__(self, device: AnyDevice) -> None:
        self._device = device
        self._answering = ""
        """A point that the device answered before: reading it again tells a lost point from a lost line."""
        self.gone: FieldscribeError | None = None

    def read(self, what: str | Sequence[str], items: Sequence[str]) -> dict[str, Any]:
        """Return the value or the error of each point by name; `what` are these points, or their group.

        Raises FieldscribeError if nothing answers.
        """
        try:
            return self._values_of(what)
        except FieldscribeError as error:
            if not error.lost or isinstance(error, LineError):
                raise
            return self._singly(items, error)

    def _values_of(self, what: str | Sequence[str]) -> dict[str, Any]:
        values: dict[str, Any] = self._device.read_many(what, errors="return")
        good = (name for name, value in values.items() if not isinstance(value, FieldscribeError))
        self._answering = next(good, self._answering)
        return values

    def _singly(self, items: Sequence[str], error: FieldscribeError) -> dict[str, Any]:
        values: dict[str, Any] = {}
        silent = 0
        for item in items:
            try:
                values.update(self._values_of([item]) if len(items) > 1 and self.gone is None else {item: error})
            except FieldscribeError as lost:
                if not lost.lost:
                    raise
                values[item] = error = lost
            if values.get(item) is error and self.gone is None:
                silent += 1
                self.gone = self._lost_line(error, silent)
        if not self._answering:
            raise error
        return values

    def _lost_line(self, error: FieldscribeError, silent: int) -> FieldscribeError | None:
        """Return the error of the line if nothing answers any more; None if only a point does not."""
        if isinstance(error, LineError) or not self._answering:
            return error if silent >= _MOST_SILENT or isinstance(error, LineError) else None
        try:
            self._values_of([self._answering])
        except FieldscribeError as lost:
            return lost
        return None


GOOD = ("ok", "special")
"""The states of points that hold something; all others are errors."""


NOT_THERE = ("no_access", "bad_link", "behind_end")
"""The states of points that a device does not have, or its link does not carry."""


class Reading(NamedTuple):
    """The reading of a point: its value for programs, and as text with its unit.

    Without a value, `value` is None, and `status` and `detail` have the reason.
    """

    name: str
    code: str | None
    value: Any
    unit: str
    text: str
    raw: int | None
    status: str
    detail: str

    @property
    def label(self) -> str:
        """Return the code and the name."""
        return f"{self.code} {self.name}" if self.code else self.name

    def as_data(self) -> dict[str, Any]:
        """Return the same for JSON and CSV."""
        return self._asdict()


class Choice(NamedTuple):
    """The points to read, by their names in code, and the names of those that come only from a group."""

    items: list[str]
    by_group: frozenset[str]


def chosen(model: Device, names: list[str]) -> Choice:
    """Return the named points, or those of a named group, record or array. Raises UnclearError."""
    groups = {group.name for group in model.groups} - {point.item for point in model.points}
    items: dict[str, None] = {}
    by_group: set[str] = set()
    for name in names:
        members = [point for point in model.points if point.group == name] if name in groups else _elements(model, name)
        inside = [point for point in members if may_be_read(model, point)]
        if not members:
            items[_point(model, name, groups)] = None
        elif not inside:
            raise UnclearError(f"no point of {name} can be read", "")
        else:
            by_group.update(point.name for point in inside if point.item not in items)
            items.update(dict.fromkeys(point.item for point in inside))
    return Choice(list(items), frozenset(by_group))


def _elements(model: Device, name: str) -> list[Point]:
    """Return the points of a record, or those of an array or of sets, by their code or common name."""
    if any(name == point.item for point in model.points):
        return []
    found = {id(match.point) for match in find(model, name)}
    repeated = [point for point in model.points if point.index is not None or point.set is not None]
    coded = [point for point in repeated if id(point) in found and point.code is not None]
    if len(coded) < max(2, len(found)):
        coded = [point for point in repeated if point.name in _names(name, point)]
    return [point for point in model.points if point.record == name] or coded


def _names(name: str, point: Point) -> tuple[str, ...]:
    """Return the names that a point with the plain name may have by its set and its index."""
    in_set = f"{name}_set_{point.set}"
    return in_set, f"{name}_index_{point.index}", f"{in_set}_index_{point.index}"


def may_be_read(model: Device, point: Point) -> bool:
    """Return True if a point is read with its group: a point of a variant needs that variant to be chosen."""
    variant = point.variant
    is_there = variant is None or model.variants[variant.axis] == (variant.value,)
    return is_there and point.readable and point.generated and not absent(point.when, model.variants)


def _point(model: Device, name: str, groups: set[str]) -> str:
    """Return the name in code of a readable point. Raises UnclearError, also for a misspelt group."""
    matches = find(model, name)
    if not matches and "=" in name:
        raise UnclearError(f"`{shortened(name)}` is no point", "`fieldscribe write` writes values")
    if not matches and len(name.split()) > 1:
        raise UnclearError(f"`{shortened(name)}` is no point", "give each point as an argument, without quotes")
    point = choose_point(model, name, groups=groups)
    if not point.readable:
        raise UnclearError(f"`{shortened(name)}` is only written: {model.id} does not tell what it holds")
    return point.item


def in_words(error: FieldscribeError, *, alone: bool = False) -> str:
    """Return a runtime error for the command line; `alone` leaves out what was requested.

    Arguments of the device's constructor are options here.
    """
    subjects = [] if alone else [error.group and f"group {error.group}", error.point]
    option = "with" if error.status == "bad_base" else "variant"
    advice = error.undecided and f"give --{option} {error.undecided}=VALUE"
    return ": ".join(filter(None, [*subjects, error.reason, advice]))


class Reader:
    """Reads points of one device repeatedly, with texts as in `decode`."""

    def __init__(self, model: Device, device: AnyDevice) -> None:
        self._model, self._device = model, device
        self._points = {point.item: point for point in model.points}
        self._meanings: dict[str, Meanings] = {}

    def read(self, choice: Choice) -> list[Reading]:
        """Read points with as few requests as the device allows; leaves out points of a group that the device lacks.

        A point without a valid answer has the error. Raises FieldscribeError if the line is lost.
        """
        items = self._existing(choice)
        values = PartialReads(self._device).read(items, items)
        rows = zip(self._device.rows(values), values.values(), strict=True)
        readings = [Reading(**row, text=self._text(row, value)) for row, value in rows]
        return [one for one in readings if one.name not in choice.by_group or one.status not in NOT_THERE]

    def _existing(self, choice: Choice) -> list[str]:
        """Return the points, except points of groups whose condition is false now."""
        inside = [self._device.POINTS[item] for item in choice.items if item in self._device.POINTS]
        points: list[Any] = [point for point in inside if point.facts.name in choice.by_group]
        try:
            existing = self._device._run(self._device._existing_steps(points))
        except FieldscribeError:
            return choice.items  # each of them fails when it is read
        gone = {point.facts.item for point in points} - {point.facts.item for point in existing}
        return [item for item in choice.items if item not in gone]

    def _text(self, row: dict[str, Any], value: Any) -> str:
        """Return a value with its unit; if other points decide the scale, with as many digits as needed."""
        if row["status"] not in GOOD:
            point = self._points.get(row["name"])
            if point is not None and not point.generated:
                return f"documented only: {point.reason or 'the manual leaves it open'}"
            return row["detail"] if isinstance(value, float) else in_words(value, alone=True)
        facts = self._device.point(row["name"]).facts
        if row["raw"] is None and not isinstance(value, (int, float)):
            return str(row["value"])
        if row["raw"] is None:
            number = f"{value:.12g}" if facts.display is None else f"{value:.{facts.display}f}"
            return f"{number} {facts.unit}".rstrip()
        if facts.item not in self._meanings:
            self._meanings[facts.item] = Meanings(self._model, self._points[facts.item])
        return self._meanings[facts.item].text(row["raw"], {})
