"""Reads points of a device, and says their values with names and units."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from fieldscribe.conversation.lookup import find
from fieldscribe.conversation.meanings import Meanings
from fieldscribe.conversation.selection import choose_point
from fieldscribe.model import Device
from fieldscribe.text import shortened
from fieldscribe.user_errors import UnclearError

if TYPE_CHECKING:
    from fieldscribe_runtime import AnyDevice

GOOD = ("ok", "special")
"""The states of points that hold something; all others are errors."""


class Reading(NamedTuple):
    """What a point holds: its value as a number or text for programs, and as text with its unit for people.

    `value` is None where there is none; `status` and `detail` say why.
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


def chosen(model: Device, names: list[str]) -> str | list[str]:
    """Return what `read_many` takes: the one group that is named, or the points of all that is named.

    Raises UnclearError.
    """
    groups = {group.name for group in model.groups} - {point.item for point in model.points}
    if len(names) == 1 and names[0] in groups:
        return names[0]
    items: dict[str, None] = {}
    for name in names:
        if name in groups:
            inside = [point for point in model.points if point.group == name]
            items.update(dict.fromkeys(point.item for point in inside if point.readable and point.generated))
        else:
            items[_point(model, name, groups)] = None
    return list(items)


def _point(model: Device, name: str, groups: set[str]) -> str:
    """Return the name in code of a point that is read. Raises UnclearError, for a group that is nearly named, too."""
    from difflib import get_close_matches

    near = [] if find(model, name) else get_close_matches(name, groups, 1)
    if near:
        raise UnclearError(f"{model.id} has no point or group `{shortened(name)}`", f"did you mean `{near[0]}`?")
    point = choose_point(model, name)
    if not point.readable:
        raise UnclearError(f"`{shortened(name)}` is only written: {model.id} does not tell what it holds")
    return point.item


class Reader:
    """Reads points of one device again and again, and says what they hold as `decode` does."""

    def __init__(self, model: Device, device: AnyDevice) -> None:
        self._model, self._device = model, device
        self._points = {point.item: point for point in model.points}
        self._meanings: dict[str, Meanings] = {}

    def read(self, what: str | list[str]) -> list[Reading]:
        """Read a group or points with as few requests as the device allows.

        Raises FieldscribeError for a line that loses all.
        """
        values = self._device.read_many(what, errors="return")
        rows = self._device.rows(values)
        return [Reading(**row, text=self._text(row, value)) for row, value in zip(rows, values.values(), strict=True)]

    def _text(self, row: dict[str, Any], value: Any) -> str:
        """Return a value with its unit; of one whose scale other points decide, as many digits as its number has."""
        if row["status"] not in GOOD:
            point = self._points.get(row["name"])
            if point is not None and not point.generated:
                return f"documented only: {point.reason or 'the manual leaves it open'}"
            label = f"{row['code']} {row['name']}" if row["code"] else row["name"]
            return str(row["detail"]).removeprefix(f"{label}: ")
        facts = self._device.point(row["name"]).facts
        if row["raw"] is None and not isinstance(value, (int, float)):
            return str(row["value"])
        if row["raw"] is None:
            number = f"{value:.12g}" if facts.display is None else f"{value:.{facts.display}f}"
            return f"{number} {facts.unit}".rstrip()
        if facts.item not in self._meanings:
            self._meanings[facts.item] = Meanings(self._model, self._points[facts.item])
        return self._meanings[facts.item].text(row["raw"], {})
